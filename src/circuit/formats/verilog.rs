//! Structural Verilog: an `assign` a cell, an `always` block a register.

use std::fmt::Write;

use crate::circuit::formats::design::{Design, RegisterKind};
use crate::circuit::formats::names::{ClockName, FileNames, cells_in_order, visible};
use crate::circuit::{NetId, Netlist, Node};

/// Writes a design.
pub fn write(design: &Design) -> String {
    let netlist = &design.logic;
    // Escaped last, because a number appended to an escaped name would be outside of it.
    let names = FileNames::new(netlist, &design.registers, &[], |name| visible(name, &[]));
    let name = |id: NetId| escaped(names.net(id));
    let (inputs, states) = netlist.inputs().split_at(design.inputs());
    let (outputs, nexts) = netlist.outputs().split_at(design.outputs());
    let clocks = names.own_clocks().map(escaped);
    let input_names: Vec<_> = clocks.chain(inputs.iter().map(|&id| name(id))).collect();
    let output_names: Vec<_> = outputs.iter().map(|&id| name(id)).collect();
    let ports = input_names.iter().map(|name| format!("input {name}"));
    let ports: Vec<_> = ports.chain(output_names.iter().map(|name| format!("output {name}"))).collect();
    let title = if netlist.name.is_empty() { "circuit".to_owned() } else { escaped(&visible(&netlist.name, &[])) };
    let mut text = format!("module {title}({});\n", ports.join(", "));
    for (state, register) in states.iter().zip(&design.registers) {
        let start = register.start.map_or(String::new(), |start| format!(" = 1'b{}", u8::from(start)));
        let _ = writeln!(text, "    reg {}{start};", name(*state));
    }
    let cells = cells_in_order(netlist);
    for &id in cells.iter().chain(nexts) {
        let _ = writeln!(text, "    wire {};", name(id));
    }
    let net = |id: NetId| match netlist.node(id) {
        Node::Constant(value) => format!("1'b{}", u8::from(*value)),
        _ => name(id),
    };
    for &id in &cells {
        let _ = writeln!(text, "    assign {} = {};", name(id), expression(netlist, id, &net));
    }
    for &id in netlist.outputs() {
        let _ = writeln!(text, "    assign {} = {};", name(id), net(netlist.pins(id)[0]));
    }
    for ((register, state), next) in design.registers.iter().zip(states).zip(nexts) {
        let clock = match names.clock(register) {
            Some(ClockName::Net(id)) => name(id),
            Some(ClockName::Own(clock)) => escaped(clock),
            None => "clk".to_owned(),
        };
        let (state, next) = (name(*state), name(*next));
        let _ = match register.kind {
            RegisterKind::Rising => writeln!(text, "    always @(posedge {clock}) {state} <= {next};"),
            RegisterKind::Falling => writeln!(text, "    always @(negedge {clock}) {state} <= {next};"),
            RegisterKind::High => writeln!(text, "    always @* if ({clock}) {state} = {next};"),
            RegisterKind::Low => writeln!(text, "    always @* if (!{clock}) {state} = {next};"),
        };
    }
    text.push_str("endmodule\n");
    text
}

fn expression(netlist: &Netlist, id: NetId, net: &impl Fn(NetId) -> String) -> String {
    let function = netlist.cell(id).expect("the order holds cells").function;
    let pins = netlist.pins(id);
    let a = net(pins[0]);
    let b = pins.get(1).map_or_else(|| a.clone(), |&pin| net(pin));
    match function.bits() {
        0b0000 => "1'b0".to_owned(),
        0b1111 => "1'b1".to_owned(),
        0b0011 => format!("~{a}"),
        0b0101 => format!("~{b}"),
        0b1100 => a,
        0b1010 => b,
        0b0110 => format!("{a} ^ {b}"),
        0b1001 => format!("~({a} ^ {b})"),
        0b1000 => format!("{a} & {b}"),
        0b0111 => format!("~({a} & {b})"),
        0b1110 => format!("{a} | {b}"),
        0b0001 => format!("~({a} | {b})"),
        0b0100 => format!("{a} & ~{b}"),
        0b0010 => format!("~{a} & {b}"),
        0b1101 => format!("{a} | ~{b}"),
        _ => format!("~{a} | {b}"),
    }
}

/// The reserved words of Verilog and SystemVerilog.
const RESERVED: &[&str] = &[
    "accept_on",
    "alias",
    "always",
    "always_comb",
    "always_ff",
    "always_latch",
    "and",
    "assert",
    "assign",
    "assume",
    "automatic",
    "before",
    "begin",
    "bind",
    "bins",
    "binsof",
    "bit",
    "break",
    "buf",
    "bufif0",
    "bufif1",
    "byte",
    "case",
    "casex",
    "casez",
    "cell",
    "chandle",
    "checker",
    "class",
    "clocking",
    "cmos",
    "config",
    "const",
    "constraint",
    "context",
    "continue",
    "cover",
    "covergroup",
    "coverpoint",
    "cross",
    "deassign",
    "default",
    "defparam",
    "design",
    "disable",
    "dist",
    "do",
    "edge",
    "else",
    "end",
    "endcase",
    "endchecker",
    "endclass",
    "endclocking",
    "endconfig",
    "endfunction",
    "endgenerate",
    "endgroup",
    "endinterface",
    "endmodule",
    "endpackage",
    "endprimitive",
    "endprogram",
    "endproperty",
    "endsequence",
    "endspecify",
    "endtable",
    "endtask",
    "enum",
    "event",
    "eventually",
    "expect",
    "export",
    "extends",
    "extern",
    "final",
    "first_match",
    "for",
    "force",
    "foreach",
    "forever",
    "fork",
    "forkjoin",
    "function",
    "generate",
    "genvar",
    "global",
    "highz0",
    "highz1",
    "if",
    "iff",
    "ifnone",
    "ignore_bins",
    "illegal_bins",
    "implements",
    "implies",
    "import",
    "incdir",
    "include",
    "initial",
    "inout",
    "input",
    "inside",
    "instance",
    "int",
    "integer",
    "interconnect",
    "interface",
    "intersect",
    "join",
    "join_any",
    "join_none",
    "large",
    "let",
    "liblist",
    "library",
    "local",
    "localparam",
    "logic",
    "longint",
    "macromodule",
    "matches",
    "medium",
    "modport",
    "module",
    "nand",
    "negedge",
    "nettype",
    "new",
    "nexttime",
    "nmos",
    "nor",
    "noshowcancelled",
    "not",
    "notif0",
    "notif1",
    "null",
    "or",
    "output",
    "package",
    "packed",
    "parameter",
    "pmos",
    "posedge",
    "primitive",
    "priority",
    "program",
    "property",
    "protected",
    "pull0",
    "pull1",
    "pulldown",
    "pullup",
    "pulsestyle_ondetect",
    "pulsestyle_onevent",
    "pure",
    "rand",
    "randc",
    "randcase",
    "randsequence",
    "rcmos",
    "real",
    "realtime",
    "ref",
    "reg",
    "reject_on",
    "release",
    "repeat",
    "restrict",
    "return",
    "rnmos",
    "rpmos",
    "rtran",
    "rtranif0",
    "rtranif1",
    "s_always",
    "s_eventually",
    "s_nexttime",
    "s_until",
    "s_until_with",
    "scalared",
    "sequence",
    "shortint",
    "shortreal",
    "showcancelled",
    "signed",
    "small",
    "soft",
    "solve",
    "specify",
    "specparam",
    "static",
    "string",
    "strong",
    "strong0",
    "strong1",
    "struct",
    "super",
    "supply0",
    "supply1",
    "sync_accept_on",
    "sync_reject_on",
    "table",
    "tagged",
    "task",
    "this",
    "throughout",
    "time",
    "timeprecision",
    "timeunit",
    "tran",
    "tranif0",
    "tranif1",
    "tri",
    "tri0",
    "tri1",
    "triand",
    "trior",
    "trireg",
    "type",
    "typedef",
    "union",
    "unique",
    "unique0",
    "unsigned",
    "until",
    "until_with",
    "untyped",
    "use",
    "uwire",
    "var",
    "vectored",
    "virtual",
    "void",
    "wait",
    "wait_order",
    "wand",
    "weak",
    "weak0",
    "weak1",
    "while",
    "wildcard",
    "wire",
    "with",
    "within",
    "wor",
    "xnor",
    "xor",
];

/// A name in Verilog; escaped with a backslash and a space if it is not a plain word.
fn escaped(name: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let word = name.chars().all(plain) && !name.starts_with(|c: char| c.is_ascii_digit()) && !name.is_empty();
    if word && !RESERVED.contains(&name) {
        return name.to_owned();
    }
    format!("\\{name} ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circuit::example::full_adder;

    #[test]
    fn a_full_adder_is_readable() {
        let text = write(&Design { logic: full_adder(), registers: Vec::new() });
        assert!(
            text.starts_with("module full_adder(input a, input b, input cin, output sum, output carry);\n"),
            "{text}"
        );
        assert!(text.contains(" ^ cin;"), "{text}");
    }

    #[test]
    fn the_number_of_a_shared_name_is_inside_its_escape() {
        let mut netlist = Netlist::new("one");
        let a = netlist.add_input("q[0]");
        netlist.add_output("q[0]", a);
        let text = write(&Design { logic: netlist, registers: Vec::new() });
        assert!(text.starts_with("module one(input \\q[0] , output \\q[0]_1 );\n"), "{text}");
    }

    #[test]
    fn odd_names_are_escaped() {
        assert_eq!(escaped("a[3]"), "\\a[3] ");
        assert_eq!(escaped("and"), "\\and ");
        assert_eq!(escaped("q_1"), "q_1");
    }
}
