//! The formats for a design, and the limits of each.

use std::collections::BTreeSet;

use crate::formats::wording::encode as wording;
use crate::formats::{Design, Forcing, RegisterKind, aiger, blif, dot, nb, pla, verilog};
use crate::{Loops, NetId};
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
            Self::Nb if design.netlist.outputs().is_empty() => {
                return Err(wording::nb_without_outputs(&design.netlist.name));
            }
            Self::Pla => fits_pla(design)?,
            Self::Nb | Self::Blif | Self::Verilog | Self::Dot => {}
        }
        Ok(match self {
            Self::Blif => blif::write(design).into_bytes(),
            Self::Pla => pla::write(design).into_bytes(),
            Self::AigerBinary => aiger::write(design, true),
            Self::AigerText => aiger::write(design, false),
            Self::Verilog => verilog::write(design).into_bytes(),
            Self::Dot => dot::write(&design.netlist).into_bytes(),
            Self::Nb => nb::write(design).into_bytes(),
        })
    }
}

/// AIGER has flip-flops of one clock without a name, and no loops.
fn fits_aiger(design: &Design) -> Result<(), Diagnostic> {
    if !Loops::of(&design.netlist).cores().is_empty() {
        return Err(wording::aiger_loop());
    }
    let netlist = &design.netlist;
    if let Some((id, _)) = netlist.registers().find(|(_, register)| register.forcing != Forcing::Never) {
        return Err(wording::aiger_forced(&netlist.net_name(id)));
    }
    if let Some((id, register)) = netlist.registers().find(|(_, register)| register.kind != RegisterKind::Rising) {
        return Err(wording::aiger_register(&netlist.net_name(id), register.kind));
    }
    let clocks: BTreeSet<NetId> = netlist.registers().map(|(id, _)| netlist.pins(id)[1]).collect();
    if clocks.len() > 1 {
        let names: BTreeSet<String> = clocks.into_iter().map(|clock| netlist.net_name(clock)).collect();
        return Err(wording::aiger_clocks(names.iter().map(String::as_str)));
    }
    Ok(())
}

/// A PLA is two-level logic, written from a truth table.
fn fits_pla(design: &Design) -> Result<(), Diagnostic> {
    let inputs = design.netlist.inputs().len();
    if design.netlist.registers().next().is_some() || !Loops::of(&design.netlist).cores().is_empty() {
        return Err(wording::pla_state());
    }
    Limit::TriedBits.permit(inputs as u64).map_err(|_| wording::pla_inputs(inputs))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Netlist, RegisterNode};

    fn check(registers: &[(RegisterKind, &str)], expected: Option<&str>) {
        let mut design = Design::new(Netlist::new("m"));
        for (i, &(kind, clock)) in registers.iter().enumerate() {
            let clock = design.clock(clock);
            let name = Some(format!("q{i}"));
            let register = RegisterNode { kind, forcing: Forcing::Never, start: None, name, span: None };
            let id = design.netlist.add_loose_register(register);
            (0..).zip([id, clock]).for_each(|(pin, net)| design.netlist.connect(id, pin, net));
        }

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
