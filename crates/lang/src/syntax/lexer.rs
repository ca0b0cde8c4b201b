//! The tokens of a text: words, numbers, texts in quotes, comments and signs. Spaces and the ends of lines are between
//! them.

use std::ops::Range;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// A name, a keyword, or any other run of letters and digits.
    Word,
    /// Digits with what follows them without a space: a point and more digits, or the base and digits of a constant.
    Number,
    /// It ends with its line at the latest.
    Quoted,
    Comment,
    /// From `#` to the end of the line, or from `/*` to `*/`.
    ForeignComment,
    /// One character of any other kind, or an operator of two.
    Sign,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    pub kind: TokenKind,
    pub range: Range<usize>,
    /// Whether only comments are before it on its line.
    pub is_first: bool,
}

const PAIRS: [[u8; 2]; 11] = [*b"->", *b"=>", *b"==", *b"!=", *b"<=", *b">=", *b"<<", *b">>", *b"..", *b"**", *b":="];

pub fn tokens(text: &str) -> impl Iterator<Item = Token> {
    tokens_from(text, 0)
}

/// From the start of a token, before which its line has only comments.
pub fn tokens_from(text: &str, start: usize) -> impl Iterator<Item = Token> {
    let (mut at, mut is_first) = (start, true);
    std::iter::from_fn(move || {
        let start = at + run(&text[at..], |b| b.is_ascii_whitespace() || b == 0xb, char::is_whitespace);
        if start == text.len() {
            return None;
        }
        is_first |= text.as_bytes()[at..start].iter().any(|b| matches!(b, b'\n' | b'\r'));
        let (kind, length) = token(&text[start..]);
        at = start + length;
        let token = Token { kind, range: start..at, is_first };
        is_first &= matches!(kind, TokenKind::Comment | TokenKind::ForeignComment);
        Some(token)
    })
}

/// The bytes up to the first character that is no such one. Most are ASCII, which needs no decoding.
fn run(text: &str, ascii: impl Fn(u8) -> bool, all: impl Fn(char) -> bool) -> usize {
    let bytes = text.as_bytes();
    let plain = bytes.iter().position(|&b| !ascii(b)).unwrap_or(bytes.len());
    match bytes.get(plain) {
        Some(128..) => plain + text[plain..].find(|c| !all(c)).unwrap_or(bytes.len() - plain),
        _ => plain,
    }
}

fn word(text: &str) -> usize {
    run(text, |b| b.is_ascii_alphanumeric() || b == b'_', is_word)
}

fn token(rest: &str) -> (TokenKind, usize) {
    let first = rest.chars().next().expect("the text goes on");
    let line = || rest.find(['\n', '\r']).unwrap_or(rest.len());
    match first {
        _ if rest.starts_with("//") => (TokenKind::Comment, line()),
        _ if rest.starts_with("/*") => (TokenKind::ForeignComment, rest.find("*/").map_or(rest.len(), |end| end + 2)),
        '#' => (TokenKind::ForeignComment, line()),
        '"' => (TokenKind::Quoted, quoted(rest)),
        c if c.is_ascii_digit() => (TokenKind::Number, number(rest)),
        c if is_word(c) => (TokenKind::Word, word(rest)),
        _ if rest.as_bytes().first_chunk().is_some_and(|pair| PAIRS.contains(pair)) => (TokenKind::Sign, 2),
        c => (TokenKind::Sign, c.len_utf8()),
    }
}

/// A point between digits belongs to the number; the two of a range do not.
fn number(rest: &str) -> usize {
    let whole = rest.find(|c| !is_word(c) && c != '\'').unwrap_or(rest.len());
    let digits = |text: &str| text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    match rest[whole..].strip_prefix('.').map(digits) {
        Some(more) if more > 0 => whole + 1 + more,
        _ => whole,
    }
}

fn quoted(rest: &str) -> usize {
    let end = rest[1..].find(['"', '\n', '\r']).map_or(rest.len(), |end| end + 1);
    end + usize::from(rest[end..].starts_with('"'))
}

pub(crate) fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// As offsets.
pub(crate) fn open_brackets(text: &str) -> Vec<usize> {
    let mut open = Vec::new();
    for token in tokens(text) {
        bracket(&mut open, &text[token.range.clone()], token.range.start, |open| &text[*open..*open + 1]);
    }
    open
}

/// A closing brace also closes what is open inside it. Returns whether a closing bracket has no opening one.
pub(crate) fn bracket<'t, T>(open: &mut Vec<T>, sign: &str, at: T, text: impl Fn(&T) -> &'t str) -> bool {
    let opening = match sign {
        "(" | "[" | "{" => {
            open.push(at);
            return false;
        }
        ")" => "(",
        "]" => "[",
        "}" => "{",
        _ => return false,
    };
    let place = match open.last() {
        Some(last) if text(last) == opening => open.len() - 1,
        _ if sign == "}" => match open.iter().rposition(|open| text(open) == "{") {
            Some(place) => place,
            None => return true,
        },
        _ => return true,
    };
    open.truncate(place);
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_split_into_tokens() {
        let text = "q=4'b1 // é\n/* a\nb */ {a[3..0]} # x\n\"c d\" \"open\nü->";
        let words: Vec<_> = tokens(text).map(|token| (&text[token.range], token.is_first)).collect();
        let first = ["q", "/* a\nb */", "{", "\"c d\"", "ü"];
        let all = "q|=|4'b1|// é|/* a\nb */|{|a|[|3|..|0|]|}|# x|\"c d\"|\"open|ü|->";
        let all: Vec<_> = all.split('|').map(|word| (word, first.contains(&word))).collect();
        assert_eq!(words, all);
    }

    #[test]
    fn numbers_have_points_and_bases_but_no_ranges() {
        let words = |text: &'static str| tokens(text).map(|token| &text[token.range]).collect::<Vec<_>>();
        assert_eq!(
            words("0.6..1.6 -> 4'b1_0 n'd(1)"),
            ["0.6", "..", "1.6", "->", "4'b1_0", "n", "'", "d", "(", "1", ")"]
        );
        let kinds: Vec<_> = tokens("12 a12 é").map(|token| token.kind).collect();
        assert_eq!(kinds, [TokenKind::Number, TokenKind::Word, TokenKind::Word]);
    }

    #[test]
    fn brackets_stay_open_until_they_are_closed() {
        assert_eq!(open_brackets("{ (a \")\" // )\n [b]"), [0, 2]);
        assert_eq!(open_brackets("{ ( [ }"), [0; 0]);
        assert_eq!(open_brackets("( ]"), [0]);
    }
}
