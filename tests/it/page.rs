//! The HTML report: its contents, and its scripts in a real browser if there is one.

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use nbc_base::model::{
    Base, Body, Character, CircuitTest, Displacements, Function, PhysicsWorld, Provenance, Robot, Stimulation, TestRow,
};
use nbc_base::source::{FileId, Span};
use nbc_session::report::{self, PageSwarm, Scheme, Stage, SwarmOutcome};
use nbc_swarm::{Assembly, Level, Member, Recorded, Recording, RowHold, SwarmTrace, TestVerdict, judge_swarm};

use crate::support::traces::{large, latch, latch_netlist};
use crate::support::*;

pub fn robot(name: &str, function: Function) -> Robot {
    let rows = ["66666", "46666", "44444", "44404", "44005"];
    Robot {
        name: name.to_owned(),
        behavior: function.into(),
        body: Body::parse(&rows, &nbc_base::model::Palette::paper()).unwrap(),
        displacement: Displacements::under(2, |_| 1.0),
        character: Character {
            clock: 4,
            switches: 1000,
            error_rate: 0.0,
            glitch_rate: 0.0,
            margin: 0.1,
            topples: false,
            settle: Vec::new(),
            radius: None,
        },
        provenance: Provenance {
            program: "nbc".to_owned(),
            version: "0.1.0".to_owned(),
            evolution: "gates".to_owned(),
            seed: 1,
            generation: 1,
            evaluations: 1,
        },
        genotype: None,
    }
}

fn verdict(trace: &SwarmTrace) -> TestVerdict {
    let span = Span::new(FileId(0), 0, 0);
    let test = CircuitTest {
        circuit: "d_latch".into(),
        title: "holds </script><b> its bit".to_owned(),
        span,
        file: "latch.nb".to_owned(),
        line: 1,
        inputs: trace.inputs.clone(),
        outputs: trace.outputs.clone(),
        stimulation: Stimulation::Rows(Vec::new()),
        rows_from: None,
        worlds: Vec::new(),
    };
    let row = |(at, q): (usize, bool)| TestRow {
        inputs: trace.cycles[8 * at].inputs.clone(),
        expected: vec![Some(q), None],
        bases: vec![Base::Bits; 4],
        hold: None,
        span,
        line: 3 + at,
        row: 1 + at,
        is_half: false,
        given_up: None,
    };
    let rows: Vec<TestRow> = [false, true, true].into_iter().enumerate().map(row).collect();
    let row_holds = vec![RowHold { hold: 8, needed: 8, rests: vec![true; test.output_bits().len()] }; 3];
    let rows = judge_swarm(&test, &rows, &row_holds, trace, &[4; 5]);
    TestVerdict {
        file: test.file,
        line: test.line,
        circuit: trace.circuit.clone(),
        title: test.title,
        swarm: None,
        world: Some("paper".to_owned()),
        is_world_named: false,
        level: Level::Physics,
        printed: None,
        proof: None,
        fault: None,
        rows_from: None,
        passed: rows.iter().all(|row| row.passed),
        inputs: test.inputs,
        outputs: test.outputs,
        weak_robots: Vec::new(),
        rows,
    }
}

pub fn assembly(trace: &SwarmTrace) -> Assembly {
    let member = |k: usize| Member {
        net: trace.robots[k].net.clone(),
        block: trace.robots[k].block.clone(),
        robot: robot(&trace.robots[k].robot, trace.robots[k].function),
        senses: trace.robots[k].senses.clone(),
        start: false,
        held: Default::default(),
    };
    Assembly {
        circuit: trace.circuit.clone(),
        inputs: trace.inputs.clone(),
        members: (0..5).map(member).collect(),
        outputs: trace.outputs.clone(),
        shown: trace.shown.clone(),
        beat: 1,
        world: PhysicsWorld::default(),
    }
}

fn page() -> String {
    let mut trace = latch(&[(false, true), (true, true), (true, false)], 8);
    trace.recording = Stage::of_swarm(&assembly(&trace), &trace, 7).record(5);
    page_of(&trace)
}

/// The page of a trace, twice on one page.
fn page_of(trace: &SwarmTrace) -> String {
    let (assembly, verdict) = (assembly(trace), verdict(trace));
    let robots: Vec<&Robot> = assembly.members.iter().map(|member| &member.robot).collect();
    let netlist = latch_netlist();
    let schematic = report::Schematic::of(&netlist, &robots, &[], Scheme::Paper).pages();
    let spacetime = report::draw_swarm(trace);
    let test = || PageSwarm {
        outcome: SwarmOutcome::Test(&verdict),
        trace,
        assembly: &assembly,
        schematic: &schematic,
        spacetime: &spacetime,
        timing: "settles within <5> cycles\n".to_owned(),
    };
    report::draw_run_page("circuits/<latch>.nb", &[test(), test()], Scheme::Paper)
}

fn data(page: &str) -> Value {
    let start = page.find("type=\"application/json\">").unwrap() + "type=\"application/json\">".len();
    let end = start + page[start..].find("</script>").unwrap();
    serde_json::from_str(&page[start..end]).unwrap()
}

#[test]
fn the_page_is_self_contained() {
    let page = page();
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
    for outside in ["src=\"", "href=\"http", "url(", "@import", "fetch("] {
        assert!(!page.contains(outside), "the page says {outside:?}");
    }
    assert!(page == self::page(), "the same run has the same page");
    assert!(page.contains("pass: 2 of 2 tests passed"), "the verdict comes first");
    assert!(page.contains("circuits/&lt;latch&gt;.nb"));
    assert!(!page.contains("</script><b>"), "a title cannot break out");
    let data = data(&page);
    let test = &data["swarms"][0];
    assert_eq!(test["robots"].as_array().unwrap().len(), 5);
    assert_eq!(test["cycles"], 24);
    assert_eq!(test["robots"][0]["sensed"][1].as_str().unwrap().len(), 24);
    assert_eq!(test["marks"], json!([8, 16]));
    let frames = test["robots"][0]["frames"].as_str().unwrap().len() / 4 * 3 / 2;
    let points = test["robots"][0]["corners"].as_u64().unwrap() as usize;
    assert_eq!(frames / (points * 2), 24 * 12 + 1);
}

#[test]
fn the_page_of_a_large_swarm_is_small() {
    let mut trace = large();
    let recorded = |robot: usize| {
        let mut recorded = Recorded::default();
        (recorded.robot, recorded.points) = (robot, 36);
        recorded.frames = vec![0; 36 * 2 * (1000 * 2 + 1)];
        recorded
    };
    trace.recording = Recording { frames_per_cycle: 2, robots: [1, 4].map(recorded).into() };
    let page = page_of(&trace);
    assert!(page.len() < 2 * 2_500_000, "{} bytes for two swarms", page.len());
    let swarm = &data(&page)["swarms"][0];
    let cells: Vec<_> = swarm["robots"].as_array().unwrap().iter().map(|robot| robot["cell"].as_u64()).collect();
    assert_eq!(cells, [Some(1), Some(4)], "a robot of the player knows its cell of the schematic");
    let rows = ["inputs", "outputs", "cells"].map(|rows| swarm[rows].as_array().unwrap().len());
    assert_eq!(rows, [2, 2, 5], "every robot has its bits, recorded or not");
    assert_eq!(swarm["cells"][0]["bits"].as_str().unwrap().len(), 1000 / 4, "four cycles are a digit");
}

fn browse(browser: &Path, folder: &Path, arguments: &[&str], file: &Path) -> Command {
    let profile = format!("--user-data-dir={}", folder.join("profile").display());
    let mut command = Command::new(browser);
    command.args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", &profile]);
    command.args(arguments).arg(format!("file://{}", file.display()));
    command
}

/// What a reader does, as scripts before and after the page's own.
const WATCH: &str = include_str!("browser/watch.js");
const READER: &str = include_str!("browser/reader.js");
const EXPLORER: &str = include_str!("browser/explorer.js");
const SIMULATION: &str = include_str!("browser/simulation.js");
const SHEETS: &str = include_str!("browser/sheets.js");

/// What the reader's script tells on the console. Frames come in real time only: a virtual clock runs ahead of them on
/// a busy machine.
fn told(mut command: Command) -> String {
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let log = BufReader::new(child.stderr.take().unwrap());
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || log.lines().map_while(Result::ok).try_for_each(|line| sender.send(line)));
    let (started, mut said) = (Instant::now(), String::new());
    let found = loop {
        let left = Duration::from_secs(120).saturating_sub(started.elapsed());
        let Ok(line) = receiver.recv_timeout(left) else { break None };
        if let Some((_, found)) = line.split_once("\"found ") {
            break found.rsplit_once("\", source: ").map(|(found, _)| found.to_owned());
        }
        said += &line;
        said.push('\n');
    };
    let _ = child.kill();
    let _ = child.wait();
    found.unwrap_or_else(|| panic!("the reader's script did not end:\n{said}"))
}

fn found(browser: &Path, page: &str, reader: &str, size: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let watched = page
        .replace("<head>\n", &format!("<head>\n<script>{WATCH}</script>\n"))
        .replace("</body>", &format!("<script>{reader}</script>\n</body>"));
    let file = folder.path().join("watched.html");
    fs::write(&file, watched).unwrap();
    // With its debugger the browser stays, and its console goes to standard error.
    let arguments = [size, "--remote-debugging-port=0", "--enable-logging=stderr"];
    let found: Value = serde_json::from_str(&told(browse(browser, folder.path(), &arguments, &file))).unwrap();
    assert_eq!(found["faults"], json!([]), "{found}");
    assert_eq!(found["wide"], true, "nothing sticks out of the page: {found}");
    found
}

fn keep(browser: &Path, name: &str, page: &str, size: (u32, u32), look: &str) {
    let artefacts = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (file, picture) = (artefacts.join(format!("{name}.html")), artefacts.join(format!("{name}.png")));
    fs::write(&file, page).unwrap();
    let (to, window) = (format!("--screenshot={}", picture.display()), format!("--window-size={},{}", size.0, size.1));
    let folder = tempfile::tempdir().unwrap();
    browse(browser, folder.path(), &[&window, look, "--virtual-time-budget=1000", &to], &file).output_in_time();
    let decoder = png::Decoder::new(BufReader::new(fs::File::open(&picture).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height), size);
    let corner = &pixels[..3];
    assert_eq!(corner[0] < 60, look == DARK, "the page is in the reader's theme: {corner:?}");
}

const LIGHT: &str = "--blink-settings=preferredColorScheme=1";
const DARK: &str = "--blink-settings=preferredColorScheme=0";

#[test]
fn the_page_of_a_run_works_in_a_browser() {
    let Some(browser) = CHROMIUM.find() else { return };
    let page = page();
    for size in ["--window-size=1200,900", "--window-size=500,800"] {
        let found = found(&browser, &page, READER, size);
        assert_eq!(found["walked"], true, "the player moves");
        assert_eq!((&found["tall"], &found["alone"]), (&460.into(), &240.into()), "a cell's robot is alone: {found}");
        assert_eq!((&found["pressed"], &found["focusable"]), (&"true".into(), &0.into()));
        assert!(found["panel"].as_str().unwrap().contains("nand_1"), "{found}");
        assert!(found["hovered"].as_str().unwrap().contains("n3 = nand"), "{found}");
        assert_eq!(found["clock"], "cycle 7 of 24");
    }
    keep(&browser, "run", &page, (1100, 1500), LIGHT);
    keep(&browser, "run-phone-dark", &page, (500, 1500), DARK);
}

const SUMS: &str = "
circuit sums(a[8], b[8], c[8]) -> (q[8]) {
    first  = a + b
    second = first + c
    q = not second
}
";

#[test]
fn the_sheets_of_a_schematic_open_in_a_browser() {
    let bench = Bench::with("sums.nb", SUMS);
    for name in ["a", "b"] {
        bench.ok(&["draw", "sums.nb", "--as", "schematic", "-o", &format!("{name}.html")]);
    }
    let page = bench.read("a.html");
    assert!(page == bench.read("b.html"), "the same page each time");
    let sheets = data(&page)["schematic"]["sheets"].as_array().unwrap().len();
    assert!(sheets >= 3, "{sheets} sheets");
    let Some(browser) = CHROMIUM.find() else { return };
    for size in ["--window-size=1200,900", "--window-size=500,800"] {
        let found = found(&browser, &page, SHEETS, size);
        assert_eq!(found["whole"], json!(["first", "second"]), "{found}");
        assert_eq!(found["opened"], json!(["sums", "first"]), "{found}");
        assert_ne!(found["inside"], found["whole_about"], "{found}");
        assert_eq!((&found["cells"], &found["whole_about"]), (&0.into(), &"68 robots".into()), "{found}");
        assert!(found["panel"].as_str().unwrap().starts_with("q[5] = "), "{found}");
        assert_eq!(found["chosen"], 1, "{found}");
        assert!(found["lit"].as_u64().unwrap() > 2, "{found}");
        assert_eq!(found["path"], 2, "the path of a sum runs through both adders: {found}");
        assert!(found["high"].as_f64().unwrap() < 2.5, "{found}");
    }
    keep(&browser, "sheets", &page, (1100, 900), LIGHT);
}

#[test]
fn the_page_of_an_evolution_opens_elites_in_a_browser() {
    let bench = crate::drawing::evolved();
    let page = bench.read("out/tiny/report.html");
    assert!(page.len() < 5_000_000 && page.contains("of 16 behaviors in") && page.contains("2 seeds together"));
    let data = data(&page);
    let elites = data["elites"].as_array().unwrap();
    assert!(elites.len() > 4 && elites.iter().all(|elite| elite["frames"].is_string()));
    let Some(browser) = CHROMIUM.find() else { return };
    let found = found(&browser, &page, EXPLORER, "--window-size=1200,900");
    assert_eq!(found["walked"], true, "the chosen elite walks: {found}");
    let panel = found["panel"].as_str().unwrap();
    assert!(panel.contains(found["behavior"].as_str().unwrap()) && panel.contains(found["body"].as_str().unwrap()));
    assert_eq!((&found["stepped"], &found["maps"]), (&true.into(), &16.into()), "{found}");
    assert!(found["niches"].as_u64().unwrap() > 2 && found["again"].as_u64().unwrap() > 2, "{found}");
    keep(&browser, "evolution", &page, (1100, 2400), LIGHT);
    keep(&browser, "evolution-phone-dark", &page, (500, 2400), DARK);
}

const BUSES: &str = "
circuit choice(a[2], s) -> (q[2], r) {
    q = if s then a else 2'd0
    r = a[0] and s
}
swarm pair { circuit: choice }
simulate pair with schedule (a, s) {
    2'd0 1 for 3 cycles
    2'd3 1 for 3 cycles
}
test choice \"selects\" {
    a    s | q    r
    2'd1 1 | 2'd1 1
}
";

#[test]
fn a_simulation_has_its_section_and_a_bus_its_strip() {
    let bench = Bench::with("buses.nb", BUSES);
    bench.ok("run buses.nb");
    let diagram = bench.read("out/buses/simulate-pair-spacetime.svg");
    let values: Vec<&str> =
        diagram.split("<text").filter_map(|text| text.split_once('>')?.1.split('<').next()).collect();
    for value in ["2'd0", "2'd3"] {
        // Each of the outputs q[1], q[0] and r shows the strip of the bus `a`.
        assert_eq!(values.iter().filter(|found| **found == value).count(), 3, "{values:?}");
    }
    let page = bench.read("out/buses/report.html");
    let Some(browser) = CHROMIUM.find() else { return };
    let found = found(&browser, &page, SIMULATION, "--window-size=1200,900");
    assert_eq!(found["walked"], true, "the simulated robots move: {found}");
    let rows = json!([["8", "2'd0", "1", "3", "2'd0", "0", "1", "1"], ["9", "2'd3", "1", "3", "2'd3", "1", "1", "1"]]);
    assert_eq!(found["rows"], rows);
}
