//! Worlds other than the paper's: their physics, their noise, and where programs name them.

use nbc::{
    Body, CompileOptions, MemoryWorld, Palette, Pattern, Schedule, Session, Setting, Simulator, Trajectory, Trial,
};
use nbc_base::model::{GroundProfile, PhysicsWorld, WorldFactors, WorldNoise};
use nbc_session::report::Stage;
use nbc_swarm::{Assembly, Recording, Room, SwarmConditions, SwarmTrace, simulate};

use crate::support::*;

const NOISE: WorldNoise =
    WorldNoise { start: 0.5, missed: 0.2, weak: 0.05, dead: 0.02, phase: 0.0, drift: 0.0, seed: 3 };

const CIRCUIT: &str = "\
circuit gate(a, b) -> (q) {
    q = a nand b
}

test gate WORLD {
    a b | q
    0 0 | 1
    1 1 | 0
}
";

/// The paths of the robots of the program's test, with these declarations and the test in this world.
fn paths(declarations: &str, world: &str) -> Vec<Vec<f64>> {
    let mut runs = tested(&format!("{}{declarations}", CIRCUIT.replace("WORLD", world)));
    runs.remove(0).swarm.unwrap().trace.robots.into_iter().map(|robot| robot.com_x).collect()
}

#[test]
fn a_world_changes_the_physics_and_the_papers_does_not() {
    let paper = paths("", "");
    assert_eq!(paths("world same { friction: 100% }", "in same"), paper);
    assert_eq!(paths("", "in paper"), paper);
    let fields = ["friction", "gravity", "stiffness", "drag", "damping", "swelling"].map(|field| (field, "1.05"));
    for (field, value) in fields.into_iter().chain([("start", "0.3"), ("weak", "5%"), ("dead", "20%")]) {
        assert_ne!(paths(&format!("world other {{ {field}: {value} }}"), "in other"), paper, "{field}");
    }
    assert_eq!(paths("world flat { ground: [2, 2] }", "in flat"), paper);
    let stairs = "world stairs { ground: [0, 0, 0, 1] }\n";
    let on_stairs = paths(stairs, "in stairs");
    assert_ne!(on_stairs, paper);
    assert_eq!(paths(&format!("{stairs}world same {{ from: stairs, friction: 1 }}"), "in same"), on_stairs);
    assert_eq!(paths(&format!("{stairs}world even {{ from: stairs, ground: 0 }}"), "in even"), paper);
}

/// `world paper` of a file is the world of its tests, swarms, simulations, evolutions and worlds that name none.
#[test]
fn a_redeclared_paper_is_the_world_of_all_that_names_none() {
    let heavy = "world paper { gravity: 1.2 }\n";
    let other = paths("world other { gravity: 1.2 }", "in other");
    assert_ne!(other, paths("", ""));
    for declarations in ["", "swarm s { circuit: gate }", "library shipped { from: shipped }"] {
        assert_eq!(paths(&format!("{heavy}{declarations}"), ""), other, "{declarations}");
    }
    assert_eq!(paths("world light { gravity: 0.6 }\nworld paper { from: light, gravity: 1.2 }", ""), other);
    let text = format!(
        "{CIRCUIT}{heavy}world rough {{ friction: 2 }}
swarm s {{ circuit: gate }}
evolution own {{ box: 3 x 3 }}
evolution named {{ from: own, world: rough }}
evolution taken {{ from: named, seed: 2 }}
simulate s with schedule (a, b) {{ 0 0 for 2 cycles }}"
    );
    let (session, checked) = session_of(text.replace("WORLD", ""));
    let program = &checked.program;
    let gravity = |name: &str| program.evolution(name).unwrap().world.factors.gravity;
    assert_eq!(["own", "named", "taken", "gates"].map(gravity), [1.2, 1.2, 1.2, 1.0]);
    let friction = |name: &str| program.evolution(name).unwrap().world.factors.friction;
    assert_eq!(["own", "named", "taken"].map(friction), [1.0, 2.0, 2.0]);
    let run = session.simulate(&checked, &program.simulations[0], &CompileOptions::default(), &mut ()).unwrap();
    assert_eq!(run.swarm.compiled.plan.world.world.factors.gravity, 1.2);
}

#[test]
fn a_yield_is_around_a_redeclared_paper() {
    let bench = Bench::new();
    let found = |declarations: &str, world: &str| {
        bench.file("a.nb", format!("{declarations}{}", CIRCUIT.replace("WORLD", world)));
        let asked = ["test", "a.nb", "--vary", "gravity=1%", "--worlds", "2", "--format", "json"];
        validate("robustness", &bench.run(&asked).out)["tests"][0].clone()
    };
    // Robots are unstable in such a world.
    let own = found("world paper { stiffness: 10 }\n", "");
    let named = found("world stiff { stiffness: 10 }\n", "in stiff");
    assert_eq!((&own["yield"]["passed"], &own["world"]), (&json!(0), &json!("paper")));
    assert_eq!(named["world"], "stiff");
    assert_eq!(own["failures"], named["failures"], "the worlds of the sample are the same");
    assert_eq!(found("", "")["yield"]["passed"], 2);
}

/// A file of Evolution Gym has the same ground as heights, around the place where robots start.
#[test]
fn the_ground_may_be_a_file() {
    let column = |high: usize| (0..=high).map(|row| row * 8).collect::<Vec<_>>();
    let cells: Vec<usize> =
        (0..8).flat_map(|x| column(usize::from(x == 7)).into_iter().map(move |at| at + x)).collect();
    let codes = vec!["5"; cells.len()].join(", ");
    let file = format!(
        r#"{{"grid_width": 8, "grid_height": 2, "objects": {{"floor": {{"indices": {cells:?}, "types": [{codes}]}}}}}}"#
    );
    let program = |world: &str| {
        let mut files = MemoryWorld::default();
        files.insert("worlds/step.json", file.clone());
        files.insert("a/a.nb", format!("{}{world}", CIRCUIT.replace("WORLD", "in steps")));
        let mut session = Session::new(files);
        let checked = session.open("a/a.nb").unwrap_or_else(|error| panic!("{error}"));
        assert!(checked.diagnostics.is_empty());
        let run = session.test(&checked, &checked.program.tests[0], &in_physics(), &mut ()).unwrap().remove(0);
        run.swarm.unwrap().trace.robots.into_iter().map(|robot| robot.com_x).collect::<Vec<_>>()
    };
    // The middle of the ground, a power of two, is column 6 of the file, so column 7 is the next of eight.
    let heights = program("world steps { ground: [0, 1, 0, 0, 0, 0, 0, 0] }");
    assert_eq!(program(r#"world steps { ground: "../worlds/step.json" }"#), heights);
    assert_eq!(program("world hills { ground: \"../worlds/step.json\" }\nworld steps { from: hills }"), heights);
    assert_ne!(program("world steps { ground: 0 }"), heights);
}

#[test]
fn the_example_with_hills_passes() {
    let ran = Bench::new().run(&["test", root().join("examples/hills.nb").to_str().unwrap()]);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
}

#[test]
fn worlds_derive_from_each_other_and_a_test_overrides_its_swarm() {
    let worlds = "world heavy { gravity: 1.1 }\nworld both { from: heavy, friction: 0.8 }\n";
    let direct = paths("world own { gravity: 1.1, friction: 0.8 }\n", "in own");
    assert_eq!(paths(worlds, "in both"), direct);
    let swarm = format!("{worlds}swarm sliders {{ circuit: gate, world: both }}\n");
    assert_eq!(paths(&swarm, ""), direct);
    assert_eq!(paths(&swarm, "in heavy"), paths(worlds, "in heavy"));
}

#[test]
fn a_simulation_names_a_world_and_so_does_an_evolution() {
    let program = format!(
        "{}world heavy {{ gravity: 1.1 }}\nswarm s {{ circuit: gate }}\nevolution e {{ world: heavy }}\n\
         simulate s in heavy with schedule (a, b) {{\n    0 1 for 3 cycles\n}}\n",
        CIRCUIT.replace("WORLD", "")
    );
    let (session, checked) = session_of(program);
    let run = session.simulate(&checked, &checked.program.simulations[0], &CompileOptions::default(), &mut ());
    assert_eq!(run.unwrap().swarm.compiled.assembly.world.factors.gravity, 1.1);
    let evolution = checked.program.evolution("e").unwrap();
    assert_eq!(evolution.world.factors.gravity, 1.1);
    let bodies = || vec![Body::parse(&["343", "563"], &Palette::paper()).unwrap()];
    let paper = nbc::Evolution { world: PhysicsWorld::default(), ..evolution.clone() };
    let simulator = Simulator::default();
    let [there, here] = [evolution, &paper].map(|run| nbc::evaluate_bodies(&simulator, run, bodies()));
    assert_ne!(there, here);
}

fn walk(setting: &Setting) -> Trajectory {
    let body = Body::parse(&["343", "563"], &Palette::paper()).unwrap();
    let trial = Trial { body, schedule: Schedule::constant(Pattern::PAIRS[1], 84) };
    Simulator::default().run_trials(setting, &[trial]).remove(0)
}

#[test]
fn factors_multiply_what_they_name() {
    // A body falls from the end of the ground with the acceleration of gravity.
    let fall = |gravity: f64| {
        let factors = WorldFactors { gravity, ..WorldFactors::default() };
        let edge =
            Setting { world_width: 50, start_x: Some(0), shift: -20.0, factors, ground: GroundProfile::default() };
        let heights = walk(&edge).com_y;
        heights[0] - heights[4]
    };
    let ratio = fall(1.5) / fall(1.0);
    assert!((ratio - 1.5).abs() < 0.05, "{ratio}");
    let shifted = walk(&Setting { shift: 0.25, ..Setting::default() }).com_x[0] - walk(&Setting::default()).com_x[0];
    assert!((shifted - 0.25).abs() < 1e-9);
}

#[test]
fn a_body_starts_above_the_ground_below_it_and_falls_to_it() {
    let heights = |ground: &[u8], shift: f64| {
        let ground = GroundProfile::new(ground).unwrap();
        let walked = walk(&Setting { world_width: 60, start_x: Some(30), shift, ground, ..Setting::default() });
        [walked.com_y[0], walked.com_y[40]]
    };
    let flat = heights(&[0], 0.0);
    let high = heights(&[0, 0, 0, 4, 4, 4, 4, 4, 4, 4], 3.5);
    assert!((high[0] - flat[0] - 4.0).abs() < 1e-9);
    assert!((high[1] - flat[1] - 4.0).abs() < 0.3, "{high:?} and {flat:?}");
    // One column below it is a wall.
    let mut columns = [0; 30];
    columns[29] = 3;
    assert!((heights(&columns, -0.9)[0] - flat[0] - 3.0).abs() < 1e-9);
}

/// The swarm of the program's test in a world with noise.
fn noisy() -> Assembly {
    let run = tested(&CIRCUIT.replace("WORLD", "")).remove(0);
    run.swarm.unwrap().compiled.assembly.in_world(PhysicsWorld { noise: NOISE, ..PhysicsWorld::default() })
}

fn trace(assembly: &Assembly, poses: Option<Room>) -> SwarmTrace {
    let inputs = (0..12).map(|cycle| vec![cycle / 4 % 2 == 1, cycle % 2 == 1]).collect();
    simulate(&Simulator::default(), assembly, &SwarmConditions { inputs, window: 1, poses }, &mut |_| {})
}

#[test]
fn noise_is_drawn_once_and_films_show_the_same() {
    let assembly = noisy();
    let (first, again) = (trace(&assembly, Some(Room::SWARM)), trace(&assembly, None));
    assert_eq!(SwarmTrace { recording: Recording::default(), ..first.clone() }, again);
    assert_eq!(first.recording, Stage::of_swarm(&assembly, &again, 7).record(assembly.members.len()));
    let inputs: Vec<_> = again.cycles.iter().map(|cycle| cycle.inputs.clone()).collect();
    let sensed: Vec<_> = again.cycles.iter().map(|cycle| cycle.sensed[0].bits(2)).collect();
    assert_ne!(inputs, sensed, "some stimuli are missed");
}

const HOSTILE: &str = "\
circuit inverter(a) -> (q) {
    q = not a
}

test inverter \"inverts\" {
    a | q
    0 | 1
    1 | 0
    0 | 1
}
";

#[test]
fn yields_are_the_same_for_any_number_of_threads_and_worlds_can_be_declared() {
    let bench = Bench::with("a.nb", HOSTILE);
    let run = |more: &[&str]| {
        let ran = bench.run(&[&["test", "a.nb", "--worlds", "6", "--format", "json"], more].concat());
        (ran.status, validate("robustness", &ran.out))
    };
    let (status, wild) = run(&["--vary", "all=90%,dead=50%"]);
    assert_eq!(status, 0, "a failed world is a result");
    let one = |found: &Value| found["tests"][0].clone();
    let failures = one(&wild)["failures"].as_array().unwrap().clone();
    assert!(!failures.is_empty(), "{wild}");
    let shared = ["test", "a.nb", "--worlds", "6", "--format", "json", "--vary", "all=90%,dead=50%"];
    let output = bench.command(&shared).env("RAYON_NUM_THREADS", "3").output_in_time();
    assert_eq!(validate("robustness", std::str::from_utf8(&output.stdout).unwrap()), wild);
    assert_eq!(run(&["--vary", "all=90%,dead=50%", "--least-yield", "100%"]).0, 1);
    assert_eq!(run(&["--vary", "all=45%,dead=25%", "--times", "2"]).1["tests"][0]["failures"], one(&wild)["failures"]);
    let calm = one(&run(&["--vary", "all=0.1%", "--least-yield", "100%"]).1);
    assert_eq!(calm["yield"]["passed"], 6);
    assert!(calm["least"]["margin"].as_f64().unwrap() > 0.0);
    // The world of a failure, declared, makes the test fail too.
    let ran = bench.run("test a.nb --worlds 6 --vary all=90%,dead=50%");
    let world = ran.out.lines().find_map(|line| line.trim().strip_prefix("world w")).expect("an example");
    let (number, fields) = world.split_once(' ').unwrap();
    assert_eq!(failures[0]["world"].to_string(), number);
    bench.file("b.nb", format!("world bad {fields}\n{}", HOSTILE.replace("\" {", "\" in bad {")));
    assert_eq!(bench.run("test b.nb --physics").status, 1);
}

#[test]
fn a_trial_ends_with_the_first_row_that_fails() {
    let dead = WorldNoise { dead: 1.0, ..WorldNoise::default() };
    let world = PhysicsWorld { noise: dead, ..PhysicsWorld::default() };
    let (session, checked) = session_of(HOSTILE);
    let case = checked.cases(&checked.program.tests[0], &in_physics()).unwrap().remove(0);
    let mut told = (0, 0);
    let run = session.run_case(case.trial_in(world), &mut |done, all| told = (done, all));
    assert!(!run.verdict.passed && run.verdict.rows.iter().filter(|row| !row.passed).count() == 1);
    assert!(run.verdict.rows.len() < case.rows().len() && told.0 == told.1);
    assert_eq!(run.world_trial().unwrap().failed.unwrap().0, run.verdict.rows.len());
    assert!(session.run_case(case.trial_in(PhysicsWorld::default()), &mut ()).verdict.passed);
}

#[test]
fn yields_are_drawn() {
    let bench = Bench::with("a.nb", HOSTILE);
    let arguments = ["test", "a.nb", "--worlds", "2", "--vary", "friction=1%", "--vary", "all=1%", "--times", "1,30"];
    bench.ok(&[&arguments[..], &["--picture", "yields.svg"]].concat());
    let picture = bench.read("yields.svg");
    assert!(picture.contains("all factors") && picture.contains("largest change in %"), "{picture}");
    assert_eq!(bench.run(&[&arguments[..], &["--picture", "yields.pdf"]].concat()).status, 2);
}

#[test]
fn wrong_changes_are_explained() {
    let bench = Bench::with("a.nb", HOSTILE);
    for (changes, word) in
        [("fiction=1%", "`fiction` does not vary"), ("friction=95%", "from 0 to 0.9"), ("all", "no amount")]
    {
        let ran = bench.run(&["test", "a.nb", "--vary", changes]);
        assert_eq!(ran.status, 2);
        assert!(ran.err.contains(word), "{}", ran.err);
    }
    assert_eq!(bench.run("test a.nb --worlds 3").status, 2, "worlds of nothing");
    assert_eq!(bench.run("test a.nb --logic --vary all=1%").status, 2);
}

/// A folder with the NAND of the library.
fn bench_with_a_gate() -> Bench {
    let bench = Bench::new();
    let text = text_of("library/robots/nand_5x5.yaml");
    bench.file("nand.yaml", &text);
    bench
}

/// The exit status and the radius that `nbc library verify` tells.
fn radius(bench: &Bench, changes: &str, more: &[&str]) -> (i32, f64) {
    let command = ["library", "verify", "nand.yaml", "--worlds", "1", "--vary", changes];
    let ran = bench.run(&[&command, more, &["--format", "json"]].concat());
    (ran.status, validate("radii", &ran.out)["robots"][0]["radius"].as_f64().unwrap())
}

#[test]
fn a_tiny_change_has_the_largest_radius() {
    assert_eq!(radius(&bench_with_a_gate(), "gravity=0.001%", &[]), (0, 6.0));
}

#[test]
fn a_robot_has_a_radius_and_its_file_keeps_it() {
    let bench = bench_with_a_gate();
    let (status, least) = radius(&bench, "dead=100%", &["--write"]);
    assert!(status == 0 && least < 6.0);
    let file = bench.path().join("nand.yaml");
    let written = fs::read_to_string(&file).unwrap();
    assert!(written.contains("vary: 'dead=100%'"), "{written}");
    assert_eq!(radius(&bench, "dead=100%", &[]), (0, least));
    bench.ok("library show nand.yaml");
    bench.file("nand.yaml", written.replace(&format!("radius: {least:?}"), "radius: 77.0"));
    assert_eq!(radius(&bench, "dead=100%", &[]), (1, least), "the file says something else");
    bench.file("nand.yaml", written.replace("vary: 'dead=100%'", "vary: 'daed=100%'"));
    assert_eq!(bench.run("library show nand.yaml").status, 2);
}

/// A library of two robots for one gate: a quick one, and one that bears other worlds.
fn bench_with_two_gates(more: &str) -> Bench {
    let bench = Bench::new();
    fs::create_dir(bench.path().join("robots")).unwrap();
    for (folder, name) in [("thin", "nand_5x5"), ("robots", "nand_7x7")] {
        let path = root().join(format!("library/{folder}/{name}.yaml"));
        bench.file(format!("robots/{name}.yaml"), fs::read_to_string(path).unwrap());
    }
    let source = format!(
        "library two {{ from: \"robots\"{more} }}\n\
         circuit and_gate(a, b) -> (q) {{ q = not (a nand b) }}\n\
         swarm walkers {{ circuit: and_gate, library: two }}\n\
         test and_gate {{ a b | q\n 0 0 | 0\n 1 1 | 1\n 1 0 | 0\n 1 1 | 1\n 0 1 | 0\n 1 1 | 1 }}\n"
    );
    bench.file("gate.nb", &source);
    bench
}

#[test]
fn hardening_leaves_out_the_robot_that_fails_in_other_worlds() {
    let bench = bench_with_two_gates("");
    let command = ["build", "gate.nb", "--objective", "delay", "--harden", "35%", "--worlds", "8"];
    let ran = bench.ok(&[&command[..], &["--least-yield", "80%", "--format", "json"]].concat());
    let hardened = validate("build", &ran.out)["hardened"].clone();
    let tried = hardened["tried"].as_array().unwrap();
    assert_eq!((&hardened["without"], &hardened["reached"]), (&json!(["nand_5x5"]), &true.into()));
    assert_eq!(tried.len(), 2);
    assert!(tried[0]["yield"]["share"].as_f64() < Some(0.8) && tried[0]["fails_first"][0] == "nand_5x5");
    assert!(ran.err.ends_with("to use these robots, write `without: [nand_5x5]` in the library\n"), "{}", ran.err);
    let plain = bench.run("build gate.nb --format json");
    assert!(validate("build", &plain.out)["hardened"].is_null());
}

#[test]
fn hardening_that_cannot_reach_its_goal_says_so() {
    let bench = bench_with_two_gates(", without: [nand_7x7]");
    let ran = bench.run("build gate.nb --harden 45% --worlds 12");
    assert_eq!(ran.status, 1);
    assert!(ran.err.ends_with("no choice of robots passes in enough worlds; no robot is left out\n"), "{}", ran.err);
    assert!(ran.out.contains("nand("));
    bench.file("untested.nb", "circuit inverter(a) -> (q) { q = not a }\n");
    let ran = bench.run("build untested.nb --harden friction=10%");
    assert!(ran.status == 2 && ran.err.contains("the file has no test of `inverter`"), "{}", ran.err);
}

/// A circuit with three swarms, and tests that name no world and three.
const MANY: &str = "\
world low { friction: 0.2 }
world w1  { gravity: 1.05 }

circuit inv(a) -> (q) {
    q = not a
}

swarm one   { circuit: inv }
swarm two   { circuit: inv, world: low }
swarm three { circuit: inv, hold: 1 cycles }

test inv \"plain\" {
    a | q
    0 | 1
}

test inv \"in\" in [paper, w1, low] {
    a | q
    0 | 1
}
";

#[test]
fn every_result_names_its_world_and_logic_counts_a_test_once() {
    let bench = Bench::with("many.nb", MANY);
    let ran = bench.run("test many.nb --physics");
    let of = |title: &str, says: &str| {
        let lines = ran.out.lines().filter(|line| line.contains(title) && line.contains(says));
        lines.count()
    };
    assert_eq!(
        [of("\"plain\"", ""), of("\"plain\" in low", ""), of("\"plain\"", " as two ")],
        [3, 1, 1],
        "{}",
        ran.out
    );
    for world in ["paper", "w1", "low"] {
        assert_eq!(of(&format!("\"in\" in {world} "), ""), 3, "{}", ran.out);
    }
    let told = bench.run("test many.nb --physics --format json");
    let tests = validate("test", &told.out)["tests"].clone();
    let worlds: Vec<(&str, &str)> = tests.as_array().unwrap().iter().map(named).collect();
    let swarms = ["one", "two", "three"];
    let plain = swarms.map(|swarm| (swarm, if swarm == "two" { "low" } else { "paper" }));
    let each = swarms.iter().flat_map(|&swarm| ["paper", "w1", "low"].map(|world| (swarm, world)));
    assert_eq!(worlds, plain.into_iter().chain(each).collect::<Vec<_>>());
    let logic = bench.run("test many.nb --logic");
    assert_eq!(logic.out, "pass  inv \"plain\" (1 row, logic)\npass  inv \"in\" (1 row, logic)\n2 passed, 0 failed\n");
    let told = bench.run("test many.nb --logic --format json");
    assert!(validate("test", &told.out)["tests"][1]["world"].is_null());
}

fn named(test: &Value) -> (&str, &str) {
    (test["swarm"].as_str().unwrap(), test["world"].as_str().unwrap())
}

#[test]
fn a_run_of_several_tests_is_a_line_each_and_the_folder() {
    let bench = Bench::with("many.nb", MANY);
    let ran = bench.run("run many.nb --swarm one");
    let lines: Vec<&str> = ran.out.lines().collect();
    let expected = [
        "pass  inv as one \"plain\" (1 row, physics)",
        "pass  inv as one \"in\" in paper (1 row, physics)",
        "pass  inv as one \"in\" in w1 (1 row, physics)",
    ];
    assert_eq!(lines[..3], expected, "{}", ran.out);
    assert!(ran.out.contains("\nfiles    out/many\nreport   out/many/report.html\nresults  out/many/result.json\n"));
    for world in ["paper", "w1", "low"] {
        assert!(bench.path().join(format!("out/many/inv-one-{world}-spacetime.svg")).is_file(), "{world}");
    }
    let whole = bench.run("run many.nb --swarm one --only in --tables");
    assert_eq!(whole.out.matches("expected").count(), 3, "{}", whole.out);
    let one = bench.run("run many.nb --swarm one --only plain");
    assert!(one.out.contains("test inv as one \"plain\": pass\n    inputs  expected"), "{}", one.out);
}
