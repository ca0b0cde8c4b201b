//! Designs that a format cannot represent.

use crate::formats::RegisterKind;
use nbc_base::diag::{Code, Diagnostic};

/// A design that cannot be written in the requested format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EncodeError {
    /// A feedback loop, in AIGER.
    AigerLoop,
    /// A register other than a flip-flop of the rising edge, in AIGER.
    AigerRegister { register: String, kind: RegisterKind },
    /// A register with an asynchronous set or reset, in AIGER.
    AigerForced { register: String },
    /// Registers of several clocks, in AIGER.
    AigerClocks { clocks: Vec<String> },
    /// A circuit without outputs, in the project's own language.
    NbNoOutputs { circuit: String },
    /// A circuit with registers or loops, as PLA.
    PlaState,
    /// A circuit with too many inputs for a truth table, as PLA.
    PlaInputs { inputs: usize, most: u64 },
    /// A file name without the extension of a format.
    UnknownFormat { path: String },
}

impl From<EncodeError> for Diagnostic {
    fn from(error: EncodeError) -> Self {
        let other_format = "write BLIF or Verilog, which keep every register";
        let (message, help) = match error {
            EncodeError::AigerLoop => {
                let help = "keep the registers with `--registers keep`, or write BLIF or Verilog";
                ("AIGER has no feedback loops".to_owned(), help)
            }
            EncodeError::AigerRegister { register, kind } => {
                let kind = match kind {
                    RegisterKind::Rising => "a flip-flop of the rising edge",
                    RegisterKind::Falling => "a flip-flop of the falling edge",
                    RegisterKind::High | RegisterKind::Low => "a level-sensitive latch",
                };
                (format!("AIGER only has flip-flops of the rising edge, but `{register}` is {kind}"), other_format)
            }
            EncodeError::AigerForced { register } => {
                (format!("AIGER has no asynchronous set or reset, but `{register}` has one"), other_format)
            }
            EncodeError::AigerClocks { clocks } => {
                let clocks: Vec<_> = clocks.iter().map(|clock| format!("`{clock}`")).collect();
                (format!("AIGER has one clock, but the registers have {}", clocks.join(", ")), other_format)
            }
            EncodeError::NbNoOutputs { circuit } => (
                format!("`{circuit}` has no outputs, but a circuit of a .nb file needs one"),
                "give the model an output",
            ),
            EncodeError::PlaState => {
                let message = "PLA is logic without state, but the circuit has registers or loops";
                (message.to_owned(), "write BLIF, which keeps registers")
            }
            EncodeError::PlaInputs { inputs, most } => {
                let message = format!("PLA is written of at most {most} input bits, but the circuit has {inputs}");
                (message, "write BLIF, which keeps the gates")
            }
            EncodeError::UnknownFormat { path } => {
                let expected = "expected .blif, .pla, .aig, .aag, .v, .dot or .nb";
                let message = format!("unrecognized circuit format of `{path}`; {expected}");
                return Self::without_place(Code::BadValue, message);
            }
        };
        Self::without_place(Code::BadValue, message).with_help(help)
    }
}
