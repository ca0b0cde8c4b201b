//! A limit of the diagnostics of a file, after which one more says how many there are. Every door shows what
//! [`crate::check::check`] returns, so the limit is here.

use std::collections::BTreeMap;

use crate::check::wording;
use nbc_base::diag::{Diagnostic, Severity};
use nbc_base::source::{FileId, Sources, Span};

pub(crate) const MOST: usize = 200;

/// Keeps the first diagnostics of each file, all errors before any warning, and counts the others.
pub(crate) fn limit(diagnostics: Vec<Diagnostic>, sources: &Sources) -> Vec<Diagnostic> {
    let mut counts: BTreeMap<Option<FileId>, Count> = BTreeMap::new();
    for diagnostic in &diagnostics {
        let count = counts.entry(file(diagnostic)).or_default();
        *(if diagnostic.is_error() { &mut count.errors } else { &mut count.warnings }) += 1;
    }
    if counts.values().all(|count| count.errors + count.warnings <= MOST) {
        return diagnostics;
    }
    let mut kept = Vec::new();
    let mut left: BTreeMap<Option<FileId>, Count> = counts.iter().map(|(&file, count)| (file, count.shown())).collect();
    let mut more: BTreeMap<FileId, Span> = BTreeMap::new();
    for diagnostic in diagnostics {
        let left = left.get_mut(&file(&diagnostic)).expect("the file was counted");
        let left = if diagnostic.is_error() { &mut left.errors } else { &mut left.warnings };
        match diagnostic.labels.first() {
            _ if *left > 0 => {
                *left -= 1;
                kept.push(diagnostic);
            }
            Some(label) => _ = more.entry(label.span.file).or_insert(label.span),
            None => {}
        }
    }
    for (file, place) in more {
        let (all, shown) = (counts[&Some(file)], counts[&Some(file)].shown());
        let [errors, warnings] = [all.errors - shown.errors, all.warnings - shown.warnings];
        let severity = if errors > 0 { Severity::Error } else { Severity::Warning };
        let error = wording::more_faults(&sources.file(file).name, errors, warnings, place);
        kept.push(Diagnostic { severity, ..error });
    }
    kept
}

fn file(diagnostic: &Diagnostic) -> Option<FileId> {
    diagnostic.labels.first().map(|label| label.span.file)
}

#[derive(Clone, Copy, Debug, Default)]
struct Count {
    errors: usize,
    warnings: usize,
}

impl Count {
    fn shown(self) -> Self {
        let errors = self.errors.min(MOST);
        Self { errors, warnings: self.warnings.min(MOST - errors) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::diag::Code;

    #[test]
    fn errors_are_kept_before_warnings_and_the_others_are_counted() {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", " ".repeat(1000));
        let at = |code, place| Diagnostic::new(code, "message", Span::new(file, place, place + 1), "label");
        let found = |warnings: usize, errors: usize| {
            let warnings = (0..warnings).map(|place| at(Code::Unused, place));
            let all = warnings.chain((0..errors).map(|place| at(Code::Syntax, 500 + place))).collect();
            let found = limit(all, &sources);
            let errors = found.iter().filter(|found| found.is_error()).count();
            (found.len(), errors, found.last().unwrap().message.clone())
        };
        assert_eq!(found(150, 50), (200, 50, "message".to_owned()));
        assert_eq!(found(250, 1), (201, 1, "51 more warnings in `a.nb` are not shown".to_owned()));
        assert_eq!(
            found(10, 300),
            (201, 201, "100 more errors and 10 more warnings in `a.nb` are not shown".to_owned())
        );
        assert_eq!(found(0, 201).2, "1 more error in `a.nb` is not shown");
    }
}
