//! The .bench format of the ISCAS benchmarks: `G5 = NAND(G1, G3)`. Its flip-flops have one clock for all, which has no
//! name.

use crate::formats::design::{Design, Forcing, Register, RegisterKind};
use crate::formats::draft::{Definition, Draft, DraftRegister};
use crate::formats::wording::{BenchError, TextError};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::Function;
use nbc_base::source::{FileId, Span};

/// Reads a file; `clock` names the clock of its flip-flops.
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
        draft.fault(BenchError::NoOutput, Span::new(file, 0, 0));
    }
    draft.finish()
}

fn statement(draft: &mut Draft, line: &str, span: Span, clock: Option<&str>) {
    let (target, call) = match line.split_once('=') {
        Some((target, call)) => (Some(target.trim()), call.trim()),
        None => (None, line),
    };
    let Some((word, arguments)) = call.strip_suffix(')').and_then(|call| call.split_once('(')) else {
        return draft.fault(BenchError::NotAStatement, span);
    };
    if arguments.split(',').any(|pin| pin.trim().is_empty()) || target == Some("") {
        return draft.fault(BenchError::UnnamedNet, span);
    }
    if target.is_some_and(|target| target.contains(char::is_whitespace)) || pins_have_blanks(arguments) {
        return draft.fault(BenchError::SpaceInName, span);
    }
    let is_long = |name: &&str| Limit::FileNameBytes.permit(name.len() as u64).is_err();
    if let Some(long) = target.into_iter().chain(arguments.split(',')).find(is_long) {
        let start = Span { end: span.start + 20, ..span };
        return draft.fault(TextError::LongName { bytes: long.len(), most: Limit::FileNameBytes.most() }, start);
    }
    let pins: Vec<_> = arguments.split(',').map(|pin| draft.name(pin.trim())).collect();
    let word = word.trim().to_ascii_uppercase();
    match (target, word.as_str(), &pins[..]) {
        (None, "INPUT", &[net]) => draft.inputs.push((net, span)),
        (None, "OUTPUT", &[net]) => draft.outputs.push((net, span)),
        (Some(target), "DFF", &[next]) => {
            let output = draft.name(target);
            let clock = Some(clock.unwrap_or("clk").to_owned());
            let register = Register {
                name: target.to_owned(),
                kind: RegisterKind::Rising,
                clock,
                start: Some(false),
                forcing: Forcing::Never,
            };
            draft.registers.push(DraftRegister { register, output, next, forcing: Vec::new(), span });
        }
        (Some(target), word, pins) => match gate(word, pins.len()) {
            Some((function, inverted)) => {
                let output = draft.name(target);
                draft.define(output, Definition::Gate(function, inverted, pins.to_vec()), span);
            }
            None => {
                draft.fault(BenchError::UnknownGate { gate: word.to_owned(), nets: pins.len() }, span);
            }
        },
        (None, "INPUT" | "OUTPUT", pins) => {
            draft.fault(BenchError::PortNets { word, nets: pins.len() }, span);
        }
        (None, ..) => draft.fault(BenchError::Unassigned { word }, span),
    }
}

fn pins_have_blanks(arguments: &str) -> bool {
    arguments.split(',').any(|pin| pin.trim().contains(char::is_whitespace))
}

/// The function of a gate's word, and whether it is inverted in the end.
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
