//! The first steps with the program: its words on success, `new`, `watch`, standard input, interruptions, the tutorial
//! and the page for those who come from Verilog.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

use nbc_base::model::Instance;
use nbc_circuit::{Logic, NetId, Netlist, elaborate};
use nbc_session::store::DiskWorld;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::manual::{Fence, fences};

use crate::support::*;

const FINE: &str = "circuit f(a) -> (q) {\n    q = not a\n}\n\ntest f {\n    a | q\n    0 | 1\n    1 | 0\n}\n";

#[test]
fn a_program_without_errors_is_told_so() {
    let bench = Bench::with("fine.nb", FINE);
    bench.file("odd.nb", "circuit f(a, b) -> (q) { q = not a }\n");
    let ran = bench.run("check fine.nb odd.nb");
    assert_eq!((ran.status, ran.out.as_str()), (0, "fine.nb: no errors\nodd.nb: no errors, 1 warning\n"));
}

#[test]
fn standard_input_is_checked() {
    let bench = Bench::with("used.nb", FINE);
    let fine = bench.with_input("check -", "use \"used.nb\"\ncircuit g(a) -> (q) { q = f(a) }\n");
    assert_eq!((fine.status, &*fine.out, &*fine.err), (0, "<stdin>: no errors\n", ""));
    bench.with_input("check -", "circuit g(a) -> (q) { q = b }\n").expect_fault(&["[<stdin>:1:27]"]);
}

#[test]
fn new_writes_a_program_that_passes_and_overwrites_none() {
    let bench = Bench::new();
    let ran = bench.run("new adder");
    assert_eq!((ran.status, ran.out.as_str()), (0, "wrote adder.nb; `nbc test adder.nb` tests it\n"), "{}", ran.err);
    bench.ok("fmt --check adder.nb");
    let tested = bench.run("test adder.nb");
    assert_eq!(tested.out, "pass  adder \"adds\" (4 rows, physics)\n1 passed, 0 failed\n", "{}", tested.err);
    let json = bench.run("new other --format json");
    assert!(json.status == 2 && json.out.contains("a first program cannot be JSON"), "{}", json.out);
    assert!(!bench.has("other.nb"));
    bench.run("new adder.nb").expect_fault(&["`adder.nb` exists already", "choose another name"]);
    bench.run("new 2nd").expect_fault(&["no circuit can have the name of `2nd.nb`"]);
    bench.run("new nand").expect_fault(&["no circuit can have the name of `nand.nb`"]);
    bench.run("new nowhere/adder").expect_fault(&["nowhere/adder.nb"]);
}

#[test]
fn one_test_of_several_is_chosen_by_its_title_or_circuit() {
    let bench = Bench::new();
    let other = FINE.replace("f(", "g(").replace("test f", "test g \"other\"");
    bench.file("two.nb", format!("{FINE}\n{other}"));
    for (name, found) in
        [("other", "pass  g \"other\" (2 rows, logic)\n1 passed"), ("f", "pass  f (2 rows, logic)\n1 ")]
    {
        let ran = bench.run(&["test", "two.nb", "--logic", "--only", name]);
        assert!(ran.out.starts_with(found), "{}{}", ran.out, ran.err);
    }
    bench.run("test two.nb --only h").expect_fault(&["called `h`", "there are `f`, `g` and `other`"]);
}

#[test]
fn verdicts_are_colored_where_that_is_wanted() {
    let bench = Bench::with("fine.nb", FINE);
    let out = |arguments: &[&str]| bench.run(arguments).out;
    assert!(out(&["test", "fine.nb", "--logic", "--color", "always"]).starts_with("\u{1b}[32mpass\u{1b}[0m  f"));
    assert!(out(&["test", "fine.nb", "--logic"]).starts_with("pass  f"));
    bench.file("wrong.nb", FINE.replace("q = not a", "q = a"));
    let colored = out(&["test", "wrong.nb", "--logic", "--color", "always"]);
    assert!(colored.starts_with("\u{1b}[1;31mFAIL\u{1b}[0m  f"), "{colored:?}");
}

#[test]
fn the_citation_is_of_this_version() {
    let citation = text_of("CITATION.cff");
    let field = |name: &str| citation.lines().find_map(|line| line.strip_prefix(&format!("{name}: "))).unwrap();
    assert_eq!(
        (field("cff-version"), field("version"), field("type")),
        ("1.2.0", env!("CARGO_PKG_VERSION"), "software")
    );
    let readme = fences(&text_of("README.md"));
    let entry = &readme.iter().find(|fence| fence.words == ["bibtex"]).unwrap().text;
    let value = |name: &str| {
        let line = entry.lines().find(|line| line.trim().starts_with(name)).unwrap();
        line.split_once('{').unwrap().1.trim_end_matches(['}', ',']).trim_start_matches('{').to_owned()
    };
    assert_eq!(value("title"), field("title").trim_matches('"'));
    assert_eq!((value("version"), value("license")), (field("version").to_owned(), field("license").to_owned()));
    assert_eq!(value("year"), field("date-released")[..4]);
    assert!(citation.contains(&format!("  - name: {}", value("author"))), "{entry}");
}

struct Running {
    child: Child,
    _limit: Limit,
    lines: std::io::Lines<BufReader<std::process::ChildStdout>>,
}

impl Running {
    fn start(mut command: Command) -> Self {
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap()).lines();
        Self { _limit: Limit::of(&child), child, lines }
    }

    #[track_caller]
    fn expect(&mut self, line: &str) {
        assert_eq!(self.lines.next().map(Result::unwrap).as_deref(), Some(line));
    }

    /// Whether the program would notice Ctrl-C, by the signals that it catches.
    #[cfg(target_os = "linux")]
    fn watches_interrupts(&self) -> bool {
        const INT: u64 = 1 << 1;
        let about = fs::read_to_string(format!("/proc/{}/status", self.child.id())).unwrap();
        let caught = about.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
        u64::from_str_radix(caught.trim(), 16).unwrap() & INT != 0
    }

    /// Sends Ctrl-C; the exit status, the rest of standard output and all of standard error.
    #[cfg(unix)]
    fn interrupt(mut self) -> (Option<i32>, String, String) {
        signal("INT", self.child.id());
        let out = self.lines.map(|line| line.unwrap() + "\n").collect();
        let mut err = String::new();
        std::io::Read::read_to_string(&mut self.child.stderr.take().unwrap(), &mut err).unwrap();
        (self.child.wait().unwrap().code(), out, err)
    }
}

#[test]
#[cfg(unix)]
fn watch_checks_and_tests_again_when_a_file_or_one_that_it_uses_is_saved() {
    let bench = Bench::with("used.nb", FINE);
    bench.file("a.nb", "use \"used.nb\"\ncircuit g(a) -> (q) { q = f(a) }\ntest g {\n    a | q\n    0 | 1\n}\n");
    let mut watch = Running::start(bench.command("watch a.nb --logic"));
    // Saved in one step: a slow machine may pause within a write for longer than the program waits.
    let save = |name, text: &str| fs::rename(bench.file("new", text), bench.path().join(name)).unwrap();
    watch.expect("a.nb: no errors");
    watch.expect("pass  g (1 row, logic)");
    watch.expect("1 passed, 0 failed");
    save("used.nb", &FINE.replace("not a", "not not a"));
    watch.expect("a.nb: no errors");
    watch.expect("FAIL  g (1 row, logic)");
    watch.expect("    a.nb:5: row 1: a=0 | q=0, expected 1");
    watch.expect("0 passed, 1 failed");
    save("a.nb", "use \"used.nb\"\ncircuit g(a) -> (q) { q = h(a) }\n");
    watch.expect("a.nb: 1 error");
    save("used.nb", "circuit h(a) -> (q) { q = not a }\n");
    watch.expect("a.nb: no errors");
    let (status, out, err) = watch.interrupt();
    assert_eq!((status, out.as_str()), (Some(0), ""), "{err}");
    assert!(err.contains("watching 2 paths; Ctrl-C ends"), "{err}");
}

/// A test whose physics takes minutes, after one that takes no time.
const LONG: &str = "circuit f(a) -> (q) {\n    q = not a\n}\n\ntest f {\n    a | q\n    0 | 1 for 2 cycles\n}\n\n\
                    test f \"long\" {\n    a | q\n    0 | 1 for 900000 cycles\n}\n";

#[test]
#[cfg(unix)]
fn an_interrupted_test_says_what_was_done() {
    let bench = Bench::with("long.nb", LONG);
    let mut test = Running::start(bench.command("test long.nb"));
    test.expect("pass  f (1 row, physics)");
    let (status, out, err) = test.interrupt();
    assert_eq!((status, out.as_str()), (Some(4), "1 passed, 0 failed, 1 interrupted or not begun\n"), "{err}");
}

#[test]
#[cfg(target_os = "linux")]
fn an_interrupted_run_writes_what_is_complete() {
    let bench = Bench::with("long.nb", LONG);
    let run = Running::start(bench.command("run long.nb --no-report"));
    limits::until("the program watches no signals", || run.watches_interrupts());
    let (status, _, err) = run.interrupt();
    assert_eq!(status, Some(4), "{err}");
    assert!(err.contains(" of 2 tests and simulations complete"), "{err}");
}

fn execute(bench: &Bench, fence: &Fence) {
    for session in fence.text.split("$ nbc ").skip(1) {
        let (line, expected) = session.split_once('\n').unwrap();
        let ran = bench.run(line);
        let fails = fence.words.iter().any(|word| word == "fails");
        assert_eq!(ran.status != 0, fails, "{line}: {}{}", ran.out, ran.err);
        if !expected.is_empty() {
            assert_eq!(ran.out, expected, "{line}: {}", ran.err);
        }
    }
}

/// Writes the files of a page and runs its commands, in their order; the number of commands.
fn execute_page(bench: &Bench, page: &str) -> usize {
    let fences = fences(&text_of(page));
    let mut commands = 0;
    for fence in &fences {
        let file = fence.words.iter().find_map(|word| word.strip_prefix("file="));
        match (fence.words[0].as_str(), file) {
            ("console", None) => {
                execute(bench, fence);
                commands += fence.text.matches("$ nbc ").count();
            }
            (_, Some(name)) => _ = bench.file(name, &fence.text),
            (word, None) => panic!("{word} is neither a file nor a command"),
        }
        if let Some(name) = file.filter(|name| name.ends_with(".nb")) {
            bench.ok(&["fmt", "--check", name]);
        }
    }
    commands
}

#[test]
fn every_step_of_the_tutorial_runs() {
    let bench = Bench::new();
    let commands = execute_page(&bench, "docs/tutorial.md");
    assert!(commands > 12, "{commands} commands");
    assert!(bench.has("out/ring/report.html"));
}

#[test]
#[cfg(feature = "play")]
fn every_task_of_how_do_i_runs() {
    let bench = Bench::new();
    let commands = execute_page(&bench, "docs/how-do-i.md");
    assert!(commands > 12, "{commands} commands");
    for file in ["maj.nb", "vote.svg", "nand.png", "vote.html", "robots.csv"] {
        assert!(bench.has(file), "{file}");
    }
    let page = text_of("docs/how-do-i.md");
    assert_eq!(page.lines().filter(|line| line.starts_with("## ")).count(), 10, "ten tasks");
}

#[test]
fn a_property_is_written_proved_broken_and_repaired() {
    let commands = execute_page(&Bench::new(), "docs/always.md");
    assert_eq!(commands, 7);
}

#[test]
fn each_pair_of_the_page_for_verilog_computes_the_same() {
    let Some(_) = SLANG.find() else { return };
    let fences = fences(&text_of("docs/from-verilog.md"));
    let fences: Vec<Fence> = fences.into_iter().filter(|fence| fence.words.len() == 1).collect();
    let pairs: Vec<_> = fences.chunk_by(|a, _| a.words == ["verilog"]).filter(|pair| pair.len() == 2).collect();
    assert_eq!(pairs.len(), 9);
    let bench = Bench::with("theirs.v", pairs.iter().map(|pair| &*pair[0].text).collect::<String>());
    bench.file("theirs.nb", "use \"theirs.v\"\n");
    let mut session = nbc::Session::new(DiskWorld);
    let mut program = |file: &str| {
        let checked = session.checked(bench.path().join(file).to_str().unwrap());
        assert!(!checked.has_errors(), "{file}: {:?}", checked.diagnostics);
        checked
    };
    let theirs = program("theirs.nb");
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for (at, pair) in pairs.iter().enumerate() {
        let name = pair[0].text.split(['(', ' ', '#']).nth(1).unwrap();
        let file = format!("ours{at}.nb");
        bench.file(&file, &pair[1].text);
        let both = [&theirs, &program(&file)].map(|it| elaborate(&it.program, &Instance::from(name)).unwrap());
        let names =
            |netlist: &Netlist, ports: &[NetId]| ports.iter().map(|&id| netlist.net_name(id)).collect::<Vec<_>>();
        let inputs = both.each_ref().map(|netlist| names(netlist, netlist.inputs()));
        assert_eq!(BTreeSet::from_iter(&inputs[0]), BTreeSet::from_iter(&inputs[1]), "{name}");
        let mut values: BTreeMap<&String, bool> = inputs[0].iter().map(|input| (input, false)).collect();
        let mut logic = both.each_ref().map(Logic::new);
        for step in 0..400 {
            if step > 0 {
                *values.get_mut(&inputs[0][random.random_range(0..inputs[0].len())]).unwrap() ^= true;
            }
            let outputs = [0, 1].map(|i| {
                let shown = logic[i].settle(&inputs[i].iter().map(|input| values[input]).collect::<Vec<_>>()).unwrap();
                names(&both[i], both[i].outputs()).into_iter().zip(shown).collect::<BTreeMap<_, _>>()
            });
            assert_eq!(outputs[0], outputs[1], "{name} at {values:?}");
        }
    }
}
