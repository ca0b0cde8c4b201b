//! The output of the formatter: lines with their indent, comments and blank lines where the source has them.

use crate::source::Span;

/// Spaces of one indent.
pub(super) const INDENT: usize = 4;

/// A text that is being printed.
pub(super) struct Printer<'a> {
    source: &'a str,
    comments: &'a [Span],
    /// The first comment that is not yet printed.
    next: usize,
    out: String,
    pub(super) indent: usize,
    /// Where in the source the last thing printed ended; `None` at the start of a block.
    last: Option<u32>,
    /// Whether a blank line must come before what is printed next.
    separate: bool,
}

impl<'a> Printer<'a> {
    pub(super) fn new(source: &'a str, comments: &'a [Span]) -> Self {
        Self { source, comments, next: 0, out: String::new(), indent: 0, last: None, separate: false }
    }

    /// The whole text, with the comments after the last declaration.
    pub(super) fn finish(mut self) -> String {
        self.separate = false;
        self.comments_until(u32::MAX);
        assert_eq!(self.next, self.comments.len(), "every comment is printed");
        if !self.out.is_empty() {
            self.out.push('\n');
        }
        self.out
    }

    /// Writes into the line that is being printed.
    pub(super) fn write(&mut self, text: &str) {
        self.out.push_str(text);
    }

    /// The column at which the next character will stand, from 0.
    pub(super) fn column(&self) -> usize {
        let line = self.out.rfind('\n').map_or(0, |newline| newline + 1);
        self.out[line..].chars().count()
    }

    /// Asks for a blank line before what comes next.
    pub(super) fn separate(&mut self, separate: bool) {
        self.separate |= separate && self.last.is_some();
    }

    /// Asks for a blank line after what was just printed.
    pub(super) fn separate_next(&mut self, separate: bool) {
        self.separate = separate;
    }

    /// Prints an item with the comments before and inside it, and the one behind it on its line.
    pub(super) fn item(&mut self, span: Span, print: impl FnOnce(&mut Self)) {
        self.item_with_inside(span, span.end, print);
    }

    /// Prints an item that prints the comments after `head` itself.
    pub(super) fn item_with_inside(&mut self, span: Span, head: u32, print: impl FnOnce(&mut Self)) {
        // A comment right after the opening brace belongs to what is inside.
        let brace = self.source[span.start as usize..head as usize].rfind('{').filter(|_| head != span.end);
        let head = brace.map_or(head, |brace| span.start + brace as u32);
        self.comments_until(head);
        self.new_line(span.start);
        print(self);
        self.last = Some(span.end);
        self.comment_behind();
    }

    /// Prints a block in braces: `items` prints what is inside, `end` is where the closing brace ends.
    pub(super) fn block(&mut self, end: u32, items: impl FnOnce(&mut Self)) {
        self.write("{");
        self.indent += INDENT;
        self.last = None;
        items(self);
        self.comments_until(end);
        self.indent -= INDENT;
        let empty = self.last.is_none();
        if !empty {
            self.line();
        }
        self.write("}");
    }

    /// Begins a new line, after a blank one where the source has one before `start` or one was asked for.
    fn new_line(&mut self, start: u32) {
        if !self.out.is_empty() {
            let blank = self.last.is_some_and(|last| last <= start && self.has_blank_line(last, start));
            if (self.separate || blank) && self.last.is_some() {
                self.out.push('\n');
            }
            self.line();
        }
        self.separate = false;
    }

    /// Begins a new line.
    pub(super) fn line(&mut self) {
        self.out.push('\n');
        self.out.extend(std::iter::repeat_n(' ', self.indent));
    }

    fn has_blank_line(&self, from: u32, to: u32) -> bool {
        self.source[from as usize..to as usize].bytes().filter(|&byte| byte == b'\n').count() >= 2
    }

    /// Prints the comments that begin before a place, each on a line of its own.
    pub(super) fn comments_until(&mut self, place: u32) {
        while let Some(comment) = self.comments.get(self.next).filter(|comment| comment.start < place) {
            self.new_line(comment.start);
            self.write(self.source[comment.range()].trim_end());
            self.last = Some(comment.end);
            self.next += 1;
        }
    }

    /// Prints the next comment if it stands behind what was just printed, on the same line.
    fn comment_behind(&mut self) {
        let (Some(last), Some(comment)) = (self.last, self.comments.get(self.next)) else { return };
        let between = self.source.get(last as usize..comment.start as usize);
        if between.is_some_and(|between| between.chars().all(|c| matches!(c, ' ' | '\t' | ','))) {
            self.write("  ");
            self.write(self.source[comment.range()].trim_end());
            self.last = Some(comment.end);
            self.next += 1;
        }
    }

    /// Whether two items follow each other without a blank line or a comment on a line of its own between them.
    pub(super) fn adjacent(&self, first: Span, second: Span) -> bool {
        let between = &self.source[first.end as usize..second.start as usize];
        between.bytes().filter(|&byte| byte == b'\n').count() <= 1
    }

    /// Whether a comment stands inside a span.
    pub(super) fn has_comment_inside(&self, span: Span) -> bool {
        let first = self.comments.partition_point(|comment| comment.start < span.start);
        self.comments.get(first).is_some_and(|comment| comment.start < span.end)
    }

    /// The text under a span.
    pub(super) fn text(&self, span: Span) -> &'a str {
        &self.source[span.range()]
    }
}
