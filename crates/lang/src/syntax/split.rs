//! Splits a text into declarations, so that an error in one does not hide errors in the others.
//!
//! A declaration begins at a keyword that is the first word of its line. Within braces, only a keyword in the first
//! column, followed by a name, begins a declaration: there an unclosed brace is assumed to end.

use std::ops::Range;

use crate::syntax::lexer::{Token, TokenKind, bracket, is_word, tokens_from};

pub const KEYWORDS: [&str; 17] = [
    "circuit",
    "enum",
    "environment",
    "evolution",
    "file",
    "images",
    "let",
    "library",
    "material",
    "prove",
    "schedule",
    "simulate",
    "stimulus",
    "swarm",
    "test",
    "use",
    "world",
];

const FOREIGN_KEYWORDS: [&str; 4] = ["module", "fn", "def", "function"];

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Split {
    pub(crate) pieces: Vec<SourcePiece>,
    pub(crate) comments: Vec<Range<usize>>,
    pub(crate) foreign_comments: Vec<Range<usize>>,
}

/// Without the spaces and comments around it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SourcePiece {
    pub(crate) range: Range<usize>,
    pub(crate) semicolons: Vec<usize>,
    /// Of brackets and `if`.
    pub(crate) depth: usize,
    pub(crate) words: usize,
    /// The bytes of the longest name.
    pub(crate) name: usize,
}

/// Splits a text, of which `old` was split before. Only what is near the first and the last change is read.
pub(crate) fn split_again(text: &str, old: &str, mut split: Split) -> Split {
    let first = alike(text.as_bytes(), old.as_bytes());
    let last = alike_at_end(&text.as_bytes()[first..], &old.as_bytes()[first..]);
    let by = text.len().wrapping_sub(old.len());
    // The first words of a declaration decide where it begins, and where the one before it ends.
    let kept = split.pieces.partition_point(|piece| piece.range.start < first).saturating_sub(2);
    let start = if kept == 0 { 0 } else { split.pieces[kept].range.start };
    let mut after = split.split_off(kept, start);
    let mut splitter = Splitter { text, split, piece: None, open: Vec::new(), closed: false, choices: 0 };
    for token in tokens_from(text, start) {
        let range = token.range.clone();
        match token.kind {
            TokenKind::Comment => splitter.split.comments.push(range),
            TokenKind::ForeignComment => splitter.split.foreign_comments.push(range),
            _ if splitter.begins(&token, &text[range.clone()]) => {
                splitter.end_piece();
                let same = after.pieces.binary_search_by_key(&range.start.wrapping_sub(by), |piece| piece.range.start);
                if let Ok(same) = same
                    && range.start >= text.len() - last
                {
                    let rest = after.split_off(same, range.start.wrapping_sub(by));
                    splitter.split.add(rest, by);
                    return splitter.split;
                }
                splitter.token(&token);
            }
            _ => splitter.token(&token),
        }
    }
    splitter.end_piece();
    splitter.split
}

/// Bytes that are compared at once.
const BLOCK: usize = 1 << 10;

/// The length of what both begin with.
fn alike(one: &[u8], other: &[u8]) -> usize {
    let blocks = one.chunks_exact(BLOCK).zip(other.chunks_exact(BLOCK)).take_while(|(one, other)| one == other);
    let start = blocks.count() * BLOCK;
    start + one[start..].iter().zip(&other[start..]).take_while(|(one, other)| one == other).count()
}

fn alike_at_end(one: &[u8], other: &[u8]) -> usize {
    let blocks = one.rchunks_exact(BLOCK).zip(other.rchunks_exact(BLOCK)).take_while(|(one, other)| one == other);
    let end = blocks.count() * BLOCK;
    let rest = one[..one.len() - end].iter().rev().zip(other[..other.len() - end].iter().rev());
    end + rest.take_while(|(one, other)| one == other).count()
}

impl Split {
    /// Takes the pieces from one on, which begins at `start`.
    fn split_off(&mut self, piece: usize, start: usize) -> Self {
        let from = |list: &mut Vec<Range<usize>>| list.split_off(list.partition_point(|comment| comment.start < start));
        Self {
            pieces: self.pieces.split_off(piece),
            comments: from(&mut self.comments),
            foreign_comments: from(&mut self.foreign_comments),
        }
    }

    /// Adds what was split before the text in front of it got longer by so many bytes, modulo 2^64.
    fn add(&mut self, more: Self, by: usize) {
        let moved = |range: Range<usize>| range.start.wrapping_add(by)..range.end.wrapping_add(by);
        self.comments.extend(more.comments.into_iter().map(moved));
        self.foreign_comments.extend(more.foreign_comments.into_iter().map(moved));
        self.pieces.extend(more.pieces.into_iter().map(|mut piece| {
            piece.semicolons.iter_mut().for_each(|at| *at = at.wrapping_add(by));
            SourcePiece { range: moved(piece.range), ..piece }
        }));
    }
}

struct Splitter<'a> {
    text: &'a str,
    split: Split,
    piece: Option<SourcePiece>,
    open: Vec<usize>,
    /// Whether the braces of the piece are closed, so that any keyword at the start of a line begins a declaration.
    closed: bool,
    /// Each `if` without its `else` so far.
    choices: usize,
}

impl Splitter<'_> {
    fn token(&mut self, token: &Token) {
        let word = &self.text[token.range.clone()];
        let start = token.range.start;
        let empty = || SourcePiece { range: start..start, semicolons: Vec::new(), depth: 0, words: 0, name: 0 };
        let piece = self.piece.get_or_insert_with(empty);
        piece.range.end = token.range.end;
        piece.words += 1;
        if token.kind == TokenKind::Word {
            piece.name = piece.name.max(word.len());
        }
        let text = self.text;
        bracket(&mut self.open, word, start, |&open| &text[open..=open]);
        self.closed |= word == "}" && self.open.is_empty();
        if word == ";" && self.open.last().is_none_or(|&open| self.text.as_bytes()[open] == b'{') {
            piece.semicolons.push(start);
        }
        match word {
            "if" => self.choices += 1,
            // The `else` of a table has a colon after it.
            "else" if !self.text[token.range.end..].trim_start().starts_with(':') => {
                self.choices = self.choices.saturating_sub(1);
            }
            _ => {}
        }
        piece.depth = piece.depth.max(self.open.len() + self.choices);
    }

    fn begins(&self, token: &Token, word: &str) -> bool {
        if !token.is_first || !matches!(token.kind, TokenKind::Word | TokenKind::Number) {
            return false;
        }
        let keyword = KEYWORDS.contains(&word);
        let rest = &self.text[token.range.end..];
        if self.open.is_empty() {
            let foreign = FOREIGN_KEYWORDS.contains(&word) && starts_declaration(word, rest);
            return keyword || foreign || self.closed;
        }
        let is_first_column = token.range.start == 0 || self.text[..token.range.start].ends_with(['\n', '\r']);
        keyword && is_first_column && starts_declaration(word, rest)
    }

    fn end_piece(&mut self) {
        self.split.pieces.extend(self.piece.take());
        self.open.clear();
        self.closed = false;
        self.choices = 0;
    }
}

/// Whether `rest` continues like a declaration with this keyword. A net may have a keyword's name.
fn starts_declaration(keyword: &str, rest: &str) -> bool {
    let rest = rest.trim_start_matches([' ', '\t']);
    match keyword {
        "use" => rest.starts_with('"'),
        // Statements begin with it too.
        "let" => false,
        _ => {
            let name = rest.find(|c| !is_word(c)).unwrap_or(rest.len());
            name > 0 && !rest[..name].eq("init")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(text: &str) -> Split {
        split_again(text, "", Split::default())
    }

    #[test]
    fn a_changed_text_is_split_like_a_new_one() {
        let parts =
            "circuit f {\n|}\n|test g |let|\n\n| |// c\n|/* |*/|;|\"|\nelse|:|\ncircuit h() -> (q) { q = 1 }\n|é";
        let parts: Vec<&str> = parts.split('|').collect();
        for turn in 0..parts.len() {
            let around = [&parts[turn..], &parts[..turn]].concat().concat().repeat(2);
            for (old, new) in parts.iter().flat_map(|old| parts.iter().map(move |new| (old, new))) {
                let [old, new] = [old, new].map(|middle| format!("{around}{middle}{around}"));
                assert_eq!(split_again(&new, &old, split(&old)), split(&new), "{old:?} to {new:?}");
            }
        }
    }

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
    }

    #[test]
    fn comments_of_other_languages_hide_what_they_hold() {
        let text = "/* circuit f\ncircuit g */ circuit h(a) -> (q) { q = a } # }";
        check(text, &["circuit h(a) -> (q) { q = a }"]);
        assert_eq!(split(text).foreign_comments, [0..25, 56..59]);
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
