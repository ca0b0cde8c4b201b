//! What is known without a simulation: a check says it, and so does every command that begins with one. And nothing
//! that is given is ignored.

use crate::support::*;

const FLIP_FLOP: &str = "circuit ff(a, clk) -> (q) { q = register(a, clk) }\n";
const ROWS: &str = "test ff {\n a clk | q\n 0 0 | 0\n 1 ^ | 1\n}\n";

/// A program that `check` and `test` refuse in the same words.
#[track_caller]
fn refused(text: &str, says: &str) {
    let bench = Bench::with("a.nb", text);
    let [checked, tested] = ["check", "test"].map(|command| bench.run(&[command, "a.nb"]));
    checked.expect_fault(&[says]);
    assert_eq!((tested.status, tested.err), (2, checked.err), "{}", tested.out);
}

#[test]
fn a_check_refuses_swarms_that_cannot_be_made() {
    let swarm = |fields: &str| format!("{FLIP_FLOP}swarm s {{ circuit: ff, {fields} }}\n{ROWS}");
    refused(&swarm("registers: mux"), "no multiplexer without glitches");
    refused(&swarm("registers: waves, step: 3 cycles, beat: 2 cycles"), "no whole number of beats");
    let step = "circuit ff(a[4], clk) -> (c[4]) {\n c = register(c * 3 + a, clk)\n}\n\
                swarm s { circuit: ff, registers: waves, step: 1 cycle }\ntest ff {\n a clk | c\n 1 ^ | 1\n}\n";
    refused(step, "a step of 1 cycle is too short");
    let two = "circuit ff(a, clk, c) -> (q, r) {\n q = register(a, clk)\n r = register(a, c)\n}\n\
               swarm s { circuit: ff, registers: waves }\ntest ff {\n a clk c | q\n 1 ^ 0 | 1\n}\n";
    refused(two, "the registers have two clocks");
    let rows = ROWS.replace(" 1 ^ | 1", " 1 ^ | 1\n 0 1 | 1\n 0 ^ | 0 for 9 cycles");
    let text = format!("{FLIP_FLOP}swarm s {{ circuit: ff, registers: waves }}\n{rows}");
    refused(&text, "shows new outputs only after an edge");
    refused(&text, "a row of a wave machine has no hold of its own");
}

#[test]
fn a_check_refuses_a_kind_of_registers_where_there_are_none() {
    let gate = "circuit g(a, b) -> (q) { q = a and b }\ntest g {\n a b | q\n 0 1 | 0\n}\n";
    let swarm = format!("swarm s {{ circuit: g, library: three, registers: mux }}\n{gate}");
    refused(&swarm, "`registers: mux` has no effect in the swarm `s`");
    let bench =
        Bench::with("a.nb", format!("{FLIP_FLOP}swarm s {{ circuit: ff, library: three, registers: mux }}\n{ROWS}"));
    bench.ok("check a.nb");
}

#[test]
fn a_check_looks_at_the_robots_of_an_evolution_that_has_run() {
    let gate = "circuit g(a, b) -> (q) { q = a and b }\ntest g {\n a b | q\n 0 1 | 0\n}\n";
    let library = |fields: &str| {
        let evolution = "evolution few { objective: gate, box: 3 x 3, generations: 2 }\n";
        format!("{evolution}library own {{ from: few{fields} }}\nswarm s {{ circuit: g, library: own }}\n{gate}")
    };
    let bench = Bench::with("a.nb", library(""));
    bench.ok("check a.nb");
    let robot = |name: &str| {
        let robots = nbc_session::store::shipped_library().robots;
        nbc_session::store::print_robot(robots.iter().find(|robot| robot.name == name).unwrap())
    };
    for (name, text, fields, says) in [
        ("broken", "format: 2".to_owned(), "", "broken.yaml"),
        ("xor", robot("xor_5x5"), "", "cannot be made of"),
        ("nand", robot("nand_5x5"), ", without: [nobody]", "the library has no robot `nobody`"),
    ] {
        let bench = Bench::with("a.nb", library(fields));
        fs::create_dir_all(bench.path().join("out/few/robots")).unwrap();
        bench.file(format!("out/few/robots/{name}.yaml"), text);
        let [checked, tested] = ["check", "test"].map(|command| bench.run(&[command, "a.nb"]));
        checked.expect_fault(&[says]);
        assert_eq!((tested.status, tested.err), (2, checked.err), "{}", tested.out);
    }
}

#[test]
fn a_check_refuses_libraries_without_the_robots_that_are_needed() {
    let gate = "circuit g(a, b) -> (q) { q = a and b }\ntest g {\n a b | q\n 0 1 | 0\n}\n";
    let missing = "cannot be made of";
    refused(&format!("library shipped {{ from: shipped, behaviors: [xor] }}\n{gate}"), missing);
    refused(
        &format!("library few {{ from: three, behaviors: [or] }}\nswarm s {{ circuit: g, library: few }}\n{gate}"),
        missing,
    );
    refused(
        &format!(
            "library few {{ from: shipped, behaviors: [nand, maj] }}\nswarm s {{ circuit: g, library: few }}\n{gate}"
        ),
        "`few` has no robot of `maj`",
    );
    refused(
        &format!("library few {{ from: shipped, without: [nobody] }}\nswarm s {{ circuit: g, library: few }}\n{gate}"),
        "the library has no robot `nobody`",
    );
    let bench = Bench::with(
        "a.nb",
        format!("library few {{ from: shipped, behaviors: [nand] }}\nswarm s {{ circuit: g, library: few }}\n{gate}"),
    );
    let checked = bench.run("check a.nb");
    assert_eq!((checked.status, checked.err.as_str()), (0, ""), "nand makes everything");
    bench.file(
        "b.nb",
        "library big { from: shipped, behaviors: [nand] }\nevolution e { genome: voxels, box: 3 x 3, start: big }\n",
    );
    bench.run("check b.nb").expect_fault(&["no robot of `big` fits into the box"]);
}

#[test]
fn a_check_reads_the_files_that_memories_begin_with() {
    let text = "file words = \"words.hex\"\n\
circuit echo(d[8], clk) -> (at[2], same) {\n at = register(at + 1, clk)\n same = d == 7\n}\n\
environment store(at[2]) -> (d[8]) {\n net m[4][8] init words\n d = m[at]\n}\n\
test echo with store {\n clk | same\n ^ | 1\n}\n";
    let bench = Bench::with("a.nb", text);
    let checked = bench.run("check a.nb");
    assert!(
        checked.status == 0 && checked.err.contains("warning[unreadable]: cannot read `words.hex`"),
        "{}",
        checked.err
    );
    bench.run("test a.nb --logic").expect_fault(&["error[unreadable]: cannot read `words.hex`"]);
    bench.file("seven.hex", "7 7 7 7");
    bench.ok("test a.nb --logic --file words=seven.hex");
    bench.file("words.hex", "7 7 7 7 7");
    bench.run("check a.nb").expect_fault(&["`words.hex` has 5 words, and the memory 4"]);
    bench.file("words.hex", "\u{feff}7 7\n");
    bench.ok("check a.nb");
}

#[test]
fn files_that_no_memory_begins_with_are_refused() {
    let bench = Bench::with("a.nb", format!("{FLIP_FLOP}{ROWS}"));
    bench.file("b.nb", format!("file idle = \"a.hex\"\n{FLIP_FLOP}{ROWS}"));
    for command in ["test", "run"] {
        let given = |file, option| bench.run(&[command, file, "--file", option]);
        given("a.nb", "idle=a.hex").expect_fault(&["the program declares no file `idle`"]);
        given("b.nb", "idle=a.hex").expect_fault(&["no memory begins with the file `idle`"]);
        given("b.nb", "idel=a.hex").expect_fault(&["the program declares no file `idel`", "`idle`"]);
    }
    let twice = ["test", "a.nb", "--file", "x=a", "--file", "x=b"];
    bench.run(&twice).expect_fault(&["the file `x` is given twice"]);
}

#[test]
fn what_is_outside_of_an_array_is_zero_everywhere() {
    let text = "\
circuit g(a[5], n[3], at[2], d[2], w, clk) -> (bit, same, word[2], all[6]) {
    net m[3][2]
    m[at] = register(d, clk, enable: w)
    bit   = a[n]
    same  = select(a, n)
    word  = m[at]
    all   = m
}
test g \"nets\" {
    a     n at d w clk | bit same word all
    11111 4 0  1 1 ^   | 1   1    1    000001
    11111 5 2  3 1 ^   | 0   0    3    110001
    11111 7 3  2 1 ^   | 0   0    0    110001
    01111 4 3  2 1 ^   | 0   0    0    110001
    10000 6 2  0 0 0   | 0   0    3    110001
}
circuit h(clk, word[2]) -> (at[2], seen[2]) {
    at   = register(at + 1, clk)
    seen = word
}
environment e(at[2], clk) -> (word[2]) {
    net m[3][2]
    m[at] = register(2'd3, clk)
    word  = m[at]
}
test h \"memory\" with e {
    clk | at seen
    ^   | 1  0
    ^   | 2  0
    ^   | 3  0
    ^   | 0  0
    ^   | 1  3
}
";
    let bench = Bench::with(
        "one.nb",
        "circuit f(d, at, clk) -> (q, r) {\n net m[1][1]\n m[at] = register(d, clk)\n q = m\n r = m[at]\n}\n\
         test f {\n d at clk | q r\n 1 1 ^ | 0 0\n 1 0 ^ | 1 1\n 0 1 ^ | 1 0\n}\n",
    );
    let ran = bench.run("test one.nb --logic");
    assert!(ran.status == 0 && ran.out.contains("1 passed"), "{}{}", ran.out, ran.err);
    bench.file("a.nb", text);
    let ran = bench.run("test a.nb --logic");
    assert!(ran.status == 0 && ran.out.contains("2 passed"), "{}{}", ran.out, ran.err);
    let checked = bench.run("check a.nb");
    assert_eq!(checked.err.matches("warning[index-outside]").count(), 6, "{}", checked.err);
}

#[test]
fn a_test_that_gives_up_says_after_how_many_rows_and_a_pulse_is_one() {
    let text = "circuit g(clk) -> (c[3], q) {\n c = register(c + 1, clk)\n q = c == 6\n}\n\
                test g \"short\" {\n clk | c q\n ^ | - - until q, at most 3 rows\n}\n\
                test g \"long\" {\n clk | c q\n 0 | 0 0\n repeat 7 {\n ^ | - -\n }\n}\n";
    let bench = Bench::with("a.nb", text);
    let ran = bench.run("test a.nb --logic");
    let limit = "q=0, expected 1 (repeated 3 times, as often as its `until` permits)";
    assert!(ran.out.contains(limit) && ran.out.contains("pass  g \"long\" (8 rows"), "{}", ran.out);
    let tested = bench.run("test a.nb --logic --format json");
    assert_eq!(validate("test", &tested.out)["tests"][0]["rows"][0]["until"], 3, "{}", tested.out);
    bench.file("b.nb", format!("{FLIP_FLOP}{ROWS}"));
    let ran = bench.run("test b.nb --physics");
    assert!(ran.out.contains("pass  ff (2 rows, physics)"), "{}{}", ran.out, ran.err);
}
