//! A file's declarations decide what runs: swarms, libraries and simulations, in the real program.

use crate::support::*;

/// A correct robot, and one with the same body whose file has errors.
const TURNER: &str = "format: 2
name: turner
behavior: RRLL
body: ['55555', '55511', '30441', '30411', '33311']
displacement: [0.88, 0.88, -4.18, -4.18]
character: { clock: 2, switches: 1024, error_rate: 0.0, glitch_rate: 0.0, margin: 0.06, topples: false, settle: [] }
provenance: { program: nbc, version: 0.1.0, evolution: gates5, seed: 1, generation: 29, evaluations: 1209 }
";

const INVERTER: &str = "circuit inverter(a) -> (q) { q = not a }\n";

const TEST: &str = "test inverter \"inverts\" {\n    a | q\n    0 | 1\n    1 | 0\n}\n";

fn bench() -> Bench {
    let bench = Bench::new();
    fs::create_dir(bench.path().join("robots")).unwrap();
    bench.file("robots/turner.yaml", TURNER);
    bench
}

#[track_caller]
fn json(bench: &Bench, line: &str) -> Value {
    let ran = bench.run(&format!("{line} --format json"));
    assert!(ran.status < 2, "{line}: {}", ran.err);
    serde_json::from_str(&ran.out).unwrap()
}

fn texts(values: &Value) -> Vec<&str> {
    values.as_array().unwrap().iter().map(|value| value["text"].as_str().unwrap()).collect()
}

#[test]
fn a_declared_library_and_swarm_apply_to_every_command() {
    let bench = bench();
    // The swarm's `n` is the default, which gives the same circuit.
    let program = "circuit many[n = 1](a[n]) -> (q[n]) { q = not a }\nlibrary mine { from: \"robots\" }\n\
         swarm one { circuit: many[1], library: mine, window: 2 cycles }\ntest many {\n    a | q\n    0 | 1\n    1 | \
         0\n}\n";
    bench.file("a.nb", program);
    let found = json(&bench, "run a.nb");
    assert_eq!(found["tests"][0]["robots"][0]["robot"], "turner", "{found}");
    assert_eq!(found["tests"][0]["swarm"], "one");
    assert_eq!(json(&bench, "test a.nb --physics")["tests"][0]["swarm"], "one");
    assert_eq!(
        json(&bench, "build a.nb --emit json")["hold"],
        2,
        "the clock of `turner`; that of the shipped robot is 1"
    );
    bench.ok("draw a.nb --as schematic -o a.svg");
    assert!(bench.read("a.svg").contains("turner"), "the schematic names the robot");
}

#[test]
fn the_folder_of_a_library_is_relative_to_its_file() {
    let bench = bench();
    fs::create_dir(bench.path().join("parts")).unwrap();
    fs::rename(bench.path().join("robots"), bench.path().join("parts/robots")).unwrap();
    bench.file(
        "parts/own.nb",
        format!("{INVERTER}library mine {{ from: \"robots\" }}\nswarm one {{ circuit: inverter, library: mine }}\n"),
    );
    bench.file("a.nb", format!("use \"parts/own.nb\"\n{TEST}"));
    assert_eq!(json(&bench, "run a.nb")["tests"][0]["robots"][0]["robot"], "turner");
    let from_elsewhere = Bench::new();
    let path = bench.path().join("a.nb");
    assert_eq!(json(&from_elsewhere, &format!("test {} --physics", path.display()))["passed"], true);
    fs::remove_dir_all(bench.path().join("parts/robots")).unwrap();
    bench.run("test a.nb --physics").expect_fault(&["cannot read the library `parts/robots`", "parts/own.nb:2"]);
}

#[test]
fn robots_of_an_evolution_are_read_from_the_folder_of_runs() {
    let bench = bench();
    let program = format!(
        "{INVERTER}evolution walkers {{ generations: 1 }}\nlibrary mine {{ from: walkers }}\n\
         swarm one {{ circuit: inverter, library: mine }}\n{TEST}"
    );
    bench.file("a.nb", program);
    bench.run("test a.nb --physics").expect_fault(&[
        "`out/walkers/robots`",
        "`nbc evolve a.nb --run walkers --out out`, then `nbc library add out/walkers --into out/walkers/robots`",
    ]);
    for command in ["test a.nb --physics", "run a.nb", "build a.nb", "draw a.nb --as dot -o a.dot"] {
        bench.run(&format!("{command} --runs elsewhere")).expect_fault(&[
            "`elsewhere/walkers/robots`",
            "--into elsewhere/walkers/robots",
            "--out elsewhere",
        ]);
    }
    fs::create_dir_all(bench.path().join("elsewhere/walkers")).unwrap();
    fs::rename(bench.path().join("robots"), bench.path().join("elsewhere/walkers/robots")).unwrap();
    assert_eq!(json(&bench, "run a.nb --runs elsewhere")["tests"][0]["robots"][0]["robot"], "turner");
}

#[test]
fn all_swarms_of_a_circuit_run() {
    let bench = bench();
    let program = format!(
        "{INVERTER}library mine {{ from: \"robots\" }}\nswarm usual {{ circuit: inverter }}\n\
         swarm own {{ circuit: inverter, library: mine }}\n{TEST}simulate own with schedule (a) {{\n    0 for 5 \
         cycles\n}}\n"
    );
    bench.file("a.nb", program);
    let found = json(&bench, "run a.nb");
    let of = |at: usize| [&found["tests"][at]["swarm"], &found["tests"][at]["robots"][0]["robot"]];
    assert_eq!((of(0)[0], of(1)), (&"usual".into(), [&"own".into(), &"turner".into()]));
    assert_ne!(of(0)[1], "turner");
    let levels = json(&bench, "test a.nb --physics");
    assert_eq!(levels["tests"].as_array().unwrap().len(), 2);
    assert_eq!(json(&bench, "test a.nb --logic")["tests"].as_array().unwrap().len(), 1, "gates are of no library");
    for file in ["inverter-usual-waves.vcd", "inverter-own-waves.vcd", "simulate-own-cycles.csv"] {
        bench.read(format!("out/a/{file}"));
    }
    bench.run("build a.nb").expect_fault(&[
        "several swarms are declared for `inverter`",
        "`--swarm usual`",
        "`--swarm own`",
    ]);
    assert_eq!(json(&bench, "build a.nb --emit json --swarm own")["hold"], 2);
    bench.ok("build a.nb --cells nand");
    bench.run("draw a.nb --as schematic -o a.svg").expect_fault(&["several swarms", "`--swarm own`"]);
    bench.run("draw a.nb --as spacetime -o a.svg").expect_fault(&["several swarms", "`--swarm own`"]);
    bench.ok("draw a.nb --as spacetime --swarm own -o a.svg");
    assert!(bench.read("a.svg").contains("turner"));
    bench.run("build a.nb --swarm owl").expect_fault(&["no swarm is called `owl`", "`own`"]);
}

#[test]
fn an_unused_library_is_reported() {
    let bench = bench();
    bench.file("a.nb", format!("{INVERTER}library mine {{ from: \"robots\" }}\n{TEST}"));
    let ran = bench.run("check a.nb");
    assert!(ran.err.contains("no swarm uses the library `mine`"), "{}", ran.err);
}

const SWARM: &str = "swarm ring_of_three { circuit: ring }\n";
const RING: &str = "circuit ring() -> (q) {\n    q init 0 = not not not q\n}\n";

#[test]
fn a_simulation_writes_all_its_results() {
    let bench = Bench::new();
    let program = "circuit delay(d[2], en) -> (q[2]) { q = latch(d, en) }\nswarm cells { circuit: delay }\n\
                   simulate cells with schedule (d, en) {\n    2'd1 1 for 12 cycles\n    2'd2 0 for 3 cycles\n    \
                   2'd2 1 for 12 cycles\n}\n";
    bench.file("a.nb", program);
    let ran = bench.ok("run a.nb");
    assert!(ran.out.contains("simulate cells, of delay") && !ran.out.contains("pass"), "{}", ran.out);
    assert!(ran.out.contains("2'd1 1"), "{}", ran.out);
    let found: Value = serde_json::from_str(&bench.read("out/a/result.json")).unwrap();
    assert_eq!(found["tests"], Value::Array(Vec::new()));
    let simulation = &found["simulations"][0];
    assert_eq!((&simulation["swarm"], &simulation["circuit"]), (&"cells".into(), &"delay".into()));
    assert_eq!((&simulation["line"], &simulation["rows"][2]["line"]), (&3.into(), &6.into()));
    let rows = simulation["rows"].as_array().unwrap();
    let told: Vec<_> = rows.iter().map(|row| (texts(&row["inputs"]), texts(&row["observed"]))).collect();
    assert_eq!(told[0], (vec!["2'd1", "1"], vec!["2'd1"]));
    assert_eq!(told[1], (vec!["2'd2", "0"], vec!["2'd1"]), "the latch remembers");
    assert_eq!(told[2], (vec!["2'd2", "1"], vec!["2'd2"]));
    let robots = simulation["robots"].as_array().unwrap();
    check_table(&bench.read("out/a/simulate-cells-cycles.csv"), robots);
    let waves = bench.read("out/a/simulate-cells-waves.vcd");
    assert!(waves.contains("$var wire 2 ! d [1:0] $end") && waves.contains("\nb01 !\n"), "{waves}");
    assert!(bench.read("out/a/report.html").contains("1 simulation"));
    for file in ["spacetime.svg", "spacetime.png", "schematic.svg"] {
        assert!(bench.path().join(format!("out/a/simulate-cells-{file}")).is_file(), "{file}");
    }
}

/// A row for each cycle: the inputs, the outputs, the other nets, and the distance of each robot, which add up to its
/// total.
fn check_table(table: &str, robots: &[Value]) {
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 1 + 27);
    assert_eq!(rows[0][..4], ["cycle", "d", "en", "q"]);
    assert_eq!((rows[1][..3].to_vec(), rows[13][..3].to_vec()), (vec!["1", "1", "1"], vec!["13", "2", "0"]));
    assert_eq!(rows[27][3], "2");
    for robot in robots {
        let net = robot["net"].as_str().unwrap();
        let place = rows[0].iter().position(|name| *name == format!("{net}.displacement")).unwrap();
        let walked: f64 = rows[1..].iter().map(|row| row[place].parse::<f64>().unwrap()).sum();
        assert!((walked - robot["displacement"].as_f64().unwrap()).abs() < 1e-9);
        assert!(net.starts_with("q[") || rows[0].contains(&net), "every net is a column: {net}");
    }
}

#[test]
fn tests_and_simulations_can_be_selected() {
    let bench = Bench::with(
        "a.nb",
        format!("{INVERTER}{RING}{SWARM}{TEST}simulate ring_of_three with schedule () {{\n    for 4 cycles\n}}\n"),
    );
    let counts = |only: &str| {
        let found = json(&bench, &format!("run a.nb --no-report --only {only}"));
        ["tests", "simulations"].map(|key| found[key].as_array().unwrap().len())
    };
    assert_eq!([counts("inverts"), counts("inverter"), counts("ring_of_three")], [[1, 0], [1, 0], [0, 1]]);
    bench.run("run a.nb --only rung").expect_fault(&["`rung`", "`inverter`", "`inverts`", "`ring_of_three`"]);
    bench.file("bare.nb", INVERTER);
    bench.run("run bare.nb").expect_fault(&["no test and no simulation"]);
}

#[test]
fn a_ring_without_inputs_is_tested_and_simulated() {
    let bench = Bench::new();
    let test = "test ring \"runs\" {\n    | q\n    | - for 12 cycles\n}\n";
    bench.file(
        "a.nb",
        format!("{RING}{SWARM}{test}simulate ring_of_three with schedule () {{\n    for 24 cycles\n}}\n"),
    );
    assert_eq!(json(&bench, "test a.nb --logic")["passed"], true, "nothing is asked of it");
    let found = json(&bench, "run a.nb");
    assert_eq!((&found["passed"], &found["tests"][0]["rows"][0]["cycles"]), (&true.into(), &12.into()));
    let row = &found["simulations"][0]["rows"][0];
    assert!(row["changes"][0].as_u64().unwrap() > 3, "the ring oscillates: {row}");
    bench.file("b.nb", format!("{RING}test ring \"stops\" {{\n    | q\n    | 1\n}}\n"));
    let ran = bench.run("test b.nb --logic");
    assert_eq!(ran.status, 1, "{}", ran.err);
    assert!(ran.out.contains("b.nb:6: row 1: q keeps changing, expected 1"), "{}", ran.out);
    bench.file(
        "c.nb",
        format!(
            "{INVERTER}swarm one {{ circuit: inverter }}\nsimulate one with schedule () {{\n    for 4 cycles\n}}\n"
        ),
    );
    bench.run("check c.nb").expect_fault(&["no values for the input `a`"]);
}

#[test]
fn a_failed_test_lists_its_rows_in_their_notation() {
    let bench = Bench::new();
    let program = "circuit add_four(a[4], b[4]) -> (sum[4], odd) {\n    sum = a + b\n    odd = sum[0]\n}\n\n\
                   // rows are counted as they stand\ntest add_four \"adds\" {\n    a     b    | sum   odd\n    \
                   4'd3  0001 | 4'd4  0\n\n    4'd5  0100 | 4'd8  -\n    4'hf  0000 | 1111  0\n}\n";
    bench.file("a.nb", program);
    let ran = bench.run("test a.nb --logic");
    assert_eq!(ran.status, 1);
    assert!(ran.out.contains("    a.nb:11: row 2: a=4'd5 b=0100 | sum=4'd9, expected 4'd8\n"), "{}", ran.out);
    assert!(ran.out.contains("    a.nb:12: row 3: a=4'hf b=0000 | odd=1, expected 0\n"), "{}", ran.out);
    let found = json(&bench, "test a.nb --logic");
    let test = &found["tests"][0];
    assert_eq!((&test["file"], &test["line"], &test["level"]), (&"a.nb".into(), &7.into(), &"logic".into()));
    assert_eq!(test["outputs"], json!([{ "name": "sum", "width": 4 }, { "name": "odd", "width": 1 }]));
    let row = &test["rows"][1];
    assert_eq!((&row["row"], &row["line"], &row["passed"]), (&2.into(), &11.into(), &false.into()));
    assert_eq!(row["observed"][0], json!({ "text": "4'd9", "bits": "1001" }));
    assert_eq!((texts(&row["inputs"]), texts(&row["expected"])), (vec!["4'd5", "0100"], vec!["4'd8", "-"]));
}

#[test]
fn build_chooses_the_right_circuit() {
    let bench = Bench::with(
        "a.nb",
        "circuit choose[w = 2](a[w], b[w], s) -> (q[w]) { q = if s then a else b }\ntest choose for \
        all inputs { q = if not s then b else a }\n",
    );
    let circuit = |more: &[&str]| {
        let ran = bench.ok(&[&["build", "a.nb", "--emit", "json"], more].concat());
        let found: Value = serde_json::from_str(&ran.out).unwrap();
        (found["circuit"].as_str().unwrap().to_owned(), found["inputs"].as_array().unwrap().len())
    };
    assert_eq!(circuit(&[]), ("choose".to_owned(), 5), "not the reference of its test");
    assert_eq!(circuit(&["--circuit", "choose[w = 3]"]), ("choose[3]".to_owned(), 7));
    assert_eq!(circuit(&["--circuit", "choose[3]"]), ("choose[3]".to_owned(), 7));
    assert_eq!(circuit(&["--circuit", "half_adder"]).0, "half_adder", "a standard circuit");
    let build = |name: &str| bench.run(&["build", "a.nb", "--circuit", name]);
    build("chose").expect_fault(&["no circuit is called `chose`", "did you mean `choose`"]);
    build("choose[v = 3]").expect_fault(&["no parameter `v`"]);
    build("choose[").expect_fault(&["`choose[` is not the name of a circuit"]);
    build("choose as tested").expect_fault(&["is not the name of a circuit"]);
    // A circuit without inferable widths is built with the parameters of its test.
    bench.file("b.nb", "circuit turn[w](a[w]) -> (q[w]) { q = not a }\ntest turn[3] {\n    a | q\n    000 | 111\n}\n");
    assert!(bench.run("build b.nb").out.starts_with("netlist turn[3]("));
}

#[test]
fn a_circuit_without_tests_is_drawn_without_simulation() {
    let bench = Bench::with("a.nb", format!("circuit wide[n](a[n]) -> (q[n]) {{ q = not a }}\n{INVERTER}"));
    bench.ok("draw a.nb --as dot -o a.dot");
    assert!(bench.read("a.dot").contains("not"));
    bench.ok(&["draw", "a.nb", "--as", "schematic", "--circuit", "wide[n = 2]", "-o", "a.svg"]);
    assert!(bench.read("a.svg").contains("q[1]"));
    bench.run("draw a.nb --as spacetime -o b.svg").expect_fault(&["no test and no simulation", "`--as schematic`"]);
    bench.file(
        "b.nb",
        format!(
            "{INVERTER}{TEST}circuit same(a) -> (q) {{ q = a }}\ntest same \"is the same\" {{\n    \
        a | q\n    1 | 1\n}}\n"
        ),
    );
    bench.ok(&["draw", "b.nb", "--as", "vcd", "--test", "is the same", "-o", "b.vcd"]);
    assert!(bench.read("b.vcd").contains("module same"));
    bench.ok("draw b.nb --as schematic --test inverts -o b.svg");
    assert!(bench.read("b.svg").contains("inverter"));
}

#[test]
fn a_robot_with_errors_is_reported_once_and_first() {
    let bench = bench();
    let weak = TURNER.replace("error_rate: 0.0", "error_rate: 0.43");
    bench.file("robots/turner.yaml", weak);
    let wrong = "test inverter \"is wrong\" {\n    a | q\n    0 | 0\n}\n";
    bench.file(
        "a.nb",
        format!(
            "{INVERTER}library mine {{ from: \"robots\" }}\nswarm one {{ circuit: inverter, library: mine \
            }}\n{TEST}{wrong}"
        ),
    );
    for command in ["test a.nb --physics", "run a.nb"] {
        let ran = bench.run(command);
        assert_eq!(ran.status, 1, "{}", ran.err);
        assert_eq!(ran.err.matches("`inverter` uses the robot `turner`, wrong in 43.0 %").count(), 1, "{}", ran.err);
        let after = ran.out.split("FAIL").nth(1).unwrap();
        assert!(after.lines().nth(1).unwrap().contains("robot turner on q: wrong in 43.0 %"), "{}", ran.out);
    }
    let found = json(&bench, "test a.nb --physics");
    assert_eq!(found["tests"][0]["weak_robots"][0]["robot"], "turner");
}
