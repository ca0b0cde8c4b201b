//! Messages: each program of `tests/ui` with its exact diagnostics beside it as `.stderr`.
//!
//! `NBC_UPDATE_UI=1 cargo test --test it ui` rewrites the records; read the diff before you commit it.

use nbc_base::diag::{Code, Diagnostic, Severity, render};
use nbc_base::source::{MemoryWorld, OverlayWorld, Sources};
use nbc_lang::check;
use nbc_session::store::DiskWorld;

use crate::support::*;

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
    let (mut offered, mut worse) = (0, Vec::new());
    for path in programs("tests/ui") {
        let mut sources = Sources::default();
        let Ok(file) = check::open(&DiskWorld, &name(&path), &mut sources) else { continue };
        let faults = check::check(&DiskWorld, &mut sources, file).diagnostics;
        for fault in faults.iter().filter(|fault| fault.labels.first().is_some_and(|label| label.span.file == file)) {
            let is_certain = fault.help.as_ref().is_some_and(|help| help.starts_with("did you mean"));
            assert!(fault.fix.is_some() || !is_certain, "{}: `{}` has no fix", path.display(), fault.message);
            let Some(fix) = &fault.fix else { continue };
            let fixed = fix.apply(file, &sources.file(file).text);
            let mut world = OverlayWorld::new(DiskWorld);
            world.insert(&name(&path), fixed.as_str());
            let mut sources = Sources::default();
            let file = check::open(&world, &name(&path), &mut sources).unwrap();
            let left = check::check(&world, &mut sources, file).diagnostics;
            let is_left =
                left.iter().any(|left| left.labels.first() == fault.labels.first() && left.message == fault.message);
            assert!(!is_left, "{}: `{}` is left after `{}`:\n{fixed}", path.display(), fault.message, fix.title);
            let known: Vec<&str> = faults.iter().map(|fault| fault.message.as_str()).collect();
            let new = left.iter().filter(|left| !known.contains(&left.message.as_str()));
            let path = path.display();
            worse.extend(new.map(|new| format!("{path}: `{}` after `{}`:\n{fixed}", new.message, fix.title)));
            offered += 1;
        }
    }
    assert!(worse.is_empty(), "{}", worse.join("\n\n"));
    assert!(offered > 30, "{offered} fixes were tried");
}

#[test]
fn programs_whose_errors_all_have_a_fix_are_right_after_them() {
    let (mut mended, mut left) = (0, Vec::new());
    for path in programs("tests/ui") {
        let mut text = fs::read_to_string(&path).unwrap_or_default();
        let mut had_fixes = true;
        for round in 0..200 {
            let (mut world, mut sources) = (MemoryWorld::default(), Sources::default());
            world.insert("fixed.nb", text.as_str());
            let Ok(file) = check::open(&world, "fixed.nb", &mut sources) else { break };
            let mut errors = check::check(&world, &mut sources, file).diagnostics;
            errors.retain(|diagnostic| diagnostic.severity == Severity::Error);
            had_fixes &= round > 0 || errors.iter().all(|error| error.fix.is_some());
            if !had_fixes || errors.is_empty() {
                mended += usize::from(had_fixes && round > 0);
                break;
            }
            let fix = errors.iter().find_map(|error| error.fix.as_ref());
            let Some(fix) = fix else {
                let messages: Vec<&str> = errors.iter().map(|error| error.message.as_str()).collect();
                left.push(format!("{}: {messages:?}:\n{text}", path.display()));
                break;
            };
            text = fix.apply(file, &text);
        }
    }
    assert!(left.is_empty(), "{}", left.join("\n\n"));
    assert!(mended > 7, "{mended} programs were mended");
}
