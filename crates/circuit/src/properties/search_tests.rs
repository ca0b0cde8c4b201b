//! What a search says of random machines and of counters, against a search through all their states.

use std::collections::BTreeSet;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::and_graph::AndGraph;
use crate::properties::bounded::{Bounded, Induction};
use crate::properties::frames::{Found, Frames};
use crate::properties::needed::needed;
use crate::properties::pairs::never_together;
use crate::properties::system::{Cube, is_on};
use nbc_base::model::Function;
use nbc_base::source::CancelFlag;

fn random_system(random: &mut ChaCha8Rng) -> TransitionSystem {
    let mut draw = |bound: usize| (random.next_u32() as usize) % bound;
    let (inputs, registers) = (draw(4), 1 + draw(8));
    let mut graph = AndGraph::new(inputs + registers);
    let mut literals: Vec<usize> = (0..inputs + registers).map(|at| graph.source(at)).collect();
    for _ in 0..3 + draw(30) {
        let pins = [literals[draw(literals.len())] ^ draw(2), literals[draw(literals.len())] ^ draw(2)];
        let made = match draw(3) {
            0 => graph.function(Function::XOR, pins),
            _ => graph.and(pins[0], pins[1]),
        };
        literals.push(made);
    }
    let starts: Vec<Option<bool>> = (0..registers)
        .map(|_| match draw(12) {
            0 => None,
            value => Some(value % 4 == 1),
        })
        .collect();
    let late = |random: &mut ChaCha8Rng| {
        let back = (random.next_u32() as usize % literals.len()).min(random.next_u32() as usize % literals.len());
        literals[literals.len() - 1 - back] ^ (random.next_u32() & 1) as usize
    };
    let register = |(at, start): (usize, Option<bool>)| SystemRegister { name: format!("r{at}"), start, next: 0 };
    let mut registers: Vec<SystemRegister> = starts.into_iter().enumerate().map(register).collect();
    registers.iter_mut().for_each(|register| register.next = late(random));
    let mut rare = |random: &mut ChaCha8Rng, parts: usize| {
        let parts: Vec<usize> = (0..parts).map(|_| late(random)).collect();
        parts.into_iter().fold(1, |all, one| graph.and(all, one))
    };
    let bad = (0..1 + random.next_u32() % 3).map(|_| rare(random, 3)).collect();
    let constraints = (0..random.next_u32() % 2).map(|_| rare(random, 2) ^ 1).collect();
    TransitionSystem {
        inputs: (0..inputs).map(|at| format!("i{at}")).collect(),
        registers,
        ands: graph.ands.items,
        bad,
        constraints,
    }
}

fn bits(number: usize, count: usize) -> Vec<bool> {
    (0..count).map(|bit| number >> bit & 1 == 1).collect()
}

fn exhaustive(system: &TransitionSystem) -> Vec<Option<usize>> {
    explored(system).0
}

/// The number of steps of a shortest violation of each property, and all states that are reached.
fn explored(system: &TransitionSystem) -> (Vec<Option<usize>>, BTreeSet<Vec<bool>>) {
    let all = |state: &Vec<bool>| -> Vec<Vec<bool>> {
        (0..1 << system.inputs.len()).map(|inputs| system.values(&bits(inputs, system.inputs.len()), state)).collect()
    };
    let states = (0..1 << system.registers.len()).map(|state| bits(state, system.registers.len()));
    let mut front: BTreeSet<Vec<bool>> = states.filter(|state| system.may_start(state)).collect();
    let mut seen = front.clone();
    let mut found = vec![None; system.bad.len()];
    let mut steps = 0;
    while !front.is_empty() {
        steps += 1;
        let mut next = BTreeSet::new();
        for values in front.iter().flat_map(all) {
            if !system.constraints.iter().all(|&constraint| is_on(&values, constraint)) {
                continue;
            }
            for (found, &bad) in found.iter_mut().zip(&system.bad) {
                if found.is_none() && is_on(&values, bad) {
                    *found = Some(steps);
                }
            }
            let state = system.next(&values);
            if seen.insert(state.clone()) {
                next.insert(state);
            }
        }
        front = next;
    }
    (found, seen)
}

fn check(system: &TransitionSystem, what: &str) {
    let expected = exhaustive(system);
    let search = PropertySearch::new(system.clone(), SearchBudget::default(), CancelFlag::default());
    for (property, (verdict, expected)) in search.finish().into_iter().zip(&expected).enumerate() {
        match verdict {
            PropertyVerdict::Refuted(run) => {
                assert_eq!(Some(run.inputs.len()), *expected, "{what}: {system:?}");
                assert_eq!(system.violation(property, &run), Some(run.inputs.len() - 1), "{what}: {system:?}");
            }
            PropertyVerdict::Proved(_) => assert_eq!(*expected, None, "{what}: {system:?}"),
            PropertyVerdict::Undecided { .. } => panic!("{what} is undecided: {system:?}"),
        }
    }
    for (property, expected) in expected.into_iter().enumerate() {
        let mut frames = Frames::new(system, property, (Vec::new(), Vec::new()), CancelFlag::default());
        let found = loop {
            match frames.advance(system) {
                Found::Nothing => {}
                Found::Violation(run) => break Some(system.violation(property, &run).unwrap() + 1),
                Found::Invariant(_) => break None,
            }
        };
        assert_eq!(found.is_some(), expected.is_some(), "the invariant of {what}: {system:?}");
        assert!(found >= expected, "the run of {what}: {system:?}");
    }
}

#[test]
fn ten_thousand_random_machines_are_decided_as_by_their_states() {
    let mut random = ChaCha8Rng::seed_from_u64(60);
    let (mut proved, mut refuted) = (0, 0);
    for machine in 0..10_000 {
        let system = random_system(&mut random);
        check(&system, &format!("machine {machine}"));
        let found = exhaustive(&system);
        refuted += found.iter().flatten().count();
        proved += found.iter().filter(|found| found.is_none()).count();
    }
    assert!(proved > 10_000 && refuted > 5_000, "{proved} properties proved, {refuted} refuted");
}

#[test]
fn induction_alone_decides_what_it_says_it_does() {
    let mut random = ChaCha8Rng::seed_from_u64(61);
    let mut proved = 0;
    for _ in 0..300 {
        let system = random_system(&mut random);
        let expected = exhaustive(&system);
        let mut bounded = Bounded::new(&system, CancelFlag::default());
        let mut induction = Induction::new(&system, CancelFlag::default());
        let mut open: BTreeSet<usize> = (0..system.bad.len()).collect();
        while induction.steps < 10 {
            induction.extend(&system);
            while bounded.step < induction.steps {
                if let Some((property, run)) = bounded.advance(&system, &open, u64::MAX) {
                    assert_eq!(Some(run.inputs.len()), expected[property]);
                    open.remove(&property);
                }
            }
            for property in induction.proved(&system, &open, u64::MAX).unwrap() {
                assert_eq!(expected[property], None, "{system:?}");
                open.remove(&property);
                proved += 1;
            }
        }
    }
    assert!(proved > 100, "{proved} were proved");
}

#[test]
fn registers_that_never_have_some_values_together_have_them_in_no_state() {
    let mut random = ChaCha8Rng::seed_from_u64(65);
    let mut found = [0; 2];
    for _ in 0..300 {
        let system = random_system(&mut random);
        let (_, states) = explored(&system);
        for cube in never_together(&system, &CancelFlag::default()).0 {
            let is_in = |state: &Vec<bool>| cube.iter().all(|&(at, value)| state[at] == value);
            assert!(!states.iter().any(is_in), "{cube:?}: {system:?}");
            found[cube.len() - 1] += 1;
        }
    }
    assert!(found.iter().all(|&count| count > 100), "{found:?} cubes of one and two registers");
}

#[test]
fn an_invariant_has_only_the_clauses_that_it_needs() {
    // The last place of a ring with one 1 excludes the first; the places between them matter, and the counter does not.
    let mut system = counter(4, 9, 15);
    let registers = system.registers.len();
    let place = |at: usize| 2 * (registers + 1 + at % 4);
    let ring = (0..4).map(|at| SystemRegister { name: format!("r{at}"), start: Some(at == 0), next: place(at + 3) });
    let shifted = |literal: usize| if literal / 2 > registers { literal + 8 } else { literal };
    system.ands.iter_mut().flatten().for_each(|pin| *pin = shifted(*pin));
    system.registers.iter_mut().for_each(|register| register.next = shifted(register.next));
    system.registers.extend(ring);
    system.ands.push([place(3), place(0)]);
    system.bad = vec![2 * (registers + 4 + system.ands.len())];
    let pairs = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    let mut cubes: Vec<Cube> =
        pairs.iter().map(|pair| pair.iter().map(|at| (registers + at, true)).collect()).collect();
    cubes.insert(2, vec![(0, true), (1, true), (2, true), (3, true)]);
    let kept = needed(&system, 0, &[], cubes, &CancelFlag::default());
    let expected: Vec<Cube> =
        [[0, 1], [0, 3], [1, 2], [2, 3]].iter().map(|pair| pair.map(|at| (registers + at, true)).to_vec()).collect();
    assert_eq!(kept, expected);
}

#[test]
fn a_wrong_proof_is_found() {
    let mut random = ChaCha8Rng::seed_from_u64(62);
    let mut wrong = 0;
    for _ in 0..300 {
        let system = random_system(&mut random);
        let violated: Vec<usize> =
            exhaustive(&system).iter().enumerate().filter(|(_, found)| found.is_some()).map(|(at, _)| at).collect();
        for property in violated {
            let together = BTreeSet::from([property]);
            for steps in 1..4 {
                assert!(!InductiveProof::Steps { steps, together: together.clone() }.proves(&system, property));
            }
            let clauses =
                system.registers.iter().enumerate().filter_map(|(at, register)| Some(vec![(at, register.start?)]));
            for clauses in [Vec::new(), clauses.collect()] {
                let given = BTreeSet::new();
                assert!(!InductiveProof::Invariant { clauses, given }.proves(&system, property), "{system:?}");
            }
            wrong += 1;
        }
    }
    assert!(wrong > 50, "{wrong} properties are violated");
}

/// Whether a state, the lowest bit first, is a number.
fn is_number(graph: &mut AndGraph, state: &[usize], number: usize) -> usize {
    let bit = |(bit, &literal): (usize, &usize)| literal ^ usize::from(number >> bit & 1 == 0);
    state.iter().enumerate().map(bit).fold(1, |all, literal| graph.and(all, literal))
}

fn counter(bits: usize, last: usize, wrong: usize) -> TransitionSystem {
    let mut graph = AndGraph::new(bits);
    let state: Vec<usize> = (0..bits).map(|at| graph.source(at)).collect();
    let [end, bad] = [last, wrong].map(|number| is_number(&mut graph, &state, number));
    let mut carry = 1;
    let mut registers = Vec::new();
    for (bit, &literal) in state.iter().enumerate() {
        let sum = graph.function(Function::XOR, [literal, carry]);
        carry = graph.and(literal, carry);
        registers.push(SystemRegister { name: format!("c{bit}"), start: Some(false), next: graph.and(sum, end ^ 1) });
    }
    TransitionSystem { registers, ands: graph.ands.items, bad: vec![bad], ..TransitionSystem::default() }
}

#[test]
fn counters_stay_below_their_end_and_reach_it() {
    let decide =
        |system| PropertySearch::new(system, SearchBudget::default(), CancelFlag::default()).finish().remove(0);
    assert!(matches!(decide(counter(8, 99, 200)), PropertyVerdict::Proved(_)));
    let PropertyVerdict::Refuted(run) = decide(counter(8, 99, 99)) else { panic!("it is reached") };
    assert_eq!(run.inputs.len(), 100);
}

#[test]
fn a_search_ends_with_its_budget_and_does_the_same_again() {
    let budget = SearchBudget { steps: 20, work: 300 };
    let search = || {
        let mut search = PropertySearch::new(counter(16, 40_000, 39_999), budget, CancelFlag::default());
        while !search.is_done() {
            search.advance();
        }
        (search.work(), search.verdicts())
    };
    let (work, verdicts) = search();
    assert!(matches!(verdicts[0], PropertyVerdict::Undecided { steps } if steps > 0), "{verdicts:?}");
    assert_eq!(search(), (work, verdicts));
}

/// A counter of eight bits that counts by one, or by three while its input is 1; it must not become 200.
fn two_paces() -> TransitionSystem {
    let mut graph = AndGraph::new(9);
    let sources: Vec<usize> = (0..9).map(|at| graph.source(at)).collect();
    let (fast, state) = (sources[0], &sources[1..]);
    let bad = is_number(&mut graph, state, 200);
    let mut carry = 0;
    let mut registers = Vec::new();
    for (bit, &c) in state.iter().enumerate() {
        let added = [1, fast].get(bit).copied().unwrap_or(0);
        let half = graph.function(Function::XOR, [c, added]);
        let next = graph.function(Function::XOR, [half, carry]);
        let [both, carried] = [graph.and(c, added), graph.and(half, carry)];
        carry = graph.or(both, carried);
        registers.push(SystemRegister { name: format!("c{bit}"), start: Some(false), next });
    }
    TransitionSystem {
        inputs: vec!["fast".to_owned()],
        registers,
        ands: graph.ands.items,
        bad: vec![bad],
        ..TransitionSystem::default()
    }
}

#[test]
fn a_run_may_be_longer_than_the_shortest_if_the_work_ends() {
    let system = two_paces();
    let search =
        |work| PropertySearch::new(system.clone(), SearchBudget { steps: 10_000, work }, CancelFlag::default());
    let shortest = exhaustive(&system)[0].unwrap();
    let mut whole = search(10_000_000);
    let mut found = None;
    while !whole.is_done() {
        whole.advance();
        if let PropertyVerdict::Refuted(run) = whole.verdicts().remove(0) {
            found.get_or_insert((whole.work(), run.inputs.len()));
        }
    }
    let PropertyVerdict::Refuted(last) = whole.verdicts().remove(0) else { panic!("it becomes 200") };
    let (work, steps) = found.unwrap();
    assert!(steps > shortest && last.inputs.len() == shortest, "{steps} steps, {} at last", last.inputs.len());
    // What is found until then is a violation, too.
    let PropertyVerdict::Refuted(run) = search(work + 1).finish().remove(0) else { panic!("a run was found") };
    assert_eq!((run.inputs.len(), system.violation(0, &run)), (steps, Some(steps - 1)));
}
