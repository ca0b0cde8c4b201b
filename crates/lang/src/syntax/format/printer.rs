//! The output of the formatter: lines with their indentation, and the comments and blank lines of the source.

use std::collections::BTreeSet;

use nbc_base::source::Span;

pub(super) const INDENT: usize = 4;

pub(super) struct Printer<'a> {
    source: &'a str,
    comments: &'a [Span],
    next: usize,
    placed: BTreeSet<u32>,
    out: String,
    pub(super) indent: usize,
    /// The end of the last printed item in the source; `None` at the start of a block.
    last: Option<u32>,
    separate: bool,
}

impl<'a> Printer<'a> {
    pub(super) fn new(source: &'a str, comments: &'a [Span]) -> Self {
        Self {
            source,
            comments,
            next: 0,
            placed: BTreeSet::new(),
            out: String::new(),
            indent: 0,
            last: None,
            separate: false,
        }
    }

    pub(super) fn finish(mut self) -> String {
        self.separate = false;
        self.comments_until(self.source.len() as u32);
        assert_eq!(self.next, self.comments.len(), "every comment is printed");
        if !self.out.is_empty() {
            self.out.push('\n');
        }
        self.out
    }

    pub(super) fn write(&mut self, text: &str) {
        self.out.push_str(text);
    }

    /// From 0.
    pub(super) fn column(&self) -> usize {
        let line = self.out.rfind('\n').map_or(0, |newline| newline + 1);
        self.out[line..].chars().count()
    }

    pub(super) fn separate(&mut self, separate: bool) {
        self.separate |= separate && self.last.is_some();
    }

    pub(super) fn separate_next(&mut self, separate: bool) {
        self.separate = separate;
    }

    pub(super) fn item(&mut self, span: Span, print: impl FnOnce(&mut Self)) {
        self.item_with_inside(span, span.end, print);
    }

    pub(super) fn item_with_inside(&mut self, span: Span, head: u32, print: impl FnOnce(&mut Self)) {
        // A comment directly after the opening brace belongs to the block.
        let brace = self.source[span.start as usize..head as usize].rfind('{').filter(|_| head != span.end);
        let head = brace.map_or(head, |brace| span.start + brace as u32);
        self.comments_until(head);
        self.new_line(span.start);
        print(self);
        self.last = Some(span.end);
        self.comment_behind();
    }

    pub(super) fn last_end(&mut self, end: u32) {
        self.last = Some(end);
    }

    /// `items` prints the contents, and `end` is the end of the closing brace.
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

    /// A blank line comes first if the source has one before `start` or one was requested.
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

    pub(super) fn line(&mut self) {
        self.out.push('\n');
        self.out.extend(std::iter::repeat_n(' ', self.indent));
    }

    fn has_blank_line(&self, from: u32, to: u32) -> bool {
        self.source[from as usize..to as usize].bytes().filter(|&byte| byte == b'\n').count() >= 2
    }

    pub(super) fn comments_until(&mut self, place: u32) {
        while let Some(comment) = self.comments.get(self.next).filter(|comment| comment.start < place) {
            if !self.placed.contains(&comment.start) {
                self.new_line(comment.start);
                self.write(self.source[comment.range()].trim_end());
                self.last = Some(comment.end);
            }
            self.next += 1;
        }
    }

    pub(super) fn source(&self) -> (&'a str, &'a [Span]) {
        (self.source, self.comments)
    }

    pub(super) fn place(&mut self, starts: impl IntoIterator<Item = u32>) {
        self.placed.extend(starts);
    }

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

    pub(super) fn adjacent(&self, first: Span, second: Span) -> bool {
        let between = &self.source[first.end as usize..second.start as usize];
        between.bytes().filter(|&byte| byte == b'\n').count() <= 1
    }

    pub(super) fn has_comment_inside(&self, span: Span) -> bool {
        let first = self.comments.partition_point(|comment| comment.start < span.start);
        self.comments.get(first).is_some_and(|comment| comment.start < span.end)
    }

    pub(super) fn text(&self, span: Span) -> &'a str {
        &self.source[span.range()]
    }
}
