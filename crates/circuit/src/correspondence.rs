//! Registers that a design does not need: those that never change, those that always equal another, and those that no
//! output depends on.
//!
//! Registers that agree in a simulation from the start form a class. Induction then proves the classes: if the
//! registers of every class agree, so do their next values. A class for which this fails is split, until the proof
//! holds. C. A. J. van Eijk, IEEE Transactions on Computer-Aided Design 19 (2000), 814-819.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

use crate::formats::{Design, Forcing, RegisterKind};
use crate::network::{Gate, Network, Signal, View};
use crate::passes::simplify;
use crate::proof::{self, Compared, Counterpart, Proof, SatSweep};
use crate::{CancelFlag, NetId, Node, ProofError, RegisterNode};

const CYCLES: usize = 64;

const LANES: usize = 64;

const WORDS: usize = 8;

/// Registers that a circuit does not need.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Removed {
    /// Those that keep their start value, with this value.
    pub constant: BTreeMap<String, u8>,
    /// Those that always equal another, with the other.
    pub equal: BTreeMap<String, String>,
    /// Those that no output depends on.
    pub unused: Vec<String>,
}

impl Removed {
    pub fn is_empty(&self) -> bool {
        self.constant.is_empty() && self.equal.is_empty() && self.unused.is_empty()
    }
}

/// Registers without a start value start at 0. Those that clock others stay, as do all where the logic has feedback.
pub fn reduce(design: &Design) -> (Design, Removed) {
    let netlist = &design.netlist;
    let ids: Vec<NetId> = netlist.registers().map(|(id, _)| id).collect();
    let is_wire = |id| matches!(netlist.node(id), Node::Wire { .. });
    if ids.is_empty() || netlist.ids().any(is_wire) {
        return (design.clone(), Removed::default());
    }
    let Ok(view) = View::of(netlist, &ids) else { return (design.clone(), Removed::default()) };
    let registers: Vec<RegisterNode> = netlist.registers().map(|(_, register)| register.clone()).collect();
    let ports = [netlist.inputs().len(), netlist.outputs().len()];
    let classes = RegisterClasses::of(&registers, &view.network, ports, ClassLimits::default());
    let mut removed = classes.removed(&ids.iter().map(|&id| netlist.net_name(id)).collect::<Vec<_>>());
    let mut reduced = classes.merged(design, &ids);
    let names = |design: &Design| -> BTreeSet<String> {
        design.netlist.registers().map(|(id, _)| design.netlist.net_name(id)).collect()
    };
    let before = names(&reduced);
    simplify(&mut reduced.netlist);
    removed.unused = before.difference(&names(&reduced)).cloned().collect();
    if removed.is_empty() {
        return (design.clone(), removed);
    }
    match prove(design, &reduced, &removed) {
        Ok(_) => (reduced, removed),
        Err(error) => panic!("`{}` without the registers that it does not need differs: {error}", netlist.name),
    }
}

/// Proves a design equal to the one that was read; the proof checks `removed`, the registers that it does without.
pub fn prove(read: &Design, made: &Design, removed: &Removed) -> Result<Proof, ProofError> {
    let names = |design: &Design| -> BTreeMap<String, usize> {
        design.netlist.registers().enumerate().map(|(at, (id, _))| (design.netlist.net_name(id), at)).collect()
    };
    let [numbers, places] = [read, made].map(names);
    let counterpart = |name: &String| {
        if let Some(&value) = removed.constant.get(name) {
            return Counterpart::Constant(value == 1);
        }
        if let Some(&leader) = removed.equal.get(name).and_then(|leader| numbers.get(leader)) {
            return Counterpart::Like(leader);
        }
        places.get(name).map_or(Counterpart::Unused, |&at| Counterpart::Same(at))
    };
    let registers = read.netlist.registers().map(|(id, _)| (id, counterpart(&read.netlist.net_name(id))));
    proof::prove_registers(&read.netlist, &made.netlist, registers.collect())
}

pub(crate) struct RegisterClasses<'d> {
    registers: &'d [RegisterNode],
    /// The logic: its inputs are ports and then registers, its outputs ports and then the pins of registers.
    network: &'d Network,
    ports: [usize; 2],
    /// The signal that represents each register: a constant, or the first register of its class.
    leaders: Vec<Signal>,
    /// For each register, the first output that is one of its pins.
    places: Vec<usize>,
    limits: ClassLimits,
}

#[derive(Clone, Default)]
pub(crate) struct ClassLimits {
    pub(crate) portion: Option<u64>,
    pub(crate) cancel: CancelFlag,
    pub(crate) follows_clocks: bool,
}

/// What distinguishes registers: a constant or the leader before, what changes them, and values.
type Key = (Option<Signal>, Change, Vec<u64>);

type Change = (RegisterKind, Signal, Forcing);

impl<'d> RegisterClasses<'d> {
    pub(crate) fn of(
        registers: &'d [RegisterNode],
        network: &'d Network,
        ports: [usize; 2],
        limits: ClassLimits,
    ) -> Self {
        let mut next = ports[1];
        let place = |register: &RegisterNode| {
            let first = next;
            next += register.pins();
            first
        };
        let places = registers.iter().map(place).collect();
        let mut classes = Self { registers, network, ports, leaders: Vec::new(), places, limits };
        let histories = classes.histories();
        classes.split(|at| (None, histories[at].clone()));
        let mut random = ChaCha8Rng::seed_from_u64(0x6e62_6363_6c61_7373);
        loop {
            // Most classes that do not hold are split by any states in which they would have to.
            while classes.split_by_next(WORDS, |_, _| random.next_u64()) {}
            let (patterns, is_split) = classes.counterexamples();
            let Some(first) = patterns.first() else {
                if is_split {
                    continue;
                }
                return classes;
            };
            let lane = |lane: usize| patterns.get(lane).unwrap_or(first);
            let word = |input: usize| (0..LANES).fold(0, |word, at| word | u64::from(lane(at)[input]) << at);
            classes.split_by_next(1, |_, input| word(input));
        }
    }

    /// Splits classes by the next values for words of inputs and states, `word(number, input)`. Returns whether it did.
    fn split_by_next(&mut self, words: usize, mut word: impl FnMut(usize, usize) -> u64) -> bool {
        let network = self.assumed();
        let mut values: Vec<Vec<u64>> = vec![Vec::new(); self.leaders.len()];
        for number in 0..words {
            let inputs: Vec<u64> = (0..network.inputs).map(|input| word(number, input)).collect();
            let found = network.simulate(&inputs);
            for (at, values) in values.iter_mut().enumerate() {
                values.extend(self.changes(at).map(|output| found[network.outputs[output] as usize]));
            }
        }
        let before = self.leaders.clone();
        self.split(|at| (Some(before[at]), values[at].clone()));
        self.leaders != before
    }

    fn state(&self, at: usize) -> Signal {
        self.network.input(self.ports[0] + at)
    }

    fn register(&self, leader: Signal) -> Option<usize> {
        (leader as usize).checked_sub(2 + self.ports[0])
    }

    fn next(&self, at: usize) -> usize {
        self.places[at]
    }

    fn clock(&self, at: usize) -> Signal {
        self.network.outputs[self.places[at] + usize::from(RegisterNode::CLOCK)]
    }

    fn forcing(&self, at: usize) -> Range<usize> {
        let first = self.places[at];
        first + 2..first + self.registers[at].pins()
    }

    fn changes(&self, at: usize) -> impl Iterator<Item = usize> {
        std::iter::once(self.next(at)).chain(self.forcing(at))
    }

    fn forced(&self, at: usize, value: u64, values: &[u64]) -> u64 {
        let register = &self.registers[at];
        match (register.forcing, &self.network.outputs[self.forcing(at)]) {
            (Forcing::ToStart, &[reset]) => {
                let reset = values[reset as usize];
                value & !reset | filled(register.starts_at()) & reset
            }
            (Forcing::SetReset, &[set, reset]) => (value | values[set as usize]) & !values[reset as usize],
            _ => value,
        }
    }

    /// The values of each register in a simulation from the start, 64 runs in a word.
    fn histories(&self) -> Vec<Vec<u64>> {
        let mut random = ChaCha8Rng::seed_from_u64(0x6e62_6373_7461_7465);
        let mut now: Vec<u64> = self.registers.iter().map(|register| filled(register.starts_at())).collect();
        let mut histories: Vec<Vec<u64>> = now.iter().map(|&word| vec![word]).collect();
        for _ in 0..CYCLES {
            let mut ticks = BTreeMap::new();
            let inputs: Vec<u64> = (0..self.ports[0]).map(|_| random.next_u64()).chain(now.clone()).collect();
            let values = self.network.simulate(&inputs);
            for (at, register) in self.registers.iter().enumerate() {
                let tick = *ticks.entry((register.kind, self.clock(at))).or_insert_with(|| random.next_u64());
                let next = values[self.network.outputs[self.next(at)] as usize];
                now[at] = self.forced(at, next & tick | now[at] & !tick, &values);
                histories[at].push(now[at]);
            }
        }
        histories
    }

    /// Registers that keep one value in all words need not have the same clock; registers that clock others lead.
    fn split(&mut self, keys: impl Fn(usize) -> (Option<Signal>, Vec<u64>)) {
        let clocks: BTreeSet<Signal> = (0..self.registers.len()).map(|at| self.clock(at)).collect();
        let mut known: BTreeMap<Key, Signal> = BTreeMap::new();
        let mut leaders = Vec::new();
        for (at, register) in self.registers.iter().enumerate() {
            let (before, words) = keys(at);
            let own = self.state(at);
            let constant = [false, true].into_iter().find(|&value| words.iter().all(|&word| word == filled(value)));
            let constant = constant.map(Signal::from).filter(|&signal| before.is_none_or(|before| before == signal));
            let change = (register.kind, self.clock(at), register.forcing);
            leaders.push(match constant {
                _ if clocks.contains(&own) => {
                    if self.limits.follows_clocks {
                        known.entry((before, change, words)).or_insert(own);
                    }
                    own
                }
                // A set and a reset need not agree with the start value.
                Some(constant) if register.forcing != Forcing::SetReset => constant,
                _ => *known.entry((before, change, words)).or_insert(own),
            });
        }
        self.leaders = leaders;
    }

    fn assumed(&self) -> Network {
        let first = 2 + self.ports[0];
        let leader = |signal: Signal| match (signal as usize).checked_sub(first) {
            Some(at) if at < self.leaders.len() => self.leaders[at],
            _ => signal,
        };
        let gate = |gate: &Gate| Gate { function: gate.function, pins: gate.pins.map(leader) };
        Network {
            inputs: self.network.inputs,
            gates: self.network.gates.iter().map(gate).collect(),
            outputs: self.network.outputs.iter().map(|&output| leader(output)).collect(),
        }
    }

    /// Inputs and states after which members of a class differ, and whether registers left a class without a proof.
    fn counterexamples(&mut self) -> (Vec<Vec<bool>>, bool) {
        let mut network = self.assumed();
        let mut pairs: Vec<(usize, [Signal; 2])> = Vec::new();
        for at in (0..self.leaders.len()).filter(|&at| self.leaders[at] != self.state(at)) {
            match self.register(self.leaders[at]) {
                None => pairs.push((at, [self.leaders[at], network.outputs[self.next(at)]])),
                Some(leader) => pairs.extend(
                    self.changes(leader)
                        .zip(self.changes(at))
                        .map(|(one, two)| (at, [network.outputs[one], network.outputs[two]])),
                ),
            }
        }
        network.outputs = pairs.iter().flat_map(|(_, pair)| *pair).collect();
        let network = network.swept();
        let mut sweep = self.sweep(&network);
        let signals = sweep.add(&network);
        let mut patterns = Vec::new();
        let mut is_split = false;
        for (&(at, _), pair) in pairs.iter().zip(network.outputs.chunks(2)) {
            match sweep.compared(signals[pair[0] as usize], signals[pair[1] as usize]) {
                Compared::Equal => {}
                Compared::Different(pattern) => patterns.push(pattern),
                Compared::Open => {
                    self.leaders[at] = self.state(at);
                    is_split = true;
                }
            }
            if patterns.len() == LANES {
                break;
            }
        }
        (patterns, is_split)
    }

    fn sweep(&self, network: &Network) -> SatSweep {
        SatSweep::limited(network.inputs, self.limits.portion.unwrap_or(u64::MAX), self.limits.cancel.clone())
    }

    pub(crate) fn are_equal(&self, one: usize, two: usize) -> bool {
        self.leaders[one] == self.leaders[two]
    }

    /// Whether these outputs are equal wherever registers equal their leaders, be such a state ever reached or not.
    pub(crate) fn compared(&self, pairs: &[[usize; 2]]) -> Compared {
        let mut network = self.assumed();
        network.outputs = pairs.iter().flatten().map(|&output| network.outputs[output]).collect();
        let network = network.swept();
        let mut sweep = self.sweep(&network);
        let signals = sweep.add(&network);
        for pair in network.outputs.chunks(2) {
            match sweep.compared(signals[pair[0] as usize], signals[pair[1] as usize]) {
                Compared::Equal => {}
                Compared::Different(mut inputs) => {
                    for (at, &leader) in self.leaders.iter().enumerate() {
                        inputs[self.ports[0] + at] = match leader {
                            0 | 1 => leader == 1,
                            leader => inputs[leader as usize - 2],
                        };
                    }
                    return Compared::Different(inputs);
                }
                Compared::Open => return Compared::Open,
            }
        }
        Compared::Equal
    }

    fn removed(&self, names: &[String]) -> Removed {
        let mut removed = Removed::default();
        for (at, name) in names.iter().enumerate() {
            match self.register(self.leaders[at]) {
                None => drop(removed.constant.insert(name.clone(), u8::from(self.leaders[at] == 1))),
                Some(leader) if leader != at => drop(removed.equal.insert(name.clone(), names[leader].clone())),
                Some(_) => {}
            }
        }
        removed
    }

    fn merged(&self, design: &Design, ids: &[NetId]) -> Design {
        let mut design = design.clone();
        for (at, &id) in ids.iter().enumerate().filter(|&(at, _)| self.leaders[at] != self.state(at)) {
            let leader = match self.register(self.leaders[at]) {
                None => design.netlist.add_constant(self.leaders[at] == 1),
                Some(leader) => {
                    if let Node::Register(leading) = design.netlist.node_mut(ids[leader]) {
                        leading.start = leading.start.or(self.registers[at].start);
                    }
                    ids[leader]
                }
            };
            design.netlist.move_listeners(id, leader);
            design.netlist.remove(id);
        }
        design
    }
}

fn filled(value: bool) -> u64 {
    if value { !0 } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Netlist;
    use nbc_base::model::Function;

    /// A register for each of these next values, functions of `d` or of another register; the output shows the last.
    fn machine(registers: &[(&str, Function, &str)]) -> Design {
        let mut netlist = Netlist::new("machine");
        let [input, clock] = ["d", "clk"].map(|name| netlist.add_input(name));
        let node = |name: &str| RegisterNode {
            kind: RegisterKind::Rising,
            forcing: Forcing::Never,
            start: Some(false),
            name: Some(name.to_owned()),
            span: None,
        };
        let states: Vec<NetId> = registers.iter().map(|(name, ..)| netlist.add_loose_register(node(name))).collect();
        let place = |name: &str| registers.iter().position(|(known, ..)| *known == name);
        for ((_, function, other), &id) in registers.iter().zip(&states) {
            let other = place(other).map_or(input, |at| states[at]);
            let next = netlist.add_gate(*function, &[other, input]);
            (0..).zip([next, clock]).for_each(|(pin, net)| netlist.connect(id, pin, net));
        }
        netlist.add_output("q", *states.last().unwrap());
        Design::new(netlist)
    }

    fn ids(design: &Design) -> Vec<NetId> {
        design.netlist.registers().map(|(id, _)| id).collect()
    }

    fn change(design: &mut Design, at: usize, change: impl FnOnce(&mut RegisterNode)) {
        let id = ids(design)[at];
        let Node::Register(register) = design.netlist.node_mut(id) else { unreachable!() };
        change(register);
    }

    #[test]
    fn registers_that_keep_their_value_are_constant() {
        let design = machine(&[("a", Function::AND, "b"), ("b", Function::AND, "a")]);
        let (reduced, removed) = reduce(&design);
        assert_eq!(removed.constant, [("a".to_owned(), 0), ("b".to_owned(), 0)].into());
        assert!(ids(&reduced).is_empty() && reduced.netlist.inputs().len() == 2);
    }

    #[test]
    fn registers_that_were_removed_wrongly_are_found() {
        let design = machine(&[("a", Function::XOR, "a"), ("b", Function::XOR, "b"), ("q", Function::AND, "b")]);
        let (reduced, removed) = reduce(&design);
        assert_eq!(removed.equal, [("b".to_owned(), "a".to_owned())].into());
        assert!(prove(&design, &reduced, &removed).is_ok());
        let constant = Removed { constant: [("b".to_owned(), 0)].into(), ..Removed::default() };
        let unused = Removed { unused: vec!["b".to_owned()], ..Removed::default() };
        for wrong in [constant, unused] {
            assert!(matches!(prove(&design, &reduced, &wrong), Err(ProofError::Different { .. })), "{wrong:?}");
        }
        let mut other = reduced.clone();
        change(&mut other, 0, |register| register.start = Some(true));
        assert_eq!(prove(&design, &other, &removed).unwrap_err(), ProofError::Start("a".to_owned()));
        let mut other = reduced;
        let first = ids(&other)[0];
        let opposite = other.netlist.add_gate(Function::NOT, &[other.netlist.pins(first)[0]]);
        other.netlist.drive(first, RegisterNode::DATA, opposite);
        assert!(matches!(prove(&design, &other, &removed), Err(ProofError::Different { .. })));
    }

    #[test]
    fn registers_that_agree_merge_though_each_reads_itself() {
        let design = machine(&[("a", Function::XOR, "a"), ("b", Function::XOR, "b"), ("q", Function::XOR, "b")]);
        let (reduced, removed) = reduce(&design);
        let others = ["b", "q"].map(|name| (name.to_owned(), "a".to_owned()));
        assert_eq!(removed.equal, others.into());
        assert_eq!(ids(&reduced).len(), 1);
    }

    #[test]
    fn different_starts_clocks_and_edges_are_kept_apart() {
        let mut design = machine(&[("a", Function::XOR, "a"), ("q", Function::XOR, "a")]);
        change(&mut design, 1, |register| register.start = Some(true));
        assert_eq!(reduce(&design).1, Removed::default());
        change(&mut design, 1, |register| (register.start, register.kind) = (Some(false), RegisterKind::Falling));
        assert_eq!(reduce(&design).1, Removed::default());
        change(&mut design, 1, |register| register.kind = RegisterKind::Rising);
        let (other, second) = (design.netlist.add_input("other"), ids(&design)[1]);
        design.netlist.drive(second, RegisterNode::CLOCK, other);
        assert_eq!(reduce(&design).1, Removed::default());
    }

    #[test]
    fn a_register_that_nothing_shows_is_unused_unless_it_clocks_another() {
        let mut design = machine(&[("a", Function::XOR, "a"), ("q", Function::OR, "q")]);
        assert_eq!(reduce(&design).1.unused, ["a"]);
        let [first, second] = ids(&design)[..] else { unreachable!() };
        design.netlist.drive(second, RegisterNode::CLOCK, first);
        assert_eq!(reduce(&design).1, Removed::default());
    }
}
