//! Messages: each program of `tests/ui` with its exact diagnostics beside it as `.stderr`.
//!
//! `NBC_UPDATE_UI=1 cargo test --test it ui` rewrites the records; read the diff before you commit it.

use std::fs;
use std::path::Path;

use nbc_base::diag::{Code, Diagnostic, render};
use nbc_base::source::{MemoryWorld, Sources};
use nbc_lang::check;
use nbc_session::store::DiskWorld;

use crate::language::{programs, root};

/// The diagnostics of a file of the repository, by its path from the root.
fn found(path: &str) -> (Vec<Diagnostic>, String) {
    let mut sources = Sources::default();
    let diagnostics = match check::open(&DiskWorld, path, &mut sources) {
        Ok(file) => check::check(&DiskWorld, &mut sources, file).diagnostics,
        Err(fault) => vec![fault],
    };
    let text = render::text(&diagnostics, &sources, false);
    (diagnostics, text)
}

fn name(path: &Path) -> String {
    format!("tests/ui/{}", path.file_name().unwrap().to_str().unwrap())
}

#[test]
fn every_message_matches_its_record() {
    let update = std::env::var_os("NBC_UPDATE_UI").is_some();
    let mut differing = Vec::new();
    for path in programs("tests/ui") {
        let (_, said) = found(&name(&path));
        assert!(!said.is_empty(), "{} has faults", path.display());
        let recorded = path.with_extension("stderr");
        if update {
            fs::write(&recorded, &said).unwrap();
        } else if fs::read_to_string(&recorded).unwrap_or_default() != said {
            differing.push(format!("{}\n{said}", recorded.display()));
        }
    }
    assert!(differing.is_empty(), "messages differ from what is recorded:\n{}", differing.join("\n"));
}

#[test]
fn every_code_has_a_program_and_its_message() {
    for code in Code::ALL {
        // Codes of the command line and of other files have their program and their message on their page.
        let own = format!("tests/ui/{code}.nb");
        let (page, said) = (format!("tests/ui/pages/{code}.stderr"), root().join(&own).is_file().then(|| found(&own)));
        assert!(root().join(&page).is_file(), "`{code}` has its message in {page}");
        if let Some((diagnostics, said)) = said {
            let here = diagnostics.iter().any(|diagnostic| diagnostic.code == *code);
            assert!(here, "`{code}` is not said of its program:\n{said}");
        }
    }
}

#[test]
fn messages_follow_the_style() {
    for path in programs("tests/ui") {
        for diagnostic in found(&name(&path)).0 {
            let help = diagnostic.help.iter();
            let title = diagnostic.fix.iter().map(|fix| &fix.title);
            let labels = diagnostic.labels.iter().chain(&diagnostic.related).map(|label| &label.text);
            let texts = labels.chain(help).chain(title);
            for text in texts.chain([&diagnostic.message]) {
                assert!(!text.ends_with('.') && !text.is_empty(), "{text:?} ends without a full stop");
                assert!(!text.starts_with(char::is_uppercase), "{text:?} begins in lower case");
            }
        }
    }
}

#[test]
fn every_fix_removes_its_error() {
    let mut offered = 0;
    for path in programs("tests/ui") {
        let mut sources = Sources::default();
        let Ok(file) = check::open(&DiskWorld, &name(&path), &mut sources) else { continue };
        let faults = check::check(&DiskWorld, &mut sources, file).diagnostics;
        for fault in faults.iter().filter(|fault| fault.labels.first().is_some_and(|label| label.span.file == file)) {
            let is_certain = fault.help.as_ref().is_some_and(|help| help.starts_with("did you mean"));
            assert!(fault.fix.is_some() || !is_certain, "{}: `{}` has no fix", path.display(), fault.message);
            let Some(fix) = &fault.fix else { continue };
            let fixed = fix.apply(file, &sources.file(file).text);
            let mut world = MemoryWorld::default();
            world.insert("fixed.nb", fixed.as_str());
            let mut sources = Sources::default();
            let file = check::open(&world, "fixed.nb", &mut sources).unwrap();
            let left = check::check(&world, &mut sources, file).diagnostics;
            let is_left =
                left.iter().any(|left| left.labels.first() == fault.labels.first() && left.message == fault.message);
            assert!(!is_left, "{}: `{}` is left after `{}`:\n{fixed}", path.display(), fault.message, fix.title);
            offered += 1;
        }
    }
    assert!(offered > 30, "{offered} fixes were tried");
}
