//! The .bench format of the ISCAS benchmarks: `G5 = NAND(G1, G3)`. Its flip-flops have one clock for all, which has no
//! name.

use crate::formats::design::Design;
use crate::formats::draft::{Definition, Draft, DraftRegister};
use crate::formats::wording::{bench as wording, text};
use crate::formats::{Forcing, RegisterKind};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::Function;
use nbc_base::source::{FileId, Span};

pub fn read(text: &str, file: FileId, clock: Option<&str>) -> Result<Design, Vec<Diagnostic>> {
    let mut draft = Draft::default();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let code = line.split('#').next().unwrap_or("");
        let trimmed = code.trim();
        if !trimmed.is_empty() {
            let at = start + (trimmed.as_ptr() as usize - line.as_ptr() as usize);
            statement(&mut draft, trimmed, Span::new(file, at, at + trimmed.len()), clock);
        }
        start += line.len();
    }
    if draft.outputs.is_empty() && draft.errors.is_empty() {
        draft.fault(wording::no_output(Span::new(file, 0, 0)));
    }
    draft.finish()
}

fn statement(draft: &mut Draft, line: &str, span: Span, clock: Option<&str>) {
    let (target, call) = match line.split_once('=') {
        Some((target, call)) => (Some(target.trim()), call.trim()),
        None => (None, line),
    };
    let Some((word, arguments)) = call.strip_suffix(')').and_then(|call| call.split_once('(')) else {
        return draft.fault(wording::not_a_statement(span));
    };
    let names: Vec<&str> = arguments.split(',').map(str::trim).collect();
    if names.contains(&"") || target == Some("") {
        return draft.fault(wording::unnamed_net(span));
    }
    if target.iter().chain(&names).any(|name| name.contains(char::is_whitespace)) {
        return draft.fault(wording::space_in_name(span));
    }
    let is_long = |name: &&str| Limit::FileNameBytes.permit(name.len() as u64).is_err();
    if let Some(long) = target.into_iter().chain(arguments.split(',')).find(is_long) {
        return draft.fault(text::long_name(long.len(), span));
    }
    let pins: Vec<_> = names.iter().map(|pin| draft.name(pin)).collect();
    let word = word.trim().to_ascii_uppercase();
    match (target, word.as_str(), &pins[..]) {
        (None, "INPUT", &[net]) => draft.inputs.push((net, span)),
        (None, "OUTPUT", &[net]) => draft.outputs.push((net, span)),
        (Some(target), "DFF", &[next]) => {
            let (output, clock) = (draft.name(target), draft.name(clock.unwrap_or(Design::CLOCK)));
            let (kind, forcing, start, nets) = (RegisterKind::Rising, Forcing::Never, Some(false), Vec::new());
            draft.registers.push(DraftRegister { kind, forcing, start, output, next, clock, nets, span });
        }
        (Some(target), word, pins) => match gate(word, pins.len()) {
            Some((function, inverted)) => {
                let output = draft.name(target);
                draft.define(output, Definition::Gate(function, inverted, pins.to_vec()), span);
            }
            None => draft.fault(wording::unknown_gate(word, pins.len(), span)),
        },
        (None, "INPUT" | "OUTPUT", pins) => draft.fault(wording::port_nets(&word, pins.len(), span)),
        (None, ..) => draft.fault(wording::unassigned(&word, span)),
    }
}

fn gate(word: &str, pins: usize) -> Option<(Function, bool)> {
    Some(match word {
        "NOT" | "INV" if pins == 1 => (Function::AND, true),
        "BUF" | "BUFF" if pins == 1 => (Function::AND, false),
        "AND" => (Function::AND, false),
        "NAND" => (Function::AND, true),
        "OR" => (Function::OR, false),
        "NOR" => (Function::OR, true),
        "XOR" => (Function::XOR, false),
        "XNOR" => (Function::XOR, true),
        _ => return None,
    })
}
