//! The tokens of Verilog: what Yosys would read, without comments.

use std::rc::Rc;

use nbc_base::source::VerilogFault;

/// The kinds of tokens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum VerilogTokenKind {
    /// A name or a keyword.
    Word,
    /// A name after a backslash, up to a space.
    Escaped,
    /// A number without a base.
    Number,
    /// A number with a base from its quote on, or a single digit after a quote.
    Based,
    /// A text in quotes.
    Quoted,
    /// `$` and a name.
    System,
    /// A backquote and a name: a directive or a macro.
    Directive,
    /// A comment with an instruction for synthesizers, such as `synopsys full_case`.
    Hint,
    /// Any other character.
    Sign,
}

/// A place in one of the files that are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct TokenPlace {
    pub(super) file: u32,
    /// From 1.
    pub(super) line: u32,
}

/// A token and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct VerilogToken {
    pub(super) kind: VerilogTokenKind,
    pub(super) text: String,
    /// Whether anything stands between it and the token before.
    pub(super) is_spaced: bool,
    pub(super) place: TokenPlace,
}

impl VerilogToken {
    pub(super) fn is_sign(&self, sign: &str) -> bool {
        self.kind == VerilogTokenKind::Sign && self.text == sign
    }
}

/// The tokens of a text, one after the other.
#[derive(Debug)]
pub(super) struct Lexer {
    text: Rc<str>,
    at: usize,
    place: TokenPlace,
}

impl Lexer {
    /// The tokens of a text whose first line is at `place`.
    pub(super) fn new(text: impl Into<Rc<str>>, place: TokenPlace) -> Self {
        Self { text: text.into(), at: 0, place }
    }

    /// The place that was reached.
    pub(super) fn place(&self) -> TokenPlace {
        self.place
    }

    /// The byte that was reached.
    pub(super) fn offset(&self) -> usize {
        self.at
    }

    /// The next token; `None` at the end.
    ///
    /// # Errors
    /// At a comment or a text without an end, or a character that no Verilog has.
    pub(super) fn next(&mut self) -> Result<Option<VerilogToken>, VerilogFault> {
        let from = self.at;
        loop {
            self.skip_space();
            let rest = &self.text[self.at..];
            let comment = match rest.as_bytes() {
                [b'/', b'/', ..] => rest.find(['\n', '\r']).unwrap_or(rest.len()),
                [b'/', b'*', ..] => 4 + rest[2..].find("*/").ok_or(VerilogFault::OpenComment)?,
                _ => break,
            };
            let hint = hint(&rest[..comment]);
            let place = self.place;
            self.advance(comment);
            if let Some(text) = hint {
                return Ok(Some(VerilogToken { kind: VerilogTokenKind::Hint, text, is_spaced: true, place }));
            }
        }
        let rest = &self.text[self.at..];
        let Some(first) = rest.chars().next() else { return Ok(None) };
        let (kind, length) = token(rest, first)?;
        let (text, is_spaced, place) = (rest[..length].to_owned(), self.at > from || from == 0, self.place);
        self.advance(length);
        Ok(Some(VerilogToken { kind, text, is_spaced, place }))
    }

    /// The rest of the line without comments. A line that ends with a backslash goes on in the next.
    ///
    /// # Errors
    /// At a comment without an end.
    pub(super) fn rest_of_line(&mut self) -> Result<String, VerilogFault> {
        let mut line = String::new();
        loop {
            let rest = &self.text[self.at..];
            let length = match rest.as_bytes() {
                [] | [b'\n' | b'\r', ..] => return Ok(line),
                [b'\\', b'\r', b'\n', ..] => 3,
                [b'\\', b'\n', ..] => 2,
                [b'/', b'/', ..] => rest.find(['\n', '\r']).unwrap_or(rest.len()),
                [b'/', b'*', ..] => 4 + rest[2..].find("*/").ok_or(VerilogFault::OpenComment)?,
                [b'"', ..] => {
                    let length = quoted(rest)?;
                    line.push_str(&rest[..length]);
                    self.advance(length);
                    continue;
                }
                _ => {
                    let first = rest.chars().next().expect("the rest is not empty");
                    line.push(first);
                    self.at += first.len_utf8();
                    continue;
                }
            };
            line.push(' ');
            self.advance(length);
        }
    }

    fn skip_space(&mut self) {
        let rest = &self.text[self.at..];
        self.advance(rest.find(|c: char| !is_space(c)).unwrap_or(rest.len()));
    }

    fn advance(&mut self, length: usize) {
        let lines = self.text[self.at..self.at + length].bytes().filter(|&byte| byte == b'\n').count();
        self.place.line += lines as u32;
        self.at += length;
    }
}

fn is_space(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\n' | '\r' | '\u{b}' | '\u{c}')
}

fn is_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || matches!(c, '_' | '$')
}

/// The length of the characters at the start for which `is` holds.
fn run(rest: &str, is: impl Fn(char) -> bool) -> usize {
    rest.find(|c| !is(c)).unwrap_or(rest.len())
}

fn token(rest: &str, first: char) -> Result<(VerilogTokenKind, usize), VerilogFault> {
    Ok(match first {
        'a'..='z' | 'A'..='Z' | '_' => (VerilogTokenKind::Word, run(rest, is_word)),
        '0'..='9' => (VerilogTokenKind::Number, number(rest)),
        '\'' => based(rest).map_or((VerilogTokenKind::Sign, 1), |length| (VerilogTokenKind::Based, length)),
        '"' => (VerilogTokenKind::Quoted, quoted(rest)?),
        '$' => (VerilogTokenKind::System, 1 + run(&rest[1..], is_word)),
        '`' if rest.starts_with("``") => (VerilogTokenKind::Directive, 2),
        '`' => (VerilogTokenKind::Directive, 1 + run(&rest[1..], is_word)),
        '\\' => (VerilogTokenKind::Escaped, escaped(rest)?),
        c if c.is_ascii_graphic() => (VerilogTokenKind::Sign, 1),
        character => return Err(VerilogFault::Character { character }),
    })
}

/// The length of a number without a base. A point between digits belongs to it, and so does an exponent. Letters after
/// it are a word, as they are for Yosys.
fn number(rest: &str) -> usize {
    let digits = |at: usize| run(&rest[at..], |c| c.is_ascii_digit() || c == '_');
    let mut length = digits(0);
    if rest[length..].starts_with('.') && rest[length + 1..].starts_with(|c: char| c.is_ascii_digit()) {
        length += 1 + digits(length + 1);
    }
    let sign = run(&rest[length..], |c| matches!(c, 'e' | 'E')).min(1);
    match digits(length + sign) {
        exponent if sign == 1 && exponent > 0 => length + 1 + exponent,
        _ => length,
    }
}

/// The length of a base and its digits, or of a single digit after a quote.
fn based(rest: &str) -> Option<usize> {
    let sign = 1 + run(&rest[1..], |c| matches!(c, 's' | 'S')).min(1);
    if rest[sign..].starts_with(['b', 'B', 'o', 'O', 'd', 'D', 'h', 'H']) {
        let space = run(&rest[sign + 1..], is_space);
        let digits = run(&rest[sign + 1 + space..], |c| c.is_ascii_hexdigit() || "xXzZ?_".contains(c));
        return Some(if digits > 0 { sign + 1 + space + digits } else { sign + 1 });
    }
    rest[1..].starts_with(['0', '1', 'x', 'X', 'z', 'Z']).then_some(2)
}

/// The length of a text in quotes, which ends in its line.
fn quoted(rest: &str) -> Result<usize, VerilogFault> {
    let mut characters = rest.char_indices().skip(1);
    while let Some((at, c)) = characters.next() {
        match c {
            '"' => return Ok(at + 1),
            '\\' => match characters.next() {
                Some((_, escaped)) if !escaped.is_control() => {}
                _ => break,
            },
            '\t' => {}
            c if c.is_control() => break,
            _ => {}
        }
    }
    Err(VerilogFault::OpenQuote)
}

/// The length of a name after a backslash. Yosys must not see a comment, a text or a macro in it.
fn escaped(rest: &str) -> Result<usize, VerilogFault> {
    let length = run(rest, |c| !is_space(c));
    let name = &rest[..length];
    let strange = name.chars().find(|&c| c.is_control() || matches!(c, '`' | '"'));
    let comment = (name.contains("//") || name.contains("/*")).then_some('/');
    match strange.or(comment) {
        Some(character) => Err(VerilogFault::Character { character }),
        None => Ok(length),
    }
}

/// The instruction for synthesizers in a comment, in one form; `None` for other comments.
fn hint(comment: &str) -> Option<String> {
    let mut words = comment[2..].trim_end_matches("*/").split_ascii_whitespace();
    let is_hint = matches!(words.next(), Some("synopsys" | "synthesis"));
    let known = ["full_case", "parallel_case", "translate_off", "translate_on"];
    let words: Vec<&str> = words.take_while(|word| is_hint && known.contains(word)).collect();
    (!words.is_empty()).then(|| format!("/* synopsys {} */", words.join(" ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Result<Vec<(VerilogTokenKind, String)>, VerilogFault> {
        let mut lexer = Lexer::new(text, TokenPlace::default());
        let mut tokens = Vec::new();
        while let Some(token) = lexer.next()? {
            tokens.push((token.kind, token.text));
        }
        Ok(tokens)
    }

    #[test]
    fn a_text_is_split_as_yosys_splits_it() {
        use VerilogTokenKind::{Based, Directive, Escaped, Hint, Number, Quoted, Sign, System, Word};
        let cases: [(&str, &[(VerilogTokenKind, &str)]); 10] = [
            ("a_1$b /* c */+\\d[0] ", &[(Word, "a_1$b"), (Sign, "+"), (Escaped, "\\d[0]")]),
            ("4 'sb1?z_0", &[(Number, "4"), (Based, "'sb1?z_0")]),
            ("'h ff'z'{", &[(Based, "'h ff"), (Based, "'z"), (Sign, "'"), (Sign, "{")]),
            (
                "1.5e3 x[1].y",
                &[(Number, "1.5e3"), (Word, "x"), (Sign, "["), (Number, "1"), (Sign, "]"), (Sign, "."), (Word, "y")],
            ),
            ("\"a\\\"//b\" // c\n d", &[(Quoted, "\"a\\\"//b\""), (Word, "d")]),
            ("$signed/**/x", &[(System, "$signed"), (Word, "x")]),
            (
                "`a `b``c``d",
                &[(Directive, "`a"), (Directive, "`b"), (Directive, "``"), (Word, "c"), (Directive, "``"), (Word, "d")],
            ),
            ("//  synthesis full_case parallel_case now\n", &[(Hint, "/* synopsys full_case parallel_case */")]),
            ("'b", &[(Based, "'b")]),
            (
                "1import 2e3f 4_0e",
                &[(Number, "1"), (Word, "import"), (Number, "2e3"), (Word, "f"), (Number, "4_0"), (Word, "e")],
            ),
        ];
        for (text, expected) in cases {
            let expected: Vec<_> = expected.iter().map(|(kind, text)| (*kind, (*text).to_owned())).collect();
            assert_eq!(tokens(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn what_yosys_could_read_otherwise_is_a_fault() {
        assert_eq!(tokens("a /* b"), Err(VerilogFault::OpenComment));
        assert_eq!(tokens("\"a\nb\""), Err(VerilogFault::OpenQuote));
        for (text, character) in [("a\0b", '\0'), ("é", 'é'), ("\\a`b ", '`'), ("\\a/*b ", '/'), ("\\a\"b ", '"')] {
            assert_eq!(tokens(text), Err(VerilogFault::Character { character }), "{text}");
        }
    }

    #[test]
    fn a_line_is_read_without_comments_and_goes_on_after_a_backslash() {
        let mut lexer = Lexer::new(" a /* b\nc */ d \\\n e \"//\" // f\ng", TokenPlace { file: 0, line: 1 });
        assert_eq!(lexer.rest_of_line().unwrap(), " a   d   e \"//\"  ");
        assert_eq!(lexer.place().line, 3);
        assert_eq!(lexer.next().unwrap().unwrap().text, "g");
    }
}
