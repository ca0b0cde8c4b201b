//! Structural Verilog: an `assign` a cell, an `always` block a register.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::circuit::formats::design::{Design, RegisterKind};
use crate::circuit::formats::names::{cells_in_order, names};
use crate::circuit::{NetId, Netlist, Node};

/// Writes a design.
pub fn write(design: &Design) -> String {
    let netlist = &design.logic;
    // Escaped last: a number behind an escaped name would stand outside of it.
    let names = names(netlist, design.registers.len(), str::to_owned);
    let names: BTreeMap<_, _> = names.into_iter().map(|(id, name)| (id, escaped(&name))).collect();
    let (inputs, states) = netlist.inputs().split_at(design.inputs());
    let (outputs, nexts) = netlist.outputs().split_at(design.outputs());
    let known: Vec<_> = inputs.iter().map(|&id| netlist.net_name(id)).collect();
    let mut clocks: Vec<_> = design.registers.iter().filter_map(|register| register.clock.clone()).collect();
    clocks.sort_unstable();
    clocks.dedup();
    clocks.retain(|clock| !known.contains(clock));
    let clocks = clocks.iter().map(|clock| escaped(clock));
    let input_names: Vec<_> = clocks.chain(inputs.iter().map(|id| names[id].clone())).collect();
    let output_names: Vec<_> = outputs.iter().map(|id| names[id].clone()).collect();
    let ports = input_names.iter().map(|name| format!("input {name}"));
    let ports: Vec<_> = ports.chain(output_names.iter().map(|name| format!("output {name}"))).collect();
    let title = if netlist.name.is_empty() { "circuit".to_owned() } else { escaped(&netlist.name) };
    let mut text = format!("module {title}({});\n", ports.join(", "));
    for (state, register) in states.iter().zip(&design.registers) {
        let start = register.start.map_or(String::new(), |start| format!(" = 1'b{}", u8::from(start)));
        let _ = writeln!(text, "    reg {}{start};", names[state]);
    }
    let cells = cells_in_order(netlist);
    for id in cells.iter().chain(nexts) {
        let _ = writeln!(text, "    wire {};", names[id]);
    }
    let net = |id: NetId| match netlist.node(id) {
        Node::Constant(value) => format!("1'b{}", u8::from(*value)),
        _ => names[&id].clone(),
    };
    for &id in &cells {
        let _ = writeln!(text, "    assign {} = {};", names[&id], expression(netlist, id, &net));
    }
    for &id in netlist.outputs() {
        let _ = writeln!(text, "    assign {} = {};", names[&id], net(netlist.pins(id)[0]));
    }
    for ((register, state), next) in design.registers.iter().zip(states).zip(nexts) {
        let clock = escaped(register.clock.as_deref().unwrap_or("clk"));
        let (state, next) = (&names[state], &names[next]);
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

/// Words that Verilog keeps for itself and that circuits like to use.
const RESERVED: &[&str] = &[
    "always", "and", "assign", "begin", "buf", "case", "default", "else", "end", "for", "if", "initial", "inout",
    "input", "module", "nand", "nor", "not", "or", "output", "reg", "table", "wire", "xnor", "xor",
];

/// A name as Verilog reads it, with a backslash and a space where it is no plain word.
fn escaped(name: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let word = name.chars().all(plain) && !name.starts_with(|c: char| c.is_ascii_digit()) && !name.is_empty();
    if word && !RESERVED.contains(&name) {
        return name.to_owned();
    }
    let visible: String = name.chars().map(|c| if c.is_ascii_graphic() { c } else { '_' }).collect();
    format!("\\{visible} ")
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
    fn a_name_that_two_nets_share_is_numbered_inside_its_escape() {
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
