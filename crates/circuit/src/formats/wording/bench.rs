//! Messages about .bench files.

use crate::formats::wording::text::damaged;
use nbc_base::diag::{Diagnostic, counted};
use nbc_base::source::Span;

pub fn no_output(at: Span) -> Diagnostic {
    damaged("no `OUTPUT` in this .bench file", at, "expected `OUTPUT(net)`")
}

pub fn not_a_statement(at: Span) -> Diagnostic {
    damaged("not a statement of .bench", at, "expected `INPUT(a)`, `OUTPUT(b)` or `b = NAND(a, c)`")
}

pub fn unnamed_net(at: Span) -> Diagnostic {
    damaged("net has no name", at, "expected a name between the commas")
}

pub fn space_in_name(at: Span) -> Diagnostic {
    damaged("name contains a space", at, "expected a comma between names")
}

pub fn unknown_gate(gate: &str, nets: usize, at: Span) -> Diagnostic {
    let message = format!(".bench has no gate `{gate}` of {}", counted(nets, "net"));
    damaged(message, at, "expected AND, NAND, OR, NOR, XOR or XNOR of any nets, NOT, BUFF or DFF of one")
}

pub fn port_nets(word: &str, nets: usize, at: Span) -> Diagnostic {
    let label = format!("expected `{word}(net)` for each net");
    damaged(format!("`{word}` names {}", counted(nets, "net")), at, label)
}

pub fn unassigned(word: &str, at: Span) -> Diagnostic {
    let message = format!("the value of `{word}` is not assigned to a net");
    damaged(message, at, format!("expected `net = {word}(…)`"))
}
