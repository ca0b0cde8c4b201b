//! Random machines against their sources, at the level of logic.

use proptest::prelude::*;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::Node;
use crate::example::random_machine;
use nbc_base::model::Function;

/// The robots of clock 1 in the shipped library.
fn thin_cells() -> CellLibrary {
    CellLibrary::uniform(Function::all().filter(|f| ![Function::XOR, Function::XNOR].contains(f) && f.arity() > 0))
}

/// What the source shows of each row: the first before an edge, each later one after one.
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

fn check(source: &Netlist, options: &WaveOptions, random: &mut ChaCha8Rng) -> WaveMachine {
    let machine = balance(source, &thin_cells(), options).unwrap_or_else(|error| panic!("{error}\n{source}"));
    let step = ClockStep::of(source).unwrap();
    certify(&step, &machine).unwrap_or_else(|error| panic!("{error}\n{source}\n{}", machine.netlist));
    let rows: Vec<Vec<bool>> =
        (0..12).map(|_| step.inputs.iter().map(|_| random.next_u32() & 1 == 1).collect()).collect();
    let expected = expected(&step, &rows);
    for (thread, shown) in machine.run(&rows).into_iter().enumerate() {
        assert_eq!(shown, expected, "machine {thread} of\n{source}\n{}", machine.netlist);
    }
    machine
}

proptest! {
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
    for _ in 0..100 {
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
    assert!(mixed > 5 && different > 20, "{mixed} and {different} faults were found");
}
