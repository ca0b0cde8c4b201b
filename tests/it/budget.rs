//! Small texts that would make much: refused at every door within a second and a gigabyte, before anything is unfolded.

use nbc_base::budget::Limit;
use nbc_base::diag::Code;

use crate::support::*;

const WIDE: &str = "circuit f(a[1000000]) -> (q) { q = a[0] }\n";
const BIT: &str = "circuit f(a) -> (q) { q = a }\n";

fn circuit(statements: &str) -> String {
    format!("circuit f(a) -> (q) {{\n{statements}\nq = a\n}}\n")
}

fn turns(statements: &str) -> String {
    circuit(&format!("for i in 0..300000 {{\n{statements}\n}}"))
}

fn numbered(range: std::ops::Range<usize>, text: impl Fn(usize) -> String) -> String {
    range.map(text).collect()
}

/// Rows that are repeated, alone, inside others, over worlds and over tests; and those that take long.
pub fn rows() -> Vec<(&'static str, String)> {
    let test = |rows: &str| format!("test f {{\n a | q\n{rows}}}\n");
    let worlds = numbered(1..70, |at| format!("world w{at} {{ gravity: 9.{at} }}\n"));
    let names: Vec<String> = (1..70).map(|at| format!("w{at}")).collect();
    let wide = "circuit f(a[16]) -> (q[400000]) { q = {400000{a[0]}} }\n";
    vec![
        ("rows", format!("{WIDE}{}", test(" repeat 150000 {\n 0 | -\n }\n"))),
        ("nested", format!("{BIT}{}", test(&format!("{} 0 | 0\n{}", "repeat 1000 {\n".repeat(7), "}\n".repeat(7))))),
        ("worlds", format!("{worlds}{WIDE}test f in [{}] {{\n a | q\n 0 | -\n}}\n", names.join(", "))),
        ("repeated", format!("{BIT}{}", test(" repeat 999999 {\n 0 | 0\n }\n"))),
        ("tests", format!("{BIT}{}", test(" repeat 60000 {\n 0 | 0\n }\n").repeat(4))),
        ("all inputs", format!("{wide}test f for all inputs {{ q = {{400000{{a[0]}}}} }}\n")),
        ("held", format!("{WIDE}{}", test(" 0 | - for 1000000 cycles\n"))),
        (
            "cycles",
            format!("{WIDE}swarm s {{ circuit: f }}\nsimulate s with schedule (a) {{\n 0 for 1000000 cycles\n}}\n"),
        ),
    ]
}

/// A circuit that cells permit, but robots do not.
fn too_many_for_robots() -> String {
    "circuit f(a[64], b[64]) -> (q[64]) {\n net t[3500][64]\n t[0] = a xor b\n for i in 1..3500 {\n\
     t[i] = (t[i - 1] nand {t[i - 1][62..0], t[i - 1][63]}) xor b\n }\n q = t[3499]\n}\n\
     swarm s { circuit: f }\nsimulate s with schedule (a, b) {\n 1 2 for 4 cycles\n}\n"
        .to_owned()
}

/// Circuits that become large.
fn circuits() -> Vec<(&'static str, String)> {
    let long = "n".repeat(4_000);
    let doubled = |name: &str| {
        let level = |at: usize| {
            let inner = at - 1;
            format!("circuit c{at}(a) -> (q) {{ {name}{at} = c{inner}(a)\n q = c{inner}({name}{at}) }}\n")
        };
        format!("circuit c0(a) -> (q) {{ q = a }}\n{}", numbered(1..24, level))
    };
    let leaves = "circuit leaf[n](a) -> (q) { q = a }\n\
        circuit mid[m](a) -> (q) { for i in 0..1000 { _ = leaf[m * 1000 + i](a) }\n q = a }\n";
    let ports = |count| numbered(0..count, |at| format!("p{at}, "));
    vec![
        ("parameters", format!("{leaves}{}", circuit("for i in 0..2000 { _ = mid[i](a) }"))),
        ("calls without cells", doubled("x")),
        ("names of calls", doubled(&format!("x{}", &long[..3_900]))),
        ("statements in an `if`", turns(&format!("if 1 == 1 {{\n{}}}", "_ = a\n".repeat(500)))),
        ("gates", turns(&format!("_ = a{}", " and a".repeat(500)))),
        ("bits", turns("_ = {1000000{a}}")),
        ("parts", turns(&format!("_ = {{{}a}}", "a, ".repeat(2_000)))),
        ("sizes", turns(&format!("_ = {{(0{}){{a}}}}", " + 1".repeat(20_000)))),
        ("integers", turns(&format!("{}_ = a", numbered(0..2_000, |at| format!("let v{at} = i\n"))))),
        ("names", turns(&format!("{long} = a\n_ = {long}"))),
        ("defaults", format!("circuit d[n = 0{}](a) -> (q) {{ q = a }}\n{}", " + 1".repeat(20_000), turns("_ = d(a)"))),
        (
            "ports",
            format!(
                "circuit d({}z) -> (q) {{ q = z }}\n{}",
                ports(3_000),
                turns(&format!("_ = d({}a)", "a, ".repeat(3_000)))
            ),
        ),
        ("a name", format!("circuit {}(a) -> (q) {{ q = a }}\n", "n".repeat(100_000))),
        (
            "memories",
            format!(
                "environment e(clk, a) -> (q) {{\n{}q = a\n}}\n",
                numbered(0..30, |at| format!("net m{at}[1000000][8]\n"))
            ),
        ),
    ]
}

#[test]
fn small_programs_are_refused_within_a_second_and_a_gigabyte() {
    let bench = Bench::new();
    for (name, text) in rows().into_iter().chain(circuits()) {
        let file = format!("{}.nb", name.replace([' ', '`'], "_"));
        bench.file(&file, &text);
        refused_by(&bench, &["check", &file], Code::TooLarge);
    }
    bench.file("swarm.nb", too_many_for_robots());
    refused_by(&bench, &["run", "swarm.nb"], Code::TooLarge);
    for (name, text) in rows() {
        bench.file("small.nb", &text);
        eprintln!("{name}");
        refused_by(&bench, &["test", "small.nb"], Code::TooLarge);
    }
}

#[test]
fn texts_that_are_long_to_look_at_are_checked_in_bounds() {
    let bench = Bench::new();
    // Every output depends on every input, so there are too many pairs to look for loops.
    let passes = "circuit g(a[20000]) -> (q[20000]) { t = any(a)\n q = {20000{t}} }\n\
        circuit f(a) -> (q) { x = g({20000{y}})\n y = x[0]\n q = a }\n";
    let errors = turns("net t[10]\n_ = t[i]");
    for (text, status) in [(passes.to_owned(), 0), (errors, 2)] {
        bench.file("long.nb", text);
        let ran = bench.limited(BOUNDS, "check long.nb");
        assert_eq!(ran.status, status, "{:.300}", ran.err);
    }
}

#[test]
fn robot_files_are_counted_with_their_aliases() {
    let bench = Bench::new();
    let robot = "format: 2\nname: x\n";
    let long = "x".repeat(900_000);
    let aliases = |name: &str, times: usize| vec![format!("*{name}"); times].join(", ");
    let nested = (1..10).map(|at| format!("n{at}: &n{at} [{}]\n", aliases(&format!("n{}", at - 1), 10)));
    for (name, text) in [
        ("scalar", format!("{robot}body: [&a \"{long}\", {}]\n", aliases("a", 20_000))),
        ("block", format!("{robot}body:\n- &a \"{long}\"\n{}", "- *a\n".repeat(20_000))),
        ("genotype", format!("{robot}genotype: [&a \"{long}\", {}]\n", aliases("a", 20_000))),
        ("nested", format!("{robot}n0: &n0 [x, x, x, x]\n{}", nested.collect::<String>())),
        ("deep", format!("{robot}body: {}\n", "- ".repeat(400_000))),
        ("keys", (0..80_000).map(|at| format!("k{at}: 1\n")).collect()),
        ("flow", format!("{robot}body: [{}]\n", "x,".repeat(500_000))),
        ("json", format!("{{\"format\": 2, \"body\": [{}\"x\"]}}", "\"\",".repeat(300_000))),
        ("deep json", format!("{{\"format\": 2, \"body\": {}}}", "[".repeat(100_000))),
    ] {
        let file = format!("{}.yaml", name.replace(' ', "_"));
        bench.file(&file, text);
        refused_by(&bench, &["simulate", &file, "--schedule", "00*1"], Code::RobotFile);
    }
}

#[test]
fn words_far_outside_of_a_memory_take_no_room() {
    let bench = Bench::with("far.hex", "@3fffffff 1\n");
    bench.file(
        "far.nb",
        "file words = \"far.hex\"\ncircuit f(d, clk) -> (at) { at = register(d, clk) }\n\
         environment e(at) -> (d) { net m[2][1] init words\n d = m[at] }\n\
         test f with e {\n clk | at\n ^ | 0\n}\n",
    );
    refused_by(&bench, &["test", "far.nb"], Code::TooLarge);
}

#[test]
fn a_test_of_all_inputs_takes_a_moment() {
    let bench = Bench::new();
    let product = "circuit f(a[8], b[8]) -> (q[16]) { q = {8'd0, a} * {8'd0, b} }\n";
    let other = "circuit g(a[8], b[8]) -> (q[16]) { q = {8'd0, b} * {8'd0, a} }\ntest f for all inputs against g\n";
    let square = "circuit f(a[16]) -> (q[16]) { q = a * a }\ntest f for all inputs { q = a * a }\n";
    let wrong = "circuit f(a[16]) -> (q[16]) { q = a * a }\ntest f for all inputs { q = a * (a xor 16'd256) }\n";
    for (text, status) in [(format!("{product}{other}"), 0), (square.to_owned(), 0), (wrong.to_owned(), 1)] {
        bench.file("all.nb", text);
        let ran = bench.limited(BOUNDS, "test all.nb");
        assert_eq!(ran.status, status, "{:.300}", ran.out);
    }
}

#[test]
fn the_page_of_limits_has_them_all() {
    let page = text_of("docs/limits.md");
    let rows: Vec<String> = Limit::ALL.iter().map(|limit| limit.row()).collect();
    let table: Vec<&str> = page.lines().filter(|line| line.starts_with("| ")).skip(1).collect();
    assert_eq!(table, rows, "docs/limits.md has the table of `Limit`");
}
