//! What can be wrong with the text of a program, as data, and how it is worded.

use crate::syntax::split::KEYWORDS;
use nbc_base::diag::{Code, Diagnostic, Fix, Suggestion, suggest};
use nbc_base::source::Span;

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
    TooDeep { depth: usize, most: u64 },
    /// Nesting above the limit of the parser itself.
    TooDeepHere,
    /// A declaration of too many words.
    TooLong { words: usize, most: u64 },
    /// A name of too many bytes in a declaration.
    LongName { bytes: usize, most: u64 },
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
    UnclosedBracket { is_declaration: bool },
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
            Self::LongName { bytes, most } => {
                let message = format!("a name of {bytes} bytes is too long");
                Diagnostic::new(Code::TooLarge, message, span, format!("expected at most {most} in this declaration"))
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
            Self::UnclosedBracket { is_declaration } => {
                let (end, help) = match is_declaration {
                    true => ("declaration", "close it; a keyword in the first column begins a new declaration"),
                    false => ("statement", "close it"),
                };
                let label = format!("opened here, and still open at the end of the {end}");
                Diagnostic::new(Code::Syntax, "unclosed bracket", span, label).with_help(help)
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
    /// A comment that begins with `#` or `/*`; `replacement` is the same comment in this language.
    ForeignComment { sign: &'static str, replacement: Option<String> },
    /// Outputs without parentheses.
    BareOutputs { outputs: String },
    /// A keyword of another language before nets; `whole` covers both.
    NetKeyword { word: String, nets: String, whole: Span },
    /// `init` where a net is declared.
    StartOfNet { net: String },
    /// `:` in the range of a loop.
    ColonInLoop,
    /// `if` with statements in braces, and the choices that it means, if they are certain; `whole` covers it.
    IfBlock { choices: Vec<String>, whole: Span },
    /// A choice whose first value is in braces.
    MissingThen,
    /// A name with invalid letters.
    ForeignLetters { word: String },
    /// A quote that is not closed.
    UnclosedQuote,
    /// A string in single quotes; `close` is the second of them.
    SingleQuote { close: Option<Span> },
    /// A keyword as a name.
    ReservedWord { word: String },
    /// `:` in the bits of a net.
    ColonInSlice { net: String, slice: String, index: Span },
    /// `[7:0]` after a port's name.
    RangeOfPort { port: String, width: String },
    /// `[7:0]` before a name; `both` covers the two.
    WidthBeforeName { name: String, width: String, both: Span },
    /// `input` or `wire` before a port; `before` covers it with the space after it.
    KindOfPort { kind: String, before: Span },
    /// A choice with `?` and `:`; `whole` covers it.
    QuestionMark { condition: String, then: String, otherwise: String, whole: Span },
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
    /// A `-` before an operand; what to write instead, and where, if that is certain.
    Sign { instead: Option<(Span, String)> },
    /// Two entries of a list without a comma; `before` is the first of them.
    MissingComma { before: Option<(String, Span)>, found: String, close: char },
    /// `module` or `fn` for a circuit; the rest may be as it should.
    CircuitKeyword { word: String, is_circuit: bool },
    /// A sign that ends a statement in other languages.
    StatementEnd { sign: String },
    /// `assign` or `wire` before a statement; `whole` covers it with the space after it.
    StatementKeyword { word: String, whole: Span },
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
    /// A value where a circuit has its parameters.
    ValueForParameter,
}

impl Slip {
    /// A comment of another language, with the text after it.
    pub(crate) fn foreign_comment(comment: &str, after: &str) -> Self {
        if let Some(text) = comment.strip_prefix('#') {
            return Self::ForeignComment { sign: "#", replacement: Some(format!("//{text}")) };
        }
        let inner = comment.strip_prefix("/*").and_then(|rest| rest.strip_suffix("*/"));
        let replacement = inner.map(|inner| {
            let lines: Vec<_> = inner.lines().map(|line| format!("// {}", line.trim()).trim_end().to_owned()).collect();
            let ends_line = after.trim_start_matches([' ', '\t']).starts_with(['\n', '\r']) || after.trim().is_empty();
            lines.join("\n") + if ends_line { "" } else { "\n" }
        });
        Self::ForeignComment { sign: "/*", replacement }
    }

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
            Self::ForeignComment { sign, .. } => sign,
            Self::BareOutputs { outputs } => {
                outputs.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default()
            }
            Self::StartOfNet { .. } => "init",
            Self::ColonInLoop => ":",
            Self::IfBlock { .. } => "if",
            Self::MissingThen => "{",
            Self::Sign { .. } => "-",
            Self::SingleQuote { .. } | Self::WidthOfConstant { .. } => "'",
            Self::ColonInSlice { .. } | Self::RangeOfPort { .. } => ":",
            Self::WidthBeforeName { .. } => "[",
            Self::QuestionMark { .. } => "?",
            Self::NetsInBraces { .. } => "{",
            Self::FieldSign { .. } => "=",
            Self::SliceOfCircuit => "..",
            Self::ValueForParameter => "[",
            Self::BaseOfComputed { base } => return format!("unexpected `{base}`"),
            Self::KindOfPort { kind: word, .. }
            | Self::MisspelledOperator { word, .. }
            | Self::MissingOperator { found: word }
            | Self::SpaceInPattern { found: word, .. }
            | Self::MissingComma { found: word, .. }
            | Self::CircuitKeyword { word, .. }
            | Self::NetKeyword { word, .. }
            | Self::StatementKeyword { word, .. } => word,
            Self::StatementEnd { sign }
            | Self::DriveSign { sign }
            | Self::NotSign { sign }
            | Self::OperatorSign { sign, .. } => sign,
        };
        format!("unexpected `{found}`")
    }

    fn label(&self) -> String {
        let label = match self {
            Self::ForeignComment { .. } => "expected a comment that begins with `//`",
            Self::ForeignLetters { .. } => "expected the letters `a` to `z`, digits and `_`",
            Self::UnclosedQuote => "opened here",
            Self::SingleQuote { .. } => "expected `\"`",
            Self::ReservedWord { .. } | Self::WidthBeforeName { .. } => "expected a name",
            Self::ColonInSlice { .. } | Self::ColonInLoop => "expected `..`",
            Self::BareOutputs { .. } => "expected outputs in parentheses",
            Self::NetKeyword { .. } => "expected `net`",
            Self::StartOfNet { .. } => "expected `,` or a new line",
            Self::MissingThen => "expected `then`",
            Self::RangeOfPort { .. } => "expected a number of bits",
            Self::KindOfPort { .. } => "expected the name of a port",
            Self::QuestionMark { .. } | Self::MisspelledOperator { .. } => "expected an operator",
            Self::WidthOfConstant { .. } => "expected a number or a name as the width of a constant",
            Self::NetsInBraces { .. } => "expected a net, or nets in parentheses, before `=`",
            Self::SpaceBeforeOperands { .. } => "expected no space here",
            Self::MissingOperator { .. } => "expected an operator or a new line",
            Self::SpaceInPattern { .. } | Self::FieldSign { .. } => "expected `:`",
            Self::CircuitKeyword { .. } => "expected `circuit`",
            Self::StatementEnd { .. } | Self::StatementKeyword { .. } | Self::IfBlock { .. } => "expected a statement",
            Self::DriveSign { .. } => "expected `=`",
            Self::NotSign { .. } => "expected `not`",
            Self::Sign { .. } => "values have no sign",
            Self::BaseOfComputed { .. } => "expected `d` before a computed value",
            Self::ParametersOfNet => "expected a bit or a slice",
            Self::SliceOfCircuit => "expected parameters",
            Self::ValueForParameter => "expected an integer",
            Self::MissingComma { close, .. } => return format!("expected `,` or `{close}`"),
            Self::OperatorSign { operator, .. } => return format!("expected `{operator}`"),
        };
        label.to_owned()
    }

    fn help(&self) -> Option<String> {
        Some(match self {
            Self::ForeignComment { .. } => "a comment runs from `//` to the end of its line".to_owned(),
            Self::BareOutputs { outputs } => format!("write `-> ({outputs})`"),
            Self::NetKeyword { word, .. } => help_for_statement(word).to_owned(),
            Self::StartOfNet { net } => {
                format!("write the start value where the net is driven: `{net} init 0 = …`")
            }
            Self::ColonInLoop => "write `for i in 0..8 { … }`; the end is not included".to_owned(),
            Self::IfBlock { choices, .. } => match &choices[..] {
                [choice] if choice.len() < 60 => format!("`if` chooses a value: `{choice}`"),
                _ => "`if` chooses a value, and needs an `else`: `q = if s then a else b`".to_owned(),
            },
            Self::MissingThen => "write `if s then a else b`".to_owned(),
            Self::ForeignLetters { .. } => "write it with ASCII letters".to_owned(),
            Self::UnclosedQuote => "close it with `\"` on the same line".to_owned(),
            Self::SingleQuote { .. } => "write strings in double quotes".to_owned(),
            Self::ReservedWord { word } => format!("choose another name, for example `{word}_1`"),
            Self::ColonInSlice { net, slice, .. } => format!("write `{net}{slice}`, the highest bit first"),
            Self::RangeOfPort { port, width, .. } => {
                format!("write the number of bits: `{port}[{width}]`")
            }
            Self::WidthBeforeName { name, width, .. } => format!("write the width after the name: `{name}[{width}]`"),
            Self::KindOfPort { .. } => "write only the name, and the width after it".to_owned(),
            Self::QuestionMark { condition, then, otherwise, .. } => {
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
            Self::CircuitKeyword { is_circuit: true, .. } => "write `circuit`".to_owned(),
            Self::CircuitKeyword { .. } => "write `circuit name(inputs) -> (outputs) { … }`".to_owned(),
            Self::StatementEnd { sign } => format!("a statement ends with its line; leave out the `{sign}`"),
            Self::StatementKeyword { word, .. } => help_for_statement(word).to_owned(),
            Self::DriveSign { .. } => "drive a net with `=`".to_owned(),
            Self::FieldSign { field } => format!("write `{field}: …`"),
            Self::NotSign { .. } => "write `not`".to_owned(),
            Self::Sign { instead } => {
                let text = instead.as_ref().map_or("(0 - a)", |(_, text)| text);
                format!("write `{text}`: results wrap, so it is the two's complement")
            }
            Self::OperatorSign { operator, .. } => format!("write `{operator}`"),
            Self::BaseOfComputed { .. } => "write `'d(…)`".to_owned(),
            Self::ParametersOfNet => "a bit is `a[3]`, a slice is `a[7..4]`; the parameters of a circuit stand \
                                      before its operands: `add[8](a, b)`"
                .to_owned(),
            Self::SliceOfCircuit => "separate parameters with commas: `register[4, 0](d, clk)`".to_owned(),
            Self::ValueForParameter => "parameters are integers that are known when the circuit is built; a value of \
                                        nets is an operand, in parentheses"
                .to_owned(),
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
            Self::ColonInSlice { slice, index, .. } => Fix::replace(*index, slice.as_str()),
            Self::RangeOfPort { width, .. } => Fix::replace(here, format!("[{width}]")),
            Self::ForeignComment { replacement, .. } => Fix::replace(here, replacement.as_ref()?.as_str()),
            Self::BareOutputs { outputs } => Fix::replace(here, format!("({outputs})")),
            Self::NetKeyword { nets, whole, .. } => Fix::replace(*whole, format!("net {nets}")),
            Self::ColonInLoop => Fix::replace(here, ".."),
            Self::IfBlock { choices, whole } if !choices.is_empty() => Fix::replace(*whole, choices.join("\n    ")),
            Self::QuestionMark { condition, then, otherwise, whole } => {
                Fix::replace(*whole, format!("if {condition} then {then} else {otherwise}"))
            }
            Self::MissingThen => Fix::insert(here, "then "),
            Self::CircuitKeyword { is_circuit: true, .. } => Fix::replace(here, "circuit"),
            Self::StatementKeyword { word, whole } => Fix::remove(*whole, &format!("`{word}`")),
            Self::WidthBeforeName { name, width, both } => Fix::replace(*both, format!("{name}[{width}]")),
            Self::KindOfPort { kind, before } => Fix::remove(*before, &format!("`{kind}`")),
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
            Self::Sign { instead } => {
                let (span, text) = instead.as_ref()?;
                Fix::replace(*span, text.as_str())
            }
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
