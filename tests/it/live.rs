//! Sessions without the command line: sources in memory, swarms that are stepped, work that is cancelled.

use crate::support::*;
use nbc::{CompileOptions, Observer, Session, TestRun};
use nbc_session::RunEnd;

#[allow(dead_code, reason = "the example's own main reads the terminal")]
#[path = "../../examples/live.rs"]
mod example;

const LATCH: &str = include_str!("../../circuits/latch.nb");

fn observed(observer: &mut dyn Observer) -> TestRun {
    let (session, checked) = session_of(LATCH);
    session.test(&checked, &checked.program.tests[0], &in_physics(), observer).unwrap().remove(0)
}

#[test]
fn the_example_steps_the_latch() {
    let mut told = Vec::new();
    example::converse(&b"11 8\n00 4\nwhat\n01 8\n10 4\n"[..], &mut told).unwrap();
    let told = String::from_utf8(told).unwrap();
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines[0], "5 robots, inputs d e");
    let expected = [
        "cycle 8: q 1, nq 0",
        "cycle 12: q 1, nq 0",
        "expected 2 bits and a number of cycles, such as `11 6`",
        "cycle 20: q 0, nq 1",
        "cycle 24: q 0, nq 1",
    ];
    assert_eq!(lines[1..], expected);
}

#[test]
fn a_live_swarm_does_what_a_test_does() {
    let run = observed(&mut ());
    assert!(run.verdict.passed && run.end == RunEnd::Complete);
    let tested = run.swarm.unwrap();
    let mut live = session_of(LATCH).0.swarm(&tested.compiled);
    for cycle in &tested.trace.cycles {
        assert_eq!(live.step(&cycle.inputs), Ok(cycle));
    }
    assert_eq!(*live.trace(), tested.trace);
}

#[test]
fn a_swarm_in_parts_does_the_same() {
    let (session, checked) = session_of(LATCH);
    let compiled = checked.compile(&"d_latch".into(), &CompileOptions::default()).unwrap();
    let (mut whole, mut parted) = (session.swarm(&compiled), session.swarm(&compiled));
    for (inputs, at) in [([false, true], 2), ([true, true], 4), ([true, false], 1)] {
        let begun = parted.begin(&inputs).unwrap();
        assert_eq!(begun, parted.begin(&inputs).unwrap(), "a cycle that has begun changes nothing");
        let part = |robots| parted.part(&begun, &compiled.assembly, Session::LIVE_CYCLES, robots);
        let states = [part(0..at), part(at..5)].map(|part| part.simulate(&nbc::Simulator::default()));
        assert_eq!(parted.end(begun, &states), whole.step(&inputs));
    }
    assert_eq!(parted.trace(), whole.trace());
    assert_eq!(parted.snapshot().robots(), whole.snapshot().robots());
}

#[test]
fn a_restored_swarm_does_the_same_again() {
    let (session, checked) = session_of(LATCH);
    let compiled = checked.compile(&"d_latch".into(), &CompileOptions::default()).unwrap();
    let mut swarm = session.swarm(&compiled);
    let walk = |swarm: &mut nbc::LiveSwarm| {
        [[true, true], [true, false], [false, true]].iter().for_each(|inputs| _ = swarm.step(inputs));
        swarm.trace().clone()
    };
    swarm.step(&[false, true]).unwrap();
    let snapshot = swarm.snapshot();
    let first = walk(&mut swarm);
    swarm.restore(&snapshot);
    assert_eq!(walk(&mut swarm), first);
    let mut other = session.swarm(&compiled);
    other.restore(&snapshot);
    assert_eq!(walk(&mut other), first);
}

struct Until(u64);

impl Observer for Until {
    fn progress(&mut self, done: u64, _: u64) {
        self.0 = self.0.saturating_sub(done.min(1));
    }

    fn is_cancelled(&self) -> bool {
        self.0 == 0
    }
}

#[test]
fn a_cancelled_test_has_its_completed_rows_and_has_not_passed() {
    let whole = observed(&mut ());
    let first = whole.verdict.rows[0].cycles.unwrap() as u64;
    let run = observed(&mut Until(first + 1));
    assert_eq!((run.end, run.verdict.passed), (RunEnd::Cancelled, false));
    assert_eq!(run.verdict.rows, whole.verdict.rows[..1]);
    assert_eq!(run.swarm.unwrap().trace.cycles.len() as u64, first + 1);
}

#[test]
fn an_error_has_its_sources() {
    let (mut session, _) = session_of(LATCH);
    session.update("a.nb", 2, LATCH.replace("not d", "not f"));
    let fault = session.open("a.nb").unwrap_err();
    assert!(fault.to_string().starts_with("a.nb:5:31: error[unknown]"), "{fault}");
}
