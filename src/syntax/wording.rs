//! What can be wrong with the text of a program, as data, and how it is worded.

use crate::diag::{Code, Diagnostic, Fix, Suggestion, suggest};
use crate::source::Span;
use crate::syntax::split::KEYWORDS;

/// How to keep a text short.
const REPEAT: &str = "use `for` and circuits for parts that repeat";

/// How to keep expressions flat.
const NAME_PARTS: &str = "name inner parts: `t = …`";

/// A text that does not follow the grammar.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum SyntaxError {
    /// Too much text.
    TooLarge { bytes: usize, most: u64 },
    /// A zero byte.
    ZeroByte,
    /// A declaration that is nested too deeply.
    TooDeep { depth: usize, most: usize },
    /// Nesting above the limit of the parser itself.
    TooDeepHere,
    /// A declaration of too many words.
    TooLong { words: usize, most: usize },
    /// A text that is not the name of a circuit with its parameters.
    NotAnInstance { text: String },
    /// An unexpected word or sign; `expected` describes the valid ones.
    Unexpected { found: String, expected: String },
    /// An unexpected word at the start of a declaration.
    UnexpectedDeclaration { found: String, meant: Suggestion },
    /// A line that ends too early.
    EndOfLine { expected: String },
    /// A declaration that ends too early.
    EndOfDeclaration { expected: String },
    /// A bracket that is not closed.
    UnclosedBracket,
    /// Two operators without an order of precedence.
    Ambiguous { operators: [&'static str; 2], first: Span, readings: [String; 2] },
}

impl SyntaxError {
    /// The error at its place.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::TooLarge { bytes, most } => {
                let message = format!("source file of {} MB is too large", bytes >> 20);
                let label = format!("expected at most {} MB", most >> 20);
                Diagnostic::new(Code::Unreadable, message, span, label)
                    .with_help(format!("split it into several files, or {REPEAT}"))
            }
            Self::ZeroByte => Diagnostic::new(Code::Unreadable, "file is not text", span, "found a zero byte")
                .with_help("source files are UTF-8 text"),
            Self::TooDeep { depth, most } => {
                let label = format!("expected at most {most} levels in a declaration");
                Diagnostic::new(Code::Nesting, format!("brackets are nested {depth} levels deep"), span, label)
                    .with_help(NAME_PARTS)
            }
            Self::TooDeepHere => {
                Diagnostic::new(Code::Nesting, "text is nested too deeply", span, "at this point").with_help(NAME_PARTS)
            }
            Self::TooLong { words, most } => {
                let message = format!("declaration of {words} words and signs is too long");
                Diagnostic::new(Code::TooLarge, message, span, format!("expected at most {most}"))
                    .with_help(format!("split it, or {REPEAT}"))
            }
            Self::NotAnInstance { text } => {
                let message = format!("`{text}` is not the name of a circuit");
                Diagnostic::new(Code::Syntax, message, span, "expected a name")
                    .with_help("write parameters in brackets: `adder[8]` or `adder[n = 8]`")
            }
            Self::Unexpected { found, expected } => unexpected(&found, span, expected),
            Self::UnexpectedDeclaration { found, meant } => {
                let error = unexpected(&found, span, "expected a declaration");
                match meant {
                    Suggestion::Near(_) => error.with_suggestion(span, &meant),
                    _ => error.with_help(format!("declarations begin with {}", suggest::alternatives(&KEYWORDS, "or"))),
                }
            }
            Self::EndOfLine { expected } => Diagnostic::new(Code::Syntax, "unexpected end of line", span, expected),
            Self::EndOfDeclaration { expected } => {
                Diagnostic::new(Code::Syntax, "unexpected end of declaration", span, expected)
            }
            Self::UnclosedBracket => {
                let label = "opened here, and still open at the end of the declaration";
                Diagnostic::new(Code::Syntax, "unclosed bracket", span, label)
                    .with_help("close it; a keyword in the first column begins a new declaration")
            }
            Self::Ambiguous { operators: [before, after], first, readings: [left, right] } => {
                let message = format!("`{before}` and `{after}` side by side can be read in two ways");
                Diagnostic::new(Code::Ambiguous, message, span, "or this one first?")
                    .with_label(first, "this one first?")
                    .with_help(format!("write `{left}` or `{right}`"))
            }
        }
    }
}

/// An unexpected word or sign at `span`.
fn unexpected(found: &str, span: Span, expected: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Code::Syntax, format!("unexpected `{found}`"), span, expected)
}

/// A habit from another language or a common mistake, whose meaning is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Slip {
    /// A comment that begins with `/*`.
    BlockComment,
    /// A name with invalid letters.
    ForeignLetters { word: String },
    /// A quote that is not closed.
    UnclosedQuote,
    /// A string in single quotes; `close` is the second of them.
    SingleQuote { close: Option<Span> },
    /// A keyword as a name.
    ReservedWord { word: String },
    /// `:` in the bits of a net.
    ColonInSlice { net: String, high: String, low: String },
    /// `[7:0]` after a port's name; `range` is the text in the brackets.
    RangeOfPort { port: String, width: Option<u64>, range: Span },
    /// `[7:0]` before a name; `both` covers the two.
    WidthBeforeName { name: String, width: String, both: Option<Span> },
    /// `input` or `wire` before a port; `both` covers the two.
    KindOfPort { kind: String, port: String, both: Span },
    /// A choice with `?` and `:`.
    QuestionMark { condition: String, then: String, otherwise: String },
    /// A constant whose width is a sum; `zero` covers it where all its bits are 0.
    WidthOfConstant { width: String, digits: String, zero: Option<Span> },
    /// Nets in braces before `=`.
    NetsInBraces { nets: String, bits: Vec<String> },
    /// A space between a name and its operands.
    SpaceBeforeOperands { name: String, operands: String },
    /// A word that is nearly an operator.
    MisspelledOperator { word: String, operator: String },
    /// Two operands without an operator.
    MissingOperator { found: String },
    /// A pattern with spaces; `whole` covers it.
    SpaceInPattern { found: String, pattern: String, whole: Span },
    /// Two entries of a list without a comma; `before` is the first of them.
    MissingComma { before: Option<(String, Span)>, found: String, close: char },
    /// `module` or `fn` for a circuit.
    CircuitKeyword { word: String },
    /// A sign that ends a statement in other languages.
    StatementEnd { sign: String },
    /// `assign` or `wire` before a statement.
    StatementKeyword { word: String },
    /// `<=`, `:=` or `:` for `=`.
    DriveSign { sign: String },
    /// `=` for `:` in a record.
    FieldSign { field: String },
    /// `~` or `!` for `not`.
    NotSign { sign: String },
    /// `&` for `and`, and the like; `text` is the operator with the spaces that it needs.
    OperatorSign { sign: String, operator: &'static str, text: String },
    /// A base other than `d` before a computed value.
    BaseOfComputed { base: char },
    /// Parameters after a net.
    ParametersOfNet,
    /// A slice where a circuit has its parameters.
    SliceOfCircuit,
}

impl Slip {
    /// The slip at its place, with what to write instead.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        let error = Diagnostic::new(Code::Syntax, self.message(), span, self.label());
        let error = match self.help() {
            Some(help) => error.with_help(help),
            None => error,
        };
        error.with_fix(self.fix(span))
    }

    fn message(&self) -> String {
        let found = match self {
            Self::ForeignLetters { word } => return format!("`{word}` is not a valid name"),
            Self::UnclosedQuote => return "unclosed string".to_owned(),
            Self::ReservedWord { word } => return format!("`{word}` is a reserved word"),
            Self::SpaceBeforeOperands { .. } => return "unexpected space before `(`".to_owned(),
            Self::ParametersOfNet => return "unexpected parameters".to_owned(),
            Self::BlockComment => "/*",
            Self::SingleQuote { .. } | Self::WidthOfConstant { .. } => "'",
            Self::ColonInSlice { .. } | Self::RangeOfPort { .. } => ":",
            Self::WidthBeforeName { .. } => "[",
            Self::QuestionMark { .. } => "?",
            Self::NetsInBraces { .. } => "{",
            Self::FieldSign { .. } => "=",
            Self::SliceOfCircuit => "..",
            Self::BaseOfComputed { base } => return format!("unexpected `{base}`"),
            Self::KindOfPort { kind: word, .. }
            | Self::MisspelledOperator { word, .. }
            | Self::MissingOperator { found: word }
            | Self::SpaceInPattern { found: word, .. }
            | Self::MissingComma { found: word, .. }
            | Self::CircuitKeyword { word }
            | Self::StatementKeyword { word } => word,
            Self::StatementEnd { sign }
            | Self::DriveSign { sign }
            | Self::NotSign { sign }
            | Self::OperatorSign { sign, .. } => sign,
        };
        format!("unexpected `{found}`")
    }

    fn label(&self) -> String {
        let label = match self {
            Self::BlockComment => "expected a comment that begins with `//`",
            Self::ForeignLetters { .. } => "expected the letters `a` to `z`, digits and `_`",
            Self::UnclosedQuote => "opened here",
            Self::SingleQuote { .. } => "expected `\"`",
            Self::ReservedWord { .. } | Self::WidthBeforeName { .. } => "expected a name",
            Self::ColonInSlice { .. } => "expected `..`",
            Self::RangeOfPort { .. } => "expected `]`",
            Self::KindOfPort { .. } => "expected the name of a port",
            Self::QuestionMark { .. } | Self::MisspelledOperator { .. } => "expected an operator",
            Self::WidthOfConstant { .. } => "expected a number or a name as the width of a constant",
            Self::NetsInBraces { .. } => "expected a net, or nets in parentheses, before `=`",
            Self::SpaceBeforeOperands { .. } => "expected no space here",
            Self::MissingOperator { .. } => "expected an operator or a new line",
            Self::SpaceInPattern { .. } | Self::FieldSign { .. } => "expected `:`",
            Self::CircuitKeyword { .. } => "expected `circuit`",
            Self::StatementEnd { .. } | Self::StatementKeyword { .. } => "expected a statement",
            Self::DriveSign { .. } => "expected `=`",
            Self::NotSign { .. } => "expected `not`",
            Self::BaseOfComputed { .. } => "expected `d` before a computed value",
            Self::ParametersOfNet => "expected a bit or a slice",
            Self::SliceOfCircuit => "expected parameters",
            Self::MissingComma { close, .. } => return format!("expected `,` or `{close}`"),
            Self::OperatorSign { operator, .. } => return format!("expected `{operator}`"),
        };
        label.to_owned()
    }

    fn help(&self) -> Option<String> {
        Some(match self {
            Self::BlockComment => "a comment runs from `//` to the end of its line".to_owned(),
            Self::ForeignLetters { .. } => "write it with ASCII letters".to_owned(),
            Self::UnclosedQuote => "close it with `\"` on the same line".to_owned(),
            Self::SingleQuote { .. } => "write strings in double quotes".to_owned(),
            Self::ReservedWord { word } => format!("choose another name, for example `{word}_1`"),
            Self::ColonInSlice { net, high, low } => format!("write `{net}[{high}..{low}]`"),
            Self::RangeOfPort { port, width, .. } => {
                format!("a port gives its number of bits: `{port}[{}]`", width.unwrap_or(8))
            }
            Self::WidthBeforeName { name, width, .. } => format!("write the width after the name: `{name}[{width}]`"),
            Self::KindOfPort { port, .. } => format!("write only the name: `{port}`"),
            Self::QuestionMark { condition, then, otherwise } => {
                format!("write `if {condition} then {then} else {otherwise}`")
            }
            Self::WidthOfConstant { width, zero: Some(_), .. } => format!("repeat a zero: `{{({width}){{0}}}}`"),
            Self::WidthOfConstant { width, digits, zero: None } => {
                format!("give the width a name, as in `circuit name[w = {width}](…)`, and write `w'd{digits}`")
            }
            Self::NetsInBraces { nets, bits } => {
                let bits = suggest::alternatives(bits, "and");
                format!(
                    "for a circuit's outputs, write `({nets}) = …`; for bits of a value, write `t = …`, then {bits}"
                )
            }
            Self::SpaceBeforeOperands { name, operands } => format!("write `{name}{operands}`"),
            Self::MisspelledOperator { operator, .. } => format!("did you mean `{operator}`?"),
            Self::MissingOperator { .. } => return None,
            Self::SpaceInPattern { pattern, .. } => format!("write patterns without spaces: `{pattern}`"),
            Self::MissingComma { before, found, .. } => format!("write `{}, {found}`", before.as_ref()?.0),
            Self::CircuitKeyword { .. } => "write `circuit name(inputs) -> (outputs) { … }`".to_owned(),
            Self::StatementEnd { sign } => format!("a statement ends with its line; leave out the `{sign}`"),
            Self::StatementKeyword { word } => help_for_statement(word).to_owned(),
            Self::DriveSign { .. } => "drive a net with `=`".to_owned(),
            Self::FieldSign { field } => format!("write `{field}: …`"),
            Self::NotSign { .. } => "write `not`".to_owned(),
            Self::OperatorSign { operator, .. } => format!("write `{operator}`"),
            Self::BaseOfComputed { .. } => "write `'d(…)`".to_owned(),
            Self::ParametersOfNet => "a bit is `a[3]`, a slice is `a[7..4]`; the parameters of a circuit stand \
                                      before its operands: `add[8](a, b)`"
                .to_owned(),
            Self::SliceOfCircuit => "separate parameters with commas: `register[4, 0](d, clk)`".to_owned(),
        })
    }

    /// The fix, if it is certain; `here` is the slip's place.
    fn fix(&self, here: Span) -> Option<Fix> {
        Some(match self {
            Self::SingleQuote { close } => {
                let [mut first, second] = [here, (*close)?].map(|quote| Fix::replace(quote, "\""));
                first.edits.extend(second.edits);
                first
            }
            Self::ColonInSlice { .. } => Fix::replace(here, ".."),
            Self::RangeOfPort { width, range, .. } => Fix::replace(*range, (*width)?.to_string()),
            Self::WidthBeforeName { name, width, both } => Fix::replace((*both)?, format!("{name}[{width}]")),
            Self::KindOfPort { port, both, .. } => Fix::replace(*both, port.as_str()),
            Self::WidthOfConstant { width, zero, .. } => Fix::replace((*zero)?, format!("{{({width}){{0}}}}")),
            Self::SpaceBeforeOperands { .. } => Fix::remove(here, "the space"),
            Self::MisspelledOperator { operator, .. } => Fix::replace(here, operator.as_str()),
            Self::SpaceInPattern { pattern, whole, .. } => Fix::replace(*whole, pattern.as_str()),
            Self::MissingComma { before, .. } => {
                let end = before.as_ref()?.1.end;
                Fix::insert(Span { start: end, end, ..here }, ",")
            }
            Self::StatementEnd { sign } if sign == ";" => Fix::remove(here, "the `;`"),
            Self::DriveSign { .. } => Fix::replace(here, "="),
            Self::FieldSign { .. } => Fix::replace(here, ":"),
            Self::NotSign { .. } => Fix::replace(here, "not "),
            Self::OperatorSign { text, .. } => Fix::replace(here, text.as_str()),
            _ => return None,
        })
    }
}

/// The replacement of a word that begins a statement in other languages.
fn help_for_statement(word: &str) -> &'static str {
    match word {
        "wire" | "logic" | "signal" => {
            "driving a net declares it: `t = a and b`; to declare its width, write `net t[8]`"
        }
        "reg" => "for state, write a feedback loop, `q init 0 = …`, or use a register, `q = register(d, clk)`",
        _ => "write `name = expression`",
    }
}
