//! Random machines against their sources, at the level of logic.

use proptest::prelude::*;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::as_nands;
use crate::example::{flip_flop, random_machine};
use crate::{NetId, Node};
use nbc_base::model::Function;

fn thin_cells() -> CellLibrary {
    CellLibrary::uniform(Function::all().filter(|f| ![Function::XOR, Function::XNOR].contains(f) && f.arity() > 0))
}

fn expected(step: &ClockStep, rows: &[Vec<bool>]) -> Vec<Vec<bool>> {
    let mut state: Vec<bool> = step.state.iter().map(|bit| bit.start).collect();
    let mut shown = Vec::new();
    for (at, row) in rows.iter().enumerate() {
        if at > 0 {
            state = step.run(row, &state).1;
        }
        shown.push(step.run(row, &state).0);
    }
    shown
}

/// By thread, row and port, if every thread gets these rows of input bits.
fn run(machine: &WaveMachine, rows: &[Vec<bool>]) -> Vec<Vec<Vec<bool>>> {
    let beat = machine.beat as usize;
    let netlist = &machine.netlist;
    let slots = netlist.ids().map(|id| id.index() + 1).max().unwrap_or(0);
    let mut shown = vec![false; slots];
    for id in netlist.ids() {
        if let Node::Constant(value) = netlist.node(id) {
            shown[id.index()] = *value;
        }
    }
    let cells: Vec<_> = netlist.cells().map(|(id, cell)| (id, cell.function, netlist.pins(id))).collect();
    let held_bits = |id: NetId, pins: &[NetId]| (0..).zip(pins).map(|(pin, _)| machine.held_bits(id, pin)).collect();
    let held: Vec<Vec<Vec<bool>>> = cells.iter().map(|(id, _, pins)| held_bits(*id, pins)).collect();
    let ports: Vec<NetId> = netlist.outputs().iter().map(|&id| netlist.pins(id)[0]).collect();
    let mut past: Vec<Vec<bool>> = Vec::new();
    for at in 0..machine.cycles(rows.len()) / beat {
        for (input, id) in netlist.inputs().iter().enumerate() {
            shown[id.index()] = rows[machine.row_at(input, at * beat, rows.len())][input];
        }
        let next: Vec<bool> = cells
            .iter()
            .zip(&held)
            .map(|((_, function, pins), held)| {
                let bit = |pin: usize| held[pin].get(at * beat).copied().unwrap_or(shown[pins[pin].index()]);
                function.at((0..function.inputs()).map(|input| bit(input.min(pins.len() - 1))))
            })
            .collect();
        for ((id, ..), next) in cells.iter().zip(next) {
            shown[id.index()] = next;
        }
        past.push(ports.iter().map(|net| shown[net.index()]).collect());
    }
    let value = |thread: usize, row: usize, output: usize| match machine.reading(output, row, thread) {
        Reading::Start(start) => start,
        Reading::Cycle(cycle) => past[cycle / beat][output],
    };
    let row = |thread: usize, row: usize| (0..ports.len()).map(|output| value(thread, row, output)).collect();
    (0..machine.period as usize).map(|thread| (0..rows.len()).map(|at| row(thread, at)).collect()).collect()
}

fn check(source: &Netlist, options: &WaveOptions, random: &mut ChaCha8Rng) -> WaveMachine {
    let machine = balance(source, &thin_cells(), options).unwrap_or_else(|error| panic!("{error}\n{source}"));
    let step = ClockStep::of(source).unwrap();
    certify(&step, &machine).unwrap_or_else(|error| panic!("{error}\n{source}\n{}", machine.netlist));
    let rows: Vec<Vec<bool>> =
        (0..12).map(|_| step.inputs.iter().map(|_| random.next_u32() & 1 == 1).collect()).collect();
    let expected = expected(&step, &rows);
    for (thread, shown) in run(&machine, &rows).into_iter().enumerate() {
        assert_eq!(shown, expected, "machine {thread} of\n{source}\n{}", machine.netlist);
    }
    machine
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn random_machines_agree_with_their_sources_in_every_thread(seed in any::<u64>(), beat in 1u32..3) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let source = random_machine(&mut random);
        let mapping = MapOptions { effort: Effort::Fast, ..MapOptions::default() };
        check(&source, &WaveOptions { beat, mapping, ..WaveOptions::default() }, &mut random);
    }
}

#[test]
fn a_machine_with_a_wrong_phase_or_a_wrong_cell_is_not_proved() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    let (mut mixed, mut different) = (0, 0);
    for _ in 0..50 {
        let source = random_machine(&mut random);
        let machine = check(&source, &WaveOptions::default(), &mut random);
        let step = ClockStep::of(&source).unwrap();
        let Some((&id, _)) = machine.phase.iter().next() else { continue };
        if machine.period > 1 {
            let mut wrong = machine.clone();
            *wrong.phase.get_mut(&id).unwrap() += 1;
            mixed += usize::from(certify(&step, &wrong).is_err());
        }
        let mut wrong = machine.clone();
        if let Node::Cell(cell) = wrong.netlist.node_mut(id) {
            cell.function = cell.function.inverted();
        }
        different += usize::from(certify(&step, &wrong).is_err());
    }
    assert!(mixed > 2 && different > 10, "{mixed} and {different} faults were found");
}

#[test]
fn a_register_starts_as_its_cells_do_though_the_one_that_names_it_has_no_start_value() {
    let mut random = ChaCha8Rng::seed_from_u64(72);
    let mut started = [0; 2];
    for _ in 0..50 {
        let mut source = as_nands(&random_machine(&mut random));
        let expected = ClockStep::of(&source).unwrap();
        let named: Vec<_> = source
            .cells()
            .filter(|(_, cell)| expected.state.iter().any(|bit| cell.name.as_ref() == Some(&bit.name)))
            .map(|(id, _)| id)
            .collect();
        named.into_iter().for_each(|id| source.cell_mut(id).unwrap().start = None);
        let step = ClockStep::of(&source).unwrap();
        assert_eq!(step.state, expected.state, "{source}");
        step.state.iter().for_each(|bit| started[usize::from(bit.start)] += 1);
    }
    assert!(started.iter().all(|&count| count > 10), "{started:?} start at 0 and 1");
}

fn started(rises: bool, starts: [Option<bool>; 4]) -> Netlist {
    let mut netlist = Netlist::new("started");
    let [d, clock] = ["d", "clk"].map(|name| netlist.add_input(name));
    let edge = if rises { clock } else { netlist.add_gate(Function::NOT, &[clock]) };
    let q = flip_flop(&mut netlist, "q", d, edge, false);
    netlist.add_output("o", q);
    let mut netlist = as_nands(&netlist);
    for (name, start) in ["q", "q.n", "q.held", "q.held.n"].into_iter().zip(starts) {
        let id = netlist.ids().find(|&id| netlist.net_name(id) == name).unwrap();
        netlist.cell_mut(id).unwrap().start = start;
    }
    netlist
}

#[test]
fn start_values_that_contradict_are_no_step() {
    let [zero, one] = [Some(false), Some(true)];
    let state = |rises, starts| ClockStep::of(&started(rises, starts)).map(|step| step.state[0].start);
    let contradicts = Err(WaveError::Starts { net: "q".to_owned() });
    assert_eq!(state(true, [zero, zero, zero, one]), contradicts);
    assert_eq!(state(true, [None, zero, zero, one]), Ok(true));
    // The first latch of a register that stores when its clock falls is seen before that.
    assert_eq!([true, false].map(|rises| state(rises, [one, None, zero, one])), [Ok(true), contradicts]);
}

#[test]
fn a_register_whose_data_never_change_has_steps() {
    let mut random = ChaCha8Rng::seed_from_u64(73);
    for value in [false, true] {
        let mut netlist = Netlist::new("constant");
        let clock = netlist.add_input("clk");
        let data = netlist.add_constant(value);
        let q = flip_flop(&mut netlist, "q", data, clock, !value);
        netlist.add_output("o", q);
        let step = ClockStep::of(&netlist).unwrap();
        assert_eq!((step.state[0].start, step.run(&[true], &[!value])), (!value, (vec![!value], vec![value])));
        check(&netlist, &WaveOptions { beat: 1, ..WaveOptions::default() }, &mut random);
    }
}
