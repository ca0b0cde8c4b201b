//! The tokens of a text, for what editors ask about a place that the tree does not tell, such as one in a text that is
//! not yet complete.

use std::ops::Range;

/// The kinds of tokens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum EditorTokenKind {
    /// A name or a keyword.
    Word,
    /// Digits, or a constant with its width.
    Number,
    /// A text in quotes.
    Quoted,
    Comment,
    /// One character of any other kind, or an operator of two.
    Sign,
}

/// A token and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct EditorToken {
    pub(super) kind: EditorTokenKind,
    pub(super) range: Range<usize>,
}

/// Operators of two characters.
const PAIRS: [&str; 7] = ["->", "==", "!=", "<=", ">=", "..", "**"];

/// The tokens of a text, in order.
pub(super) fn tokens(text: &str) -> Vec<EditorToken> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(first) = text[at..].chars().next() {
        if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        }
        let (kind, length) = token(&text[at..], first);
        tokens.push(EditorToken { kind, range: at..at + length });
        at += length;
    }
    tokens
}

/// The token at a byte, or the word that ends there.
pub(super) fn at(tokens: &[EditorToken], offset: usize) -> Option<&EditorToken> {
    let next = tokens.partition_point(|token| token.range.start <= offset);
    let token = tokens[..next].last()?;
    let ends_here = token.range.end == offset && matches!(token.kind, EditorTokenKind::Word | EditorTokenKind::Number);
    (offset < token.range.end || ends_here).then_some(token)
}

fn token(rest: &str, first: char) -> (EditorTokenKind, usize) {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let run = |is: &dyn Fn(char) -> bool| rest.find(|c| !is(c)).unwrap_or(rest.len());
    match first {
        _ if rest.starts_with("//") => (EditorTokenKind::Comment, rest.find(['\n', '\r']).unwrap_or(rest.len())),
        '"' => (EditorTokenKind::Quoted, quoted(rest)),
        c if c.is_ascii_digit() => (EditorTokenKind::Number, number(rest, run(&|c| is_word(c) || c == '\''))),
        c if is_word(c) => (EditorTokenKind::Word, run(&is_word)),
        _ if PAIRS.iter().any(|pair| rest.starts_with(pair)) => (EditorTokenKind::Sign, 2),
        c => (EditorTokenKind::Sign, c.len_utf8()),
    }
}

/// The length of a number of which `whole` bytes are known: a point between digits belongs to it.
fn number(rest: &str, whole: usize) -> usize {
    let digits = |text: &str| text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    match rest[whole..].strip_prefix('.').map(digits) {
        Some(more) if more > 0 => whole + 1 + more,
        _ => whole,
    }
}

fn quoted(rest: &str) -> usize {
    let end = rest[1..].find(['"', '\n']).map_or(rest.len(), |end| end + 1);
    end + usize::from(rest[end..].starts_with('"'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<&str> {
        tokens(text).into_iter().map(|token| &text[token.range]).collect()
    }

    #[test]
    fn a_text_is_split_into_tokens() {
        assert_eq!(
            words("q=4'b1_0 // é\n{a[3..0]}"),
            ["q", "=", "4'b1_0", "// é", "{", "a", "[", "3", "..", "0", "]", "}"]
        );
        assert_eq!(
            words("0.6..1.6 -> \"a b\" n'd(1)"),
            ["0.6", "..", "1.6", "->", "\"a b\"", "n", "'", "d", "(", "1", ")"]
        );
        assert_eq!(words("\"open\n§x"), ["\"open", "§", "x"]);
    }

    #[test]
    fn the_token_at_a_byte_is_found() {
        let found = |offset| at(&tokens("ab (c"), offset).map(|token| token.range.clone());
        assert_eq!([0, 2, 3, 4, 5].map(found), [Some(0..2), Some(0..2), Some(3..4), Some(4..5), Some(4..5)]);
    }
}
