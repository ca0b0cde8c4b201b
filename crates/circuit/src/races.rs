//! Races: memory whose state depends on the delays of robots, found by ternary simulation (docs/timing.md, "Races").
//!
//! An input switches in a stable state, and every receiver sees it in the same cycle. Each cell that may change becomes
//! unknown, until no more cells do. Then every cell whose value is determined takes this value. A memory element that
//! stays unknown has a race. Eichelberger, IBM Journal of Research and Development 9 (1965), 90-99.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use crate::loops::Loops;
use crate::network::counting_word;
use crate::{NetId, Netlist, Node};
use nbc_base::model::Function;

const MOST_BITS: usize = 16;

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Race {
    pub net: String,
    pub input: String,
    /// Whether it is the edge at which the input rises.
    pub rises: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Ternary {
    zero: u64,
    one: u64,
}

impl Ternary {
    fn known(one: u64) -> Self {
        Self { zero: !one, one }
    }

    fn or(self, other: Self) -> Self {
        Self { zero: self.zero | other.zero, one: self.one | other.one }
    }

    fn of(self, value: bool) -> u64 {
        if value { self.one } else { self.zero }
    }
}

/// The races after one switch of an input in any stable state; `None` if there are too many states to try.
pub fn races(netlist: &Netlist) -> Option<Vec<Race>> {
    let loops = Loops::memory(netlist);
    let memory = loops.cores().concat();
    let bits = netlist.inputs().len() + memory.len();
    if memory.is_empty() {
        return Some(Vec::new());
    }
    if bits > MOST_BITS {
        return None;
    }
    let mut found = BTreeSet::new();
    for word in 0..(1u64 << bits).div_ceil(64) {
        let (values, stable) = at_rest(netlist, &loops, &memory, bits, word);
        for &input in netlist.inputs() {
            let end = switch(netlist, &loops, values.clone(), input);
            for &net in &memory {
                let either = end[&net].zero & end[&net].one & stable;
                let races = [(either & values[&input].zero, true), (either & values[&input].one, false)];
                found.extend(races.iter().filter(|race| race.0 != 0).map(|&(_, rises)| (net, input, rises)));
            }
        }
    }
    let name = |net: NetId| netlist.net_name(net);
    Some(found.into_iter().map(|(net, input, rises)| Race { net: name(net), input: name(input), rises }).collect())
}

type Values = BTreeMap<NetId, Ternary>;

/// The values of all nets in 64 states of the inputs and the memory, and which of these states are at rest.
fn at_rest(netlist: &Netlist, loops: &Loops, memory: &[NetId], bits: usize, word: u64) -> (Values, u64) {
    let free = netlist.inputs().iter().chain(memory).enumerate();
    let mut values: Values = free.map(|(i, &id)| (id, Ternary::known(counting_word(i, word as usize)))).collect();
    for &id in loops.order() {
        if !values.contains_key(&id) {
            let value = answer(netlist, &values, id);
            values.insert(id, value);
        }
    }
    let used = if bits < 6 { (1u64 << (1 << bits)) - 1 } else { u64::MAX };
    let stable = memory.iter().fold(used, |stable, id| stable & !(values[id].one ^ answer(netlist, &values, *id).one));
    (values, stable)
}

fn switch(netlist: &Netlist, loops: &Loops, mut values: Values, input: NetId) -> Values {
    let Ternary { zero, one } = values[&input];
    values.insert(input, Ternary { zero: one, one: zero });
    settle(netlist, loops, &mut values, Ternary::or);
    settle(netlist, loops, &mut values, |_, now| now);
    values
}

fn settle(netlist: &Netlist, loops: &Loops, values: &mut Values, merge: impl Fn(Ternary, Ternary) -> Ternary) {
    let mut changed = true;
    while changed {
        changed = false;
        for &id in loops.order().iter().filter(|&&id| !matches!(netlist.node(id), Node::Input(_))) {
            let old = values[&id];
            let new = merge(old, answer(netlist, values, id));
            changed |= new != old;
            values.insert(id, new);
        }
    }
}

fn answer(netlist: &Netlist, values: &Values, id: NetId) -> Ternary {
    let pins: Vec<_> = netlist.pins(id).iter().map(|pin| values[pin]).collect();
    match netlist.node(id) {
        Node::Cell(cell) => {
            let inputs: Vec<Ternary> = netlist.operands(id).iter().map(|pin| values[pin]).collect();
            of_cell(cell.function, &inputs)
        }
        Node::Constant(value) => Ternary::known(0u64.wrapping_sub(u64::from(*value))),
        Node::Input(_) => values[&id],
        Node::Output(_) | Node::Wire { .. } => pins[0],
        Node::Register(_) => unreachable!("the registers of robots are cells"),
    }
}

fn of_cell(function: Function, inputs: &[Ternary]) -> Ternary {
    let mut made = Ternary::default();
    for row in 0..1 << function.inputs() {
        let here = inputs.iter().enumerate().fold(!0, |all, (i, input)| all & input.of(function.input_at(i, row)));
        let (zero, one) = if function.row(row) { (0, here) } else { (here, 0) };
        made = made.or(Ternary { zero, one });
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::as_nands;
    use crate::cells::CellLibrary;
    use crate::example::{self, register};
    use crate::map::map;
    use crate::passes::{dissolve_wires, sweep};
    use crate::register::RegisterKind;

    fn with_feedback(build: impl FnOnce(&mut Netlist, [NetId; 3]) -> NetId) -> Netlist {
        let mut netlist = Netlist::new("memory");
        let [d, e] = ["d", "e"].map(|name| netlist.add_input(name));
        let q = netlist.add_wire("q", Some(false), None);
        let made = build(&mut netlist, [d, e, q]);
        netlist.drive(q, 0, made);
        netlist.add_output("q", q);
        let mut netlist = as_nands(&netlist);
        sweep(&mut netlist);
        netlist
    }

    fn check(netlist: &Netlist, expected: &[&str]) {
        let races = races(netlist).unwrap();
        let line =
            |Race { net, input, rises }: &Race| format!("{input} {} {net}", if *rises { "rises" } else { "falls" });
        assert_eq!(races.iter().map(line).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn safe_latches_have_no_race() {
        let mut paper = example::latch();
        dissolve_wires(&mut paper).unwrap();
        check(&paper, &[]);
        check(&map(&paper, &CellLibrary::uniform([Function::NAND])).unwrap(), &[]);
        check(&with_feedback(|netlist, [d, e, _]| register(netlist, RegisterKind::High, "q", [d, e], false)), &[]);
        let any_cells = with_feedback(|netlist, [d, e, q]| {
            let set = netlist.add_gate(Function::AND, &[d, e]);
            let reset = netlist.add_gate(Function::AND.with_input_inverted(0), &[d, e]);
            let kept = netlist.add_gate(Function::AND.with_input_inverted(1), &[q, reset]);
            netlist.add_gate(Function::OR, &[set, kept])
        });
        check(&any_cells, &[]);
    }

    #[test]
    fn a_multiplexer_that_drives_itself_has_a_race() {
        let netlist = with_feedback(|netlist, [d, e, q]| {
            let taken = netlist.add_gate(Function::AND, &[d, e]);
            let kept = netlist.add_gate(Function::AND.with_input_inverted(1), &[q, e]);
            let made = netlist.add_gate(Function::OR, &[taken, kept]);
            netlist.rename(made, "q");
            netlist.rename(kept, "kept");
            made
        });
        check(&netlist, &["e falls kept", "e falls q"]);
    }

    #[test]
    fn logic_without_memory_has_no_race_and_wide_memory_is_skipped() {
        check(&example::full_adder(), &[]);
        let mut wide = with_feedback(|netlist, [d, e, _]| register(netlist, RegisterKind::High, "q", [d, e], false));
        for i in 0..MOST_BITS {
            wide.add_input(format!("i{i}"));
        }
        assert_eq!(races(&wide), None);
    }
}
