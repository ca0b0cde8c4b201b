//! The formats for a design, and the limits of each.

use std::collections::BTreeSet;

use crate::Loops;
use crate::formats::wording::encode as wording;
use crate::formats::{Design, Forcing, RegisterKind, aiger, blif, dot, nb, pla, verilog};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CircuitSource {
    Aiger,
    Bench,
    Blif,
    Pla,
    /// Verilog, which Yosys translates to BLIF.
    Verilog,
}

impl CircuitSource {
    pub fn of_path(path: &str) -> Option<Self> {
        let (_, ending) = path.rsplit_once('.')?;
        Some(match ending.to_ascii_lowercase().as_str() {
            "aag" | "aig" => Self::Aiger,
            "bench" => Self::Bench,
            "blif" => Self::Blif,
            "pla" => Self::Pla,
            "sv" | "v" => Self::Verilog,
            _ => return None,
        })
    }
}

/// A format that a design can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CircuitFormat {
    Blif,
    /// The PLA files of espresso, for few inputs and no state.
    Pla,
    AigerBinary,
    AigerText,
    Verilog,
    Dot,
    Nb,
}

impl CircuitFormat {
    pub fn of_path(path: &str) -> Result<Self, Diagnostic> {
        let (_, ending) = path.rsplit_once('.').unwrap_or_default();
        Ok(match ending.to_ascii_lowercase().as_str() {
            "blif" => Self::Blif,
            "pla" => Self::Pla,
            "aig" => Self::AigerBinary,
            "aag" => Self::AigerText,
            "v" | "sv" => Self::Verilog,
            "dot" | "gv" => Self::Dot,
            "nb" => Self::Nb,
            _ => return Err(wording::unknown_format(path)),
        })
    }

    pub fn encode(self, design: &Design) -> Result<Vec<u8>, Diagnostic> {
        match self {
            Self::AigerBinary | Self::AigerText => fits_aiger(design)?,
            Self::Nb if design.outputs() == 0 => return Err(wording::nb_without_outputs(&design.logic.name)),
            Self::Pla => fits_pla(design)?,
            Self::Nb | Self::Blif | Self::Verilog | Self::Dot => {}
        }
        Ok(match self {
            Self::Blif => blif::write(design).into_bytes(),
            Self::Pla => pla::write(design).into_bytes(),
            Self::AigerBinary => aiger::write(design, true),
            Self::AigerText => aiger::write(design, false),
            Self::Verilog => verilog::write(design).into_bytes(),
            Self::Dot => dot::write(&design.logic).into_bytes(),
            Self::Nb => nb::write(design).into_bytes(),
        })
    }
}

/// AIGER has flip-flops of one clock without a name, and no loops.
fn fits_aiger(design: &Design) -> Result<(), Diagnostic> {
    if !Loops::of(&design.logic).cores().is_empty() {
        return Err(wording::aiger_loop());
    }
    if let Some(register) = design.registers.iter().find(|register| register.forcing != Forcing::Never) {
        return Err(wording::aiger_forced(&register.name));
    }
    if let Some(register) = design.registers.iter().find(|register| register.kind != RegisterKind::Rising) {
        return Err(wording::aiger_register(&register.name, register.kind));
    }
    let clocks: BTreeSet<&str> = design.registers.iter().filter_map(|register| register.clock.as_deref()).collect();
    if clocks.len() > 1 {
        return Err(wording::aiger_clocks(clocks));
    }
    Ok(())
}

/// A PLA is two-level logic, written from a truth table.
fn fits_pla(design: &Design) -> Result<(), Diagnostic> {
    if !design.registers.is_empty() || !Loops::of(&design.logic).cores().is_empty() {
        return Err(wording::pla_state());
    }
    Limit::TriedBits.permit(design.inputs() as u64).map_err(|_| wording::pla_inputs(design.inputs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Netlist;
    use crate::formats::Register;

    fn check(registers: &[(RegisterKind, &str)], expected: Option<&str>) {
        let mut logic = Netlist::new("m");
        let states: Vec<_> = (0..registers.len()).map(|i| logic.add_input(format!("q{i}"))).collect();
        for (i, &state) in states.iter().enumerate() {
            logic.add_output(format!("q{i}_next"), state);
        }
        let register = |(i, &(kind, clock)): (usize, &(RegisterKind, &str))| Register {
            kind,
            ..Register::flip_flop(format!("q{i}"), clock)
        };
        let design = Design::new(logic, registers.iter().enumerate().map(register).collect());

        for format in [CircuitFormat::AigerText, CircuitFormat::AigerBinary] {
            let said = format.encode(&design).err().map(|fault| fault.message);
            assert_eq!(said.as_deref(), expected);
        }
    }

    #[test]
    fn aiger_rejects_unsupported_registers() {
        use RegisterKind::{Falling, High, Rising};
        check(&[(Rising, "clk"), (Rising, "clk")], None);
        check(&[(Rising, "a"), (Rising, "b")], Some("AIGER has one clock, but the registers have `a`, `b`"));
        let only = "AIGER only has flip-flops of the rising edge, but";
        check(&[(Rising, "clk"), (Falling, "clk")], Some(&format!("{only} `q1` is a flip-flop of the falling edge")));
        check(&[(High, "en")], Some(&format!("{only} `q0` is a level-sensitive latch")));
    }
}
