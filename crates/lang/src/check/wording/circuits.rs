//! Circuits: their nets, operands and tables, and their tests and swarms.

use nbc_base::diag::{Code, Diagnostic, Edit, Fix, counted, suggest};
use nbc_base::source::Span;

/// An invalid circuit, or an invalid use of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum CircuitError {
    /// An input with a driver inside.
    DrivenInput { net: String, declared: Span },
    /// A net without a declared width, some of whose bits are driven.
    UnknownWidth { net: String },
    /// A constant of too many bits.
    ConstantTooLarge,
    /// Digits that are not of their base.
    WrongDigits { digits: String, radix: u32 },
    /// A net that begins with the contents of a file, and is no memory.
    ContentsOfNet { net: String },
    /// A net or output without a driver.
    Undriven { what: &'static str, net: String },
    /// A net or input that is not used.
    Unused { what: &'static str, net: String },
    /// A library that is not used by a swarm.
    UnusedLibrary { library: String },
    /// A circuit that contains itself, through others.
    Recursion { circuit: String, through: Vec<String> },
    /// A reference whose ports differ from those of the tested circuit, which is named at `first`.
    DifferentPorts { circuits: [String; 2], first: Span },
    /// A reference with ports of the same names as the tested circuit, and others of different names: the names that
    /// only the tested circuit has, and those that only the reference has.
    MixedPorts { circuits: [String; 2], kind: &'static str, ports: [Vec<String>; 2], first: Span },
    /// A test over all inputs with too many input bits.
    TooManyInputs { bits: usize, most: u64 },
    /// A test over all inputs of a circuit with memory.
    AllInputsOfMemory { circuit: String },
    /// Two tests of a circuit with the same title.
    SameTitle { circuit: String, title: String, first: Span },
    /// A start value of a net that a circuit drives whose start value is a parameter.
    StartOfCall { net: String, circuit: String, start: Option<String>, edit: Option<StartEdit> },
}

/// The edits that move a start value from a net to the call that drives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct StartEdit {
    /// The `init` and its value.
    pub(crate) init: Span,
    /// The place and the text of the parameter, unless the call gives it already.
    pub(crate) argument: Option<(Span, String)>,
}

impl From<StartEdit> for Fix {
    fn from(StartEdit { init, argument }: StartEdit) -> Self {
        let removed = Fix::remove(init, "the start value of the net");
        let Some((span, text)) = argument else { return removed };
        let moved = Edit { span, text };
        Fix { title: "move the start value into the call".to_owned(), edits: [removed.edits, vec![moved]].concat() }
    }
}

impl CircuitError {
    /// The error at the net, the expression or the name.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::DrivenInput { net, declared } => {
                let message = format!("the input `{net}` is driven inside its circuit");
                Diagnostic::new(Code::MultipleDrivers, message, span, "driven here")
                    .with_label(declared, "an input is driven from outside")
                    .with_help("drive a net with another name")
            }
            Self::UnknownWidth { net } => {
                let message = format!("the width of `{net}` is unknown");
                Diagnostic::new(Code::UnknownWidth, message, span, "only some of its bits are driven here")
                    .with_help(format!("declare it first: `net {net}[8]`"))
            }
            Self::ConstantTooLarge => {
                Diagnostic::new(Code::OutOfRange, "constant is too large", span, "expected at most 128 bits")
                    .with_help("join several constants: `{64'h…, 64'h…}`")
            }
            Self::WrongDigits { digits, radix } => {
                let message = format!("`{digits}` is not a number in base {radix}");
                Diagnostic::new(Code::Syntax, message, span, format!("expected digits of base {radix}"))
                    .with_help("`4'b1010` is binary, `4'd10` decimal, `4'ha` hexadecimal")
            }
            Self::ContentsOfNet { net } => {
                let message = format!("`{net}` cannot begin with the contents of a file");
                Diagnostic::new(Code::StartValue, message, span, "expected a memory: an array of an environment")
                    .with_help("declare it in an `environment`: `net words[1024][32] init program`")
            }
            Self::Undriven { what, net } => {
                let message = format!("nothing drives the {what} `{net}`");
                Diagnostic::new(Code::Undriven, message, span, "declared here")
                    .with_help(format!("add a line `{net} = …`"))
            }
            Self::Unused { what, net } => {
                let message = format!("the {what} `{net}` is never used");
                Diagnostic::new(Code::Unused, message, span, "declared here")
                    .with_help(format!("remove it, or rename it to `_{net}`"))
            }
            Self::UnusedLibrary { library } => {
                let message = format!("no swarm uses the library `{library}`");
                let help = format!("declare a swarm: `swarm my_swarm {{ circuit: my_circuit, library: {library} }}`");
                Diagnostic::new(Code::Unused, message, span, "declared here").with_help(help)
            }
            Self::DifferentPorts { circuits: [tested, other], first } => {
                let message = format!("`{tested}` and `{other}` have different ports");
                let label = "expected as many ports as the tested circuit has, with the same widths";
                Diagnostic::new(Code::Operands, message, span, label).with_label(first, "the tested circuit")
            }
            Self::MixedPorts { circuits: [tested, other], kind, ports: [own, theirs], first } => {
                let message = format!("only some {kind} of `{tested}` and `{other}` have the same names");
                let only = |names: &[String]| format!("only this circuit has {}", suggest::alternatives(names, "and"));
                Diagnostic::new(Code::Operands, message, span, only(&theirs)).with_label(first, only(&own)).with_help(
                    format!(
                        "give all {kind} the same names to pair them by name, or all different names to pair them in \
                         order"
                    ),
                )
            }
            Self::TooManyInputs { bits, most } => {
                let message = format!("too many patterns to test: {bits} input bits");
                Diagnostic::new(Code::TooLarge, message, span, format!("expected at most {most} bits"))
                    .with_help("test a narrower instance, or list rows")
            }
            Self::AllInputsOfMemory { circuit } => {
                let message = format!("`{circuit}` has memory, so this test does not try all that it can do");
                Diagnostic::new(Code::AllInputs, message, span, "every pattern is applied once, in one order")
                    .with_help(
                        "list rows in the order that matters, with `^` for a rising edge of a clock; or compare it \
                         with another circuit: `test this against other for ever`",
                    )
            }
            Self::SameTitle { circuit, title, first } => {
                let message = format!("two tests of `{circuit}` have the title \"{title}\"");
                Diagnostic::new(Code::SameTitle, message, span, "and this test")
                    .with_label(first, "this test")
                    .with_help("give each its own title, so that results and reports can be told apart")
            }
            Self::StartOfCall { net, circuit, start, edit } => {
                let start = start.as_deref().unwrap_or("…");
                let message = format!("`init` does not set the start value of `{circuit}`, which drives `{net}`");
                let help = match &edit {
                    Some(StartEdit { argument: None, .. }) => {
                        format!("remove `init {start}`; the parameter `start` is given already")
                    }
                    _ => format!("give it as a parameter: `{circuit}[start = {start}](…)`"),
                };
                Diagnostic::new(Code::StartValue, message, span, "this start value has no effect")
                    .with_help(help)
                    .with_fix(edit.map(Fix::from))
            }
            Self::Recursion { circuit, through } => {
                let through = match through.is_empty() {
                    true => String::new(),
                    false => format!(" through {}", suggest::alternatives(&through, "and")),
                };
                let message = format!("the circuit `{circuit}` contains itself{through}");
                Diagnostic::new(Code::Recursion, message, span, "used here, inside itself")
                    .with_help("a swarm has a fixed number of robots; repeat parts with `for i in 0..8 { … }`")
            }
        }
    }
}

/// A wrong number of operands, outputs or parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum OperandError {
    /// One value for several nets.
    OneValue { nets: Vec<String> },
    /// An operator with too many or too few operands.
    OperatorOperands { operator: &'static str, found: usize, expected: &'static str },
    /// `xnor` of more than two operands.
    WideXnor { found: usize },
    /// A call with too many or too few operands.
    CallOperands { circuit: String, expected: usize, found: usize, signature: String },
    /// Two operands for one port.
    TwoOperands { circuit: String, port: String },
    /// A call with more or fewer targets than the circuit has outputs.
    CallOutputs { circuit: String, expected: usize, found: usize, signature: String },
    /// One parameter too many.
    TooManyParameters { circuit: String, parameters: usize },
    /// A missing parameter before one that is given.
    MissingParameter { circuit: String, parameter: String },
}

impl OperandError {
    /// The error at the expression or the name.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        let operands = |message: String, label: String| Diagnostic::new(Code::Operands, message, span, label);
        match self {
            Self::OneValue { nets } => {
                let mut bits: Vec<String> =
                    nets.iter().rev().enumerate().map(|(bit, net)| format!("`{net} = t[{bit}]`")).collect();
                bits.reverse();
                bits.retain(|line| !line.starts_with("`_ "));
                bits.truncate(4);
                operands(format!("one value for {} nets", nets.len()), "expected a call of a circuit".to_owned())
                    .with_help(format!("name the value, `t = …`, and drive each net with a bit: {}", bits.join(", ")))
            }
            Self::OperatorOperands { operator, found, expected } => operands(
                format!("wrong number of operands of `{operator}`"),
                format!("expected {expected}, found {found}"),
            ),
            Self::WideXnor { found } => {
                operands("wrong number of operands of `xnor`".to_owned(), format!("expected two, found {found}"))
                    .with_help("to invert the parity of more than two, write `not xor(a, b, c)`")
            }
            Self::CallOperands { circuit, expected, found, signature } => {
                operands(format!("`{circuit}` takes {}", counted(expected, "operand")), format!("found {found}"))
                    .with_help(format!("it is declared as `{signature}`"))
            }
            Self::TwoOperands { circuit, port } => operands(
                format!("two operands for the input `{port}` of `{circuit}`"),
                "an operand without a name is for the input at its own place".to_owned(),
            ),
            Self::CallOutputs { circuit, expected, found, signature } => {
                operands(format!("`{circuit}` has {}", counted(expected, "output")), format!("{found} taken here"))
                    .with_help(format!("it is declared as `{signature}`"))
            }
            Self::TooManyParameters { circuit, parameters } => {
                operands(format!("`{circuit}` has {}", counted(parameters, "parameter")), "one too many".to_owned())
            }
            Self::MissingParameter { circuit, parameter } => operands(
                format!("missing parameter `{parameter}` of `{circuit}`"),
                "expected every parameter before the last one given".to_owned(),
            ),
        }
    }
}

/// An invalid use of an array, or of brackets after a net.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum ArrayError {
    /// Two brackets after a net that is no array.
    NoArray { net: String },
    /// A range of words.
    SeveralWords { net: String },
    /// A value of nets where the bits of a slice stand.
    ValueForBits,
    /// An operation on integers that nets do not have.
    NoValue { operator: &'static str },
    /// Parameters of the register that writes words of a memory.
    StartOfMemory { net: String },
    /// A word that a value selects, driven by anything but a register.
    NoRegister { net: String },
}

impl ArrayError {
    /// The error at the brackets or the target.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::NoArray { net } => {
                let message = format!("`{net}` is not an array");
                Diagnostic::new(Code::Operands, message, span, "only a word of an array has brackets after it")
                    .with_help(format!(
                        "an array is declared with two numbers: `net {net}[4][8]` has 4 words of 8 bits"
                    ))
            }
            Self::SeveralWords { net } => {
                let message = format!("a range of words of `{net}`");
                Diagnostic::new(Code::Operands, message, span, "expected one word")
                    .with_help(format!("join the words: `{{{net}[1], {net}[0]}}`"))
            }
            Self::ValueForBits => {
                Diagnostic::new(Code::Operands, "a value selects bits of a word", span, "expected integers")
                    .with_help("name the word, `t = …`, and select a bit with `t[n]`")
            }
            Self::NoValue { operator } => {
                let message = format!("`{operator}` is for integers, not for nets");
                Diagnostic::new(Code::Operands, message, span, "this value selects a word or a bit")
            }
            Self::StartOfMemory { net } => {
                let message = format!("the memory `{net}` has no start value of a register");
                Diagnostic::new(Code::StartValue, message, span, "written here")
                    .with_help(format!("it begins with zeros, or with a file: `net {net}[8][8] init program`"))
            }
            Self::NoRegister { net } => {
                let message = format!("a value selects the word of `{net}` that is driven");
                Diagnostic::new(Code::Operands, message, span, "expected a register")
                    .with_help(format!("`{net}[…] = register(d, clk, enable: e)` writes a word when the clock rises"))
            }
        }
    }
}

/// An invalid enumeration, or an invalid use of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum EnumerationError {
    /// No members.
    Empty,
    /// Too many members.
    TooMany { members: usize, most: usize },
    /// A member without a value among others that have one.
    WithoutValue { member: String },
    /// An encoding beside values.
    TwoEncodings,
    /// A value that is no constant.
    NotAConstant { word: String },
    /// Values of different widths.
    Widths { widths: [u32; 2], first: Span },
    /// A value that does not fit into the width of the others.
    TooWide { word: String, width: u32 },
    /// Two members with one value.
    SameValue { names: [String; 2], first: Span },
    /// A net with an enumeration and a width.
    Width { net: String },
}

impl EnumerationError {
    /// The error at the name or the value.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        let value = |message: String, label: &str| Diagnostic::new(Code::Value, message, span, label);
        match self {
            Self::Empty => Diagnostic::new(Code::Empty, "the enumeration has no members", span, "declared here")
                .with_help("list them: `enum phase { fetch, execute }`"),
            Self::TooMany { members, most } => {
                let message = format!("an enumeration of {members} members is too large");
                Diagnostic::new(Code::TooLarge, message, span, format!("expected at most {most}"))
            }
            Self::WithoutValue { member } => {
                value(format!("`{member}` has no value"), "expected a value, because another member has one")
            }
            Self::TwoEncodings => {
                value("the members have values and an encoding".to_owned(), "expected only one of them")
            }
            Self::NotAConstant { word } => {
                value(format!("`{word}` is not a constant"), "expected one such as `5'b01100`")
            }
            Self::Widths { widths: [before, here], first } => {
                let message = "the values of the enumeration differ in width";
                Diagnostic::new(Code::Width, message, span, counted(here as usize, "bit"))
                    .with_label(first, counted(before as usize, "bit"))
            }
            Self::TooWide { word, width } => {
                let message = format!("`{word}` does not fit into {}", counted(width as usize, "bit"));
                Diagnostic::new(Code::OutOfRange, message, span, "the width of the other values")
            }
            Self::SameValue { names: [first_name, name], first } => {
                let message = format!("`{first_name}` and `{name}` have the same value");
                Diagnostic::new(Code::Duplicate, message, span, "and this member").with_label(first, "this member")
            }
            Self::Width { net } => {
                let message = format!("`{net}` has an enumeration and a width");
                Diagnostic::new(Code::Width, message, span, "the enumeration has a width")
                    .with_help("remove the brackets")
            }
        }
    }
}
