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

use crate::formats::{Design, Forcing, Register, RegisterKind};
use crate::network::{Gate, Network, Signal, View};
use crate::passes::{self, sweep};
use crate::proof::{self, Compared, Counterpart, Proof, SatSweep};
use crate::{CancelFlag, NetId, Netlist, Node, ProofError};

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
    let is_wire = |id| matches!(design.logic.node(id), Node::Wire { .. });
    if design.registers.is_empty() || design.logic.ids().any(is_wire) {
        return (design.clone(), Removed::default());
    }
    let Ok(view) = View::of(&design.logic, &[]) else { return (design.clone(), Removed::default()) };
    let ports = [design.inputs(), design.outputs()];
    let classes = RegisterClasses::of(&design.registers, &view.network, ports, ClassLimits::default());
    let mut removed = classes.removed();
    let mut reduced = classes.merged(design);
    let simplify = |logic: &mut Netlist| passes::run(logic).expect("the view of the logic is complete");
    simplify(&mut reduced.logic);
    removed.unused = remove_unused(&mut reduced);
    if removed.is_empty() {
        return (design.clone(), removed);
    }
    simplify(&mut reduced.logic);
    match prove(design, &reduced, &removed) {
        Ok(_) => (reduced, removed),
        Err(error) => panic!("`{}` without the registers that it does not need differs: {error}", design.logic.name),
    }
}

/// Proves a design equal to the one that was read; the proof checks `removed`, the registers that it does without.
pub fn prove(read: &Design, made: &Design, removed: &Removed) -> Result<Proof, ProofError> {
    let names = made.registers.iter().enumerate().map(|(at, register)| (register.name.as_str(), at));
    let places: BTreeMap<&str, usize> = names.collect();
    let numbers = read.registers.iter().enumerate().map(|(at, register)| (register.name.as_str(), at));
    let numbers: BTreeMap<&str, usize> = numbers.collect();
    let counterpart = |register: &Register| {
        let name = register.name.as_str();
        if let Some(&value) = removed.constant.get(name) {
            return Counterpart::Constant(value == 1);
        }
        if let Some(&leader) = removed.equal.get(name).and_then(|leader| numbers.get(leader.as_str())) {
            return Counterpart::Like(leader);
        }
        places.get(name).map_or(Counterpart::Unused, |&at| Counterpart::Same(at))
    };
    proof::prove_design(read, made, read.registers.iter().map(counterpart).collect())
}

pub(crate) struct RegisterClasses<'d> {
    registers: &'d [Register],
    /// The logic: its inputs are ports and then registers, its outputs ports, next values and what forces registers.
    network: &'d Network,
    ports: [usize; 2],
    /// The signal that represents each register: a constant, or the first register of its class.
    leaders: Vec<Signal>,
    forcing: Vec<Range<usize>>,
    limits: ClassLimits,
}

#[derive(Clone, Default)]
pub(crate) struct ClassLimits {
    pub(crate) portion: Option<u64>,
    pub(crate) cancel: CancelFlag,
    pub(crate) follows_clocks: bool,
}

/// What distinguishes registers: a constant or the leader before, what changes them, and values.
type Key<'d> = (Option<Signal>, Change<'d>, Vec<u64>);

type Change<'d> = ((u8, &'d str), Forcing);

impl<'d> RegisterClasses<'d> {
    pub(crate) fn of(registers: &'d [Register], network: &'d Network, ports: [usize; 2], limits: ClassLimits) -> Self {
        let mut next = ports[1] + registers.len();
        let range = |register: &Register| {
            let first = next;
            next += register.forcing.nets().len();
            first..next
        };
        let forcing = registers.iter().map(range).collect();
        let mut classes = Self { registers, network, ports, leaders: Vec::new(), forcing, limits };
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
        self.ports[1] + at
    }

    fn changes(&self, at: usize) -> impl Iterator<Item = usize> {
        std::iter::once(self.next(at)).chain(self.forcing[at].clone())
    }

    fn forced(&self, at: usize, value: u64, values: &[u64]) -> u64 {
        let register = &self.registers[at];
        match (register.forcing, &self.network.outputs[self.forcing[at].clone()]) {
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
                let tick =
                    *ticks.entry(event(register.kind, register.clock_name())).or_insert_with(|| random.next_u64());
                let next = values[self.network.outputs[self.next(at)] as usize];
                now[at] = self.forced(at, next & tick | now[at] & !tick, &values);
                histories[at].push(now[at]);
            }
        }
        histories
    }

    /// Registers that keep one value in all words need not have the same clock; registers that clock others lead.
    fn split(&mut self, keys: impl Fn(usize) -> (Option<Signal>, Vec<u64>)) {
        let clocks: BTreeSet<&str> = self.registers.iter().map(|register| register.clock_name()).collect();
        let mut known: BTreeMap<Key, Signal> = BTreeMap::new();
        let mut leaders = Vec::new();
        for (at, register) in self.registers.iter().enumerate() {
            let (before, words) = keys(at);
            let own = self.state(at);
            let constant = [false, true].into_iter().find(|&value| words.iter().all(|&word| word == filled(value)));
            let constant = constant.map(Signal::from).filter(|&signal| before.is_none_or(|before| before == signal));
            let change = (event(register.kind, register.clock_name()), register.forcing);
            leaders.push(match constant {
                _ if clocks.contains(register.name.as_str()) => {
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

    fn removed(&self) -> Removed {
        let mut removed = Removed::default();
        for (at, register) in self.registers.iter().enumerate() {
            let name = register.name.clone();
            match self.register(self.leaders[at]) {
                None => drop(removed.constant.insert(name, u8::from(self.leaders[at] == 1))),
                Some(leader) if leader != at => {
                    removed.equal.insert(name, self.registers[leader].name.clone());
                }
                Some(_) => {}
            }
        }
        removed
    }

    fn merged(&self, design: &Design) -> Design {
        let mut design = design.clone();
        let states = design.logic.inputs()[design.inputs()..].to_vec();
        for (at, &state) in states.iter().enumerate().filter(|&(at, _)| self.leaders[at] != self.state(at)) {
            let leader = match self.register(self.leaders[at]) {
                None => design.logic.add_constant(self.leaders[at] == 1),
                Some(leader) => {
                    let start = design.registers[at].start;
                    let leading = &mut design.registers[leader];
                    leading.start = leading.start.or(start);
                    states[leader]
                }
            };
            design.logic.move_listeners(state, leader);
        }
        let leads = |at: usize| self.leaders[at] == self.state(at);
        keep(&mut design, &(0..states.len()).map(leads).collect::<Vec<_>>());
        design
    }
}

fn remove_unused(design: &mut Design) -> Vec<String> {
    let states = design.logic.inputs()[design.inputs()..].to_vec();
    let nexts = design.logic.outputs()[design.outputs()..].to_vec();
    let forcing = design.forcing();
    let register_of: BTreeMap<NetId, usize> = states.iter().enumerate().map(|(at, &state)| (state, at)).collect();
    let clocks: BTreeSet<&str> = design.registers.iter().map(|register| register.clock_name()).collect();
    let is_clock = |at: &usize| clocks.contains(design.registers[*at].name.as_str());
    let mut pending: Vec<NetId> = design.logic.outputs()[..design.outputs()].to_vec();
    pending.extend((0..states.len()).filter(is_clock).map(|at| states[at]));
    let mut used: BTreeSet<NetId> = pending.iter().copied().collect();
    while let Some(id) = pending.pop() {
        let next = register_of.get(&id).map(|&at| std::iter::once(nexts[at]).chain(forcing[at].iter().copied()));
        let pins = design.logic.pins(id).into_iter().chain(next.into_iter().flatten());
        pending.extend(pins.filter(|&pin| used.insert(pin)));
    }
    let kept: Vec<bool> = states.iter().map(|state| used.contains(state)).collect();
    let names = design.registers.iter().zip(&kept).filter(|(_, kept)| !**kept);
    let unused = names.map(|(register, _)| register.name.clone()).collect();
    keep(design, &kept);
    unused
}

fn keep(design: &mut Design, kept: &[bool]) {
    let states = design.logic.inputs()[design.inputs()..].to_vec();
    let nexts = design.logic.outputs()[design.outputs()..].to_vec();
    let others = || (0..kept.len()).filter(|&at| !kept[at]);
    let all = design.forcing();
    let forcing: Vec<NetId> = others().flat_map(|at| all[at].to_vec()).collect();
    others().map(|at| nexts[at]).chain(forcing).for_each(|output| design.logic.remove(output));
    sweep(&mut design.logic);
    others().for_each(|at| design.logic.remove(states[at]));
    let mut at = 0..;
    design.registers.retain(|_| at.next().is_some_and(|at| kept[at]));
}

fn event(kind: RegisterKind, clock: &str) -> (u8, &str) {
    (kind as u8, clock)
}

fn filled(value: bool) -> u64 {
    if value { !0 } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::Function;

    /// A register for each of these next values, functions of `d` or of another register; the output shows the last.
    fn machine(registers: &[(&str, Function, &str)]) -> Design {
        let mut logic = Netlist::new("machine");
        let input = logic.add_input("d");
        let states: Vec<NetId> = registers.iter().map(|(name, ..)| logic.add_input(*name)).collect();
        let place = |name: &str| registers.iter().position(|(known, ..)| *known == name);
        let nexts: Vec<NetId> = registers
            .iter()
            .map(|(_, function, other)| {
                let other = place(other).map_or(input, |at| states[at]);
                logic.add_gate(*function, &[other, input])
            })
            .collect();
        logic.add_output("q", *states.last().unwrap());
        let register = |(name, ..): &(&str, Function, &str)| Register {
            name: (*name).to_owned(),
            kind: RegisterKind::Rising,
            clock: None,
            start: Some(false),
            forcing: Forcing::Never,
        };
        nexts.iter().for_each(|&next| _ = logic.add_output("next", next));
        Design::new(logic, registers.iter().map(register).collect())
    }

    #[test]
    fn registers_that_keep_their_value_are_constant() {
        let design = machine(&[("a", Function::AND, "b"), ("b", Function::AND, "a")]);
        let (reduced, removed) = reduce(&design);
        assert_eq!(removed.constant, [("a".to_owned(), 0), ("b".to_owned(), 0)].into());
        assert!(reduced.registers.is_empty() && reduced.logic.inputs().len() == 1);
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
        other.registers[0].start = Some(true);
        assert_eq!(prove(&design, &other, &removed).unwrap_err(), ProofError::Start("a".to_owned()));
        let mut other = reduced;
        let next = other.logic.outputs()[1];
        let opposite = other.logic.add_gate(Function::NOT, &[other.logic.pins(next)[0]]);
        other.logic.drive(next, 0, opposite);
        assert!(matches!(prove(&design, &other, &removed), Err(ProofError::Different { .. })));
    }

    #[test]
    fn registers_that_agree_merge_though_each_reads_itself() {
        let design = machine(&[("a", Function::XOR, "a"), ("b", Function::XOR, "b"), ("q", Function::XOR, "b")]);
        let (reduced, removed) = reduce(&design);
        let others = ["b", "q"].map(|name| (name.to_owned(), "a".to_owned()));
        assert_eq!(removed.equal, others.into());
        assert_eq!(reduced.registers.len(), 1);
    }

    #[test]
    fn different_starts_clocks_and_edges_are_kept_apart() {
        let mut design = machine(&[("a", Function::XOR, "a"), ("q", Function::XOR, "a")]);
        design.registers[1].start = Some(true);
        assert_eq!(reduce(&design).1, Removed::default());
        design.registers[1].start = Some(false);
        design.registers[1].kind = RegisterKind::Falling;
        assert_eq!(reduce(&design).1, Removed::default());
        design.registers[1].kind = RegisterKind::Rising;
        design.registers[1].clock = Some("other".to_owned());
        assert_eq!(reduce(&design).1, Removed::default());
    }

    #[test]
    fn a_register_that_nothing_shows_is_unused_unless_it_clocks_another() {
        let mut design = machine(&[("a", Function::XOR, "a"), ("q", Function::OR, "q")]);
        assert_eq!(reduce(&design).1.unused, ["a"]);
        design.registers[1].clock = Some("a".to_owned());
        assert_eq!(reduce(&design).1, Removed::default());
    }
}
