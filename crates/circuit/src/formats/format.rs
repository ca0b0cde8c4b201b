//! The formats for a design, and the limits of each.

use std::collections::BTreeSet;

use crate::Loops;
use crate::formats::wording::EncodeError;
use crate::formats::{Design, Forcing, RegisterKind, aiger, blif, dot, nb, pla, verilog};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;

/// A format that a design can be read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CircuitSource {
    /// AIGER, binary or as text.
    Aiger,
    /// The .bench format of the ISCAS benchmarks.
    Bench,
    /// Berkeley Logic Interchange Format.
    Blif,
    /// The PLA files of espresso.
    Pla,
    /// Verilog, which Yosys translates to BLIF.
    Verilog,
}

impl CircuitSource {
    /// The format for the extension of a path, in any case.
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
    /// Berkeley Logic Interchange Format.
    Blif,
    /// The PLA files of espresso, for few inputs and no state.
    Pla,
    /// AIGER in binary (.aig).
    AigerBinary,
    /// AIGER as text (.aag).
    AigerText,
    /// Structural Verilog (.v).
    Verilog,
    /// A drawing for Graphviz (.dot).
    Dot,
    /// The project's own language.
    Nb,
}

impl CircuitFormat {
    /// The format for the extension of a path, in any case.
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
            _ => return Err(EncodeError::UnknownFormat { path: path.to_owned() }.into()),
        })
    }

    /// A design in this format.
    pub fn encode(self, design: &Design) -> Result<Vec<u8>, Diagnostic> {
        self.check(design).map_err(Diagnostic::from)?;
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

    fn check(self, design: &Design) -> Result<(), EncodeError> {
        match self {
            Self::AigerBinary | Self::AigerText => fits_aiger(design),
            Self::Nb => fits_nb(design),
            Self::Pla => fits_pla(design),
            Self::Blif | Self::Verilog | Self::Dot => Ok(()),
        }
    }
}

/// AIGER has flip-flops of one clock without a name, and no loops.
fn fits_aiger(design: &Design) -> Result<(), EncodeError> {
    if !Loops::of(&design.logic).cores().is_empty() {
        return Err(EncodeError::AigerLoop);
    }
    if let Some(register) = design.registers.iter().find(|register| register.forcing != Forcing::Never) {
        return Err(EncodeError::AigerForced { register: register.name.clone() });
    }
    if let Some(register) = design.registers.iter().find(|register| register.kind != RegisterKind::Rising) {
        return Err(EncodeError::AigerRegister { register: register.name.clone(), kind: register.kind });
    }
    let clocks: BTreeSet<_> = design.registers.iter().filter_map(|register| register.clock.clone()).collect();
    if clocks.len() > 1 {
        return Err(EncodeError::AigerClocks { clocks: clocks.into_iter().collect() });
    }
    Ok(())
}

/// A PLA is two-level logic, written from a truth table.
fn fits_pla(design: &Design) -> Result<(), EncodeError> {
    let (inputs, most) = (design.inputs(), Limit::TriedBits.most());
    if !design.registers.is_empty() || !Loops::of(&design.logic).cores().is_empty() {
        return Err(EncodeError::PlaState);
    }
    Limit::TriedBits.permit(inputs as u64).map_err(|_| EncodeError::PlaInputs { inputs, most })
}

/// A circuit of the language has an output.
fn fits_nb(design: &Design) -> Result<(), EncodeError> {
    if design.outputs() == 0 {
        return Err(EncodeError::NbNoOutputs { circuit: design.logic.name.clone() });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Netlist;
    use crate::formats::Register;

    /// Registers of these kinds and clocks, each of which takes its own value again.
    fn design(registers: &[(RegisterKind, &str)]) -> Design {
        let mut logic = Netlist::new("m");
        let states: Vec<_> = (0..registers.len()).map(|i| logic.add_input(format!("q{i}"))).collect();
        states.iter().enumerate().for_each(|(i, &state)| {
            logic.add_output(format!("q{i}_next"), state);
        });
        let register = |(i, &(kind, clock)): (usize, &(RegisterKind, &str))| Register {
            name: format!("q{i}"),
            kind,
            clock: Some(clock.to_owned()),
            start: None,
            forcing: Forcing::Never,
        };
        Design::new(logic, registers.iter().enumerate().map(register).collect())
    }

    fn check(registers: &[(RegisterKind, &str)], expected: Option<&str>) {
        for format in [CircuitFormat::AigerText, CircuitFormat::AigerBinary] {
            let said = format.encode(&design(registers)).err().map(|fault| fault.message);
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
