//! Materials of a program's own, wherever a body goes: archive, checkpoint, robot file, picture, swarm.

use std::sync::Arc;

use nbc_base::model::{Body, Function, Material, MaterialKind, Palette, Robot};
use nbc_session::store::{self, Checkpoint, DiskWorld};

use nbc_swarm::evolve::Elite;

use crate::support::*;

fn hearts() -> Bench {
    let bench = Bench::with("own.nb", fs::read(root().join("tests/golden/hearts.nb")).unwrap());
    bench.ok("evolve own.nb");
    bench
}

#[test]
fn robot_files_have_no_tags() {
    for entry in fs::read_dir(root().join("library/robots")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "yaml") {
            let text = fs::read_to_string(&path).unwrap();
            assert!(text.starts_with("format: 2\n"), "{}", path.display());
            assert!(!text.contains('!'), "{} has a tag, which other readers refuse", path.display());
        }
    }
}

#[test]
fn a_run_is_drawn_with_the_materials_of_its_checkpoint() {
    let ran = hearts();
    ran.ok("draw out/hearts --as sprite -o a.svg");
    let svg = ran.read("a.svg");
    assert!(svg.contains("3 heart: 0.98..1.02 in 84 steps, 0°"), "{svg}");
    assert!(svg.contains("2 muscle") && !svg.contains("3 muscle"), "{svg}");
}

/// A checkpoint whose header fits its text.
fn sealed(text: &str) -> String {
    format!("nbc-checkpoint 2 {:08x} {}\n{text}\n", crc32fast::hash(text.as_bytes()), text.len())
}

#[test]
fn a_foreign_checkpoint_with_a_correct_checksum_is_rejected() {
    let bench = hearts();
    let path = bench.path().join("out/hearts/seed-1/checkpoint.nbc");
    let whole = fs::read_to_string(&path).unwrap();
    let (_, text) = whole.trim_end().split_once('\n').unwrap();
    let (before, niches) = text.split_once("\"niches\":[[[").unwrap();
    let (_, after) = niches.split_once(']').unwrap();
    let with_key = |key: &str| format!("{before}\"niches\":[[[{key}]{after}");
    let check = |text: &str, expected: &str| {
        fs::write(&path, sealed(text)).unwrap();
        bench.run("draw out/hearts --as heatmap -o a.svg").expect_fault(&["checkpoint", expected]);
    };
    check(&with_key(""), "the archive has no niche []");
    check(&with_key("0,0,0,16"), "the archive has no niche [0, 0, 0, 16]");
    check(&with_key("4,0,0,0"), "the archive has no niche [4, 0, 0, 0]");
    check(&text.replacen("\"batch\":3,", "", 1), "missing field `batch`");
    check(&text.replacen("\"batch\":", "\"stack\":", 1), "unknown field `stack`");
    check(&text.replacen("\"kind\":\"rigid\"", "\"kind\":\"gas\"", 1), "unknown variant `gas`");
    check(&text.replacen("\"bins\":4", "\"bins\":0", 1), "an axis has 0 bins, expected 1 to 1000");
}

/// Three new materials between six of the paper's, so that no code except 1 has the paper's meaning.
const NINE: &str = "
material heart { kind: actuator, period: 42 steps, phase: 30 deg, range: 0.7..1.5 }
material ear   { kind: sensor, stimulus: s2, absent: 1.3, present: 0.8 }
material gum   { kind: soft }

schedule short(s1, s2) {
    0 0 for 1 cycles
    0 1 for 1 cycles
    1 0 for 1 cycles
    1 1 for 1 cycles
}

evolution nine {
    box:         3 x 3
    materials:   [bone, gum, heart, ear, flesh, muscle, s1_shrink, antimuscle, s1_grow]
    variable:    short
    batch:       8
    generations: 3
    seed:        5
}
";

#[test]
fn a_body_of_nine_materials_is_the_same_in_archive_file_and_simulation() {
    let bench = Bench::with("nine.nb", NINE);
    bench.ok("evolve nine.nb");
    let run = bench.path().join("out/nine/seed-5");
    let checkpoint = Checkpoint::read("a", &fs::read(run.join("checkpoint.nbc")).unwrap()).unwrap();
    let names: Vec<&str> = checkpoint.declared.palette.materials().iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names[..4], ["bone", "gum", "heart", "ear"]);
    // A robot that always walks one way is measured in the shortest time.
    let constant = |elite: &&Elite| ["LLLL", "RRRR"].contains(&elite.behavior.to_string().as_str());
    let elites = checkpoint.state.niches.iter().flat_map(|(_, elites)| elites).filter(constant);
    let behavior = elites.clone().next().expect("some body always walks one way").behavior;

    // The robot file has the archive's body and numbers.
    let word = behavior.to_string();
    let add = ["library", "add", "out/nine/seed-5", "--into", "robots", "--tries", "1", "--max-error", "1"];
    bench.ok(&[&add[..], &["--behavior", &word]].concat());
    let library = store::read_library(&DiskWorld, bench.path().join("robots").to_str().unwrap()).unwrap();
    let [robot] = &library.robots[..] else { panic!("one robot was written") };
    let elite = elites.clone().find(|elite| elite.body == robot.body).expect("the robot is of the archive");
    assert_eq!(robot.displacement, elite.displacement);

    // It walks the same distance when its file is simulated.
    let file = format!("robots/{}.yaml", robot.name);
    let walked = |file: &str, pattern: &str| {
        let schedule = format!("{pattern}*10");
        let found = bench.run(&["simulate", file, "--schedule", &schedule, "--format", "json"]).expect_json();
        found["displacement"][0].as_f64().unwrap()
    };
    assert_eq!(["00", "01", "10", "11"].map(|pattern| walked(&file, pattern)), *robot.displacement);
    let rows = serde_json::to_string(&robot.body.rows()).unwrap();
    if Body::parse(&robot.body.rows(), &Palette::paper()).is_ok() {
        bench.file("paper.json", format!("{{\"body\": {rows}}}"));
        assert_ne!(walked("paper.json", "00"), robot.displacement[0], "the same codes are another robot in the paper");
    }
}

/// The robot with other names and codes for its materials, which does not change its behavior.
fn renamed(robot: &Robot) -> Robot {
    let mut materials: Vec<Material> = robot.body.palette().materials().to_vec();
    materials.push(Material { name: "unused".to_owned(), kind: MaterialKind::Rigid });
    materials.rotate_left(3);
    for material in &mut materials {
        material.name = format!("own_{}", material.name);
    }
    let codes = robot.body.codes().iter().map(|&code| if code == 0 { 0 } else { (code + 9 - 4) % 9 + 1 }).collect();
    let body = Body::new(robot.body.width(), robot.body.height(), codes, Arc::new(Palette::new(materials)));
    Robot { name: "own_not".to_owned(), body, genotype: None, ..robot.clone() }
}

#[test]
fn two_swarms_of_different_palettes_run_in_one_file() {
    let shipped = store::shipped_library();
    let not = shipped.robots_for(Function::NOT).next().unwrap();
    let own = renamed(not);
    assert_eq!(own.body.palette().materials().len(), 9);
    let bench = Bench::new();
    for (folder, robot) in [("paper", not), ("own", &own)] {
        fs::create_dir(bench.path().join(folder)).unwrap();
        bench.file(format!("{folder}/not.yaml"), store::print_robot(robot));
    }
    let source = "
library paper { from: \"paper\" }
library own { from: \"own\" }

circuit inverter(a) -> (y) { y = not a }
swarm of_paper { circuit: inverter, library: paper }
swarm of_own { circuit: inverter, library: own }

test inverter \"turns over\" {
    a | y
    0 | 1
    1 | 0
}
";
    let file = bench.file("two.nb", source);
    let report = nbc_session::run_file(&file, &nbc::CompileOptions::default()).unwrap();
    let traces: Vec<_> = report.tests.iter().map(|run| &run.swarm.as_ref().unwrap().trace.robots[0]).collect();
    let [of_paper, of_own] = traces[..] else { panic!("the test runs once for each swarm") };
    assert_eq!((of_paper.robot.as_str(), of_own.robot.as_str()), (not.name.as_str(), "own_not"));
    assert_eq!(of_own.com_x, of_paper.com_x, "the same materials under other names and codes");
    assert!(report.passed());
}

const THIRD: &str = r#"{
    "materials": [
        { "name": "actuator", "kind": "actuator", "period": 84, "phase": 0, "range": [0.6, 1.6] },
        { "name": "touch", "kind": "sensor", "stimulus": 3, "absent": 1.1, "present": 0.6 }
    ],
    "body": ["121", "111"]
}"#;

#[test]
fn patterns_have_a_digit_for_each_stimulus_that_a_body_senses() {
    let bench = Bench::with("third.json", THIRD);
    let simulate = |schedule: &str| bench.run(&["simulate", "third.json", "--schedule", schedule, "--format", "json"]);
    let walked = |schedule: &str| simulate(schedule).expect_json()["displacement"][0].as_f64().unwrap();
    assert_eq!(walked("000*3"), walked("110*3"), "nothing senses these stimuli");
    assert_ne!(walked("000*3"), walked("001*3"));
    bench.run("simulate third.json --schedule 00*3").expect_fault(&[
        "invalid stimulus pattern `00`",
        "expected 3 digits, 0 or 1, for the stimuli that the materials of the body sense",
        "`001*10` is ten cycles",
    ]);
    let ran = bench.run(&["simulate", "third.json", "--schedule", "001*1 110*1"]);
    assert!(ran.out.contains("\n001 ") && ran.out.contains("\n110 "), "{}", ran.out);
    let draw = |kind: &str, file: &str| {
        bench.ok(&["draw", "third.json", "--as", kind, "-o", file]);
        bench.read(file)
    };
    let (strip, paths) = (draw("strip", "strip.svg"), draw("spacetime", "paths.svg"));
    assert!(
        ["000", "011", "111"].iter().all(|pattern| strip.contains(&format!(">{pattern}<"))),
        "each pattern has a row"
    );
    assert!(paths.contains("stimulus 3") && paths.contains("111 "), "{paths}");
}
