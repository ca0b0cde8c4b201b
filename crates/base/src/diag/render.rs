//! Diagnostics as text for people, through miette; JSON reads [`Diagnostic`] itself.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents, SourceCode, SourceSpan,
    SpanContents,
};

use super::visible::{visible, visible_in_place};
use super::{Diagnostic, Label, Severity};
use crate::source::{FileId, SourceFile, Sources};

/// The most diagnostics that are shown: as many as a file has, with the number of the others.
const MOST_SHOWN: usize = 201;

/// The most characters of a message that are shown, because a user's word may be megabytes long.
const MOST_CHARACTERS: usize = 600;

fn clipped(text: &str) -> String {
    match text.char_indices().nth(MOST_CHARACTERS) {
        Some((end, _)) => format!("{}…", visible(&text[..end])),
        None => visible(text).into_owned(),
    }
}

type Shown<'a> = BTreeMap<FileId, Cow<'a, str>>;

fn shown<'a>(diagnostics: &[Diagnostic], sources: &'a Sources) -> Shown<'a> {
    let labels = diagnostics.iter().take(MOST_SHOWN).flat_map(|told| told.labels.iter().chain(&told.related));
    let files: BTreeSet<FileId> = labels.map(|label| label.span.file).collect();
    files.into_iter().map(|file| (file, visible_in_place(&sources.file(file).text))).collect()
}

/// Each diagnostic with an excerpt of the source; of many, only the first, with the number of the others.
pub fn text(diagnostics: &[Diagnostic], sources: &Sources, color: bool) -> String {
    let texts = shown(diagnostics, sources);
    let shown: String = diagnostics
        .iter()
        .take(MOST_SHOWN)
        .map(|diagnostic| {
            let mut text = String::new();
            for report in Report::all(diagnostic, sources, &texts) {
                let mut part = String::new();
                let rendered = handler(&report, color).render_report(&mut part, &report);
                rendered.expect("text can be written to a string");
                // miette indents the message.
                text += part.trim_start();
            }
            text + "\n"
        })
        .collect();
    match diagnostics.len().saturating_sub(MOST_SHOWN) {
        0 => shown,
        more => format!("{shown}and {more} more like these; `--format json` has them all\n"),
    }
}

/// `error[unknown]: …` stands before the message. Lines are not wrapped, so that paths and commands can be copied.
fn handler(report: &Report<'_>, color: bool) -> GraphicalReportHandler {
    let mut theme = if color { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let marks = &mut theme.characters;
    match report.heading.map(|diagnostic| (diagnostic.severity, diagnostic.code)) {
        Some((Severity::Error, code)) => marks.error = format!("error[{code}]:"),
        Some((Severity::Warning, code)) => marks.warning = format!("warning[{code}]:"),
        None => marks.advice = "note:".to_owned(),
    }
    GraphicalReportHandler::new_themed(theme).with_wrap_lines(false).with_links(false)
}

/// A diagnostic in miette's form, or one of its labels in another file, which has no heading.
#[derive(Debug)]
struct Report<'a> {
    heading: Option<&'a Diagnostic>,
    message: String,
    labels: Vec<&'a Label>,
    excerpt: Option<Excerpt<'a>>,
}

impl<'a> Report<'a> {
    fn all(diagnostic: &'a Diagnostic, sources: &'a Sources, texts: &'a Shown<'_>) -> Vec<Self> {
        let file = diagnostic.labels.first().map(|label| label.span.file);
        let (here, elsewhere): (Vec<_>, Vec<_>) =
            diagnostic.labels.iter().chain(&diagnostic.related).partition(|label| Some(label.span.file) == file);
        let excerpt = file.map(|file| Excerpt::new(sources, texts, file));
        let main = Self { heading: Some(diagnostic), message: clipped(&diagnostic.message), labels: here, excerpt };
        let others = elsewhere.into_iter().map(|label| Self::elsewhere(label, sources, texts));
        std::iter::once(main).chain(others).collect()
    }

    fn elsewhere(label: &'a Label, sources: &'a Sources, texts: &'a Shown<'_>) -> Self {
        let excerpt = Some(Excerpt::new(sources, texts, label.span.file));
        Self { heading: None, message: clipped(&label.text), labels: vec![label], excerpt }
    }
}

impl fmt::Display for Report<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Report<'_> {}

impl miette::Diagnostic for Report<'_> {
    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.heading.map(|diagnostic| diagnostic.severity) {
            Some(Severity::Error) => miette::Severity::Error,
            Some(Severity::Warning) => miette::Severity::Warning,
            None => miette::Severity::Advice,
        })
    }

    fn help<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        self.heading?.help.as_ref().map(|help| Box::new(clipped(help)) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.excerpt.as_ref().map(|excerpt| excerpt as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let labeled = |label: &&Label| {
            let start = self.excerpt.as_ref().map_or(0, |excerpt| excerpt.visible(label.span.range().start));
            LabeledSpan::new(Some(clipped(&label.text)), start, label.span.range().len())
        };
        (!self.labels.is_empty())
            .then(|| Box::new(self.labels.iter().map(labeled)) as Box<dyn Iterator<Item = LabeledSpan>>)
    }
}

/// A source file that shows only the surroundings of a span, because a line may be megabytes long.
#[derive(Debug)]
struct Excerpt<'a> {
    file: &'a SourceFile,
    text: &'a str,
}

const MARGIN: usize = 60;

impl<'a> Excerpt<'a> {
    fn new(sources: &'a Sources, texts: &'a Shown<'_>, file: FileId) -> Self {
        Self { file: sources.file(file), text: &texts[&file] }
    }

    /// The nearest offset with a character to point at; the end of a text has none.
    fn visible(&self, offset: usize) -> usize {
        let text = self.text;
        text.floor_char_boundary(offset.min(text.len().saturating_sub(1)))
    }

    /// Whole lines with their neighbors if they are short, else the nearest part of the line.
    fn range(&self, span: &SourceSpan, before: usize, after: usize) -> std::ops::Range<usize> {
        let text = self.text;
        let start = span.offset().min(text.len());
        let end = (start + span.len()).min(text.len());
        let from = nth_line_start(text, start, before);
        let to = nth_line_end(text, end, after);
        let clip_from = text.floor_char_boundary(start.saturating_sub(MARGIN));
        let clip_to = text.ceil_char_boundary(start.saturating_add(2 * MARGIN).min(text.len()));
        let short = text[from..to].lines().all(|line| line.len() <= 4 * MARGIN);
        if short { from..to } else { line_start(text, start).max(clip_from)..line_end(text, start).min(clip_to) }
    }
}

fn line_start(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(0, |newline| newline + 1)
}

fn line_end(text: &str, at: usize) -> usize {
    text[at..].find('\n').map_or(text.len(), |newline| at + newline)
}

fn nth_line_start(text: &str, at: usize, before: usize) -> usize {
    (0..before).fold(line_start(text, at), |start, _| line_start(text, start.saturating_sub(1)))
}

fn nth_line_end(text: &str, at: usize, after: usize) -> usize {
    (0..after).fold(line_end(text, at), |end, _| line_end(text, (end + 1).min(text.len())))
}

impl SourceCode for Excerpt<'_> {
    fn read_span<'b>(
        &'b self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'b> + 'b>, MietteError> {
        let range = self.range(span, before, after);
        // Without context lines, miette asks for the place of the span itself.
        let place = self.file.line_column(if before == 0 { span.offset() } else { range.start });
        let data = if self.text.is_empty() { b" " } else { &self.text.as_bytes()[range.clone()] };
        let lines = self.text[range.clone()].lines().count();
        let shown = SourceSpan::new(range.start.into(), data.len());
        let name = visible(&self.file.name).into_owned();
        Ok(Box::new(MietteSpanContents::new_named(name, data, shown, place.line - 1, place.column - 1, lines)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::Code;
    use crate::source::Span;

    fn render(source: &str, start: usize, end: usize) -> String {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", source);
        let diagnostic =
            Diagnostic::new(Code::Syntax, "unexpected `}`", Span::new(file, start, end), "expected a name")
                .with_help("write a name");
        text(&[diagnostic], &sources, false)
    }

    #[test]
    fn a_diagnostic_shows_its_place_and_its_help() {
        let shown = render("circuit\n  }\n", 10, 11);
        assert!(shown.starts_with("error[syntax]: unexpected `}`\n"), "{shown}");
        for part in ["a.nb:2:3", "expected a name", "write a name"] {
            assert!(shown.contains(part), "no {part:?} in\n{shown}");
        }
    }

    #[test]
    fn a_huge_line_is_shortened() {
        let shown = render(&"x".repeat(10_000_000), 5_000_000, 5_000_001);
        assert!(shown.len() < 2_000, "{} bytes shown", shown.len());
        assert!(shown.contains("expected a name"), "{shown}");
    }

    #[test]
    fn a_huge_word_is_shortened_and_only_the_first_messages_are_shown() {
        let diagnostic =
            Diagnostic::without_place(Code::Unknown, format!("no net is called `{}`", "x".repeat(1_000_000)));
        let shown = text(&vec![diagnostic; 1_000], &Sources::default(), false);
        assert!(shown.len() < 400_000 && shown.ends_with("and 799 more like these; `--format json` has them all\n"));
    }

    #[test]
    fn a_place_past_the_end_is_shown_at_the_end() {
        let shown = render("circuit", 7, 7);
        assert!(shown.contains("expected a name"), "{shown}");
        assert!(render("", 0, 0).contains("expected a name"));
    }
}
