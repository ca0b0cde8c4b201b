//! DOT for Graphviz: inputs on the left, outputs on the right, a box for each cell.

use std::fmt::Write;

use crate::formats::names::starts;
use crate::{Loops, Netlist, Node};

/// Cells on feedback loops have a double border, memory elements their start values.
pub fn write(netlist: &Netlist) -> String {
    let loops = Loops::of(netlist);
    let starts = starts(netlist);
    let quoted = |text: &str| {
        let shown = text.chars().map(|c| if c.is_control() { '_' } else { c }).collect::<String>();
        shown.replace('\\', "\\\\").replace('"', "\\\"")
    };
    let mut text = format!("digraph \"{}\" {{\n    rankdir=LR;\n    node [shape=box];\n", quoted(&netlist.name));
    for id in netlist.ids() {
        let name = quoted(&netlist.net_name(id));
        let style = match netlist.node(id) {
            Node::Input(_) => format!("label=\"{name}\", shape=triangle, orientation=270"),
            Node::Output(_) => format!("label=\"{name}\", shape=circle"),
            Node::Constant(_) | Node::Wire { .. } => format!("label=\"{name}\", shape=plaintext"),
            Node::Cell(cell) => {
                let borders = if loops.contains(id) { ", peripheries=2" } else { "" };
                let start = starts.get(&id).map_or(String::new(), |&start| format!("\\ninit {}", u8::from(start)));
                format!("label=\"{}\\n{name}{start}\"{borders}", cell.function)
            }
            Node::Register(register) => {
                let start = u8::from(register.starts_at());
                format!("label=\"{}\\n{name}\\ninit {start}\", peripheries=2", register.kind.word())
            }
        };
        let _ = writeln!(text, "    n{} [{style}];", id.index());
    }
    for id in netlist.ids() {
        for (pin, driver) in netlist.pins(id).iter().enumerate() {
            let label = if netlist.pins(id).len() > 1 { format!(" [headlabel=\"{pin}\"]") } else { String::new() };
            let _ = writeln!(text, "    n{} -> n{}{label};", driver.index(), id.index());
        }
    }
    text.push_str("}\n");
    text
}
