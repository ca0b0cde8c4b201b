//! Hostile input: a clear message, bounded work, never a panic.

use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic, render};
use nbc_base::source::{MemoryWorld, Sources};
use nbc_lang::check;

use crate::support::*;

fn found(text: String) -> Vec<Diagnostic> {
    let mut sources = Sources::default();
    let file = sources.add("a.nb", text);
    let diagnostics = check::check(&MemoryWorld::default(), &mut sources, file).diagnostics;
    let shown = render::text(&diagnostics, &sources, false);
    assert!(shown.len() < 100_000, "messages stay short: {} bytes", shown.len());
    diagnostics
}

fn rejected(text: impl Into<String>, code: Code) {
    let diagnostics = found(text.into());
    assert!(diagnostics.iter().any(|diagnostic| diagnostic.code == code), "{code} is not among {diagnostics:.500?}");
}

fn circuit(line: &str) -> String {
    format!("circuit f(a) -> (q) {{\n    {line}\n}}\n")
}

#[test]
fn nesting_is_bounded() {
    let deep = 10_000;
    rejected(circuit(&format!("q = {}a{}", "(".repeat(deep), ")".repeat(deep))), Code::Nesting);
    rejected(circuit(&format!("q = {}a{}", "nand(a, ".repeat(deep), ")".repeat(deep))), Code::Nesting);
    rejected(circuit(&format!("q = {}a{}", "{".repeat(deep), "}".repeat(deep))), Code::Nesting);
    rejected(format!("{}{}", circuit("q = a"), "[".repeat(deep)), Code::Nesting);
    rejected(format!("material m {{ kind: {}{} }}", "[".repeat(deep), "]".repeat(deep)), Code::Nesting);
}

#[test]
fn long_chains_do_not_count_as_nesting() {
    let long = 20_000;
    for sign in ["~", "! ", "!not "] {
        rejected(circuit(&format!("q = {}a", sign.repeat(long))), Code::Syntax);
    }
    assert_eq!(found(circuit(&format!("q = {}a", "not ".repeat(long)))), []);
    assert_eq!(found(circuit(&format!("q = a{}", " and a".repeat(long)))), []);
    let sum = format!("{}1", "0 + ".repeat(long));
    assert_eq!(found(format!("circuit f(a[{sum}]) -> (q) {{ q = a }}")), []);
}

#[test]
fn nested_ifs_are_parsed_or_rejected() {
    for depth in [10, 60] {
        let text = circuit(&format!("q = {}a{}", "if a then ".repeat(depth), " else a".repeat(depth)));
        assert_eq!(found(text), [], "{depth} deep");
    }
    rejected(circuit(&format!("q = {}a{}", "if a then ".repeat(100_000), " else a".repeat(100_000))), Code::Nesting);
    assert_eq!(found(circuit(&format!("q = {}a", "if a then a else ".repeat(10_000)))), []);
}

/// Half of the smallest stack that a door gives: 1 MiB, in the browser and on Windows.
const STACK: usize = 512 << 10;

#[test]
fn the_deepest_nesting_needs_a_small_stack() {
    let depth = Limit::Nesting.most() as usize - 3;
    let within = |open: &str, close: &str| circuit(&format!("q = {}a{}", open.repeat(depth), close.repeat(depth)));
    let texts = [
        within("(", ")"),
        within("nand(a, ", ")"),
        within("if a then ", " else a"),
        within("{", "}"),
        within("not (a and ", ")"),
        format!("circuit f(a[{}1{}]) -> (q) {{ q = any(a) }}", "(".repeat(depth), ")".repeat(depth)),
        circuit(&format!("{}_ = a{}\n q = a", "for i in 0..1 { ".repeat(depth), " }".repeat(depth))),
        format!("material m {{ kind: {}{} }}", "[".repeat(depth), "]".repeat(depth)),
    ];
    let parse = move || {
        for text in texts {
            assert!(found(text.clone()).iter().all(|fault| fault.code != Code::Nesting), "{text}");
            let mut sources = Sources::default();
            let file = sources.add("a.nb", text);
            let parsed = nbc_lang::syntax::parse(&sources, file);
            nbc_lang::syntax::format(&sources, file, &parsed.tree);
        }
    };
    std::thread::Builder::new().stack_size(STACK).spawn(parse).unwrap().join().unwrap();
}

#[test]
fn sizes_are_bounded() {
    rejected("circuit f(a[8000000000]) -> (q) { q = any(a) }", Code::OutOfRange);
    rejected("circuit f(a[1000000000]) -> (q) { q = any(a) }", Code::OutOfRange);
    rejected("circuit f(a[0]) -> (q) { q = 0 }", Code::OutOfRange);
    rejected("circuit f(a[2 ** 62 * 4]) -> (q) { q = 0 }", Code::OutOfRange);
    rejected("circuit f(a[1 / 0]) -> (q) { q = 0 }", Code::OutOfRange);
    rejected(circuit("q = any({1000000000{a}})"), Code::OutOfRange);
    rejected(circuit("for i in 0..1000000 { _ = a }\n q = a"), Code::TooLarge);
    rejected(circuit("for i in 0..4000000000 { }\n q = a"), Code::TooLarge);
    for huge in
        ["2 ** 64", "2 ** 64 + 1", "2 ** 126", "0x10000000000000001", "2 ** 127", "0x80000000000000000000000000000000"]
    {
        let code = if huge == "2 ** 127" || huge.len() > 20 { Code::OutOfRange } else { Code::TooLarge };
        rejected(circuit(&format!("for i in 0..{huge} {{ }}\n q = a")), code);
        for lines in [
            "q = any({_{a}})",
            "net t[_]\n t = a\n q = a",
            "net t[2][_]\n t[0] = a\n q = a",
            "q = a[_]",
            "q init _ = a",
        ] {
            rejected(circuit(&lines.replace('_', &format!("({huge})"))), Code::OutOfRange);
        }
    }
    rejected(circuit("for i in 0..1000 { for j in 0..1000 { _ = a } }\n q = a"), Code::TooLarge);
    rejected(circuit("for i in 0..400000 { net t[1000]\n for j in 0..1000 { t[j] = a } }\n q = a"), Code::TooLarge);
}

#[test]
fn exponential_hierarchies_are_rejected_without_building_them() {
    let mut text = "circuit c0(a) -> (q) { q = not a }\n".to_owned();
    for level in 1..60 {
        text += &format!("circuit c{level}(a) -> (q) {{ q = c{0}(c{0}(a)) }}\n", level - 1);
    }
    rejected(text, Code::TooLarge);
}

#[test]
fn long_chains_of_circuits_are_rejected() {
    let mut text = String::new();
    for level in (1..5_000).rev() {
        text += &format!("circuit c{level}(a) -> (q) {{ q = c{}(a) }}\n", level - 1);
    }
    text += "circuit c0(a) -> (q) { q = not a }\n";
    rejected(text, Code::Nesting);
}

#[test]
fn a_long_line_and_a_long_file_are_rejected() {
    rejected("a".repeat(10_000_000), Code::Unreadable);
    rejected("a".repeat(7_000_000), Code::TooLarge);
    rejected("(".repeat(1_000_000), Code::Nesting);
    rejected("circuit f(a) -> (q) { q = a }\0", Code::Unreadable);
    rejected("", Code::Empty);
    assert_eq!(found("\u{feff}circuit f(a) -> (q) { q = a }".to_owned()), []);
    rejected("circuit f(a) -> (q) { q = a }\u{feff}", Code::Syntax);
}

#[test]
fn a_circle_of_many_files_is_rejected() {
    let mut world = MemoryWorld::default();
    for at in 0..200 {
        world.insert(format!("{at}.nb"), format!("use \"{}.nb\"\ncircuit c{at}(a) -> (q) {{ q = a }}", (at + 1) % 200));
    }
    let mut sources = Sources::default();
    let file = check::open(&world, "0.nb", &mut sources).unwrap();
    let diagnostics = check::check(&world, &mut sources, file).diagnostics;
    assert!(diagnostics.iter().any(|diagnostic| diagnostic.code == Code::Nesting), "{diagnostics:?}");
}

fn found_in(world: &MemoryWorld) -> Vec<Diagnostic> {
    let mut sources = Sources::default();
    let file = check::open(world, "main.nb", &mut sources).unwrap();
    check::check(world, &mut sources, file).diagnostics
}

#[test]
fn programs_of_many_or_large_files_are_rejected() {
    let mut world = MemoryWorld::default();
    let uses = |files: usize| (0..files).map(|at| format!("use \"{at}.nb\"\n")).collect::<String>();
    for at in 0..300 {
        world.insert(format!("{at}.nb"), "circuit f(a) -> (q) { q = a }".replace('f', &format!("f{at}")));
    }
    world.insert("main.nb", uses(255));
    assert_eq!(found_in(&world), []);
    world.insert("main.nb", uses(300));
    let codes = |world: &MemoryWorld| found_in(world).iter().map(|fault| fault.code).collect::<Vec<_>>();
    assert_eq!(codes(&world), [Code::TooLarge], "one message for all files that are too many");
    for at in 0..3 {
        world.insert(format!("{at}.nb"), "// a comment of some length\n".repeat(250_000));
    }
    world.insert("main.nb", uses(3));
    assert_eq!(codes(&world), [Code::TooLarge]);
}

#[test]
#[cfg(unix)]
fn links_to_folders_do_not_multiply_files() {
    let bench = Bench::new();
    // Links to its own folder give each file any number of paths.
    for link in ["x", "y"] {
        std::os::unix::fs::symlink(".", bench.path().join(link)).unwrap();
    }
    for at in 0..40 {
        let next = at + 1;
        bench.file(format!("{at}.nb"), format!("use \"x/{next}.nb\"\nuse \"y/{next}.nb\"\n"));
    }
    bench.file("40.nb", "circuit f(a) -> (q) { q = a }");
    let ran = bench.run("check 0.nb");
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
}

#[test]
#[cfg(unix)]
fn what_is_in_other_files_is_not_shown() {
    let bench = Bench::with("shadow", "root:secret:1::::");
    std::os::unix::fs::symlink("shadow", bench.path().join("link.nb")).unwrap();
    for path in ["shadow", "link.nb"] {
        bench.file("user.nb", format!("use \"{path}\""));
        let ran = bench.run("check user.nb");
        ran.expect_fault(&["it is neither a program nor a circuit file"]);
        assert!(!ran.err.contains("secret"), "{}", ran.err);
    }
}

#[test]
fn hostile_files_are_rejected_within_a_second_and_a_gigabyte() {
    let bench = Bench::new();
    let rejected = |text: &[u8], code: Code| {
        bench.file("hostile.nb", text);
        refused_by(&bench, &["check", "hostile.nb"], code);
    };
    let deep = |open: &str, close: &str| circuit(&format!("q = {}a{}", open.repeat(10_000), close.repeat(10_000)));
    rejected(deep("if a then ", " else a").as_bytes(), Code::Nesting);
    rejected(deep("{2{", "}}").as_bytes(), Code::Nesting);
    rejected("for i in 0..2 {\n".repeat(10_000).as_bytes(), Code::Nesting);
    rejected(circuit("for i in 0..1000000 { for j in 0..1000000 { } }\n q = a").as_bytes(), Code::TooLarge);
    rejected(b"use \"hostile.nb\"\ncircuit f(a) -> (q) { q = a }", Code::CircularUse);
    rejected(b"circuit f(a) -> (q) { q = a }\n\xff\xfe", Code::Unreadable);
    rejected(&vec![b'\n'; 100_000_000], Code::Unreadable);
    rejected("circuit f(a) -> (q) { q = a }\n".repeat(3_500_000).as_bytes(), Code::Unreadable);
    rejected("(".repeat(8_000_000).as_bytes(), Code::Nesting);
    rejected("a ".repeat(4_000_000).as_bytes(), Code::TooLarge);
    rejected("a ".repeat(900_000).as_bytes(), Code::Syntax);
    rejected("}\n".repeat(4_000_000).as_bytes(), Code::TooLarge);
    rejected("\"".repeat(8_000_000).as_bytes(), Code::TooLarge);
    rejected(circuit(&format!("q = {}1", "1+".repeat(4_000_000))).as_bytes(), Code::TooLarge);
    rejected("// c\n".repeat(1_600_000).as_bytes(), Code::Empty);
    rejected("circuit f {\n".repeat(20_000).as_bytes(), Code::Syntax);
    let numbered = |line: &dyn Fn(usize) -> String| (0..10_000).map(line).collect::<String>();
    rejected(circuit(&("q = a\n".repeat(20_000))).as_bytes(), Code::MultipleDrivers);
    rejected(circuit(&numbered(&|i| format!("n{i} = nope{i} and a\n"))).as_bytes(), Code::Unknown);
    rejected(format!("test half_adder {{\n a b | s\n{}}}\n", " 0 - | 1\n".repeat(20_000)).as_bytes(), Code::Value);
    rejected(format!("stimulus s{}", numbered(&|i| format!(", t{i}"))).as_bytes(), Code::OutOfRange);
    let signs = bench.file("signs.nb", circuit(&format!("q = {}a", "~".repeat(20_000))));
    for command in ["check", "fmt", "build", "test", "run", "evolve"] {
        refused_by(&bench, &[command, signs.to_str().unwrap()], Code::Syntax);
    }
    refused_by(&bench, &["check", "/dev/zero"], Code::Unreadable);
    refused_by(&bench, &["check", "."], Code::Unreadable);
}

#[test]
fn long_tables_are_formatted_in_linear_time() {
    let bench = Bench::new();
    let rows = "    0 | 0\n".repeat(200_000);
    bench.file("rows.nb", format!("circuit f(a) -> (q) {{\n    q = a\n}}\n\ntest f {{\n    a | q\n{rows}}}\n"));
    let long = format!("\"{}\"", "x".repeat(130));
    let records: String = (0..10_000).map(|at| format!("library l{at} {{ from: {long} }}\n")).collect();
    bench.file("records.nb", records);
    for file in ["rows.nb", "records.nb"] {
        assert_eq!(bench.limited("ulimit -t 8", &["fmt", file]).status, 0, "{file}");
    }
}

#[test]
fn hostile_circuit_files_are_rejected_within_a_second_and_a_gigabyte() {
    let bench = Bench::new();
    let rejected = |name: &str, bytes: &[u8]| {
        bench.file(name, bytes);
        refused_by(&bench, &["synth", name, "--cells", "nand"], Code::CircuitFile);
    };
    // Each model instantiates the next one so often.
    let models = |depth: usize, times: usize| {
        let mut text = ".model m0\n.inputs x\n.outputs y\n.subckt m1 x=x y=y\n.end\n".to_owned();
        for at in 1..depth {
            let next = at + 1;
            text += &format!(".model m{at}\n.inputs x\n.outputs y\n.names x y\n1 1\n");
            (0..times).for_each(|copy| text += &format!(".subckt m{next} x=x y=t{copy}\n"));
        }
        text + &format!(".model m{depth}\n.inputs x\n.outputs y\n.names x y\n0 1\n.end\n")
    };
    rejected("double.blif", models(60, 2).as_bytes());
    rejected("deep.blif", models(20_000, 1).as_bytes());
    rejected("wide.aig", b"aig 99999999 99999999 0 0 0\n");
    rejected("wide.aig", b"aig 4000000 4000000 0 0 0\n");
    rejected("long.aag", b"aag 4000000 0 0 4000000 0\n");
    rejected("zero.blif", &[0; 1_000_000]);
    rejected("zero.bench", &[b'('; 1_000_000]);
    rejected("zero.pla", &[0; 1_000_000]);
    rejected("none.pla", b".i 99999999999999999999\n.o 1\n");
    let large = |text: String| {
        bench.file("large.pla", text);
        refused_by(&bench, &["synth", "large.pla", "--cells", "nand"], Code::TooLarge);
    };
    large(".i 99999999\n.o 1\n".to_owned());
    // Each output would copy every row: two megabytes of text, a billion pins.
    let row = format!("{} {}\n", "-".repeat(1_000), "1".repeat(1_000));
    large(format!(".i 1000\n.o 1000\n{}", row.repeat(1_000)));
}

#[test]
fn rows_of_very_many_bits_are_refused() {
    let bench = Bench::new();
    let large = |name: &str, text: String| {
        bench.file(name, text);
        refused_by(&bench, &["learn", name, "--hold-out", "0"], Code::TooLarge);
    };
    let number = |digits: usize| format!("a,q\n0x{},1\n0,0\n", "f".repeat(digits));
    large("long.csv", number(1_000_000));
    large("wide.csv", number(200_000));
    large("many.csv", format!("{}{}", number(200_000), "0,1\n".repeat(100)));
    let columns: String = (0..100_000).map(|bit| format!("x[{bit}],")).collect();
    large("columns.csv", format!("{columns}q\n{}1\n", "0,".repeat(100_000)));
    large("wide.pla", format!(".i 70000\n.o 1\n.type fr\n{} 1\n", "0".repeat(70_000)));
    large("both.pla", format!(".i 1000000\n.o 1000000\n.type fr\n{}\n", "0".repeat(2_000_000)));
}

#[test]
fn a_file_of_very_many_errors_has_few_diagnostics_and_their_number() {
    let nets: String = (0..5_000).map(|net| format!("    q{net} = missing{net}\n")).collect();
    let found = found(format!("circuit f(a) -> (q) {{\n    q = a\n{nets}}}\n"));
    assert_eq!(found.len(), 201);
    assert!(found.last().unwrap().message.starts_with("4800 more errors"), "{}", found.last().unwrap().message);
}
