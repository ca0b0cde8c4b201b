//! Input that means harm: a clear message, bounded work, never a panic.

use nbc::check;
use nbc::diag::{Code, Diagnostic, render};
use nbc::source::{MemoryWorld, Sources};

fn found(text: String) -> Vec<Diagnostic> {
    let mut sources = Sources::default();
    let file = sources.add("a.nb", text);
    let diagnostics = check::check(&MemoryWorld::default(), &mut sources, file).diagnostics;
    let shown = render::text(&diagnostics, &sources, false);
    assert!(shown.len() < 100_000, "messages stay short: {} bytes", shown.len());
    diagnostics
}

/// The text is refused with this code.
fn refused(text: impl Into<String>, code: Code) {
    let diagnostics = found(text.into());
    assert!(diagnostics.iter().any(|diagnostic| diagnostic.code == code), "{code} is not among {diagnostics:.500?}");
}

fn circuit(line: &str) -> String {
    format!("circuit f(a) -> (q) {{\n    {line}\n}}\n")
}

#[test]
fn nesting_is_bounded() {
    let deep = 10_000;
    refused(circuit(&format!("q = {}a{}", "(".repeat(deep), ")".repeat(deep))), Code::Nesting);
    refused(circuit(&format!("q = {}a{}", "nand(a, ".repeat(deep), ")".repeat(deep))), Code::Nesting);
    refused(circuit(&format!("q = {}a{}", "{".repeat(deep), "}".repeat(deep))), Code::Nesting);
    refused(format!("{}{}", circuit("q = a"), "[".repeat(deep)), Code::Nesting);
    refused(format!("material m {{ kind: {}{} }}", "[".repeat(deep), "]".repeat(deep)), Code::Nesting);
}

#[test]
fn long_chains_are_no_nesting() {
    let long = 10_000;
    assert_eq!(found(circuit(&format!("q = {}a", "not ".repeat(long)))), []);
    assert_eq!(found(circuit(&format!("q = a{}", " and a".repeat(long)))), []);
    let sum = format!("{}1", "0 + ".repeat(long));
    assert_eq!(found(format!("circuit f(a[{sum}]) -> (q) {{ q = a }}")), []);
}

#[test]
fn nested_choices_are_parsed_or_refused() {
    for depth in [10, 100] {
        let text = circuit(&format!("q = {}a{}", "if a then ".repeat(depth), " else a".repeat(depth)));
        assert_eq!(found(text), [], "{depth} deep");
    }
    refused(circuit(&format!("q = {}a{}", "if a then ".repeat(100_000), " else a".repeat(100_000))), Code::Nesting);
    assert_eq!(found(circuit(&format!("q = {}a", "if a then a else ".repeat(10_000)))), []);
}

#[test]
fn sizes_are_bounded() {
    refused("circuit f(a[8000000000]) -> (q) { q = any(a) }", Code::OutOfRange);
    refused("circuit f(a[1000000000]) -> (q) { q = any(a) }", Code::OutOfRange);
    refused("circuit f(a[0]) -> (q) { q = 0 }", Code::OutOfRange);
    refused("circuit f(a[2 ** 62 * 4]) -> (q) { q = 0 }", Code::OutOfRange);
    refused("circuit f(a[1 / 0]) -> (q) { q = 0 }", Code::OutOfRange);
    refused(circuit("q = any({1000000000{a}})"), Code::OutOfRange);
    refused(circuit("for i in 0..1000000 { _ = a }\n q = a"), Code::TooLarge);
    refused(circuit("for i in 0..4000000000 { }\n q = a"), Code::TooLarge);
    refused(circuit("for i in 0..1000 { for j in 0..1000 { _ = a } }\n q = a"), Code::TooLarge);
    refused(circuit("for i in 0..400000 { net t[1000]\n for j in 0..1000 { t[j] = a } }\n q = a"), Code::TooLarge);
}

#[test]
fn hierarchies_that_double_at_each_step_are_counted_not_built() {
    let mut text = "circuit c0(a) -> (q) { q = not a }\n".to_owned();
    for level in 1..60 {
        text += &format!("circuit c{level}(a) -> (q) {{ q = c{0}(c{0}(a)) }}\n", level - 1);
    }
    refused(text, Code::TooLarge);
}

#[test]
fn long_chains_of_circuits_are_refused() {
    let mut text = String::new();
    for level in (1..5_000).rev() {
        text += &format!("circuit c{level}(a) -> (q) {{ q = c{}(a) }}\n", level - 1);
    }
    text += "circuit c0(a) -> (q) { q = not a }\n";
    refused(text, Code::Nesting);
}

#[test]
fn a_long_line_and_a_long_file_are_refused() {
    refused("a".repeat(10_000_000), Code::Unreadable);
    refused("a".repeat(7_000_000), Code::Syntax);
    refused("(".repeat(1_000_000), Code::Nesting);
    refused("circuit f(a) -> (q) { q = a }\0", Code::Unreadable);
    refused("", Code::Empty);
    refused("\u{feff}circuit f(a) -> (q) { q = a }", Code::Syntax);
}

#[test]
fn a_circle_of_many_files_is_refused() {
    let mut world = MemoryWorld::default();
    for at in 0..200 {
        world.insert(format!("{at}.nb"), format!("use \"{}.nb\"\ncircuit c{at}(a) -> (q) {{ q = a }}", (at + 1) % 200));
    }
    let mut sources = Sources::default();
    let file = check::open(&world, "0.nb", &mut sources).unwrap();
    let diagnostics = check::check(&world, &mut sources, file).diagnostics;
    assert!(diagnostics.iter().any(|diagnostic| diagnostic.code == Code::Nesting), "{diagnostics:?}");
}
