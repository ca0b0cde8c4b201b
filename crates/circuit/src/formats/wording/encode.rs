//! Messages about designs that a format cannot represent.

use crate::formats::RegisterKind;
use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic};

const KEEPS_REGISTERS: &str = "write BLIF or Verilog, which keep every register";

fn bad_value(message: impl Into<String>, help: &str) -> Diagnostic {
    Diagnostic::without_place(Code::BadValue, message).with_help(help)
}

pub fn aiger_loop() -> Diagnostic {
    let help = "keep the registers with `--registers keep`, or write BLIF or Verilog";
    bad_value("AIGER has no feedback loops", help)
}

pub fn aiger_register(register: &str, kind: RegisterKind) -> Diagnostic {
    let kind = match kind {
        RegisterKind::Rising => "a flip-flop of the rising edge",
        RegisterKind::Falling => "a flip-flop of the falling edge",
        RegisterKind::High | RegisterKind::Low => "a level-sensitive latch",
    };
    let message = format!("AIGER only has flip-flops of the rising edge, but `{register}` is {kind}");
    bad_value(message, KEEPS_REGISTERS)
}

pub fn aiger_forced(register: &str) -> Diagnostic {
    let message = format!("AIGER has no asynchronous set or reset, but `{register}` has one");
    bad_value(message, KEEPS_REGISTERS)
}

pub fn aiger_clocks<'c>(clocks: impl IntoIterator<Item = &'c str>) -> Diagnostic {
    let clocks: Vec<_> = clocks.into_iter().map(|clock| format!("`{clock}`")).collect();
    bad_value(format!("AIGER has one clock, but the registers have {}", clocks.join(", ")), KEEPS_REGISTERS)
}

pub fn nb_without_outputs(circuit: &str) -> Diagnostic {
    let message = format!("`{circuit}` has no outputs, but a circuit of a .nb file needs one");
    bad_value(message, "give the model an output")
}

pub fn pla_state() -> Diagnostic {
    let message = "PLA is logic without state, but the circuit has registers or loops";
    bad_value(message, "write BLIF, which keeps registers")
}

pub fn pla_inputs(inputs: usize) -> Diagnostic {
    let most = Limit::TriedBits.most();
    let message = format!("PLA is written of at most {most} input bits, but the circuit has {inputs}");
    bad_value(message, "write BLIF, which keeps the gates")
}

pub fn unknown_format(path: &str) -> Diagnostic {
    let expected = "expected .blif, .pla, .aig, .aag, .v, .dot or .nb";
    let message = format!("unrecognized circuit format of `{path}`; {expected}");
    Diagnostic::without_place(Code::BadValue, message)
}
