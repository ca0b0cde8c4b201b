//! Splits a text into declarations, so that an error in one does not hide errors in the others.
//!
//! A declaration begins at a keyword that is the first word of its line. Within braces, only a keyword in the first
//! column, followed by a name, begins a declaration: there an unclosed brace is assumed to end.

use std::ops::Range;

/// The keywords that begin declarations.
pub const KEYWORDS: [&str; 11] = [
    "circuit",
    "evolution",
    "library",
    "material",
    "schedule",
    "simulate",
    "stimulus",
    "swarm",
    "test",
    "use",
    "world",
];

/// A text split into declarations.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Split {
    /// The declarations.
    pub pieces: Vec<SourcePiece>,
    pub comments: Vec<Range<usize>>,
}

/// The text of a declaration, without the spaces and comments around it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourcePiece {
    /// The range of bytes.
    pub range: Range<usize>,
    /// The brackets that are not closed, as offsets.
    pub unclosed: Vec<usize>,
    /// The first closing bracket without an opening one.
    pub unopened: Option<usize>,
    /// The deepest nesting of brackets and `if`.
    pub depth: usize,
    /// The number of tokens.
    pub words: usize,
}

/// Splits a text into declarations.
pub fn split(text: &str) -> Split {
    let mut splitter = Splitter {
        text,
        split: Split::default(),
        piece: None,
        open: Vec::new(),
        closed: false,
        line: Some(0),
        choices: 0,
    };
    let mut at = 0;
    while at < text.len() {
        at = splitter.token(at);
    }
    splitter.end_piece();
    splitter.split
}

struct Splitter<'a> {
    text: &'a str,
    split: Split,
    piece: Option<SourcePiece>,
    open: Vec<usize>,
    /// Whether all braces of the piece are closed, so that any keyword at the start of a line begins another
    /// declaration.
    closed: bool,
    /// The start of the line, while only spaces have been seen in it.
    line: Option<usize>,
    /// Each `if` without its `else` so far.
    choices: usize,
}

impl Splitter<'_> {
    /// Processes the token at `at`, and returns the start of the next one.
    fn token(&mut self, at: usize) -> usize {
        let rest = &self.text[at..];
        let first = rest.chars().next().expect("the text goes on");
        let length = match first {
            _ if rest.starts_with("//") => return self.comment(at),
            '"' => quoted(rest),
            c if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        if first == '\n' {
            self.line = Some(at + 1);
        }
        if !first.is_whitespace() {
            if self.begins(at, &rest[..length], first) {
                self.end_piece();
            }
            self.extend(at, at + length);
            self.bracket(at, first);
            self.choice(at, &rest[..length]);
            self.line = None;
        }
        at + length
    }

    fn comment(&mut self, at: usize) -> usize {
        let length = self.text[at..].find(['\n', '\r']).unwrap_or(self.text.len() - at);
        self.split.comments.push(at..at + length);
        at + length
    }

    /// Whether a token is the first of a declaration.
    fn begins(&self, at: usize, token: &str, first: char) -> bool {
        let keyword = KEYWORDS.contains(&token);
        if self.open.is_empty() {
            return self.line.is_some() && is_word(first) && (keyword || self.closed);
        }
        keyword && self.line == Some(at) && starts_declaration(token, &self.text[at + token.len()..])
    }

    fn extend(&mut self, start: usize, end: usize) {
        let empty = || SourcePiece { range: start..end, unclosed: Vec::new(), unopened: None, depth: 0, words: 0 };
        let piece = self.piece.get_or_insert_with(empty);
        piece.range.end = end;
        piece.words += 1;
    }

    fn bracket(&mut self, at: usize, first: char) {
        let piece = self.piece.as_mut().expect("a token belongs to a piece");
        match first {
            '{' | '(' | '[' => self.open.push(at),
            '}' | ')' | ']' => match self.open.last() {
                Some(&open) if closes(self.text.as_bytes()[open], first) => {
                    self.open.pop();
                    self.closed |= first == '}' && self.open.is_empty();
                }
                _ => _ = piece.unopened.get_or_insert(at),
            },
            _ => {}
        }
        piece.depth = piece.depth.max(self.open.len());
    }

    /// Counts nested `if`s; the `else` of a table has a colon after it.
    fn choice(&mut self, at: usize, token: &str) {
        match token {
            "if" => self.choices += 1,
            "else" if !self.text[at + token.len()..].trim_start().starts_with(':') => {
                self.choices = self.choices.saturating_sub(1);
            }
            _ => return,
        }
        let piece = self.piece.as_mut().expect("a token belongs to a piece");
        piece.depth = piece.depth.max(self.open.len() + self.choices);
    }

    fn end_piece(&mut self) {
        if let Some(mut piece) = self.piece.take() {
            piece.unclosed = std::mem::take(&mut self.open);
            self.split.pieces.push(piece);
        }
        self.closed = false;
        self.choices = 0;
    }
}

/// Whether `rest` continues like a declaration with this keyword. A net may have the same name as a keyword.
fn starts_declaration(keyword: &str, rest: &str) -> bool {
    let rest = rest.trim_start_matches([' ', '\t']);
    match keyword {
        "use" => rest.starts_with('"'),
        _ => {
            let name = rest.find(|c| !is_word(c)).unwrap_or(rest.len());
            name > 0 && !rest[..name].eq("init")
        }
    }
}

fn quoted(rest: &str) -> usize {
    let end = rest[1..].find(['"', '\n']).map_or(rest.len(), |end| end + 1);
    end + usize::from(rest[end..].starts_with('"'))
}

fn closes(open: u8, close: char) -> bool {
    matches!((open, close), (b'{', '}') | (b'(', ')') | (b'[', ']'))
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: &[&str]) {
        let pieces: Vec<_> = split(text).pieces.into_iter().map(|piece| text[piece.range].to_owned()).collect();
        assert_eq!(pieces, expected);
    }

    #[test]
    fn keywords_at_the_start_of_a_line_begin_declarations() {
        check(
            "stimulus a,\n  b\n// c\nuse \"x\"\ntest f \"circuit\" {\n}\n",
            &["stimulus a,\n  b", "use \"x\"", "test f \"circuit\" {\n}"],
        );
        check("simulate l with schedule (d) { 1 for 2 cycles }", &["simulate l with schedule (d) { 1 for 2 cycles }"]);
    }

    #[test]
    fn an_unclosed_brace_ends_at_the_next_declaration() {
        let text = "circuit f(a) -> (q) {\n  q = a\ncircuit g(a) -> (q) { q = a }";
        check(text, &["circuit f(a) -> (q) {\n  q = a", "circuit g(a) -> (q) { q = a }"]);
        assert_eq!(split(text).pieces[0].unclosed, [20]);
    }

    #[test]
    fn a_net_may_have_a_keywords_name() {
        check("circuit f(a) -> (q) {\ntest = a\n  use = a }", &["circuit f(a) -> (q) {\ntest = a\n  use = a }"]);
    }

    #[test]
    fn an_unknown_word_after_a_block_begins_a_declaration() {
        check("circuit f(a) -> (q) { q = a }\ncicuit g() {}", &["circuit f(a) -> (q) { q = a }", "cicuit g() {}"]);
    }
}
