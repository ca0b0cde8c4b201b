//! Names: unknown ones, repeated ones, and names of something else.

use crate::syntax::tree::NameSyntax;
use nbc_base::diag::{Code, Diagnostic, Fix, Suggestion};
use nbc_base::source::Span;

fn undeclared(kind: &str, name: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Unknown, format!("no {kind} is called `{name}`"), at, "not declared")
}

pub(crate) fn unknown(kind: &str, name: &NameSyntax, meant: &Suggestion) -> Diagnostic {
    undeclared(kind, &name.text, name.span).with_suggestion(name.span, meant)
}

pub(crate) fn upper_case_operator(name: &NameSyntax) -> Diagnostic {
    let word = name.text.to_lowercase();
    undeclared("circuit", &name.text, name.span)
        .with_help(format!("write operators in lower case: `{word}(…)`"))
        .with_fix(Fix::replace(name.span, word))
}

pub(crate) fn circuit_for_net(name: &NameSyntax, signature: &str) -> Diagnostic {
    undeclared("net", &name.text, name.span).with_help(format!("it is a circuit; call it with operands: `{signature}`"))
}

pub(crate) fn truth(word: &NameSyntax, bit: bool) -> Diagnostic {
    let bit = u8::from(bit).to_string();
    undeclared("net", &word.text, word.span).with_help(format!("write `{bit}`")).with_fix(Fix::replace(word.span, bit))
}

pub(crate) fn unknown_bit(word: &NameSyntax) -> Diagnostic {
    undeclared("net", &word.text, word.span)
        .with_help("a bit is `0` or `1`; the value for patterns that never occur is `-` in a `table`")
}

pub(crate) fn unknown_number(name: &str, meant: &Suggestion, at: Span) -> Diagnostic {
    let error = undeclared("parameter or loop variable", name, at);
    match meant {
        Suggestion::None => error.with_help("parameters stand in brackets after a circuit's name: `circuit add[n](…)`"),
        _ => error.with_suggestion(at, meant),
    }
}

pub(crate) fn net_for_number(name: &str, at: Span) -> Diagnostic {
    let message = format!("`{name}` is a net, not a number");
    Diagnostic::new(Code::Unknown, message, at, "expected a parameter or a loop variable")
        .with_help("integers are known when the circuit is built; a choice by nets is `q = if c then a else b`")
}

pub(crate) fn number_for_net(name: &NameSyntax) -> Diagnostic {
    let message = format!("`{}` is a number, not a net", name.text);
    Diagnostic::new(Code::Unknown, message, name.span, "expected a net")
        .with_help("numbers stand in widths, bits and ranges; a constant is `4'd9`")
}

pub(crate) fn unknown_parameter(circuit: &str, name: &NameSyntax, meant: &Suggestion) -> Diagnostic {
    let message = format!("`{circuit}` has no parameter `{}`", name.text);
    Diagnostic::new(Code::Unknown, message, name.span, "not declared").with_suggestion(name.span, meant)
}

pub(crate) fn unknown_port(circuit: &str, kind: &str, name: &NameSyntax, meant: &Suggestion) -> Diagnostic {
    let message = format!("`{circuit}` has no {kind} `{}`", name.text);
    Diagnostic::new(Code::Unknown, message, name.span, format!("no {kind} of that name"))
        .with_suggestion(name.span, meant)
}

pub(crate) fn port_beside_bar(circuit: &str, kind: &str, name: &NameSyntax, other: &str) -> Diagnostic {
    let help = format!("it is an {other}; inputs stand before `|`, outputs after it");
    unknown_port(circuit, kind, name, &Suggestion::None).with_help(help)
}

pub(crate) fn unknown_behavior(name: &NameSyntax, meant: &Suggestion) -> Diagnostic {
    let error = undeclared("behavior", &name.text, name.span);
    match meant {
        Suggestion::Near(_) => error.with_suggestion(name.span, meant),
        _ => error.with_help("name a function such as `nand`, or write four letters such as `RRRL`"),
    }
}

pub(crate) fn duplicate(kind: &str, name: &NameSyntax, first: Span) -> Diagnostic {
    let message = format!("the {kind} `{}` is declared twice", name.text);
    let error = Diagnostic::new(Code::Duplicate, message, name.span, "declared again here");
    let error = error.with_help("rename one of them");
    let label = "first declared here";
    if first.file == name.span.file { error.with_label(first, label) } else { error.with_related(first, label) }
}

pub(crate) fn circular_record(kind: &str, name: &NameSyntax) -> Diagnostic {
    let message = format!("the {kind} `{}` takes its fields from itself", name.text);
    Diagnostic::new(Code::Recursion, message, name.span, "this closes the circle")
        .with_help(format!("remove one `from`, or take the fields of another {kind}"))
}

pub(crate) fn repeated_material(name: &NameSyntax) -> Diagnostic {
    let message = format!("the material `{}` is listed twice", name.text);
    Diagnostic::new(Code::Duplicate, message, name.span, "listed again here")
}

pub(crate) fn repeated_seed(seed: u64, first: Span, at: Span) -> Diagnostic {
    let message = format!("the seed `{seed}` is listed twice");
    Diagnostic::new(Code::Duplicate, message, at, "listed again here")
        .with_label(first, "first listed here")
        .with_help("the same seed gives the same run, which would count twice")
}
