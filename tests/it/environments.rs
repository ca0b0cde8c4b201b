//! Tests with environments, repeated rows and several worlds, and what circuits of the same words compute.

use crate::support::*;

const TELLER: &str = "
file program = \"hello.csv\"

circuit teller(char[8], clk) -> (at[3], done) {
    done = char == 0
    at   = register(at + 1, clk, enable: not done)
}

environment desk(at[3]) -> (char[8], screen: text) {
    net words[8][8] init program
    char   = words[at]
    screen = {char != 0, char}
}

test teller \"says it\" with desk {
    clk | done
    ^   | -    until done, at most 8 rows
}
";

fn teller() -> Bench {
    let bench = Bench::with("a.nb", TELLER);
    bench.file("hello.csv", "72, 105, 0\n");
    bench.file("other.hex", "4f 4b 21\n");
    bench.file("long.hex", "1 2 3 4 5 6 7 8 9\n");
    bench.file("wide.hex", "1\n100\n");
    bench
}

#[test]
fn an_environment_answers_at_both_levels() {
    let bench = teller();
    for level in ["--logic", "--physics"] {
        let ran = bench.ok(&["test", "a.nb", level]);
        assert!(ran.out.contains("\n    > Hi\n"), "{}", ran.out);
    }
    let json = bench.run("test a.nb --logic --format json").expect_json();
    assert_eq!(json["tests"][0]["printed"], "Hi");
}

#[test]
fn the_circuit_of_a_file_is_the_last_that_is_no_environment() {
    let built = teller().run("build a.nb");
    assert_eq!(built.status, 0, "{}{}", built.out, built.err);
    assert!(built.out.contains("teller"), "{}", built.out);
}

#[test]
fn a_declared_file_is_replaced_on_the_command_line() {
    let bench = teller();
    for arguments in [&["--program", "other.hex"][..], &["--program=other.hex"], &["--file", "program=other.hex"]] {
        let ran = bench.ok(&[&["test", "a.nb", "--logic"], arguments].concat());
        assert!(ran.out.contains("> OK!\n"), "{}", ran.out);
    }
    let run = |arguments: &[&str]| bench.run(&[&["test", "a.nb", "--logic"], arguments].concat());
    run(&["--file", "progam=other.hex"]).expect_fault(&["the program declares no file `progam`", "`program`"]);
    run(&["--program", "missing.hex"]).expect_fault(&["cannot read `missing.hex`"]);
    run(&["--program", "long.hex"]).expect_fault(&["`long.hex` has 9 words, and the memory 8"]);
    run(&["--program", "wide.hex"]).expect_fault(&["line 2 of `wide.hex` has no word of the memory"]);
}

#[test]
fn rows_are_repeated_a_number_of_times_or_until_an_output_has_a_value() {
    let check = |rows: &str, passes: bool, says: &str| {
        let bench = Bench::new();
        let circuit = "circuit c(clk) -> (n[3], top) {\n n = register(n + 1, clk)\n top = n == 7\n}\n";
        bench.file("a.nb", format!("{circuit}test c {{\n clk | n top\n{rows}\n}}\n"));
        let ran = bench.run("test a.nb --logic");
        assert_eq!(ran.status, i32::from(!passes), "{rows}\n{}{}", ran.out, ran.err);
        assert!(ran.out.contains(says), "{says:?} is not in\n{}", ran.out);
    };
    check(" repeat 3 {\n ^ | - 0\n }\n ^ | 4 0", true, "pass  c (4 rows, logic)");
    check(" repeat 2 {\n repeat 2 {\n ^ | - 0\n }\n ^ | - -\n }\n 0 | 6 0", true, "pass");
    check(" repeat 8 {\n ^ | - 0\n }", false, "top=1, expected 0");
    check(" ^ | - - until top, at most 7 rows", true, "pass  c (1 row, logic)");
    check(" ^ | - - until top, at most 6 rows", false, "top=0, expected 1");
    check(" ^ | - - until n = 5, at most 10 rows\n ^ | 6 0", true, "pass");
}

#[test]
fn a_test_runs_in_each_of_its_worlds() {
    let bench = Bench::new();
    let text = "world wet { friction: 95% }\ncircuit f(a) -> (q) { q = not a }\n\
                test f in [paper, wet] {\n a | q\n 0 | 1\n}\nsimulate f with schedule (a) { 0 for 3 cycles }\n";
    bench.file("a.nb", text);
    let ran = bench.run("test a.nb");
    assert!(ran.status == 0 && ran.out.contains("2 passed, 0 failed"), "{}{}", ran.out, ran.err);
    let ran = bench.run("run a.nb --no-report");
    assert!(ran.status == 0 && ran.out.contains("simulate"), "{}{}", ran.out, ran.err);
}

#[test]
fn circuits_that_change_each_other_for_ever_are_refused() {
    let bench = Bench::new();
    let text = "circuit f(a, clk) -> (q) { q = not a and clk or not a }\n\
                environment e(q) -> (a) { a = q }\n\
                test f with e {\n clk | q\n 0 | -\n}\n";
    bench.file("a.nb", text);
    let ran = bench.run("test a.nb --logic");
    assert!(ran.err.contains("change each other for ever"), "{}{}", ran.out, ran.err);
    assert_eq!(ran.status, 1);
}
