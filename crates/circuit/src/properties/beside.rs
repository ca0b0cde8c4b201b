//! An environment beside a circuit, for any contents of its memories: the words that a step reads are free, except
//! those that the first step with a violation reads.
//!
//! Each read of a memory has an address that stays the same in a run, and the word at that address: it begins as the
//! memory does, and takes what is written there. A property is violated only where the reads of the step have these
//! addresses. Every run of the circuit and its memories is such a run, with the addresses of that step.

use crate::and_graph::{AndGraph, AndLiteral};
use crate::elaborate::MemoryPorts;
use crate::properties::machine::{Machine, same};
use crate::properties::wording::NoSteps;
use crate::waves::ClockStep;
use crate::{Environment, EnvironmentFault, Netlist};

#[derive(Clone, Debug)]
pub struct EnvironmentStep {
    pub(super) step: ClockStep,
    memories: Vec<MemoryPorts>,
    /// Whether each memory begins with zeros; if not, its words may be any.
    is_empty: Vec<bool>,
}

struct Read<'e> {
    memory: &'e MemoryPorts,
    is_empty: bool,
    /// Output bits of the address, and input bits of the word.
    ports: &'e [std::ops::Range<usize>; 2],
}

pub(super) struct EnvironmentAnswer {
    pub(super) inputs: Vec<AndLiteral>,
    /// The values of the environment's registers after the edge, in order of [`EnvironmentStep::registers`].
    pub(super) after: Vec<AndLiteral>,
    pub(super) reads_known: AndLiteral,
}

impl EnvironmentStep {
    pub fn new(netlist: &Netlist, memories: Vec<MemoryPorts>, is_empty: Vec<bool>) -> Result<Self, EnvironmentFault> {
        Ok(Self { step: Environment::step(netlist, &memories)?, memories, is_empty })
    }

    fn reads(&self) -> impl Iterator<Item = Read<'_>> {
        let memories = self.memories.iter().zip(&self.is_empty);
        memories.flat_map(|(memory, &is_empty)| memory.reads.iter().map(move |ports| Read { memory, is_empty, ports }))
    }

    pub(super) fn registers(&self) -> Vec<(String, Option<bool>)> {
        let own = self.step.state.iter().map(|bit| (bit.name.clone(), Some(bit.start)));
        let read = |read: Read<'_>| {
            let [address, data] = read.ports;
            let word = data.clone().map(move |at| (self.step.inputs[at].clone(), read.is_empty.then_some(false)));
            address.clone().map(|at| (self.step.outputs[at].clone(), None)).chain(word).collect::<Vec<_>>()
        };
        own.chain(self.reads().flat_map(read)).collect()
    }

    pub(super) fn words(&self) -> Vec<String> {
        self.reads().flat_map(|read| read.ports[1].clone()).map(|at| self.step.inputs[at].clone()).collect()
    }

    pub(super) fn gives(&self, circuit: &Netlist) -> Vec<(usize, usize)> {
        let place = |name: &String| circuit.inputs().iter().position(|&id| circuit.net_name(id) == *name);
        self.step.outputs.iter().enumerate().filter_map(|(own, name)| Some((place(name)?, own))).collect()
    }

    /// `inputs` are `None` where the environment gives them, and `words` are free values for what it reads.
    pub(super) fn answer(
        &self,
        graph: &mut AndGraph,
        (circuit, machine): (&Netlist, &Machine),
        mut inputs: Vec<Option<AndLiteral>>,
        (state, own, words): (&[AndLiteral], &[AndLiteral], &[AndLiteral]),
    ) -> Result<EnvironmentAnswer, NoSteps> {
        let gives = self.gives(circuit);
        let names = |ids: &[crate::NetId]| ids.iter().map(|&id| circuit.net_name(id)).collect::<Vec<_>>();
        let (from, shown_names) = (names(circuit.inputs()), names(circuit.outputs()));
        let (own, tracked) = own.split_at(self.step.state.len());
        let tracked = self.tracked(tracked);
        let mut seen: Vec<Option<AndLiteral>> = vec![None; self.step.inputs.len()];
        let mut known = 0;
        loop {
            let shown = machine.shown_before(graph, &inputs, state);
            for (at, name) in self.step.inputs.iter().enumerate() {
                let output = shown_names.iter().position(|other| other == name).map(|port| shown[port]);
                let found = output.or_else(|| Some(inputs[from.iter().position(|other| other == name)?]));
                seen[at] = found.flatten().or(seen[at]);
            }
            let all: Vec<Option<AndLiteral>> = seen.iter().copied().chain(own.iter().map(|&bit| Some(bit))).collect();
            let said = graph.known_outputs(&self.step.logic, &all);
            let mut free = words;
            for read in self.reads() {
                let [address, data] = read.ports.clone();
                let own_words;
                (own_words, free) = free.split_at(data.len());
                let Some(address) = said[address].iter().copied().collect::<Option<Vec<AndLiteral>>>() else {
                    continue;
                };
                let mut word = own_words.to_vec();
                for (other, [place, value]) in self.reads().zip(&tracked) {
                    if other.memory.memory == read.memory.memory {
                        let hit = same(graph, &address, place);
                        word = chosen(graph, hit, value, &word);
                    }
                }
                data.zip(word).for_each(|(at, bit)| seen[at] = Some(bit));
            }
            gives.iter().for_each(|&(port, own)| inputs[port] = said[own]);
            let now = [&inputs, &seen, &said].iter().flat_map(|values| values.iter()).flatten().count();
            if now > known {
                known = now;
                continue;
            }
            let complete = |values: &[Option<AndLiteral>]| {
                values.iter().copied().collect::<Option<Vec<AndLiteral>>>().ok_or(NoSteps::Circle)
            };
            let (inputs, said) = (complete(&inputs)?, complete(&said)?);
            let (after, reads_known) = self.after(graph, &said, &tracked);
            return Ok(EnvironmentAnswer { inputs, after, reads_known });
        }
    }

    fn tracked<'r>(&self, mut registers: &'r [AndLiteral]) -> Vec<[&'r [AndLiteral]; 2]> {
        let mut take = |count: usize| {
            let taken;
            (taken, registers) = registers.split_at(count);
            taken
        };
        self.reads().map(|read| [0, 1].map(|at| take(read.ports[at].len()))).collect()
    }

    fn after(
        &self,
        graph: &mut AndGraph,
        said: &[AndLiteral],
        tracked: &[[&[AndLiteral]; 2]],
    ) -> (Vec<AndLiteral>, AndLiteral) {
        let mut after = said[self.step.outputs.len()..].to_vec();
        let mut reads_known = 1;
        for (read, [place, value]) in self.reads().zip(tracked) {
            let is_here = same(graph, &said[read.ports[0].clone()], place);
            reads_known = graph.and(reads_known, is_here);
            let mut word = value.to_vec();
            for [address, data, enable, _] in &read.memory.writes {
                let mut hit = same(graph, &said[address.clone()], place);
                hit = graph.and(hit, said[enable.start]);
                let is_inside = is_below(graph, place, read.memory.words);
                hit = graph.and(hit, is_inside);
                word = chosen(graph, hit, &said[data.clone()], &word);
            }
            after.extend(place.iter().chain(&word));
        }
        (after, reads_known)
    }
}

fn chosen(graph: &mut AndGraph, choice: AndLiteral, then: &[AndLiteral], otherwise: &[AndLiteral]) -> Vec<AndLiteral> {
    then.iter().zip(otherwise).map(|(&then, &otherwise)| graph.choice(choice, then, otherwise)).collect()
}

fn is_below(graph: &mut AndGraph, number: &[AndLiteral], most: usize) -> AndLiteral {
    if number.len() < usize::BITS as usize && most >= 1 << number.len() {
        return 1;
    }
    number.iter().rev().enumerate().fold(0, |below, (bit, &literal)| match most >> bit & 1 {
        1 => graph.or(below, literal ^ 1),
        _ => graph.and(below, literal ^ 1),
    })
}
