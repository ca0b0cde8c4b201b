//! Circuits: their nets, operands and tables, and their tests and swarms.

use crate::syntax::tree::NameSyntax;
use nbc_base::diag::{Code, Diagnostic, Edit, Fix, counted, suggest};
use nbc_base::source::Span;

pub(crate) fn driven_input(net: &str, declared: Span, at: Span) -> Diagnostic {
    let message = format!("the input `{net}` is driven inside its circuit");
    Diagnostic::new(Code::MultipleDrivers, message, at, "driven here")
        .with_label(declared, "an input is driven from outside")
        .with_help("drive a net with another name")
}

pub(crate) fn unknown_width(net: &str, at: Span) -> Diagnostic {
    let message = format!("the width of `{net}` is unknown");
    Diagnostic::new(Code::UnknownWidth, message, at, "only some of its bits are driven here")
        .with_help(format!("declare it first: `net {net}[8]`"))
}

pub(crate) fn large_constant(at: Span) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, "constant is too large", at, "expected at most 128 bits")
        .with_help("join several constants: `{64'h…, 64'h…}`")
}

pub(crate) fn wrong_digits(digits: &str, radix: u32, at: Span) -> Diagnostic {
    let message = format!("`{digits}` is not a number in base {radix}");
    Diagnostic::new(Code::Syntax, message, at, format!("expected digits of base {radix}"))
        .with_help("`4'b1010` is binary, `4'd10` decimal, `4'ha` hexadecimal")
}

pub(crate) fn contents_of_net(net: &str, at: Span) -> Diagnostic {
    let message = format!("`{net}` cannot begin with the contents of a file");
    Diagnostic::new(Code::StartValue, message, at, "expected a memory: an array of an environment")
        .with_help("declare it in an `environment`: `net words[1024][32] init program`")
}

pub(crate) fn undriven(what: &str, net: &str, at: Span) -> Diagnostic {
    let message = format!("nothing drives the {what} `{net}`");
    Diagnostic::new(Code::Undriven, message, at, "declared here").with_help(format!("add a line `{net} = …`"))
}

pub(crate) fn unused(what: &str, name: &str, at: Span) -> Diagnostic {
    let message = format!("the {what} `{name}` is never used");
    Diagnostic::new(Code::Unused, message, at, "declared here")
        .with_help(format!("remove it, or rename it to `_{name}`"))
}

pub(crate) fn unused_library(library: &NameSyntax) -> Diagnostic {
    let NameSyntax { text: name, span } = library;
    let help = format!("declare a swarm: `swarm my_swarm {{ circuit: my_circuit, library: {name} }}`");
    Diagnostic::new(Code::Unused, format!("no swarm uses the library `{name}`"), *span, "declared here").with_help(help)
}

pub(crate) fn different_ports([tested, other]: [&NameSyntax; 2]) -> Diagnostic {
    let message = format!("`{}` and `{}` have different ports", tested.text, other.text);
    let label = "expected as many ports as the tested circuit has, with the same widths";
    Diagnostic::new(Code::Operands, message, other.span, label).with_label(tested.span, "the tested circuit")
}

/// `own` are the ports that only the tested circuit has, `theirs` those that only the other one has.
pub(crate) fn mixed_ports(
    [tested, other]: [&NameSyntax; 2],
    kind: &str,
    [own, theirs]: &[Vec<String>; 2],
) -> Diagnostic {
    let message = format!("only some {kind} of `{}` and `{}` have the same names", tested.text, other.text);
    let only = |names: &[String]| format!("only this circuit has {}", suggest::alternatives(names, "and"));
    let help =
        format!("give all {kind} the same names to pair them by name, or all different names to pair them in order");
    Diagnostic::new(Code::Operands, message, other.span, only(theirs))
        .with_label(tested.span, only(own))
        .with_help(help)
}

pub(crate) fn many_inputs(bits: usize, most: u64, at: Span) -> Diagnostic {
    let message = format!("too many patterns to test: {bits} input bits");
    Diagnostic::new(Code::TooLarge, message, at, format!("expected at most {most} bits"))
        .with_help("test a narrower instance, or list rows")
}

pub(crate) fn all_inputs_of_memory(circuit: &str, at: Span) -> Diagnostic {
    let message = format!("`{circuit}` has memory, so this test does not try all that it can do");
    let help = "list rows in the order that matters, with `^` for a rising edge of a clock; or compare it with \
                another circuit: `test this against other for ever`";
    Diagnostic::new(Code::AllInputs, message, at, "every pattern is applied once, in one order").with_help(help)
}

pub(crate) fn same_title(circuit: &str, title: &str, first: Span, at: Span) -> Diagnostic {
    let message = format!("two tests of `{circuit}` have the title \"{title}\"");
    Diagnostic::new(Code::SameTitle, message, at, "and this test")
        .with_label(first, "this test")
        .with_help("give each its own title, so that results and reports can be told apart")
}

/// `edit` moves the start value into the call: the `init` with its value, and the place and text of the parameter
/// unless the call gives it already.
pub(crate) fn start_of_call(
    net: &str,
    circuit: &str,
    start: Option<&str>,
    edit: Option<(Span, Option<(Span, String)>)>,
    at: Span,
) -> Diagnostic {
    let start = start.unwrap_or("…");
    let message = format!("`init` does not set the start value of `{circuit}`, which drives `{net}`");
    let mut help = format!("give it as a parameter: `{circuit}[start = {start}](…)`");
    let fix = edit.map(|(init, argument)| {
        let mut fix = Fix::remove(init, "the start value of the net");
        if let Some((span, text)) = argument {
            fix.title = "move the start value into the call".to_owned();
            fix.edits.push(Edit { span, text });
        } else {
            help = format!("remove `init {start}`; the parameter `start` is given already");
        }
        fix
    });
    Diagnostic::new(Code::StartValue, message, at, "this start value has no effect").with_help(help).with_fix(fix)
}

pub(crate) fn recursion(circuit: &str, through: &[&str], at: Span) -> Diagnostic {
    let through =
        if through.is_empty() { String::new() } else { format!(" through {}", suggest::alternatives(through, "and")) };
    let message = format!("the circuit `{circuit}` contains itself{through}");
    Diagnostic::new(Code::Recursion, message, at, "used here, inside itself")
        .with_help("a swarm has a fixed number of robots; repeat parts with `for i in 0..8 { … }`")
}

// ---- operands, outputs and parameters ----

pub(crate) fn one_value(nets: &[&str], at: Span) -> Diagnostic {
    let bits = nets.iter().zip((0..nets.len()).rev()).filter(|(net, _)| **net != "_");
    let bits: Vec<String> = bits.map(|(net, bit)| format!("`{net} = t[{bit}]`")).take(4).collect();
    let message = format!("one value for {} nets", nets.len());
    Diagnostic::new(Code::Operands, message, at, "expected a call of a circuit")
        .with_help(format!("name the value, `t = …`, and drive each net with a bit: {}", bits.join(", ")))
}

pub(crate) fn operator_operands(operator: &str, found: usize, expected: &str, at: Span) -> Diagnostic {
    let message = format!("wrong number of operands of `{operator}`");
    Diagnostic::new(Code::Operands, message, at, format!("expected {expected}, found {found}"))
}

pub(crate) fn wide_xnor(found: usize, at: Span) -> Diagnostic {
    operator_operands("xnor", found, "two", at)
        .with_help("to invert the parity of more than two, write `not xor(a, b, c)`")
}

pub(crate) fn call_operands(circuit: &str, expected: usize, found: usize, signature: &str, at: Span) -> Diagnostic {
    let message = format!("`{circuit}` takes {}", counted(expected, "operand"));
    Diagnostic::new(Code::Operands, message, at, format!("found {found}"))
        .with_help(format!("it is declared as `{signature}`"))
}

pub(crate) fn two_operands(circuit: &str, port: &str, at: Span) -> Diagnostic {
    let message = format!("two operands for the input `{port}` of `{circuit}`");
    Diagnostic::new(Code::Operands, message, at, "an operand without a name is for the input at its own place")
}

pub(crate) fn call_outputs(circuit: &str, expected: usize, found: usize, signature: &str, at: Span) -> Diagnostic {
    let message = format!("`{circuit}` has {}", counted(expected, "output"));
    Diagnostic::new(Code::Operands, message, at, format!("{found} taken here"))
        .with_help(format!("it is declared as `{signature}`"))
}

pub(crate) fn many_parameters(circuit: &str, parameters: usize, at: Span) -> Diagnostic {
    let message = format!("`{circuit}` has {}", counted(parameters, "parameter"));
    Diagnostic::new(Code::Operands, message, at, "one too many")
}

pub(crate) fn missing_parameter(circuit: &NameSyntax, parameter: &str) -> Diagnostic {
    let message = format!("missing parameter `{parameter}` of `{}`", circuit.text);
    Diagnostic::new(Code::Operands, message, circuit.span, "expected every parameter before the last one given")
}

// ---- arrays, and brackets after nets ----

pub(crate) fn no_array(net: &str, at: Span) -> Diagnostic {
    let message = format!("`{net}` is not an array");
    Diagnostic::new(Code::Operands, message, at, "only a word of an array has brackets after it")
        .with_help(format!("an array is declared with two numbers: `net {net}[4][8]` has 4 words of 8 bits"))
}

pub(crate) fn several_words(net: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Operands, format!("a range of words of `{net}`"), at, "expected one word")
        .with_help(format!("join the words: `{{{net}[1], {net}[0]}}`"))
}

pub(crate) fn value_for_bits(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Operands, "a value selects bits of a word", at, "expected integers")
        .with_help("name the word, `t = …`, and select a bit with `t[n]`")
}

pub(crate) fn operator_of_integers(operator: &str, at: Span) -> Diagnostic {
    let message = format!("`{operator}` is for integers, not for nets");
    Diagnostic::new(Code::Operands, message, at, "this value selects a word or a bit")
}

pub(crate) fn start_of_memory(net: &str, at: Span) -> Diagnostic {
    let message = format!("the memory `{net}` has no start value of a register");
    Diagnostic::new(Code::StartValue, message, at, "written here")
        .with_help(format!("it begins with zeros, or with a file: `net {net}[8][8] init program`"))
}

pub(crate) fn no_register(net: &str, at: Span) -> Diagnostic {
    let message = format!("a value selects the word of `{net}` that is driven");
    Diagnostic::new(Code::Operands, message, at, "expected a register")
        .with_help(format!("`{net}[…] = register(d, clk, enable: e)` writes a word when the clock rises"))
}

// ---- enumerations ----

pub(crate) fn empty_enumeration(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Empty, "the enumeration has no members", at, "declared here")
        .with_help("list them: `enum phase { fetch, execute }`")
}

pub(crate) fn many_members(members: usize, most: usize, at: Span) -> Diagnostic {
    let message = format!("an enumeration of {members} members is too large");
    Diagnostic::new(Code::TooLarge, message, at, format!("expected at most {most}"))
}

pub(crate) fn member_without_value(member: &NameSyntax) -> Diagnostic {
    let message = format!("`{}` has no value", member.text);
    Diagnostic::new(Code::Value, message, member.span, "expected a value, because another member has one")
}

pub(crate) fn two_encodings(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Value, "the members have values and an encoding", at, "expected only one of them")
}

pub(crate) fn not_a_constant(word: &NameSyntax) -> Diagnostic {
    let message = format!("`{}` is not a constant", word.text);
    Diagnostic::new(Code::Value, message, word.span, "expected one such as `5'b01100`")
}

pub(crate) fn member_widths(before: u32, first: Span, here: u32, at: Span) -> Diagnostic {
    let message = "the values of the enumeration differ in width";
    Diagnostic::new(Code::Width, message, at, counted(here as usize, "bit"))
        .with_label(first, counted(before as usize, "bit"))
}

pub(crate) fn wide_member_value(word: &NameSyntax, width: u32) -> Diagnostic {
    let message = format!("`{}` does not fit into {}", word.text, counted(width as usize, "bit"));
    Diagnostic::new(Code::OutOfRange, message, word.span, "the width of the other values")
}

pub(crate) fn same_member_value(names: [&str; 2], first: Span, at: Span) -> Diagnostic {
    let message = format!("`{}` and `{}` have the same value", names[0], names[1]);
    Diagnostic::new(Code::Duplicate, message, at, "and this member").with_label(first, "this member")
}

pub(crate) fn enumeration_and_width(net: &NameSyntax) -> Diagnostic {
    let message = format!("`{}` has an enumeration and a width", net.text);
    Diagnostic::new(Code::Width, message, net.span, "the enumeration has a width").with_help("remove the brackets")
}
