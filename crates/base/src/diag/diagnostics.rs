//! Diagnostics with the texts that they point into: the one error of every call that can find something wrong with the
//! user's input.

use std::fmt;

use super::{Diagnostic, Finding, findings, visible};
use crate::source::{Sources, Span};

/// What is wrong with the user's input, with the texts that the places are in.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    /// The faults, in order of place.
    pub list: Vec<Diagnostic>,
    pub sources: Sources,
}

impl Diagnostics {
    pub fn findings(&self) -> Vec<Finding> {
        findings(&self.list, &self.sources)
    }

    fn place(&self, span: Span) -> String {
        let file = self.sources.file(span.file);
        let at = file.line_column(span.start as usize);
        format!("{}:{}:{}: ", file.name, at.line, at.column)
    }

    fn lines(&self, diagnostic: &Diagnostic) -> String {
        let place = diagnostic.labels.first().map_or(String::new(), |label| self.place(label.span));
        let severity = if diagnostic.is_error() { "error" } else { "warning" };
        let mut lines = format!("{place}{severity}[{}]: {}\n", diagnostic.code, diagnostic.message);
        for related in &diagnostic.related {
            lines += &format!("{}note: {}\n", self.place(related.span), related.text);
        }
        if let Some(help) = &diagnostic.help {
            lines += &format!("  help: {help}\n");
        }
        lines
    }
}

impl From<Diagnostic> for Diagnostics {
    fn from(diagnostic: Diagnostic) -> Self {
        Self { list: vec![diagnostic], sources: Sources::default() }
    }
}

impl fmt::Display for Diagnostics {
    /// A line for each, as compilers print it, with its remarks and its help below.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: String = self.list.iter().map(|diagnostic| self.lines(diagnostic)).collect();
        f.write_str(visible(lines.trim_end()).as_ref())
    }
}

impl std::error::Error for Diagnostics {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::Code;

    #[test]
    fn diagnostics_are_plain_lines_with_places() {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", "circuit\n  é }\n");
        let fault = Diagnostic::new(Code::Syntax, "unexpected `}`", Span::new(file, 13, 14), "here")
            .with_help("remove it")
            .with_related(Span::new(file, 0, 7), "in this declaration");
        let list = vec![fault, Diagnostic::without_place(Code::Unused, "`a` is unused")];
        insta::assert_snapshot!(Diagnostics { list, sources }, @r"
        a.nb:2:5: error[syntax]: unexpected `}`
        a.nb:1:1: note: in this declaration
          help: remove it
        warning[unused]: `a` is unused
        ");
    }
}
