//! `nbc test`: every kind of test detects errors, and the number of robots decides the level.

use crate::support::*;

const CIRCUITS: &str = "
circuit exclusive(a, b) -> (q) { q = a xor b }

circuit other(a, b) -> (q) { q = (a or b) and (a nand b) }

circuit both(a, b) -> (q) { q = a and b }

circuit toggle(clk) -> (q) { q = register(not q, clk) }
";

#[track_caller]
fn check_test(test: &str, passes: bool, says: &str) {
    let bench = Bench::with("a.nb", format!("{CIRCUITS}\n{test}\n"));
    let ran = bench.run("test a.nb --logic");
    assert_eq!(ran.status, i32::from(!passes), "{test}\n{}{}", ran.out, ran.err);
    assert!(ran.out.contains(says), "{says:?} is not in\n{}", ran.out);
}

#[test]
fn truth_tables_are_checked_row_by_row() {
    check_test(
        "test exclusive \"x\" {\n a b | q\n 0 1 | 1\n 1 1 | 0\n}",
        true,
        "pass  exclusive \"x\" (2 rows, logic)",
    );
    check_test("test exclusive {\n a b | q\n 0 1 | 1\n 1 1 | 1\n}", false, "a.nb:13: row 2: a=1 b=1 | q=0, expected 1");
    check_test("test exclusive {\n a b | q\n 0 1 | -\n 1 1 | -\n}", true, "1 passed, 0 failed");
}

#[test]
fn sequences_remember() {
    check_test("test toggle {\n clk | q\n 0 | 0\n 1 | 1\n 0 | 1\n 1 | 0\n}", true, "4 rows");
    check_test("test toggle {\n clk | q\n 0 | 0\n ^ | 1\n ^ | 0\n}", true, "3 rows");
    check_test("test toggle {\n clk | q\n 0 | 0\n ^ | 1\n ^ | 1\n}", false, "row 3: clk=1 | q=0, expected 1");
}

#[test]
fn all_inputs_are_compared_with_an_expression_or_a_circuit() {
    check_test("test exclusive for all inputs { q = a == not b }", true, "4 rows");
    check_test("test exclusive for all inputs { q = a or b }", false, "row 4: a=1 b=1 | q=0, expected 1");
    check_test("test exclusive for all inputs against other", true, "4 rows");
    check_test("test exclusive for all inputs against both", false, "row 2: a=0 b=1 | q=1, expected 0");
}

#[test]
fn rows_are_read_from_a_file_and_some_may_fail() {
    let bench = Bench::with("rows.csv", "a,b,q\n0,1,1\n1,1,0\n1,0,1\n0,0,1\n");
    let run = |share: &str| {
        bench.file("a.nb", format!("{CIRCUITS}\ntest exclusive \"x\" from \"rows.csv\"{share}\n"));
        bench.run("test a.nb --logic")
    };
    let all = run("");
    assert!(all.status == 1 && all.out.contains("rows.csv:5: row 4: a=0 b=0 | q=0, expected 1"), "{}", all.out);
    let some = run(" at least 75%");
    assert_eq!((some.status, some.err.as_str()), (0, ""));
    assert!(
        some.out.starts_with("pass  exclusive \"x\" (3 of 4 rows, at least 75 %, logic)\n1 passed"),
        "{}",
        some.out
    );
    let more = run(" at least 75.1 %");
    assert!(
        more.status == 1 && more.out.contains("FAIL  exclusive \"x\" (3 of 4 rows, at least 75.1 %"),
        "{}",
        more.out
    );
    bench.ok("fmt a.nb");
    let text = bench.read("a.nb");
    assert!(text.contains("test exclusive \"x\" from \"rows.csv\" at least 75.1%\n"), "{text}");
    let json = bench.run("test a.nb --logic --format json");
    let found: Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(found["tests"][0]["rows_from"], json!({ "file": "rows.csv", "at_least": 75.1 }));
    // In physics, too: the robots of an exclusive or, held for each row.
    let physics = bench.run("test a.nb --physics");
    assert!(physics.out.contains("(3 of 4 rows, at least 75.1 %, physics)"), "{}{}", physics.out, physics.err);
}

#[test]
fn small_swarms_are_tested_in_physics_and_large_ones_in_logic() {
    let bench =
        Bench::with("small.nb", "circuit inverter(a) -> (q) { q = not a }\n\ntest inverter {\n a | q\n 1 | 0\n}\n");
    // A chain of 13 full adders, which optimization cannot reduce to fewer than 40 robots.
    bench.file(
        "large.nb",
        "circuit sum(a[13], b[13]) -> (q[13]) { q = a + b }\n\ntest sum {\n a b | q\n 13'd4000 13'd77 | 13'd4077\n}\n",
    );
    let levels = |arguments: &[&str]| {
        let found =
            bench.run(&[&["test", "small.nb", "large.nb", "--format", "json"], arguments].concat()).expect_json();
        let level = |at: usize| found["tests"][at]["level"].as_str().unwrap().to_owned();
        [level(0), level(1)]
    };
    assert_eq!(levels(&[]), ["physics", "logic"]);
    assert_eq!(levels(&["--logic"]), ["logic", "logic"]);
}

/// A test that takes its time in physics, then two that are done at once, in two files.
fn slow_then_quick() -> Bench {
    let bench = Bench::new();
    let inverter = "circuit inverter(a) -> (q) { q = not a }";
    bench.file("slow.nb", format!("{inverter}\n\ntest inverter \"slow\" {{\n a | q\n 0 | 1 for 40 cycles\n}}\n"));
    let quick = |title| format!("test inverter \"{title}\" {{\n a | q\n 0 | 1 for 4 cycles\n}}\n");
    bench.file("quick.nb", format!("{inverter}\n\n{}\n{}", quick("second"), quick("third")));
    bench
}

#[test]
fn tests_are_reported_in_order_for_any_number_of_threads() {
    let bench = slow_then_quick();
    for format in ["text", "json"] {
        let told = |threads: &str| {
            let mut command = bench.command(&["test", "slow.nb", "quick.nb", "--physics", "--format", format]);
            let output = command.env("RAYON_NUM_THREADS", threads).output_in_time();
            assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
            String::from_utf8(output.stdout).unwrap()
        };
        let alone = told("1");
        let places: Vec<_> = ["slow", "second", "third"].map(|title| alone.find(title).unwrap()).into();
        assert!(places.is_sorted(), "{alone}");
        assert!(["2", "8"].into_iter().all(|threads| told(threads) == alone));
    }
}

#[test]
fn no_test_runs_if_a_file_has_errors() {
    let bench = slow_then_quick();
    bench.file("broken.nb", "circuit inverter(a) -> (q) { q = not b }\n");
    bench.file("bare.nb", "circuit inverter(a) -> (q) { q = not a }\n");
    bench.run("test quick.nb broken.nb").expect_fault(&["no net is called `b`"]);
    bench.run("test quick.nb bare.nb").expect_fault(&["`bare.nb` declares no test"]);
}
