//! `nbc draw` in the real program: the contents of pictures of libraries, evolution runs and swarms, and impossible
//! pictures.

use roxmltree::Document;

use crate::support::*;

const RUN: &str = "
evolution tiny {
    box:         3 x 3
    variable:    short
    fixed:       1 cycles
    batch:       8
    generations: 4
    seed:        1..2
}
";

pub fn evolved() -> Bench {
    let bench = Bench::new();
    bench.runs("tiny.nb", RUN);
    let ran = bench.ok("evolve tiny.nb --report");
    assert!(ran.out.contains("report  out/tiny/report.html"), "{}", ran.out);
    bench
}

fn draw(bench: &Bench, line: &str) -> Ran {
    bench.run(&format!("draw {line}"))
}

#[track_caller]
fn svg(bench: &Bench, line: &str) -> String {
    let ran = draw(bench, &format!("{line} -o a.svg"));
    assert_eq!((ran.status, ran.out.as_str()), (0, ""), "{}", ran.err);
    bench.read("a.svg")
}

fn texts(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).unwrap();
    document.descendants().filter(|n| n.has_tag_name("text")).filter_map(|n| n.text().map(str::to_owned)).collect()
}

fn ids(svg: &str, start: &str) -> usize {
    let document = Document::parse(svg).unwrap();
    document.descendants().filter(|n| n.attribute("id").is_some_and(|id| id.starts_with(start))).count()
}

#[test]
fn every_picture_of_a_run_is_drawn() {
    let bench = evolved();
    let archive = svg(&bench, "out/tiny --as heatmap");
    assert_eq!(ids(&archive, "map-"), 16, "a map for each behavior");
    assert!(texts(&archive).contains(&"distance (voxels)".to_owned()));
    let crossed = svg(&bench, "out/tiny/seed-1 --as heatmap --axes behavior,sensory");
    assert_eq!(ids(&crossed, "map-"), 1);
    assert!(texts(&crossed).contains(&"sensory voxels (bin)".to_owned()));
    let progress = svg(&bench, "out/tiny --as progress");
    assert!(texts(&progress).iter().any(|text| text == "coverage") && ids(&progress, "course-") == 3);
    let difficulties = ["none", "one", "both", "XOR and XNOR"];
    assert!(difficulties.iter().all(|word| texts(&progress).iter().any(|text| text == word)));
    let comparison = svg(&bench, "out/tiny --as comparison");
    assert_eq!(ids(&comparison, "group-"), 8);
    let discovery = svg(&bench, "out/tiny --as discovery");
    assert_eq!(ids(&discovery, "discovery-"), 16);
    assert!(
        texts(&discovery).iter().any(|text| text.starts_with("in 2 of 2 seeds, median")),
        "{:?}",
        texts(&discovery)
    );
    let champions = svg(&bench, "out/tiny --as spacetime --schedule 11*1");
    let behaviors = ids(&champions, "champions-");
    assert!(behaviors >= 2, "a panel for each behavior found");
    assert_eq!(ids(&svg(&bench, "out/tiny --as sprite"), "robot-"), behaviors);
    let word = texts(&champions).into_iter().find(|text| text.len() == 4 && text.chars().all(|c| "LR".contains(c)));
    let one = svg(&bench, &format!("out/tiny --as strip --behavior {}", word.unwrap()));
    assert!(texts(&one).iter().any(|text| text.starts_with("tiny: ")));
}

#[test]
fn missing_pictures_of_a_run_are_reported() {
    let bench = evolved();
    draw(&bench, "out/tiny --as heatmap --axes voxels,depth -o a.svg")
        .expect_fault(&["`depth` is not an axis", "`voxels`, `active`, `sensory` and `behavior`"]);
    draw(&bench, "out/tiny --as heatmap --axes active,active -o a.svg").expect_fault(&["both axes are `active`"]);
    draw(&bench, "out/tiny --as heatmap --axes active -o a.svg").expect_fault(&["expected two"]);
    draw(&bench, "out/tiny --as strip -o a.svg").expect_fault(&["`out/tiny` is a run", "`--behavior`"]);
    draw(&bench, "out/tiny --as vcd -o a.vcd").expect_fault(&["expected a source file"]);
    draw(&bench, "out/none --as heatmap -o a.svg").expect_fault(&["out/none"]);
    fs::write(bench.path().join("out/tiny/seed-2/checkpoint.nbc"), "nothing\n").unwrap();
    draw(&bench, "out/tiny --as heatmap -o a.svg").expect_fault(&["is not a checkpoint"]);
    assert!(!bench.has("a.svg"));
}

#[test]
fn a_library_is_drawn_robot_by_robot() {
    let bench = Bench::new();
    let robots = nbc_session::store::shipped_library().robots.len();
    assert_eq!(ids(&svg(&bench, "shipped --as sprite"), "robot-"), robots);
    let best = svg(&bench, "shipped --behavior RRRL --as sprite");
    assert!(texts(&best)[0].contains("nand, RRRL"), "{:?}", texts(&best));
    draw(&bench, "shipped --as strip -o a.svg").expect_fault(&["`shipped` is a library", "`--behavior`"]);
    draw(&bench, "shipped --as heatmap -o a.svg").expect_fault(&["expected the folder of a run"]);
}

#[test]
fn robots_of_a_swarm_are_chosen_by_their_nets() {
    let bench = Bench::with(
        "not.nb",
        "circuit inverter(a) -> (q) { q = not a }\ntest inverter \"inverts\" {\n    a | q\n    1 | 0\n}\n",
    );
    let chosen = svg(&bench, "not.nb --as spacetime --robots q");
    assert_eq!(ids(&chosen, "track-q = not"), 1);
    assert!(texts(&chosen).contains(&"robots against the inputs of the swarm".to_owned()));
    assert_eq!(svg(&bench, "not.nb --as spacetime --robots *"), chosen);
    draw(&bench, "not.nb --as spacetime --robots p -o b.svg").expect_fault(&["no robot drives `p`", "`q`"]);
    draw(&bench, "not.nb --as dot -o a.dot");
    let dot = bench.read("a.dot");
    assert!(dot.starts_with("digraph") && dot.contains("not"), "{dot}");
}

#[test]
fn a_pose_shows_the_deformed_body_over_its_outline() {
    let bench = Bench::with("walker.yaml", WALKER);
    let pose = |at: &str| svg(&bench, &format!("walker.yaml --as pose --schedule 00*2 --at {at}"));
    let shapes = |svg: &str, dashed: bool| {
        let document = Document::parse(svg).unwrap();
        let polygons = document.descendants().filter(|node| node.has_tag_name("polygon"));
        polygons
            .filter(|node| node.has_attribute("stroke-dasharray") == dashed)
            .map(|node| node.attribute("points").unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    let bent = pose("1.5");
    assert_eq!((shapes(&bent, false).len(), shapes(&bent, true).len()), (8, 8));
    assert_ne!(shapes(&bent, false), shapes(&bent, true));
    assert!(texts(&bent).iter().any(|text| text.starts_with("after 1.50 cycles, stimuli 00")));
    assert_eq!(
        pose("2"),
        svg(&bench, "walker.yaml --as pose --schedule 00*2"),
        "the end is what is shown without `--at`"
    );
    let late = draw(&bench, "walker.yaml --as pose --schedule 00*2 --at 2.5 -o late.svg");
    late.expect_fault(&["`--at 2.5` is after the end of the schedule at cycle 2"]);
}

#[test]
fn a_fault_in_the_first_cycle_is_drawn_and_not_hidden() {
    let bench = Bench::with("wild.yaml", WILD);
    let schedule = "--schedule 00*1";
    let diagram = svg(&bench, &format!("wild.yaml --as spacetime {schedule}"));
    assert!(texts(&diagram).contains(&"unstable in cycle 1".to_owned()), "{:?}", texts(&diagram));
    let pose = svg(&bench, &format!("wild.yaml --as pose {schedule}"));
    assert!(texts(&pose).iter().any(|text| text.contains("unstable")), "{:?}", texts(&pose));
    let strip = svg(&bench, &format!("wild.yaml --as strip {schedule}"));
    assert!(texts(&strip).contains(&"unstable".to_owned()));
    assert_eq!(draw(&bench, &format!("wild.yaml --as gif {schedule} -o a.gif")).status, 0);
}

#[test]
fn options_that_cannot_apply_are_rejected() {
    let bench = Bench::with("walker.yaml", WALKER);
    bench.file("idle.nb", "circuit inverter(a) -> (q) { q = not a }\n");
    let check = |line: &str, option: &str| {
        draw(&bench, &format!("{line} -o a.svg")).expect_fault(&[&format!("`{option}` does not apply"), "help"]);
    };
    check("walker.yaml --as strip --at 1", "--at");
    check("walker.yaml --as sprite --frames 1", "--frames");
    check("walker.yaml --as sprite --schedule 00*1", "--schedule");
    check("idle.nb --as spacetime --schedule 00*1", "--schedule");
    check("walker.yaml --as sprite --behavior RRRL", "--behavior");
    check("walker.yaml --as sprite --axes voxels,active", "--axes");
    check("shipped --as spacetime --robots q", "--robots");
    check("nand --as sprite --circuit inverter", "--circuit");
    check("nand --as sprite --swarm few", "--swarm");
    check("nand --as sprite --test first", "--test");
    check("nand --as spacetime --safe-colors", "--safe-colors");
    assert!(!bench.has("a.svg"));
}

#[test]
fn failed_drawings_leave_no_file() {
    let bench = Bench::with("walker.yaml", WALKER);
    bench.file("idle.nb", "circuit inverter(a) -> (q) { q = not a }\n");
    let arguments = ["draw", "walker.yaml", "--as", "spacetime", "-o", "a.svg", "--schedule", ""];
    bench.run(&arguments).expect_fault(&["the schedule is empty"]);
    draw(&bench, "idle.nb --as gif -o a.gif").expect_fault(&["no test and no simulation"]);
    draw(&bench, "walker.yaml --as pose --at -3 -o a.svg").expect_fault(&["--at"]);
    draw(&bench, "walker.yaml --as gif -o walker.yaml/a.gif").expect_fault(&["cannot write `walker.yaml/a.gif`"]);
    draw(&bench, "walker.yaml --as heatmap -o a.svg").expect_fault(&["expected the folder of a run"]);
    let files: Vec<_> = fs::read_dir(bench.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(files.len(), 2, "{files:?}");
}
