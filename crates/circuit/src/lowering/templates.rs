//! Proofs that the cells of a register do what it does, for each kind, start and form, whatever forces it. They are
//! small enough that all their states are visited.

use std::collections::BTreeSet;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::Delayed;
use crate::example::multiplexer_library;
use crate::network::View;
use crate::passes::{share, sweep};

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

/// What the node means: its value after its pins have changed to `now`.
fn meaning(register: &RegisterNode, q: bool, before: &[bool], now: &[bool]) -> bool {
    let (was_on, is_on) = (before[1], now[1]);
    let takes = match register.kind {
        RegisterKind::Rising => is_on && !was_on,
        RegisterKind::Falling => !is_on && was_on,
        RegisterKind::High => is_on,
        RegisterKind::Low => !is_on,
    };
    match now[2..] {
        [true] => register.starts_at(),
        [_, true] => false,
        [true, false] => true,
        _ if takes => now[0],
        _ => q,
    }
}

fn of_cells(register: &RegisterNode, form: RegisterForm) -> Netlist {
    let mut source = alone(register);
    gate_data(&mut source);
    let mut cells = lower(&source, &multiplexer_library(), form).unwrap();
    share(&mut cells);
    sweep(&mut cells);
    cells
}

/// Visits every state that cells of one delay reach by changes of one pin at a time, and compares what they show once
/// they are settled with the meaning of the node.
fn check_all_states(register: &RegisterNode, form: RegisterForm) {
    let netlist = of_cells(register, form);
    let cells: Vec<NetId> = netlist.cells().map(|(id, _)| id).collect();
    let step = View::of(&netlist, &cells).unwrap().network;
    let logic = crate::Logic::new(&netlist);
    let shown = |cells: &[bool], pins: &[bool]| step.run(pins.iter().chain(cells).copied())[0];
    let settled = |pins: &[bool], mut cells: Vec<bool>| {
        for _ in 0..50 {
            let next = step.run(pins.iter().chain(&cells).copied()).split_off(1);
            if next == cells {
                return cells;
            }
            cells = next;
        }
        panic!("{register:?} does not settle at {pins:?}");
    };
    let pins = vec![false; netlist.inputs().len()];
    let at_start = settled(&pins, cells.iter().map(|&id| logic.value(id)).collect());
    let expected = if register.kind == RegisterKind::Low { false } else { register.starts_at() };
    assert_eq!(shown(&at_start, &pins), expected, "{register:?} at the start");
    let mut seen: BTreeSet<(Vec<bool>, Vec<bool>)> = BTreeSet::new();
    let mut open = vec![(pins, at_start)];
    while let Some((pins, cells)) = open.pop() {
        for at in 0..pins.len() {
            let mut now = pins.clone();
            now[at] = !now[at];
            let next = settled(&now, cells.clone());
            let expected = meaning(register, shown(&cells, &pins), &pins, &now);
            assert_eq!(shown(&next, &now), expected, "{register:?} {form:?} from {pins:?} to {now:?}");
            if seen.insert((now.clone(), next.clone())) {
                open.push((now, next));
            }
        }
    }
}

#[test]
fn the_cells_of_every_register_do_for_ever_what_it_means() {
    for register in all() {
        check_all_states(&register, RegisterForm::Nands);
        check_all_states(&register, RegisterForm::Multiplexers);
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
                q = meaning(&register, q, &before, &pins);
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
        assert_eq!(cells, [[4, 9], [7, 13], [10, 17]]);
        let of = |kind| count(Forcing::Never, kind, start, RegisterForm::Multiplexers);
        assert_eq!([of(RegisterKind::Low), of(RegisterKind::Falling)], [1, 2]);
    }
}
