//! The project's own language: a netlist as a circuit of calls.

use std::fmt::Write;

use crate::circuit::formats::names::{FileNames, cells_in_order, stand_ins};
use crate::circuit::{Loops, NetId, Netlist, Node};

/// Reserved words of the language.
const RESERVED: &[&str] = &[
    "and",
    "circuit",
    "else",
    "evolution",
    "for",
    "if",
    "import",
    "in",
    "init",
    "latch",
    "library",
    "log2",
    "material",
    "nand",
    "net",
    "nor",
    "not",
    "or",
    "register",
    "schedule",
    "simulate",
    "stimulus",
    "swarm",
    "table",
    "test",
    "then",
    "use",
    "xnor",
    "xor",
];

/// Writes a netlist; feedback keeps its start values.
pub fn write(netlist: &Netlist) -> String {
    let loops = Loops::of(netlist);
    let names = FileNames::new(netlist, &[], &[], word);
    let stand_ins = stand_ins(netlist, 0);
    let net = |id: NetId| match netlist.node(id) {
        Node::Constant(value) => u8::from(*value).to_string(),
        _ => names.net(*stand_ins.get(&id).unwrap_or(&id)).to_owned(),
    };
    let ports = |ids: &[NetId]| ids.iter().map(|&id| names.net(id).to_owned()).collect::<Vec<_>>().join(", ");
    let title = if netlist.name.is_empty() { "main".to_owned() } else { word(&netlist.name) };
    let mut text = format!("circuit {title}({}) -> ({}) {{\n", ports(netlist.inputs()), ports(netlist.outputs()));
    for id in cells_in_order(netlist) {
        let cell = netlist.cell(id).expect("the order holds cells");
        let pins: Vec<_> = netlist.pins(id).into_iter().map(net).collect();
        let start = cell
            .start
            .filter(|_| loops.contains(id))
            .map_or(String::new(), |start| format!(" init {}", u8::from(start)));
        let _ = writeln!(text, "    {}{start} = {}", net(id), expression(cell.function.bits(), &pins));
    }
    for &id in netlist.outputs() {
        let driver = netlist.pins(id)[0];
        if stand_ins.get(&driver) != Some(&id) {
            let _ = writeln!(text, "    {} = {}", names.net(id), net(driver));
        }
    }
    text.push_str("}\n");
    text
}

/// A function of pins in the words of the language.
fn expression(bits: u8, pins: &[String]) -> String {
    let a = &pins[0];
    let b = pins.get(1).unwrap_or(a);
    match bits {
        0b0000 => "0".to_owned(),
        0b1111 => "1".to_owned(),
        0b0011 => format!("not {a}"),
        0b0101 => format!("not {b}"),
        0b1100 => a.clone(),
        0b1010 => b.clone(),
        0b0110 => format!("xor({a}, {b})"),
        0b1001 => format!("xnor({a}, {b})"),
        0b1000 => format!("and({a}, {b})"),
        0b0111 => format!("nand({a}, {b})"),
        0b1110 => format!("or({a}, {b})"),
        0b0001 => format!("nor({a}, {b})"),
        0b0100 => format!("and({a}, not {b})"),
        0b0010 => format!("and(not {a}, {b})"),
        0b1101 => format!("or({a}, not {b})"),
        _ => format!("or(not {a}, {b})"),
    }
}

/// A name as the language reads it.
fn word(name: &str) -> String {
    let mut word: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    let nameless = word.chars().all(|c| c == '_');
    if nameless || word.starts_with(|c: char| c.is_ascii_digit()) || RESERVED.contains(&word.as_str()) {
        word.insert_str(0, "n_");
    }
    word
}
