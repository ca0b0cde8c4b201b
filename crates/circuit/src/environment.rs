//! An environment: a circuit at the level of logic on the other side of a circuit's ports, with memories.

use crate::elaborate::MemoryPorts;
use crate::waves::{ClockRun, ClockStep, WaveError};
use crate::{NetId, Netlist};

#[derive(Clone, Debug)]
pub struct Environment {
    run: ClockRun,
    ports: Vec<MemoryPorts>,
    /// The words of each memory, each in its lowest bits.
    memories: Vec<Vec<u128>>,
    inputs: Vec<u64>,
    /// The number of inputs that are declared.
    declared: [usize; 2],
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MemoryAccess {
    pub reads: Vec<usize>,
    /// The words that it takes at the edge, each with its address, in order.
    pub writes: Vec<(usize, u128)>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EnvironmentFault {
    Clock(WaveError),
    OtherClock,
    Circle,
}

impl Environment {
    /// Missing first words of memories are 0.
    pub fn new(netlist: &Netlist, ports: Vec<MemoryPorts>, contents: Vec<Vec<u128>>) -> Result<Self, EnvironmentFault> {
        let step = Self::step(netlist, &ports)?;
        let memories = ports.iter().zip(contents).map(|(memory, mut words)| {
            words.resize(memory.words, 0);
            words
        });
        let memories = memories.collect();
        let read: usize = ports.iter().flat_map(|memory| memory.reads.iter().map(|[_, data]| data.len())).sum();
        let written: usize = ports
            .iter()
            .map(|memory| {
                let reads = memory.reads.iter().map(|[address, _]| address.len());
                let writes = memory.writes.iter().flat_map(|ports| ports.iter().map(std::ops::Range::len));
                reads.chain(writes).sum::<usize>()
            })
            .sum();
        let declared = [step.inputs.len() - read, step.outputs.len() - written];
        let inputs = vec![0; step.inputs.len()];
        Ok(Self { run: ClockRun::new(step), ports, memories, inputs, declared })
    }

    pub(crate) fn step(netlist: &Netlist, ports: &[MemoryPorts]) -> Result<ClockStep, EnvironmentFault> {
        let clocks = ports.iter().flat_map(|memory| memory.writes.iter().map(|[.., clk]| clk.start));
        let drivers: Vec<NetId> = clocks.map(|at| netlist.pins(netlist.outputs()[at])[0]).collect();
        // The clocks of memories are no data of the step.
        let mut cut = netlist.clone();
        for &at in ports.iter().flat_map(|memory| memory.writes.iter().map(|[.., clk]| &clk.start)) {
            let zero = cut.add_constant(false);
            let output = cut.outputs()[at];
            cut.drive(output, 0, zero);
        }
        let step = ClockStep::of(&cut).map_err(EnvironmentFault::Clock)?;
        let clock = step.clock.map(|at| netlist.inputs()[at]);
        if drivers.windows(2).any(|pair| pair[0] != pair[1]) || clock.zip(drivers.first()).is_some_and(|(a, b)| a != *b)
        {
            return Err(EnvironmentFault::OtherClock);
        }
        if step.clock.is_some() && !step.rises {
            return Err(EnvironmentFault::OtherClock);
        }
        Ok(step)
    }

    pub fn apply(&mut self, inputs: &[bool]) -> Result<(), EnvironmentFault> {
        assert_eq!(inputs.len(), self.declared[0], "a value for each declared input");
        for (own, &value) in self.inputs.iter_mut().zip(inputs) {
            *own = if value { !0 } else { 0 };
        }
        let reads: usize = self.ports.iter().map(|memory| memory.reads.len()).sum();
        for _ in 0..reads + 2 {
            self.run.apply(&self.inputs);
            if !self.read() {
                return Ok(());
            }
        }
        Err(EnvironmentFault::Circle)
    }

    fn read(&mut self) -> bool {
        let mut changed = false;
        for (memory, words) in self.ports.iter().zip(&self.memories) {
            for [address, data] in &memory.reads {
                let word = words.get(number(&self.run, address) as usize).copied().unwrap_or(0);
                for (at, bit) in data.clone().zip((0..memory.width).rev()) {
                    let value = if word >> bit & 1 == 1 { !0 } else { 0 };
                    changed |= std::mem::replace(&mut self.inputs[at], value) != value;
                }
            }
        }
        changed
    }

    pub fn advance(&mut self) {
        for (memory, words) in self.ports.iter().zip(&mut self.memories) {
            for (address, word) in written(&self.run, memory) {
                words[address] = word;
            }
        }
        self.run.advance();
    }

    /// What each memory is asked for, in order of their declarations.
    pub fn accesses(&self) -> Vec<MemoryAccess> {
        let access = |memory: &MemoryPorts| MemoryAccess {
            reads: memory.reads.iter().map(|[address, _]| number(&self.run, address) as usize).collect(),
            writes: written(&self.run, memory).collect(),
        };
        self.ports.iter().map(access).collect()
    }

    pub fn words(&self) -> &[Vec<u128>] {
        &self.memories
    }

    /// The declared outputs as they are, in order of the ports, the most significant bit of a port first.
    pub fn outputs(&self) -> impl Iterator<Item = bool> + '_ {
        (0..self.declared[1]).map(|at| self.run.output(at) & 1 == 1)
    }
}

fn written(run: &ClockRun, memory: &MemoryPorts) -> impl Iterator<Item = (usize, u128)> {
    memory.writes.iter().filter_map(|[address, data, enable, _]| {
        let place = number(run, address) as usize;
        (number(run, enable) == 1 && place < memory.words).then(|| (place, number(run, data)))
    })
}

/// The value of some output bits, the most significant first.
fn number(run: &ClockRun, bits: &std::ops::Range<usize>) -> u128 {
    bits.clone().fold(0, |number, at| number << 1 | u128::from(run.output(at) & 1))
}
