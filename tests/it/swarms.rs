//! Compiled swarms in full physics match their truth tables, with the holds of `hold: auto`.

use nbc::{CompileOptions, RunReport};
use nbc_base::model::{Function, PhysicsWorld, Robot};
use nbc_circuit::formats::{Design, nb};
use nbc_circuit::{MappingObjective, Netlist};
use nbc_session::SwarmRun;
use nbc_session::report::describe_test;
use nbc_session::store::shipped_library;
use nbc_sim::Simulator;
use nbc_swarm::{Assembly, Member, StimulusSource, SwarmConditions, simulate};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::*;

fn program(truth: u8) -> String {
    let mut netlist = Netlist::new("f");
    let inputs = ["a", "b", "c"].map(|name| netlist.add_input(name));
    let not = inputs.map(|input| netlist.add_gate(Function::NOT, &[input]));
    let mut sum = netlist.add_constant(false);
    for row in (0..8).filter(|row| truth >> row & 1 == 1) {
        let literal = |i: usize| if row >> (2 - i) & 1 == 1 { inputs[i] } else { not[i] };
        let pair = netlist.add_gate(Function::AND, &[literal(0), literal(1)]);
        let product = netlist.add_gate(Function::AND, &[pair, literal(2)]);
        sum = netlist.add_gate(Function::OR, &[sum, product]);
    }
    netlist.add_output("y", sum);
    let rows: String = (0..8)
        .map(|row| format!("    {} {} {} | {}\n", row >> 2 & 1, row >> 1 & 1, row & 1, truth >> row & 1))
        .collect();
    format!("{}\ntest f \"computes {truth:08b}\" {{\n    a b c | y\n{rows}}}\n", nb::write(&Design::new(netlist)))
}

fn run(program: &str, options: &CompileOptions) -> RunReport {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("f.nb");
    fs::write(&path, program).unwrap();
    nbc::run_file(&path, options).unwrap_or_else(|error| panic!("{error}"))
}

fn swarm(report: &RunReport) -> &SwarmRun {
    report.tests[0].swarm.as_ref().unwrap()
}

fn check(truth: u8) {
    let report = run(&program(truth), &CompileOptions::default());
    report.assert_passed();
    let compiled = &swarm(&report).compiled;
    println!("{truth:08b}: {} robots, hold {}", compiled.mapping.netlist.cells().count(), compiled.timing.hold);
}

#[test]
fn some_functions_of_three_inputs_compute() {
    [0b1100_1010, 0b1001_0110, 0b0001_0110].into_iter().for_each(check);
}

#[test]
fn a_robot_never_reaches_the_end_of_its_ground() {
    let fastest = |a: &&Robot, b: &&Robot| a.displacement[0].total_cmp(&b.displacement[0]);
    let robot = shipped_library().robots.iter().max_by(fastest).unwrap().clone();
    let (net, senses) = ("y".to_owned(), vec![StimulusSource::Constant(false); 2]);
    let member = Member { net, block: Vec::new(), robot, senses, start: true, held: vec![Vec::new(); 2] };
    let (outputs, shown) = (vec![crate::support::traces::port("y")], vec![StimulusSource::Robot(0)]);
    let (inputs, world) = (Vec::new(), PhysicsWorld::default());
    let assembly =
        Assembly { circuit: "one".to_owned(), inputs, members: vec![member], outputs, shown, beat: 1, world };
    let conditions = SwarmConditions { inputs: vec![Vec::new(); 80], window: 1, poses: None };
    let trace = simulate(&Simulator::default(), &assembly, &conditions, &mut |_| {});
    let walked = trace.robots[0].com_x.last().unwrap() - trace.robots[0].com_x[0];
    assert!(walked > 250.0, "{walked}: not as far as the paper's ground reaches");
    assert!(trace.cycles.iter().all(|cycle| cycle.bits[0]));
    let room = |cycles| assembly.setting(cycles).world_width / 2;
    assert_eq!(room(80), room(1000), "tests of a circuit have the same world");
    assert!(room(20_000) as f64 > 20_000.0 * 2.0 * walked / 80.0);
}

/// Run with `cargo test --release --test it fifty_random -- --ignored --nocapture`.
#[test]
#[ignore = "minutes of physics"]
fn fifty_random_functions_of_three_inputs_compute() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..50 {
        check((random.next_u32() >> 24) as u8);
    }
}

/// Run with `cargo test --release --test it gallery_computes -- --ignored --nocapture`.
#[test]
#[ignore = "minutes of physics"]
fn every_circuit_of_the_gallery_computes() {
    let mut failed = String::new();
    // The processor has a test of its own, of fewer clocks. The digits have a thousand robots and hundreds of images.
    let is_long = |path: &PathBuf| path.ends_with("riscv.nb") || path.ends_with("digits.nb");
    for path in programs("circuits").into_iter().filter(|path| !is_long(path)) {
        let report = nbc::run_file(&path, &CompileOptions::default()).unwrap_or_else(|error| panic!("{error}"));
        for test in &report.tests {
            let robots = test.swarm.as_ref().unwrap().compiled.mapping.netlist.cells().count();
            let (passed, hold) = (test.verdict.passed, test.swarm.as_ref().unwrap().compiled.timing.hold);
            println!("{} `{}`: {robots} robots, hold {hold}, passed {passed}", path.display(), test.verdict.title);
            if robots < 40 && !passed {
                failed.push_str(&describe_test(&test.verdict));
            }
        }
    }
    assert!(failed.is_empty(), "{failed}");
}

/// Run with `cargo test --release --test it the_computer -- --ignored --nocapture`.
#[test]
#[ignore = "minutes of physics"]
fn the_computer_runs_its_programs() {
    let started = std::time::Instant::now();
    let report = nbc::run_file("circuits/computer.nb", &CompileOptions::default()).unwrap();
    for test in &report.tests {
        let run = test.swarm.as_ref().unwrap();
        let (robots, rows) = (run.compiled.assembly.members.len(), test.verdict.rows.len());
        let cycles = run.trace.cycles.len();
        println!("{}: {robots} robots, {rows} rows in {cycles} cycles", test.verdict.title);
        assert!(test.verdict.passed, "{}", describe_test(&test.verdict));
    }
    println!("{:.0} s", started.elapsed().as_secs_f64());
}

#[test]
fn the_objective_chooses_among_robots_of_the_same_function() {
    let found = [MappingObjective::Delay, MappingObjective::Margin].map(|objective| {
        let options = CompileOptions { objective, ..CompileOptions::default() };
        let report = nbc::run_file("circuits/half_adder.nb", &options).unwrap();
        assert!(report.tests.iter().all(|test| test.verdict.passed), "{}", describe_test(&report.tests[0].verdict));
        let members = &swarm(&report).compiled.assembly.members;
        let margins = members.iter().map(|member| member.robot.character.margin);
        (margins.fold(f64::INFINITY, f64::min), swarm(&report).compiled.timing.hold)
    });
    let [(thin, short), (wide, long)] = found;
    assert!(wide > 4.0 * thin && short < long, "{found:?}");
}
