//! Names: unknown ones, repeated ones, and names of something else.

use nbc_base::diag::{Code, Diagnostic, Fix, Suggestion};
use nbc_base::source::Span;

/// A name that is unknown, declared twice, or of another kind than expected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum NameError {
    /// An unknown name.
    Unknown { kind: &'static str, name: String, meant: Suggestion },
    /// A circuit that is an operator in capital letters.
    Operator { name: String },
    /// An undeclared net; `circuit` is the signature of a circuit of that name.
    UnknownNet { name: String, circuit: Option<String>, meant: Suggestion },
    /// A truth value of another language.
    Truth { word: String, bit: bool },
    /// An unknown bit of another language.
    UnknownBit { word: String },
    /// An undeclared parameter or loop variable.
    UnknownNumber { name: String, meant: Suggestion },
    /// A net in the place of a number.
    NetForNumber { name: String },
    /// A number in the place of a net.
    NumberForNet { name: String },
    /// A parameter that the circuit does not have.
    UnknownParameter { circuit: String, name: String, meant: Suggestion },
    /// An input that the circuit does not have; it may be an output.
    UnknownInput { circuit: String, name: String, is_output: bool, meant: Suggestion },
    /// An output that the circuit does not have; it may be an input.
    UnknownOutput { circuit: String, name: String, is_input: bool, meant: Suggestion },
    /// Neither a function nor four letters.
    UnknownBehavior { name: String, meant: Suggestion },
    /// A second declaration of a name.
    Duplicate { kind: &'static str, name: String, first: Span },
    /// A record that takes its fields from itself, perhaps through others.
    Circular { kind: &'static str, name: String },
    /// A material that is listed twice.
    RepeatedMaterial { name: String },
    /// A seed that is listed twice.
    RepeatedSeed { seed: u64, first: Span },
}

impl NameError {
    /// The error at the name.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::Unknown { kind, name, meant } => undeclared(kind, &name, span).with_suggestion(span, &meant),
            Self::Operator { name } => {
                let word = name.to_lowercase();
                undeclared("circuit", &name, span)
                    .with_help(format!("write operators in lower case: `{word}(…)`"))
                    .with_fix(Fix::replace(span, word))
            }
            Self::UnknownNet { name, circuit: Some(signature), .. } => {
                let help = format!("it is a circuit; call it with operands: `{signature}`");
                undeclared("net", &name, span).with_help(help)
            }
            Self::UnknownNet { name, circuit: None, meant } => {
                undeclared("net", &name, span).with_suggestion(span, &meant)
            }
            Self::Truth { word, bit } => {
                let bit = u8::from(bit).to_string();
                undeclared("net", &word, span).with_help(format!("write `{bit}`")).with_fix(Fix::replace(span, bit))
            }
            Self::UnknownBit { word } => undeclared("net", &word, span)
                .with_help("a bit is `0` or `1`; the value for patterns that never occur is `-` in a `table`"),
            Self::UnknownNumber { name, meant } => {
                let error = undeclared("parameter or loop variable", &name, span);
                match meant {
                    Suggestion::None => {
                        error.with_help("parameters stand in brackets after a circuit's name: `circuit add[n](…)`")
                    }
                    _ => error.with_suggestion(span, &meant),
                }
            }
            Self::NetForNumber { name } => {
                let message = format!("`{name}` is a net, not a number");
                Diagnostic::new(Code::Unknown, message, span, "expected a parameter or a loop variable").with_help(
                    "integers are known when the circuit is built; a choice by nets is `q = if c then a else b`",
                )
            }
            Self::NumberForNet { name } => {
                let message = format!("`{name}` is a number, not a net");
                Diagnostic::new(Code::Unknown, message, span, "expected a net")
                    .with_help("numbers stand in widths, bits and ranges; a constant is `4'd9`")
            }
            Self::UnknownParameter { circuit, name, meant } => {
                let message = format!("`{circuit}` has no parameter `{name}`");
                Diagnostic::new(Code::Unknown, message, span, "not declared").with_suggestion(span, &meant)
            }
            Self::UnknownInput { circuit, name, is_output, meant } => {
                let other = is_output.then_some("output");
                unknown_port(&circuit, "input", &name, other, &meant, span)
            }
            Self::UnknownOutput { circuit, name, is_input, meant } => {
                let other = is_input.then_some("input");
                unknown_port(&circuit, "output", &name, other, &meant, span)
            }
            Self::UnknownBehavior { name, meant } => {
                let error = undeclared("behavior", &name, span);
                match meant {
                    Suggestion::Near(_) => error.with_suggestion(span, &meant),
                    _ => error.with_help("name a function such as `nand`, or write four letters such as `RRRL`"),
                }
            }
            Self::Duplicate { kind, name, first } => duplicate(kind, &name, span, first),
            Self::Circular { kind, name } => {
                let message = format!("the {kind} `{name}` takes its fields from itself");
                Diagnostic::new(Code::Recursion, message, span, "this closes the circle")
                    .with_help(format!("remove one `from`, or take the fields of another {kind}"))
            }
            Self::RepeatedMaterial { name } => {
                let message = format!("the material `{name}` is listed twice");
                Diagnostic::new(Code::Duplicate, message, span, "listed again here")
            }
            Self::RepeatedSeed { seed, first } => {
                let message = format!("the seed `{seed}` is listed twice");
                Diagnostic::new(Code::Duplicate, message, span, "listed again here")
                    .with_label(first, "first listed here")
                    .with_help("the same seed gives the same run, which would count twice")
            }
        }
    }
}

fn undeclared(kind: &str, name: &str, span: Span) -> Diagnostic {
    Diagnostic::new(Code::Unknown, format!("no {kind} is called `{name}`"), span, "not declared")
}

fn unknown_port(
    circuit: &str,
    kind: &str,
    name: &str,
    other: Option<&str>,
    meant: &Suggestion,
    span: Span,
) -> Diagnostic {
    let message = format!("`{circuit}` has no {kind} `{name}`");
    let error = Diagnostic::new(Code::Unknown, message, span, format!("no {kind} of that name"));
    match other {
        Some(other) => error.with_help(format!("it is an {other}; inputs stand before `|`, outputs after it")),
        None => error.with_suggestion(span, meant),
    }
}

fn duplicate(kind: &str, name: &str, span: Span, first: Span) -> Diagnostic {
    let message = format!("the {kind} `{name}` is declared twice");
    let error = Diagnostic::new(Code::Duplicate, message, span, "declared again here").with_help("rename one of them");
    let label = "first declared here";
    if first.file == span.file { error.with_label(first, label) } else { error.with_related(first, label) }
}
