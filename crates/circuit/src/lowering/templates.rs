//! Proofs that the cells of a register do for ever what it does, for each kind, start and form, whatever forces it, by
//! the search that decides properties.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::Delayed;
use crate::and_graph::{AndGraph, AndLiteral};
use crate::example::multiplexer_library;
use crate::network::View;
use crate::passes::{share, sweep};
use crate::properties::{PropertySearch, PropertyVerdict, SearchBudget, SystemRegister, TransitionSystem};
use nbc_base::source::CancelFlag;

/// Cells that have not settled after so many steps, as a power of two, never do.
const TIME_BITS: usize = 5;

const KINDS: [RegisterKind; 4] = [RegisterKind::Rising, RegisterKind::Falling, RegisterKind::High, RegisterKind::Low];
const FORCINGS: [Forcing; 3] = [Forcing::Never, Forcing::ToStart, Forcing::SetReset];

fn all() -> impl Iterator<Item = RegisterNode> {
    let starts = KINDS.into_iter().flat_map(|kind| [false, true].map(|start| (kind, Some(start))));
    starts.flat_map(|(kind, start)| {
        FORCINGS.map(|forcing| RegisterNode { kind, forcing, start, name: Some("q".to_owned()), span: None })
    })
}

/// A register alone, whose inputs are its pins.
fn alone(register: &RegisterNode) -> Netlist {
    let mut netlist = Netlist::new("alone");
    let names = ["d", "clk"].into_iter().chain(register.forcing.nets().iter().copied());
    let pins: Vec<NetId> = names.map(|name| netlist.add_input(name)).collect();
    let q = netlist.add_register(register.clone(), &pins);
    netlist.add_output("q", q);
    netlist
}

/// What the node means: its value after its pins have changed.
fn meaning(
    graph: &mut AndGraph,
    register: &RegisterNode,
    value: AndLiteral,
    [before, now]: [&[AndLiteral]; 2],
) -> AndLiteral {
    let (was_on, is_on) = (before[1], now[1]);
    let takes = match register.kind {
        RegisterKind::Rising => graph.and(is_on, was_on ^ 1),
        RegisterKind::Falling => graph.and(is_on ^ 1, was_on),
        RegisterKind::High => is_on,
        RegisterKind::Low => is_on ^ 1,
    };
    let taken = graph.choice(takes, now[0], value);
    match now[2..] {
        [reset] => graph.choice(reset, AndLiteral::from(register.starts_at()), taken),
        [set, reset] => {
            let kept = graph.choice(set, 1, taken);
            graph.and(kept, reset ^ 1)
        }
        _ => taken,
    }
}

/// The same of values.
fn value_after(register: &RegisterNode, value: bool, before: &[bool], now: &[bool]) -> bool {
    let [value, before, now] =
        [&[value], before, now].map(|bits| bits.iter().map(|&bit| AndLiteral::from(bit)).collect::<Vec<_>>());
    meaning(&mut AndGraph::new(0), register, value[0], [&before, &now]) == 1
}

fn of_cells(register: &RegisterNode, form: RegisterForm) -> Netlist {
    let mut source = alone(register);
    gate_data(&mut source);
    let mut cells = lower(&source, &multiplexer_library(), form).unwrap();
    share(&mut cells);
    sweep(&mut cells);
    cells
}

/// The cells with one delay beside the node: in a step, either the cells take new values, or one pin changes because
/// nothing else does. It is bad if settled cells show something else than the node, or if they never settle.
fn beside(register: &RegisterNode, cells: &Netlist) -> TransitionSystem {
    let nets: Vec<NetId> = cells.cells().map(|(id, _)| id).collect();
    let step = View::of(cells, &nets).expect("all loops are cut").network;
    let (pins, count) = (cells.inputs().len(), nets.len());
    let mut graph = AndGraph::new(2 * pins + count + 1 + TIME_BITS);
    let mut sources = (0..2 * pins + count + 1 + TIME_BITS).map(|at| graph.source(at)).collect::<Vec<_>>().into_iter();
    let mut take = |number: usize| sources.by_ref().take(number).collect::<Vec<_>>();
    let [wishes, now, own, value, time] = [pins, pins, count, 1, TIME_BITS].map(&mut take);
    let next = graph.outputs(&step, &[now.as_slice(), &own].concat());
    let settled = own.iter().zip(&next[1..]).fold(1, |all, (&one, &other)| {
        let is_same = graph.choice(one, other, other ^ 1);
        graph.and(all, is_same)
    });
    let mut is_free = settled;
    let mut after = now.clone();
    for (pin, &wish) in after.iter_mut().zip(&wishes) {
        let changes = graph.and(is_free, wish);
        *pin = graph.choice(changes, *pin ^ 1, *pin);
        is_free = graph.and(is_free, wish ^ 1);
    }
    let taken = meaning(&mut graph, register, value[0], [&now, &after]);
    let mut all_ones = 1;
    let mut later = Vec::new();
    for &bit in &time {
        let turned = graph.choice(all_ones, bit ^ 1, bit);
        later.push(graph.and(turned, settled ^ 1));
        all_ones = graph.and(all_ones, bit);
    }
    let differs = graph.choice(next[0], value[0] ^ 1, value[0]);
    let bad = vec![graph.and(settled, differs), all_ones];
    let logic = crate::Logic::new(cells);
    let shown = register.kind != RegisterKind::Low && register.starts_at();
    let starts = (0..pins).map(|_| false).chain(nets.iter().map(|&id| logic.value(id))).chain([shown]);
    let starts = starts.chain([false; TIME_BITS]);
    let nexts = after.iter().chain(&next[1..]).chain([&taken]).chain(&later);
    let state = |(start, &next)| SystemRegister { name: String::new(), start: Some(start), next };
    TransitionSystem {
        inputs: vec![String::new(); pins],
        registers: starts.zip(nexts).map(state).collect(),
        ands: graph.ands.items,
        bad,
        constraints: Vec::new(),
    }
}

fn verdicts(register: &RegisterNode, cells: &Netlist) -> Vec<PropertyVerdict> {
    PropertySearch::new(beside(register, cells), SearchBudget::default(), CancelFlag::default()).finish()
}

#[test]
fn the_cells_of_every_register_do_for_ever_what_it_means() {
    for register in all() {
        for form in [RegisterForm::Nands, RegisterForm::Multiplexers] {
            let found = verdicts(&register, &of_cells(&register, form));
            assert!(
                found.iter().all(|one| matches!(one, PropertyVerdict::Proved(_))),
                "{register:?} {form:?} {found:?}"
            );
        }
    }
}

#[test]
fn the_cells_of_another_register_are_refuted() {
    for register in all() {
        let other = RegisterNode { kind: register.kind.opposite(), ..register.clone() };
        let found = verdicts(&register, &of_cells(&other, RegisterForm::Nands));
        assert!(
            matches!(found[..], [PropertyVerdict::Refuted(_), PropertyVerdict::Proved(_)]),
            "{register:?} {found:?}"
        );
    }
}

#[test]
fn the_cells_of_every_register_work_for_all_delays() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for (register, form) in all()
        .flat_map(|register| [RegisterForm::Nands, RegisterForm::Multiplexers].map(|form| (register.clone(), form)))
    {
        let netlist = of_cells(&register, form);
        for _ in 0..30 {
            let mut draw = |bound: u32| (random.next_u32() % bound) as usize;
            // The inverter of a clock is no slower than two other cells.
            let is_inverter = |id| netlist.cell(id).is_some_and(|cell| cell.function == Function::NOT);
            let mut delayed = Delayed::new(&netlist, |id| 1 + draw(if is_inverter(id) { 2 } else { 3 }));
            let mut pins = vec![false; netlist.inputs().len()];
            let mut q = delayed.run(&pins, 40)[0];
            for _ in 0..60 {
                let before = pins.clone();
                let at = draw(pins.len() as u32);
                pins[at] = !pins[at];
                q = value_after(&register, q, &before, &pins);
                assert_eq!(delayed.run(&pins, 40), [q], "{register:?} {form:?} {pins:?}");
            }
        }
    }
}

#[test]
fn registers_are_of_few_cells() {
    let count = |forcing, kind, start, form| {
        let register = RegisterNode { kind, forcing, start: Some(start), name: None, span: None };
        of_cells(&register, form).cells().count()
    };
    for start in [false, true] {
        let of = |forcing, kind| count(forcing, kind, start, RegisterForm::Nands);
        let cells = FORCINGS.map(|forcing| [of(forcing, RegisterKind::High), of(forcing, RegisterKind::Rising)]);
        assert_eq!(cells, [[4, 8], [7, 12], [10, 16]]);
        let of = |kind| count(Forcing::Never, kind, start, RegisterForm::Multiplexers);
        assert_eq!([of(RegisterKind::Low), of(RegisterKind::Falling)], [1, 2]);
    }
}
