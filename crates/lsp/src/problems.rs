//! Diagnostics, and the fixes that they offer.

use std::collections::BTreeMap;

use gen_lsp_types::{
    CodeAction, CodeActionKind, CodeActionResponse, CodeDescription, Diagnostic as Problem,
    DiagnosticRelatedInformation, DiagnosticSeverity, DiagnosticTag, Range, TextEdit, Uri, WorkspaceEdit,
};

use crate::files::Files;
use nbc_base::diag::{Code, Diagnostic, Fix, Severity};
use nbc_lang::check::{NameKind, NameUse};

pub(super) fn by_file(files: &Files<'_>) -> BTreeMap<String, (Uri, Vec<Problem>)> {
    let mut found: BTreeMap<String, (Uri, Vec<Problem>)> = BTreeMap::new();
    for diagnostic in &files.checked.diagnostics {
        let uri = diagnostic.labels.first().map_or_else(|| files.own(), |label| files.uri(label.span.file));
        found.entry(uri.to_string()).or_insert_with(|| (uri, Vec::new())).1.push(problem(files, diagnostic));
    }
    found
}

fn problem(files: &Files<'_>, diagnostic: &Diagnostic) -> Problem {
    let place = diagnostic.labels.first().map_or_else(Range::default, |label| files.range(label.span));
    let mut message = diagnostic.message.clone();
    if let Some(label) = diagnostic.labels.first().filter(|label| !label.text.is_empty()) {
        message.push_str(&format!("\n{}", label.text));
    }
    if let Some(help) = &diagnostic.help {
        message.push_str(&format!("\nhelp: {help}"));
    }
    let related = diagnostic.labels.iter().skip(1).chain(&diagnostic.related);
    let related: Vec<_> = related
        .map(|label| DiagnosticRelatedInformation {
            location: files.location(label.span),
            message: if label.text.is_empty() { "here".to_owned() } else { label.text.clone() },
        })
        .collect();
    let page = files.readable(&format!("{}.md", diagnostic.code.word()), nbc_session::error_page(diagnostic.code));
    Problem {
        severity: Some(match diagnostic.severity {
            Severity::Error => DiagnosticSeverity::Error,
            Severity::Warning => DiagnosticSeverity::Warning,
        }),
        code: Some(diagnostic.code.word().to_owned().into()),
        code_description: page.map(|href| CodeDescription { href }),
        source: Some("nbc".to_owned()),
        tags: (diagnostic.code == Code::Unused).then(|| vec![DiagnosticTag::Unnecessary]),
        related_information: Some(related),
        range: place,
        message: message.into(),
        data: None,
    }
}

fn touching<'f>(files: &Files<'f>, uri: &Uri, range: Range) -> Vec<&'f Diagnostic> {
    let touches = |diagnostic: &&Diagnostic| {
        diagnostic.labels.iter().any(|label| {
            let place = files.range(label.span);
            files.uri(label.span.file) == *uri && place.start <= range.end && range.start <= place.end
        })
    };
    files.checked.diagnostics.iter().filter(touches).collect()
}

pub(super) fn fixes(files: &Files<'_>, uri: &Uri, range: Range) -> Vec<CodeActionResponse> {
    let fix = |diagnostic: &Diagnostic| {
        let fix = diagnostic.fix.as_ref()?;
        Some(action(files, diagnostic, fix.title.clone(), edit(files, fix)))
    };
    touching(files, uri, range).into_iter().filter_map(fix).collect()
}

pub(super) fn unused<'f>(files: &Files<'f>, uri: &Uri, range: Range) -> Vec<(&'f Diagnostic, NameUse)> {
    let found = |diagnostic: &'f Diagnostic| {
        let place = diagnostic.labels.first().filter(|_| diagnostic.code == Code::Unused)?.span;
        let found = files.checked.uses.at(place.file, place.start as usize)?;
        (found.kind == NameKind::Net).then_some((diagnostic, found))
    };
    touching(files, uri, range).into_iter().filter_map(found).collect()
}

pub(super) fn rename(files: &Files<'_>, diagnostic: &Diagnostic, new: &str, edit: WorkspaceEdit) -> CodeActionResponse {
    action(files, diagnostic, format!("rename to `{new}`"), edit)
}

fn action(files: &Files<'_>, diagnostic: &Diagnostic, title: String, edit: WorkspaceEdit) -> CodeActionResponse {
    let action = CodeAction {
        title,
        kind: Some(CodeActionKind::QuickFix),
        diagnostics: Some(vec![problem(files, diagnostic)]),
        is_preferred: Some(true),
        edit: Some(edit),
        disabled: None,
        command: None,
        data: None,
        tags: None,
    };
    action.into()
}

fn edit(files: &Files<'_>, fix: &Fix) -> WorkspaceEdit {
    let changes = fix.edits.iter().map(|edit| {
        let location = files.location(edit.span);
        (location.uri, TextEdit { range: location.range, new_text: edit.text.clone() })
    });
    super::navigation::workspace_edit(changes)
}
