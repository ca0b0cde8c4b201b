//! The processor at the level of logic, with registers and memory around it: 64 machines at once, each in a lane.

use std::fmt::Write;
use std::fs;

use nbc_base::model::Instance;
use nbc_base::source::{MemoryWorld, Sources};
use nbc_circuit::elaborate;
use nbc_circuit::waves::{ClockRun, ClockStep, LANES, StateBit};
use nbc_lang::check;

use super::reference::{Memory, OUTPUT};

/// What is outside a processor, for one lane.
#[derive(Clone, Debug, Default)]
pub struct Outside {
    pub registers: [u32; 32],
    pub memory: Memory,
    /// The address that came in during the last pass.
    pub address: u32,
    /// The bits of the next one.
    incoming: u32,
    pub halted: bool,
    /// The bytes that were stored at [`OUTPUT`].
    pub output: Vec<u8>,
}

#[derive(Clone, Debug)]
pub struct Machine {
    run: ClockRun,
    ports: Ports,
    pub lanes: Vec<Outside>,
}

/// The places of the ports, of a bus those of its bits, the lowest first.
#[derive(Clone, Debug)]
struct Ports {
    inputs: [usize; 3],
    outputs: [usize; 6],
    buses: [Vec<usize>; 6],
}

impl Ports {
    fn of(step: &ClockStep) -> Self {
        let place = |names: &[String], name: &str| {
            names.iter().position(|known| known == name).unwrap_or_else(|| panic!("port `{name}`"))
        };
        let output = |name: &str| place(&step.outputs, name);
        let bus = |name: &str| (0..5).map(|bit| output(&format!("{name}[{bit}]"))).collect();
        Self {
            inputs: ["r1", "r2", "data_in"].map(|name| place(&step.inputs, name)),
            outputs: ["rd_bit", "data_out", "write", "store", "address_bit", "halted"].map(output),
            buses: ["rs1", "rs2", "rd", "bit", "r1_place", "rd_place"].map(bus),
        }
    }
}

pub fn processor() -> ClockStep {
    let mut world = MemoryWorld::default();
    world.insert("riscv.nb", &*fs::read_to_string("circuits/riscv.nb").unwrap());
    let mut sources = Sources::default();
    let file = check::open(&world, "riscv.nb", &mut sources).unwrap();
    let checked = check::check(&world, &mut sources, file);
    assert!(checked.diagnostics.is_empty(), "{:?}", checked.diagnostics);
    ClockStep::of(&elaborate(&checked.program, &Instance::from("riscv")).unwrap()).unwrap()
}

/// The processor with a test of some clocks of this program, which starts as it is after `skipped` clocks. There are
/// two rows for each clock, before the rise and after it. Outputs of the second row belong to the inputs of the first.
pub fn with_clocks(program: &[u32], skipped: usize, clocks: usize) -> String {
    let mut machine = Machine::new();
    for (address, &word) in (0..).step_by(4).zip(program) {
        machine.lanes[0].memory.set_word(address, word);
    }
    (0..skipped).for_each(|_| machine.clock(1));
    let source = fs::read_to_string("circuits/riscv.nb").unwrap();
    let circuits = source.split("\n// ---- what is outside ----").next().unwrap_or(&source);
    let mut text: String = circuits.lines().map(|line| machine.started(line) + "\n").collect();
    let [inputs, outputs] = machine.columns();
    write!(text, "\ntest riscv \"some of its clocks\" {{\n    {inputs} | {outputs}\n").unwrap();
    for _ in 0..clocks {
        let [before, after] = machine.rows();
        write!(text, "    {before}\n    {after}\n").unwrap();
    }
    text + "}\n"
}

impl Machine {
    pub fn new() -> Self {
        let step = processor();
        let ports = Ports::of(&step);
        Self { run: ClockRun::new(step), ports, lanes: vec![Outside::default(); LANES] }
    }

    /// A clock of the first `lanes` processors: registers and memory answer what is asked, then store what comes out.
    pub fn clock(&mut self, lanes: usize) {
        self.answer(lanes);
        self.take(lanes);
        self.run.advance();
    }

    fn answer(&mut self, lanes: usize) {
        let mut inputs = vec![0; self.run.step().inputs.len()];
        let Ports { inputs: [one, two, data_in], buses: [rs1, rs2, _, bit, r1_place, _], .. } = &self.ports;
        for (lane, outside) in self.lanes[..lanes].iter().enumerate() {
            let bit = self.number(bit, lane);
            let [r1, r2] = [rs1, rs2].map(|port| outside.registers[self.number(port, lane) as usize]);
            inputs[*one] |= u64::from(r1 >> self.number(r1_place, lane) & 1) << lane;
            inputs[*two] |= u64::from(r2 >> bit & 1) << lane;
            let byte = outside.memory.byte(outside.address.wrapping_add(bit / 8));
            inputs[*data_in] |= u64::from(byte >> (bit % 8) & 1) << lane;
        }
        self.run.apply(&inputs);
    }

    fn take(&mut self, lanes: usize) {
        for lane in 0..lanes {
            let [rd, data, writes, stores, address, halted] = self.ports.outputs.map(|port| self.shows(port, lane));
            let [_, _, to, bit, _, place] = self.ports.buses.each_ref().map(|port| self.number(port, lane));
            let outside = &mut self.lanes[lane];
            if writes {
                set(&mut outside.registers[to as usize], place, rd);
            }
            if stores {
                let at = outside.address.wrapping_add(bit / 8);
                let mut byte = u32::from(outside.memory.byte(at));
                set(&mut byte, bit % 8, data);
                outside.memory.set_byte(at, byte as u8);
                if at == OUTPUT && bit == 7 {
                    outside.output.push(byte as u8);
                }
            }
            set(&mut outside.incoming, bit, address);
            if bit == 31 {
                outside.address = outside.incoming;
            }
            outside.halted = halted;
        }
    }

    /// The columns of a test in the language: the inputs and the outputs.
    pub fn columns(&self) -> [String; 2] {
        let outputs = self.buses().into_iter().map(|(name, _)| name).collect::<Vec<_>>();
        [self.run.step().inputs.join(" "), outputs.join(" ")]
    }

    /// A clock of the first processor as two rows of a test: before the rise of the clock, and after it with the same
    /// inputs.
    pub fn rows(&mut self) -> [String; 2] {
        self.answer(1);
        let before = self.row(false);
        self.take(1);
        self.run.advance();
        [before, self.row(true)]
    }

    fn row(&self, clock: bool) -> String {
        let step = self.run.step();
        let inputs = (0..step.inputs.len())
            .map(|port| if step.clock == Some(port) { clock } else { self.run.input(port) & 1 == 1 });
        let bits = |ports: &[usize]| ports.iter().map(|&port| digit(self.shows(port, 0))).collect::<String>();
        let outputs = self.buses().into_iter().map(|(_, ports)| bits(&ports));
        let inputs = inputs.map(|bit| digit(bit).to_string());
        format!("{} | {}", inputs.collect::<Vec<_>>().join(" "), outputs.collect::<Vec<_>>().join(" "))
    }

    fn buses(&self) -> Vec<(String, Vec<usize>)> {
        let mut buses: Vec<(String, Vec<usize>)> = Vec::new();
        for (place, port) in self.run.step().outputs.iter().enumerate() {
            let name = port.split('[').next().unwrap_or(port);
            match buses.last_mut() {
                Some((last, places)) if last == name => places.push(place),
                _ => buses.push((name.to_owned(), vec![place])),
            }
        }
        buses
    }

    /// A line of the processor's source. One that drives a net with a register or a part of the instruction gets the
    /// start value that the net has now.
    fn started(&self, line: &str) -> String {
        let Some((net, driver)) = line.split_once('=') else { return line.to_owned() };
        let bits = self.state(net.trim());
        match driver.trim().split_once('(') {
            Some((driver, rest))
                if driver == "register" || driver.starts_with("register[start = ") && net != "    q " =>
            {
                format!("{net}= register[start = {bits}]({rest}")
            }
            Some((part, rest)) if part.starts_with("part[") => {
                format!("{net}= {}, start = {bits}]({rest}", part.trim_end_matches(']'))
            }
            _ => line.to_owned(),
        }
    }

    fn state(&self, net: &str) -> u64 {
        let state = &self.run.step().state;
        let shown = |(at, bit): (usize, &StateBit)| {
            let name = bit.name.rsplit('/').next().unwrap_or(&bit.name);
            let (own, place) = name.split_once('[').unwrap_or((name, "0]"));
            let place: u32 = place.trim_end_matches(']').parse().unwrap();
            if own == net { (self.run.state(at) & 1) << place } else { 0 }
        };
        state.iter().enumerate().map(shown).sum()
    }

    fn shows(&self, port: usize, lane: usize) -> bool {
        self.run.output(port) >> lane & 1 == 1
    }

    fn number(&self, ports: &[usize], lane: usize) -> u32 {
        (0..).zip(ports).map(|(at, &port)| u32::from(self.shows(port, lane)) << at).sum()
    }
}

fn set(word: &mut u32, bit: u32, value: bool) {
    *word = *word & !(1 << bit) | u32::from(value) << bit;
}

fn digit(bit: bool) -> char {
    if bit { '1' } else { '0' }
}
