//! Phases: which gates of a network are made inverted, and of which cells, so that few inverters remain.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use rand_chacha::ChaCha8Rng;

use crate::network::{self, Gate, Network, Signal};
use crate::recipes::Operand;
use crate::synth::candidates::below;
use crate::synth::prices::Prices;
use nbc_base::model::Function;

const PASSES: usize = 12;

/// `None` if the library cannot make a function. Of equal choices a random one is taken, to leave local optima.
pub fn assign_phases(network: &Network, prices: &Prices, random: &mut ChaCha8Rng) -> Option<Network> {
    let source = Source::of(network, prices)?;
    let mut phases = Phases::new(source, prices)?;
    for _ in 0..PASSES {
        for node in (phases.source.first()..phases.source.nodes()).rev() {
            phases.choose(node, random);
        }
    }
    Some(phases.network())
}

/// A node of the source in one phase: 2 times the node, plus 1 for the inverted phase.
type Phase = usize;

/// A network without inverters: they are the phases in which signals are read.
struct Source {
    inputs: usize,
    /// The functions and pins of the gates; pins are nodes, counted as the signals of a network.
    gates: Vec<Gate>,
    outputs: Vec<Phase>,
    known: BTreeMap<(u8, [Signal; 2]), Phase>,
}

impl Source {
    /// Functions that take several cells in any phase are replaced by these cells.
    fn of(network: &Network, prices: &Prices) -> Option<Self> {
        let mut source =
            Self { inputs: network.inputs, gates: Vec::new(), outputs: Vec::new(), known: BTreeMap::new() };
        let mut phases: Vec<Phase> = (0..2 + network.inputs).map(|signal| 2 * signal).collect();
        for gate in &network.gates {
            let pins = gate.pins.map(|pin| phases[pin as usize]);
            let made = source.add(gate.function, pins, prices)?;
            phases.push(made);
        }
        source.outputs = network.outputs.iter().map(|&output| phases[output as usize]).collect();
        Some(source)
    }

    fn add(&mut self, function: Function, pins: [Phase; 2], prices: &Prices) -> Option<Phase> {
        if function.arity() == 1 {
            let pin = pins[usize::from(!function.depends_on(0))];
            let inverted = function == Function::NOT || function == Function::NOT_B;
            return Some(pin ^ usize::from(inverted));
        }
        let function = network::inverted(function, pins.map(|phase| phase % 2 == 1));
        let nodes = pins.map(|phase| (phase / 2) as Signal);
        if let Some(phase) = folded(function, nodes) {
            return Some(phase);
        }
        let (function, nodes) =
            if nodes[0] <= nodes[1] { (function, nodes) } else { (function.swapped(), [nodes[1], nodes[0]]) };
        if let Some(&phase) = self.known.get(&(function.bits(), nodes)) {
            return Some(phase);
        }
        let phase = if has_cell(function, prices) {
            self.gates.push(Gate { function, pins: nodes });
            2 * (self.nodes() - 1)
        } else {
            self.expand(function, nodes, prices)?
        };
        self.known.insert((function.bits(), nodes), phase);
        Some(phase)
    }

    fn expand(&mut self, function: Function, nodes: [Signal; 2], prices: &Prices) -> Option<Phase> {
        let recipe = prices.recipe(function)?;
        let mut made: Vec<Phase> = Vec::new();
        let read = |made: &[Phase], operand: Operand| match operand {
            Operand::Input(pin) => 2 * nodes[usize::from(pin)] as usize,
            Operand::Step(i) => made[usize::from(i)],
            Operand::Constant(value) => usize::from(value),
        };
        for step in &recipe.steps {
            let phase = self.add(step.function, step.pins.map(|pin| read(&made, pin)), prices)?;
            made.push(phase);
        }
        Some(read(&made, recipe.result))
    }

    fn nodes(&self) -> usize {
        self.first() + self.gates.len()
    }

    fn first(&self) -> usize {
        2 + self.inputs
    }

    fn gate(&self, node: usize) -> Option<&Gate> {
        node.checked_sub(self.first()).map(|i| &self.gates[i])
    }
}

/// The phase that equals a function of two nodes, if it depends on one of them at most.
fn folded(function: Function, nodes: [Signal; 2]) -> Option<Phase> {
    let equal = nodes[0] == nodes[1];
    let changes = [nodes[0] > 1, nodes[1] > 1 && !equal];
    let node = match changes {
        [true, true] => return None,
        [false, true] => nodes[1],
        _ => nodes[0],
    };
    let value = |node: Signal, variable: bool| if node < 2 { node == 1 } else { variable };
    let output = |variable: bool| function.output(value(nodes[0], variable), value(nodes[1], variable));
    Some(match (output(false), output(true)) {
        (false, true) => 2 * node as Phase,
        (true, false) => 2 * node as Phase + 1,
        (constant, _) => 2 * usize::from(constant),
    })
}

fn has_cell(function: Function, prices: &Prices) -> bool {
    (0..8).any(|phases| prices.cell(in_phases(function, [phases & 1 > 0, phases & 2 > 0], phases & 4 > 0)) > 0)
}

fn in_phases(function: Function, pins: [bool; 2], inverted: bool) -> Function {
    let made = network::inverted(function, pins);
    if inverted { made.inverted() } else { made }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Making {
    Inverter,
    Cell(Function, [Phase; 2]),
    Input,
}

struct Phases<'p> {
    source: Source,
    prices: &'p Prices,
    inverter: u32,
    makings: Vec<Making>,
    readers: Vec<u32>,
    cost: u32,
    pending: Vec<Phase>,
}

impl<'p> Phases<'p> {
    fn new(source: Source, prices: &'p Prices) -> Option<Self> {
        let inverter = prices.cost(Function::NOT)?;
        let count = 2 * source.nodes();
        let mut phases = Self {
            source,
            prices,
            inverter,
            makings: vec![Making::Inverter; count],
            readers: vec![0; count],
            cost: 0,
            pending: Vec::new(),
        };
        for node in 0..phases.source.nodes() {
            phases.makings[2 * node] = Making::Input;
            if phases.source.gate(node).is_some() {
                let first = (0..2).find_map(|inverted| Some((inverted, *phases.cells(2 * node + inverted).first()?)));
                let (inverted, cell) = first?;
                phases.makings[2 * node] = Making::Inverter;
                phases.makings[2 * node + inverted] = cell;
            }
        }
        // A constant is there in both phases.
        phases.makings[1] = Making::Input;
        phases.makings[3] = Making::Input;
        for i in 0..phases.source.outputs.len() {
            phases.read(phases.source.outputs[i]);
        }
        Some(phases)
    }

    fn cells(&self, phase: Phase) -> Vec<Making> {
        let Some(&Gate { function, pins }) = self.source.gate(phase / 2) else {
            return Vec::new();
        };
        let mut cells = Vec::new();
        for choice in 0..4usize {
            let inverted = [choice & 1, choice >> 1];
            let made = in_phases(function, inverted.map(|bit| bit == 1), phase % 2 == 1);
            if self.prices.cell(made) > 0 {
                cells.push(Making::Cell(made, [0, 1].map(|pin| 2 * pins[pin] as usize + inverted[pin])));
            }
        }
        cells
    }

    fn pins(&self, phase: Phase) -> [Option<Phase>; 2] {
        match self.makings[phase] {
            Making::Input => [None, None],
            Making::Inverter => [Some(phase ^ 1), None],
            Making::Cell(_, pins) => pins.map(Some),
        }
    }

    fn price(&self, phase: Phase) -> u32 {
        match self.makings[phase] {
            Making::Input => 0,
            Making::Inverter => self.inverter,
            Making::Cell(function, _) => self.prices.cell(function),
        }
    }

    fn read(&mut self, phase: Phase) {
        self.pending.push(phase);
        while let Some(phase) = self.pending.pop() {
            self.readers[phase] += 1;
            if self.readers[phase] == 1 {
                self.cost += self.price(phase);
                self.pending.extend(self.pins(phase).into_iter().flatten());
            }
        }
    }

    fn drop_reader(&mut self, phase: Phase) {
        self.pending.push(phase);
        while let Some(phase) = self.pending.pop() {
            self.readers[phase] -= 1;
            if self.readers[phase] == 0 {
                self.cost -= self.price(phase);
                self.pending.extend(self.pins(phase).into_iter().flatten());
            }
        }
    }

    fn choose(&mut self, node: usize, random: &mut ChaCha8Rng) {
        let both = [2 * node, 2 * node + 1];
        let external = self.external_readers(both);
        if external == [0; 2] {
            return;
        }
        let mut makings = both.map(|phase| self.cells(phase));
        makings.iter_mut().for_each(|makings| makings.push(Making::Inverter));
        self.set_readers(both, external, false);
        let mut best = (self.makings[both[0]], self.makings[both[1]]);
        let (mut least, mut equals) = (None, 0);
        for &plain in &makings[0] {
            for &inverted in &makings[1] {
                if plain == Making::Inverter && inverted == Making::Inverter {
                    continue;
                }
                (self.makings[both[0]], self.makings[both[1]]) = (plain, inverted);
                self.set_readers(both, external, true);
                let cost = self.cost;
                self.set_readers(both, external, false);
                equals = match least.map(|least| cost.cmp(&least)) {
                    None | Some(Ordering::Less) => 1,
                    Some(Ordering::Equal) => equals + 1,
                    Some(Ordering::Greater) => continue,
                };
                if equals == 1 || below(random, equals) == 0 {
                    (least, best) = (Some(cost), (plain, inverted));
                }
            }
        }
        (self.makings[both[0]], self.makings[both[1]]) = best;
        self.set_readers(both, external, true);
    }

    fn external_readers(&self, [plain, inverted]: [Phase; 2]) -> [u32; 2] {
        let by_inverter =
            |phase: Phase| u32::from(self.readers[phase ^ 1] > 0 && self.makings[phase ^ 1] == Making::Inverter);
        [plain, inverted].map(|phase| self.readers[phase] - by_inverter(phase))
    }

    fn set_readers(&mut self, both: [Phase; 2], readers: [u32; 2], add: bool) {
        for (phase, readers) in both.into_iter().zip(readers).filter(|(_, readers)| *readers > 0) {
            if add {
                self.read(phase);
                self.readers[phase] += readers - 1;
            } else {
                self.readers[phase] -= readers - 1;
                self.drop_reader(phase);
            }
        }
    }

    fn network(&self) -> Network {
        let mut network = Network::new(self.source.inputs);
        let mut made: Vec<Signal> = vec![Signal::MAX; self.makings.len()];
        (made[0], made[1], made[2], made[3]) = (0, 1, 1, 0);
        for node in 2..self.source.nodes() {
            // An inverter follows what it inverts.
            let plain_last = self.makings[2 * node] == Making::Inverter;
            for phase in if plain_last { [2 * node + 1, 2 * node] } else { [2 * node, 2 * node + 1] } {
                made[phase] = match self.makings[phase] {
                    Making::Input => node as Signal,
                    _ if self.readers[phase] == 0 => Signal::MAX,
                    Making::Inverter => network.add(Function::NOT, [made[phase ^ 1]; 2]),
                    Making::Cell(function, pins) => network.add(function, pins.map(|pin| made[pin])),
                };
            }
        }
        network.outputs = self.source.outputs.iter().map(|&output| made[output]).collect();
        network
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use rand::SeedableRng;

    use super::*;
    use crate::example::{library, network};
    use crate::proof::equal;
    use crate::synth::reduce::{cost, cover};

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn phases_keep_the_function(
            gates in prop::collection::vec(any::<(u8, u16, u16)>(), 1..60),
            names in prop::sample::select(vec!["nand", "nand and not", "nor or not", "and not xor"]),
        ) {
            let network = network(6, &gates);
            let prices = Prices::of(&library(names));
            let made = assign_phases(&network, &prices, &mut ChaCha8Rng::seed_from_u64(1)).unwrap();
            prop_assert!(equal(&network, &made).is_ok());
            let covered = cover(&made, &prices, &[]).unwrap();
            prop_assert!(covered.gates.iter().all(|gate| prices.cell(gate.function) > 0));
        }
    }

    #[test]
    fn an_or_of_products_needs_no_inverter() {
        let mut network = Network::new(4);
        let products = [network.add(Function::AND, [2, 3]), network.add(Function::AND, [4, 5])];
        let sum = network.add(Function::OR, products);
        network.outputs = vec![sum];
        let prices = Prices::of(&library("nand and not"));
        let made = assign_phases(&network, &prices, &mut ChaCha8Rng::seed_from_u64(1)).unwrap();
        assert_eq!((made.gates.len(), cost(&made, &prices)), (3, 3));
    }
}
