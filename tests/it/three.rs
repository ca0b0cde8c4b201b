//! Robots with three senses: how they are evolved, added to a library, and used in circuits.

use nbc_base::model::{Behavior, Function, Pattern};
use nbc_circuit::{CellLibrary, Netlist, map, prove};
use nbc_session::store;

use crate::support::*;

const SHORT: &str = "
use \"three.nb\"
evolution short {
    from:        gates
    box:         3 x 2
    materials:   [bone, flesh, muscle, antimuscle, s1_shrink, s2_shrink, s1_grow, s2_grow, s3_shrink, s3_grow]
    variable:    sweep3
    genome:      voxels
    objective:   gate
    descriptors: [voxels in 2 bins, active in 2 bins, class]
    batch:       12
    generations: 2
}
evolution multiplexers { from: short, behaviors: [mux] }
evolution rows { from: short, box: 3 x 1, batch: 6 }
";

fn bench() -> Bench {
    let bench = Bench::with("three.nb", text_of("library/three.nb"));
    bench.file("short.nb", SHORT);
    bench
}

fn evolve(bench: &Bench, run: &str, out: &str, more: &[&str]) -> Ran {
    bench.ok(&[&["evolve", "short.nb", "--run", run, "--out", out], more].concat())
}

#[test]
fn a_search_for_gates_of_three_inputs_fills_classes_and_can_be_resumed() {
    let bench = bench();
    evolve(&bench, "short", "whole", &[]);
    evolve(&bench, "short", "parts", &["--generations", "1"]);
    evolve(&bench, "short", "parts", &["--resume"]);
    let checkpoint = |out: &str| fs::read(bench.path().join(out).join("short/seed-1/checkpoint.nbc")).unwrap();
    assert_eq!(checkpoint("whole"), checkpoint("parts"));
    bench.ok("export whole/short --to json -o elites.json");
    let text = bench.read("elites.json");
    let found: Value = serde_json::from_str(&text).unwrap();
    let elites = found["elites"].as_array().unwrap();
    assert!(!elites.is_empty());
    for elite in elites {
        let behavior: Behavior = elite["behavior"].as_str().unwrap().parse().unwrap();
        assert_eq!((behavior.stimuli(), elite["displacement"].as_array().unwrap().len()), (3, 8));
        let class = behavior.function().class()[0];
        assert_eq!(elite["niche"][2].as_u64(), Some(class.bits().into()), "{behavior}");
    }
}

#[test]
fn a_search_for_some_behaviors_scores_bodies_as_those() {
    let bench = bench();
    evolve(&bench, "multiplexers", "out", &[]);
    let exported = bench.ok("export out/multiplexers --to csv");
    let rows: Vec<&str> = exported.out.lines().skip(1).collect();
    let mux = Behavior::from(Function::MUX).to_string();
    assert!(rows.iter().all(|row| row.contains(&mux)), "{}", exported.out);
}

#[test]
fn an_archive_of_classes_gives_a_robot_of_a_behavior_whose_class_it_has() {
    let bench = bench();
    evolve(&bench, "rows", "out", &[]);
    let add = |behavior: &str| {
        let add = ["library", "add", "out/rows", "--into", "robots", "--max-error", "1", "--tries", "1"];
        bench.run(&[&add[..], &["--finalists", "1", "--behavior", behavior]].concat())
    };
    // Whatever was found, the constants are a class of two, of which the archive has one.
    let elites = bench.run("export out/rows --to csv").out;
    let (other, letters) = if elites.contains(",LLLLLLLL,") { ("one3", "RRRRRRRR") } else { ("zero3", "LLLLLLLL") };
    assert!(!elites.contains(letters), "{elites}");
    let ran = add(other);
    assert_eq!(ran.status, 0, "{}", ran.out);
    let listed = bench.run("library list robots --format json").expect_json();
    let found: Vec<&str> =
        listed["robots"].as_array().unwrap().iter().map(|one| one["behavior"].as_str().unwrap()).collect();
    assert_eq!(found, [letters]);
}

#[test]
fn the_library_of_three_senses_is_of_reliable_gates_that_sense_three_stimuli() {
    let library = store::three_library();
    let own: Vec<_> = library.robots.iter().filter(|robot| robot.behavior.stimuli() == 3).collect();
    for name in ["maj", "mux", "and3", "or3", "nand3", "nor3", "and_or_invert", "or_and_invert"] {
        let function = Function::parse(name).unwrap();
        assert!(own.iter().any(|robot| robot.function() == function), "{name}");
    }
    for robot in &own {
        assert_eq!((robot.character.error_rate, robot.character.switches), (0.0, 1024), "{}", robot.name);
        assert_eq!((robot.displacement.len(), robot.character.settle.len()), (8, 56), "{}", robot.name);
        assert_eq!(robot.function().arity(), 3, "{}", robot.name);
        assert_eq!(robot.body.palette().inputs(), 3);
        let shown = robot.behavior.patterns().map(|pattern| robot.displacement.at(pattern) > 0.0);
        assert!(shown.eq(Pattern::all(3).map(|pattern| robot.function().under(pattern))), "{}", robot.name);
    }
}

#[test]
fn any_robot_of_three_stimuli_is_every_arrangement_of_its_inputs_and_gates_of_two() {
    let robots = store::three_library().robots.into_iter().filter(|robot| robot.behavior.stimuli() == 3);
    let library = nbc_base::model::Library { robots: robots.collect() };
    let cells: CellLibrary = nbc_swarm::cells(&library);
    for robot in &library.robots {
        assert!(robot.function().arrangements().iter().all(|one| cells.get(*one).is_some()), "{}", robot.name);
    }
    assert!(cells.is_complete(), "three senses suffice, for a stimulus may be constant");
    for function in Function::all().chain(Function::all_of(3)).filter(|one| cells.get(*one).is_some()) {
        let mut netlist = Netlist::new("one");
        let pins: Vec<_> = (0..function.inputs()).map(|i| netlist.add_input(format!("i{i}"))).collect();
        let gate = netlist.add_gate(function, &pins);
        netlist.add_output("y", gate);
        let assembly = nbc_swarm::assemble(&netlist, &library);
        let member = &assembly.members[0];
        for inputs in Pattern::all(function.inputs()).map(|pattern| pattern.bits(function.inputs())) {
            let sensed = member.senses.iter().map(|source| match *source {
                nbc_swarm::StimulusSource::Input(i) => inputs[i],
                nbc_swarm::StimulusSource::Constant(value) => value,
                nbc_swarm::StimulusSource::Robot(_) => panic!("there is one robot"),
            });
            assert_eq!(member.robot.function().at(sensed), function.at(inputs), "{function} by {}", member.robot.name);
        }
    }
}

#[test]
fn mapping_with_three_senses_needs_fewer_cells_and_is_proved() {
    let [two, three] = [store::shipped_library(), store::three_library()].map(|library| nbc_swarm::cells(&library));
    for name in ["fa", "rca4", "mul2", "mux4", "pop8"] {
        let design = crate::designs::read(&root().join(format!("tests/benchmarks/{name}.blif")));
        let [before, now] = [&two, &three].map(|library| map(&design.netlist, library).unwrap());
        prove(&design.netlist, &now).unwrap();
        assert!(now.cells().count() < before.cells().count(), "{name}:\n{now}");
    }
}

#[test]
fn wave_machines_have_gates_of_three_inputs() {
    let bench = Bench::new();
    let text = "enum place { none = 2'b00, one = 2'b01, gap = 2'b10, found = 2'b11 }
circuit detector(bit, clk) -> (state: place) {
    state = register(match state {
        none:  if bit then one else none
        one:   if bit then one else gap
        gap:   if bit then found else none
        found: if bit then one else gap
    }, clk)
}
swarm waves { circuit: detector, library: three, registers: waves }
test detector {
    bit clk | state
    0   0   | none
    1   ^   | one
    0   ^   | gap
    1   ^   | found
    0   ^   | gap
    0   ^   | none
}
";
    bench.file("detector.nb", text);
    let built: Value = bench.run("build detector.nb --format json").expect_json();
    let functions = built["by_function"].as_object().unwrap();
    assert!(functions.keys().any(|name| name.starts_with("f3_")), "a gate of three inputs: {functions:?}");
    bench.ok("test detector.nb --logic");
}

#[test]
fn every_command_that_makes_a_circuit_takes_its_robots_from_the_library_of_the_option() {
    let bench = Bench::new();
    let text =
        "circuit both(a, b, c) -> (q) {\n    q = a and b and c\n}\n\ntest both {\n    a b c | q\n    1 1 1 | 1\n}\n";
    bench.file("both.nb", text);
    let robots = |library: &[&str]| {
        let with = |arguments: &[&str]| bench.run(&[arguments, library].concat());
        let built = with(&["build", "both.nb", "--format", "json"]).expect_json()["cells"].as_array().unwrap().len();
        let ran = with(&["run", "both.nb", "--no-report", "--format", "json"]).expect_json();
        let drawn = with(&["draw", "both.nb", "--as", "dot", "-o", "both.dot"]);
        assert_eq!(drawn.status, 0, "{}", drawn.err);
        let drawn = bench.read("both.dot");
        let hardened =
            with(&["build", "both.nb", "--format", "json", "--harden", "friction=1%", "--worlds", "1"]).expect_json();
        assert_eq!(with(&["test", "both.nb", "--physics"]).status, 0);
        let found = [
            built,
            ran["tests"][0]["robots"].as_array().unwrap().len(),
            drawn.matches("and").count(),
            hardened["hardened"]["tried"][0]["robots"].as_u64().unwrap() as usize,
        ];
        #[cfg(feature = "play")]
        {
            let exported = with(&["play", "both.nb", "--export", "both.html", "--format", "json"]).expect_json();
            assert_eq!(exported["robots"], built);
        }
        found
    };
    assert_eq!(robots(&[])[..2], [2, 2]);
    assert_eq!(robots(&["--library", "three"]), [1; 4]);
    bench.ok("simulate and3 --library three --schedule 111*1");
    bench.run("simulate and3 --schedule 111*1").expect_fault(&["no robot of the library is called `and3`"]);
    let pose = ["draw", "and3_5x5", "--library", "three", "--as", "sprite", "-o", "a.svg"];
    bench.ok(&pose);
    bench.run("draw shipped --library three --as sprite -o a.svg").expect_fault(&["`--library`"]);
    bench.run("draw and --objective delay --as sprite -o a.svg").expect_fault(&["`--objective`"]);
}
