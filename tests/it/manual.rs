//! Executes every example of the manual and of the error pages. The message of each failing example is recorded in
//! `tests/ui/pages`; `NBC_UPDATE_UI=1 cargo test --test it manual` rewrites the records.

use nbc_base::diag::{Code, Diagnostic, Severity, render};
use nbc_base::source::{MemoryWorld, Sources};
use nbc_lang::check;
use nbc_session::Session;

use crate::support::*;

pub struct Fence {
    pub words: Vec<String>,
    pub text: String,
}

pub fn fences(page: &str) -> Vec<Fence> {
    let mut fences = Vec::new();
    let mut open: Option<Fence> = None;
    for line in page.lines() {
        match (line.strip_prefix("```"), &mut open) {
            (Some(_), Some(_)) => fences.extend(open.take()),
            (Some(words), None) => {
                let words = words.split_whitespace().map(str::to_owned).collect();
                open = Some(Fence { words, text: String::new() });
            }
            (None, Some(fence)) => fence.text += &format!("{line}\n"),
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "every fence is closed");
    fences
}

fn said(text: &str) -> (Vec<Diagnostic>, String) {
    let mut world = MemoryWorld::default();
    world.insert("main.nb", text);
    let mut sources = Sources::default();
    let file = check::open(&world, "main.nb", &mut sources).unwrap();
    let diagnostics = check::check(&world, &mut sources, file).diagnostics;
    let text = render::text(&diagnostics, &sources, false);
    (diagnostics, text)
}

fn run_command(bench: &Bench, fence: &Fence, code: Code) -> String {
    let line = fence.text.trim().strip_prefix("$ nbc ").expect("a command of the program");
    let ran = bench.run(line);
    if fence.words.contains(&"fails".to_owned()) {
        assert_eq!(ran.status == 2, code.severity() == Severity::Error, "{line}: {}{}", ran.out, ran.err);
        assert!(ran.err.contains(&format!("[{code}]: ")), "{line} says `{code}`: {}", ran.err);
    } else {
        assert_eq!((ran.status, ran.err.contains(&format!("[{code}]"))), (0, false), "{line}: {}{}", ran.out, ran.err);
    }
    ran.err
}

fn check_page(code: Code) -> String {
    let bench = Bench::new();
    let fences = fences(&text_of(format!("docs/errors/{code}.md")));
    let (mut failing, mut mended) = (Vec::new(), 0);
    for fence in &fences {
        let fails = fence.words.contains(&"fails".to_owned());
        let said = match fence.words[0].as_str() {
            "file" => {
                bench.file(&fence.words[1], &fence.text);
                continue;
            }
            "console" => run_command(&bench, fence, code),
            _ => {
                let (diagnostics, text) = said(&fence.text);
                let here = diagnostics.iter().any(|diagnostic| diagnostic.code == code);
                assert!(if fails { here } else { diagnostics.is_empty() }, "`{code}`: {text}");
                text
            }
        };
        if fails { failing.push(said) } else { mended += 1 }
    }
    assert!(failing.len() == 1 && mended == 1, "the page of `{code}` has a failing and a mended example");
    failing.remove(0)
}

#[test]
fn every_error_page_has_a_failing_and_a_corrected_example() {
    let recorded = |code| root().join(format!("tests/ui/pages/{code}.stderr"));
    let mut differing = Vec::new();
    for code in Code::ALL {
        let said = check_page(*code);
        if std::env::var_os("NBC_UPDATE_UI").is_some() {
            fs::write(recorded(code), &said).unwrap();
        } else if fs::read_to_string(recorded(code)).unwrap_or_default() != said {
            differing.push(format!("tests/ui/pages/{code}.stderr\n{said}"));
        }
    }
    assert!(differing.is_empty(), "messages differ from what is recorded:\n{}", differing.join("\n"));
}

#[test]
fn every_example_of_the_manual_runs() {
    let [majority, votes, hello] = [("blif", 0), ("csv", 0), ("csv", 1)].map(|(word, at)| {
        let shown = fences(&text_of("docs/language.md")).into_iter().filter(|fence| fence.words == [word]).nth(at);
        shown.expect("the manual shows the files that examples use").text
    });
    let pages =
        ["docs/language.md", "grammar/README.md", "docs/computer.md", "docs/evolution.md", "docs/robustness.md"];
    for (path, least) in pages.into_iter().zip([6, 6, 1, 1, 1]) {
        let examples: Vec<_> = fences(&text_of(path)).into_iter().filter(|fence| fence.words == ["nb"]).collect();
        assert!(examples.len() >= least, "{path} has examples");
        for example in examples {
            let mut sources = Sources::default();
            let file = sources.add("main.nb", example.text.as_str());
            let mut world = MemoryWorld::default();
            world.insert("adders.nb", text_of("circuits/full_adder.nb"));
            world.insert("digits.csv", text_of("library/seeing/digits.csv"));
            world.insert("computer.nb", text_of("circuits/computer.nb"));
            world.insert("circuits/counter.nb", text_of("circuits/counter.nb"));
            world.insert("majority.blif", majority.as_str());
            world.insert("votes.csv", votes.as_str());
            world.insert("hello.csv", hello.as_str());
            world.insert("main.nb", example.text);
            let checked = check::check(&world, &mut sources, file);
            let text = render::text(&checked.diagnostics, &sources, false);
            assert!(checked.diagnostics.is_empty(), "{path}:\n{}\n{text}", sources.file(file).text);
            for test in &checked.program.tests {
                passes(&checked.program, test);
            }
            performs(&mut Session::new(world), "main.nb");
        }
    }
}
