//! Registers with an asynchronous set or reset in BLIF, which has no syntax for them: the cells of Yosys.

use std::fmt::Write;

use crate::formats::design::{Forcing, Register, RegisterKind};

pub(super) struct ForcedCell {
    pub(super) kind: RegisterKind,
    pub(super) forcing: Forcing,
    /// The value that a reset gives it, if it has no set.
    pub(super) start: Option<bool>,
    pub(super) clock: &'static str,
    pub(super) ports: &'static [&'static str],
}

/// The register that a cell of Yosys is, such as `$_DFF_PP0_`. Yosys inverts nets that force a register while they
/// are 0.
pub(super) fn forced_cell(cell: &str) -> Option<ForcedCell> {
    let (family, pins) = cell.strip_prefix("$_")?.strip_suffix('_')?.split_once('_')?;
    let (edge, force) = pins.split_at_checked(1)?;
    let (is_latch, is_both) = match family {
        "DFF" => (false, false),
        "DLATCH" => (true, false),
        "DFFSR" => (false, true),
        "DLATCHSR" => (true, true),
        _ => return None,
    };
    let kind = match (is_latch, edge) {
        (false, "P") => RegisterKind::Rising,
        (false, "N") => RegisterKind::Falling,
        (true, "P") => RegisterKind::High,
        (true, "N") => RegisterKind::Low,
        _ => return None,
    };
    let (forcing, start, ports): (_, _, &[_]) = match (is_both, force) {
        (false, "P0") => (Forcing::ToStart, Some(false), &["R"]),
        (false, "P1") => (Forcing::ToStart, Some(true), &["R"]),
        (true, "PP") => (Forcing::SetReset, None, &["S", "R"]),
        _ => return None,
    };
    Some(ForcedCell { kind, forcing, start, clock: if is_latch { "E" } else { "C" }, ports })
}

/// A register with a set or a reset, its next value and value, as a line for a cell of Yosys. The start value of one
/// with both is an attribute.
pub(super) fn cell_of(register: &Register, clock: &str, [next, value]: [&str; 2], forcing: &[&str]) -> String {
    let (family, edge, port) = match register.kind {
        RegisterKind::Rising => ("DFF", 'P', 'C'),
        RegisterKind::Falling => ("DFF", 'N', 'C'),
        RegisterKind::High => ("DLATCH", 'P', 'E'),
        RegisterKind::Low => ("DLATCH", 'N', 'E'),
    };
    let start = u8::from(register.starts_at());
    match forcing {
        [set, reset] => {
            let mut text =
                format!(".subckt $_{family}SR_{edge}PP_ {port}={clock} D={next} Q={value} R={reset} S={set}\n");
            if register.start.is_some() {
                let _ = writeln!(text, ".attr init {start}");
            }
            text
        }
        _ => format!(".subckt $_{family}_{edge}P{start}_ {port}={clock} D={next} Q={value} R={}\n", forcing[0]),
    }
}
