//! Messages about BLIF, .bench and PLA files, read as named nets in any order.

use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic};
use nbc_base::source::Span;

pub(super) fn damaged(message: impl Into<String>, at: Span, label: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Code::CircuitFile, message, at, label)
}

pub fn long_name(bytes: usize, at: Span) -> Diagnostic {
    let (beginning, most) = (Span { end: at.start + 20, ..at }, Limit::FileNameBytes.most());
    damaged(format!("name of {bytes} bytes is too long"), beginning, format!("expected at most {most}"))
}

pub fn too_many_pins(at: Span) -> Diagnostic {
    let message = format!("the circuit has more than {} pins of gates", Limit::FilePins.most());
    Diagnostic::new(Code::TooLarge, message, at, "the limit is reached here")
}

pub fn too_many(what: &str, most: u64, at: Span) -> Diagnostic {
    Diagnostic::new(Code::TooLarge, format!("the file has more than {most} {what}"), at, "the limit is reached here")
}

pub fn defined_twice(net: &str, first: Span, at: Span) -> Diagnostic {
    damaged(format!("`{net}` is defined twice"), at, "defined again here").with_related(first, "first defined here")
}

pub fn net_loop(net: &str, at: Span) -> Diagnostic {
    damaged(format!("`{net}` depends on itself"), at, "this closes the loop").with_help(
        "feedback needs a start value: `.attr init 0` after its `.names` in BLIF, `(* init = 1'b0 *)` before its \
         instance in Verilog (docs/compiler.md, \"Exchange formats\")",
    )
}

pub fn logic_clock(clock: &str, register: &str, at: Span) -> Diagnostic {
    let message = format!("the clock `{clock}` of `{register}` is driven by logic");
    damaged(message, at, "expected an input or a register as clock")
}

pub fn logic_enable(latch: &str, at: Span) -> Diagnostic {
    let message = format!("`{latch}` is a latch, and logic computes when it is open");
    damaged(message, at, "it keeps its value wherever nothing sets it").with_help(
        "set it in every case, such as by a value before the first `if`; one input or register must open a latch, \
         beside what sets and resets it",
    )
}

pub fn driven_twice(net: &str, at: Span) -> Diagnostic {
    damaged(format!("`{net}` is driven twice"), at, "an input or a register cannot have another driver")
}

pub fn undefined(net: &str, at: Span) -> Diagnostic {
    damaged(format!("`{net}` is used but not defined"), at, "used here")
}
