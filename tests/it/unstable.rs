//! A robot whose simulation fails has no output: it fails its row, its world, its simulation and its search, and every
//! door names it.

use nbc_base::source::MemoryWorld;
use nbc_session::report::describe_test;
use nbc_session::{CompileOptions, RunReport, Session};
use nbc_swarm::SwarmBits;

use crate::support::*;

/// In this world robots become unstable in their first cycles. No motion is a 0, which is what each row expects.
pub const BOOM: &str = "\
world w { stiffness: 10 }

circuit conj(a, b) -> (r) {
    r = a and b
}

test conj \"all rows expect 0\" in w {
    a b | r
    0 1 | 0
    1 0 | 0
    0 0 | 0
}
";

const WAVES: &str = "\
world w { stiffness: 10 }

circuit toggle(clk) -> (q) {
    q = register(not q, clk)
}

swarm wave { circuit: toggle, registers: waves, world: w }

test toggle {
    clk | q
    0   | -
    ^   | -
}
";

pub const SIMULATED: &str = "\
world w { stiffness: 10 }

circuit conj(a, b) -> (r) {
    r = a and b
}

swarm s { circuit: conj, world: w }

simulate s with schedule (a, b) {
    0 1 for 5 cycles
}
";

fn boom() -> Bench {
    Bench::with("boom.nb", BOOM)
}

pub fn names(text: &str) -> bool {
    text.lines().any(|line| line.contains("robot ") && line.contains(" became unstable in cycle "))
}

#[test]
fn a_test_fails_with_the_robot_even_where_it_expects_what_no_motion_would_be() {
    let bench = boom();
    for command in [&["test", "boom.nb"][..], &["run", "boom.nb"]] {
        let ran = bench.run(command);
        assert_eq!(ran.status, 1, "{}{}", ran.out, ran.err);
        assert!(ran.out.contains("FAIL") && names(&ran.out) && !ran.out.contains("pass\n"), "{}", ran.out);
    }
    let told = bench.run("test boom.nb").out;
    assert!(told.contains("boom.nb:9: row 1: a=0 b=1 | robot and_5x5 on net r became unstable in cycle 1"), "{told}");
    assert!(told.contains("2 rows more failed"), "{told}");
    let told = validate("test", &bench.run("test boom.nb --format json").out);
    let result = validate("run", &bench.read("out/boom/result.json"));
    for report in [&told, &result] {
        assert_eq!((&report["passed"], &report["tests"][0]["passed"]), (&json!(false), &json!(false)));
        let rows = report["tests"][0]["rows"].as_array().unwrap();
        assert_eq!(rows.len(), 3);
        for row in rows {
            assert_eq!((&row["passed"], &row["observed"][0]["bits"]), (&json!(false), &json!("-")), "{row}");
            let fault = &row["fault"];
            assert_eq!((&fault["net"], &fault["cycle"], &fault["kind"]), (&json!("r"), &json!(0), &json!("unstable")));
        }
    }
    assert_eq!(result["tests"][0]["robots"][0]["displacement"], Value::Null);
    let page = bench.read("out/boom/report.html");
    assert!(names(&page) && page.contains("FAIL: 0 of 1 test passed"));
}

#[test]
fn a_row_before_the_fault_keeps_its_verdict() {
    // Springs that become unstable in the third row only, because the robot is held in the others.
    let run = tested(&BOOM.replace("stiffness: 10", "stiffness: 1")).remove(0);
    assert!(run.verdict.passed && run.verdict.fault.is_none());
    let mut trace = run.swarm.unwrap().trace;
    let fault = nbc::Fault { env_step: 84 * 5 + 1, kind: nbc::FaultKind::NonFinite };
    trace.robots[0].fault = Some(fault);
    let told = trace.fault().unwrap();
    assert_eq!(
        (told.cycle, told.to_string()),
        (5, "robot and_5x5 on net r left the range of numbers in cycle 6".into())
    );
}

#[test]
fn a_row_that_checks_nothing_fails_too_and_so_does_a_wave_machine() {
    let unchecked = BOOM.replace("| 0", "| -");
    for text in [&unchecked, WAVES] {
        let run = tested(text).remove(0);
        // The first row of a wave machine shows the start value.
        let told = describe_test(&run.verdict);
        assert!(!run.verdict.passed && run.verdict.rows.iter().skip(1).all(|row| !row.passed), "{told}");
        assert!(names(&told), "{told}");
    }
}

#[test]
fn a_world_in_which_a_robot_fails_does_not_count_for_the_yield() {
    let bench = boom();
    let asked = ["test", "boom.nb", "--vary", "friction=1%", "--worlds", "3"];
    let told = bench.run(&asked);
    assert!(
        told.out.contains("0 of 3 worlds pass") && told.out.contains("`and_5x5` at `r`, in 3 worlds"),
        "{}",
        told.out
    );
    assert!(names(&told.out), "{}", told.out);
    let found = validate("robustness", &bench.run(&[&asked[..], &["--format", "json"]].concat()).out);
    let test = &found["tests"][0];
    assert_eq!((&test["yield"]["passed"], &test["world"]), (&json!(0), &json!("w")));
    for failure in test["failures"].as_array().unwrap() {
        assert_eq!((&failure["fault"]["robot"], &failure["first"]), (&json!("and_5x5"), &Value::Null));
    }
}

#[test]
fn hardening_leaves_out_a_robot_that_fails() {
    let bench = Bench::new();
    let robots = "library few { from: shipped, behaviors: [and] }\nswarm s { circuit: conj, library: few }\n";
    bench.file("boom.nb", format!("{BOOM}\n{robots}"));
    let asked = ["build", "boom.nb", "--harden", "friction=1%", "--worlds", "2", "--format", "json"];
    let ran = bench.run(&asked);
    assert_eq!(ran.status, 1, "{}{}", ran.out, ran.err);
    let built = validate("build", &ran.out);
    let first = &built["hardened"]["tried"][0];
    assert_eq!((&first["yield"]["passed"], &first["fails_first"][0]), (&json!(0), &json!("and_5x5")));
}

#[test]
fn a_simulation_with_a_fault_ends_with_status_one() {
    let bench = Bench::with("s.nb", SIMULATED);
    let ran = bench.run("run s.nb");
    assert_eq!(ran.status, 1, "{}{}", ran.out, ran.err);
    assert!(names(&ran.out) && ran.out.ends_with("FAIL\n"), "{}", ran.out);
    let result = validate("run", &bench.read("out/s/result.json"));
    assert_eq!((&result["passed"], &result["simulations"][0]["fault"]["cycle"]), (&json!(false), &json!(0)));
    let page = bench.read("out/s/report.html");
    assert!(page.contains("FAIL: 1 of 1 simulation failed"), "the page says it, too");
}

#[test]
fn a_picture_names_the_robot_that_fails_in_it() {
    let bench = Bench::with("s.nb", SIMULATED);
    for kind in [["spacetime", "s.svg"], ["gif", "s.gif"], ["vcd", "s.vcd"], ["report", "s.html"]] {
        let drawn = bench.ok(&["draw", "s.nb", "--as", kind[0], "-o", kind[1]]);
        let warning = "warning[fault]: robot and_5x5 on net r became unstable in cycle 1\n";
        assert!(drawn.err.contains(warning), "{kind:?}: {}", drawn.err);
    }
    bench.file("wild.yaml", WILD);
    for kind in [["spacetime", "w.svg"], ["gif", "w.gif"], ["strip", "w.svg"], ["pose", "w.svg"]] {
        let drawn = bench.ok(&["draw", "wild.yaml", "--schedule", "00*4", "--as", kind[0], "-o", kind[1]]);
        let warning = "warning[fault]: robot wild became unstable in env step 28\n";
        assert!(drawn.err.contains(warning), "{kind:?}: {}", drawn.err);
    }
    let before = ["draw", "wild.yaml", "--schedule", "00*4", "--as", "pose", "--at", "0.3", "-o", "w.svg"];
    assert!(!bench.run(&before).err.contains("warning"));
    let sound = bench.run("draw nand --schedule 11*2 --as spacetime -o n.svg");
    assert_eq!((sound.status, sound.err.as_str()), (0, "wrote n.svg\n"));
}

#[test]
fn a_robot_that_explodes_takes_no_more_time_than_others() {
    let ran = boom().limited("ulimit -t 2", "test boom.nb --vary friction=1% --worlds 40");
    assert!(ran.out.contains("0 of 40 worlds pass"), "{}: {}", ran.status, ran.out);
}

#[test]
fn reports_of_the_library_fail() {
    for text in [BOOM, SIMULATED] {
        let mut session = Session::new(MemoryWorld::default());
        session.update("a.nb", 1, text);
        let report: RunReport = session.run("a.nb", &CompileOptions::default(), &mut ()).unwrap();
        assert!(!report.passed() && report.fault().is_some_and(|fault| fault.cycle == 0));
        let asserted = std::panic::catch_unwind(|| report.assert_passed()).unwrap_err();
        assert!(names(asserted.downcast_ref::<String>().unwrap()));
    }
}

#[test]
fn a_live_swarm_ends_with_the_fault() {
    let (session, checked) = session_of(SIMULATED);
    let compiled = checked.compile(&"conj".into(), &CompileOptions::default()).unwrap();
    let mut swarm = session.swarm(&compiled);
    let start = swarm.snapshot();
    let fault = swarm.step(&[false, true]).unwrap_err();
    assert_eq!((fault.net.as_str(), fault.cycle), ("r", 0));
    assert_eq!(swarm.step(&[true, true]), Err(fault.clone()), "there is no way on");
    assert_eq!((swarm.cycles(), swarm.trace().robots[0].com_x.len()), (0, 1));
    swarm.restore(&start);
    assert_eq!(swarm.step(&[false, true]), Err(fault));
}

#[test]
fn bits_from_another_machine_have_the_fault() {
    let (session, checked) = session_of(BOOM);
    let case = checked.cases(&checked.program.tests[0], &in_physics()).unwrap().remove(0);
    let bits = SwarmBits::simulate(&nbc::Simulator::default(), &case.task().unwrap());
    assert!(bits.cycles.is_empty() && bits.fault.is_some());
    let there = case.clone().judge(&bits);
    let here = session.run_case(case, &mut ());
    assert_eq!((there.verdict, there.end), (here.verdict, here.end));
}

#[test]
fn a_search_in_a_world_in_which_every_body_fails_fills_no_niche() {
    for objective in ["fixed: 1 cycles, variable: short", "objective: gate", "objective: wave"] {
        let bench = Bench::new();
        let world = "world w { stiffness: 10 }\n";
        let fields = "box: 3 x 2, batch: 4, generations: 2, seed: 1, world: w";
        let run = format!("{world}evolution small {{ {fields}, {objective} }}\n");
        bench.runs("small.nb", run);
        let evolved = bench.run("evolve small.nb --format json");
        let evolved: Value = serde_json::from_str(&evolved.out).unwrap_or_else(|_| panic!("{}", evolved.err));
        assert_eq!(evolved["runs"][0]["filled"], 0, "{objective}: {evolved}");
    }
}
