//! The laws of the formatter: formatting twice changes nothing, comments are kept, the meaning stays.

use nbc_base::source::{MemoryWorld, Sources};
use nbc_circuit::elaborate;
use nbc_lang::check;
use nbc_lang::syntax;
use proptest::prelude::*;

use crate::support::random_program::random_program;
use crate::support::*;

fn formatted(text: &str) -> String {
    let mut sources = Sources::default();
    let file = sources.add("a.nb", text);
    let parsed = syntax::parse(&sources, file);
    assert_eq!(parsed.errors, [], "{text}");
    syntax::format(&sources, file, &parsed.tree)
}

/// The tokens and comments of a text without its layout: no spaces, and no commas, which line breaks may replace.
fn words(text: &str) -> (String, Vec<String>) {
    let (mut words, mut comments) = (String::new(), Vec::new());
    for line in text.lines() {
        let (code, comment) = line.split_at(line.find("//").unwrap_or(line.len()));
        words.extend(code.chars().filter(|c| !c.is_whitespace() && *c != ','));
        comments.extend(Some(comment.trim_end().to_owned()).filter(|comment| !comment.is_empty()));
    }
    (words, comments)
}

fn check_laws(text: &str) {
    let once = formatted(text);
    assert_eq!(words(&once), words(text), "words and comments stay:\n{text}\n{once}");
    assert_eq!(formatted(&once), once, "twice is once:\n{text}");
}

#[test]
fn a_long_list_of_used_files_has_a_line_for_each() {
    assert_eq!(formatted("use  \"a.v\" ,\n \"b.v\""), "use \"a.v\", \"b.v\"\n");
    let (one, two) = ("long/".repeat(10), "folders/".repeat(6));
    let text = format!("use \"{one}a.v\",\n    \"{two}b.v\"\n");
    assert_eq!(formatted(&text), text);
    check_laws(&text.replace("\n    ", ""));
}

#[test]
fn every_program_of_the_repository_is_formatted() {
    let update = std::env::var_os("NBC_UPDATE_UI").is_some();
    for path in programs("circuits").into_iter().chain(programs("library")) {
        let text = fs::read_to_string(&path).unwrap();
        check_laws(&text);
        let once = formatted(&text);
        if update {
            fs::write(&path, once).unwrap();
        } else {
            assert_eq!(once, text, "{}: `nbc fmt` writes it otherwise", path.display());
        }
    }
}

#[test]
fn the_laws_hold_for_every_program_that_can_be_parsed() {
    let mut seen = 0;
    for path in programs("tests/ui").into_iter().chain(programs("tests/ui/used")) {
        let mut sources = Sources::default();
        // Some of them are not text; that is their error.
        let Ok(text) = fs::read_to_string(&path) else { continue };
        let file = sources.add("a.nb", text.clone());
        if syntax::parse(&sources, file).errors.is_empty() {
            check_laws(&text);
            seen += 1;
        }
    }
    assert!(seen > 20, "{seen} programs could be parsed");
}

fn netlist(text: &str) -> String {
    elaborate(&session_of(text).1.program, &"main".into()).unwrap().to_string()
}

fn check_random_programs(seeds: std::ops::Range<u64>) {
    for seed in seeds {
        let text = random_program(seed);
        let once = formatted(&text);
        let [before, after] = [&text, &once].map(|text| {
            let (words, mut comments) = words(text);
            // One inside an expression is printed before its statement.
            comments.sort_unstable();
            (words, comments, netlist(text))
        });
        assert_eq!(after, before, "program {seed}:\n{text}\n{once}");
        assert_eq!(formatted(&once), once, "program {seed}, twice is once:\n{text}");
    }
}

#[test]
fn a_formatted_program_checks_and_means_the_same() {
    check_random_programs(0..60);
}

/// `cargo test --test it two_thousand -- --ignored`
#[test]
#[ignore = "takes a minute"]
fn two_thousand_formatted_programs_check_and_mean_the_same() {
    check_random_programs(60..2_060);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text_is_parsed_without_a_panic(text in "(?s).{0,200}") {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", text);
        check::check(&MemoryWorld::default(), &mut sources, file);
    }

    #[test]
    fn any_words_of_the_language_are_parsed_without_a_panic(
        words in prop::collection::vec(prop::sample::select([WORDS, LINES].concat()), 0..60),
    ) {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", words.join(" "));
        let parsed = syntax::parse(&sources, file);
        if parsed.errors.is_empty() {
            check_laws(&sources.file(file).text);
        }
        check::check(&MemoryWorld::default(), &mut sources, file);
    }
}

const WORDS: &[&str] = &[
    "f", "(", "a", ",", "b", ")", "->", "{", "}", "=", "nand", "not", "q", "\n", "[", "4", "]", "..", "init", "0", "1",
    "|", "-", "^", "for", "all", "inputs", "if", "then", "else", "table", ":", "'", "4'd3", "kind", "rigid", "10",
    "cycles", "s1", "+", "==", "in", "net", "// c\n", "\"t\"", "**", "log2", "x", "add", "latch", "\ntest", "\nuse",
    "\nswarm",
];
const LINES: &[&str] =
    &["\ncircuit", "\nmaterial", "\nschedule", "circuit f(a) -> (q) { q = a }", "\n\ntest f { a | q\n 0 | 1\n}"];
