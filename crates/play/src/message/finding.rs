//! Diagnostics with their places as lines and columns.

use serde::Serialize;
#[cfg(test)]
use ts_rs::TS;

use nbc_base::diag::{Diagnostic, Label, Severity};
use nbc_base::source::Sources;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct Finding {
    code: String,
    #[cfg_attr(test, ts(type = "\"error\" | \"warning\""))]
    severity: Severity,
    message: String,
    help: Option<String>,
    /// The main one first.
    labels: Vec<FindingLabel>,
    /// Notes at other places.
    related: Vec<FindingLabel>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct FindingLabel {
    file: String,
    start: TextPlace,
    end: TextPlace,
    text: String,
}

/// A place in a text: its byte from 0, its line and column from 1.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct TextPlace {
    byte: u32,
    line: usize,
    column: usize,
}

pub(crate) fn findings(diagnostics: &[Diagnostic], sources: &Sources) -> Vec<Finding> {
    let labels = |labels: &[Label]| labels.iter().map(|one| label(one, sources)).collect();
    let finding = |one: &Diagnostic| Finding {
        code: one.code.to_string(),
        severity: one.severity,
        message: one.message.clone(),
        help: one.help.clone(),
        labels: labels(&one.labels),
        related: labels(&one.related),
    };
    diagnostics.iter().map(finding).collect()
}

fn label(label: &Label, sources: &Sources) -> FindingLabel {
    let file = sources.file(label.span.file);
    let place = |byte: u32| {
        let at = file.line_column(byte as usize);
        TextPlace { byte, line: at.line, column: at.column }
    };
    FindingLabel {
        file: file.name.clone(),
        start: place(label.span.start),
        end: place(label.span.end),
        text: label.text.clone(),
    }
}
