//! The writer of BLIF: a flat model. Registers with an asynchronous set or reset, for which BLIF has no syntax, are
//! cells of Yosys.

use std::fmt::Write;

use crate::formats::names::{FileNames, cells_in_order, stand_ins, starts, visible};
use crate::formats::{Design, Forcing, RegisterKind};
use crate::{NetId, Netlist, Node, RegisterNode};

pub fn write(design: &Design) -> String {
    let netlist = &design.netlist;
    let legal = |name: &str| visible(name, &['#', '\\', '=']);
    let names = FileNames::new(design, &[constant(false), constant(true), "NIL"], true, legal);
    let starts = starts(netlist);
    let mut stand_ins = stand_ins(netlist);
    // A memory element keeps its own name, by which it is compared.
    stand_ins.retain(|cell, output| !starts.contains_key(cell) || netlist.net_name(*cell) == netlist.net_name(*output));
    let name = |id: NetId| match netlist.node(id) {
        Node::Constant(value) => constant(*value),
        _ => names.net(*stand_ins.get(&id).unwrap_or(&id)),
    };
    let list = |ids: &[NetId]| ids.iter().map(|id| format!(" {}", names.net(*id))).collect::<String>();
    let title = if netlist.name.is_empty() { "circuit".to_owned() } else { legal(&netlist.name) };
    let outputs = netlist.outputs();
    let mut text = format!(".model {title}\n.inputs{}\n.outputs{}\n", list(design.ports()), list(outputs));
    for &clock in design.own_clocks() {
        let _ = writeln!(text, ".clock {}", name(clock));
    }
    for (id, register) in netlist.registers() {
        let pins: Vec<&str> = netlist.pins(id).into_iter().map(name).collect();
        let (next, clock) = (pins[0], pins[1]);
        if register.forcing != Forcing::Never {
            text.push_str(&cell_of(register, clock, [next, name(id)], &pins[2..]));
            continue;
        }
        let kind = match register.kind {
            RegisterKind::Rising => "re",
            RegisterKind::Falling => "fe",
            RegisterKind::High => "ah",
            RegisterKind::Low => "al",
        };
        let start = register.start.map_or(2, u8::from);
        let _ = writeln!(text, ".latch {next} {} {kind} {clock} {start}", name(id));
    }
    for id in cells_in_order(netlist) {
        write_cell(&mut text, netlist, id, &name);
        if let Some(&start) = starts.get(&id) {
            let _ = writeln!(text, ".attr init {}", u8::from(start));
        }
    }
    for value in [false, true] {
        let used = |id: NetId| *netlist.node(id) == Node::Constant(value) && !netlist.fanout(id).is_empty();
        if netlist.ids().any(used) {
            let _ = writeln!(text, ".names {}{}", constant(value), if value { "\n1" } else { "" });
        }
    }
    for &output in outputs {
        let driver = netlist.pins(output)[0];
        // An output may be an input.
        if stand_ins.get(&driver) != Some(&output) && name(driver) != names.net(output) {
            let _ = writeln!(text, ".names {} {}\n1 1", name(driver), names.net(output));
        }
    }
    text.push_str(".end\n");
    text
}

fn write_cell<'n>(text: &mut String, netlist: &Netlist, id: NetId, name: &impl Fn(NetId) -> &'n str) {
    let function = netlist.cell(id).expect("the order holds cells").function;
    let pins = netlist.pins(id);
    let list: String = pins.iter().map(|&pin| format!(" {}", name(pin))).collect();
    let _ = writeln!(text, ".names{list} {}", name(id));
    // A cell of one pin does not depend on the others of its function.
    let missing = function.inputs() - pins.len();
    for row in (0..1usize << pins.len()).filter(|row| function.row(row << missing)) {
        let _ = writeln!(text, "{row:0width$b} 1", width = pins.len());
    }
}

fn constant(value: bool) -> &'static str {
    if value { "$true" } else { "$false" }
}

pub(super) struct ForcedCell {
    pub(super) kind: RegisterKind,
    pub(super) forcing: Forcing,
    /// The value that a reset gives it, if it has no set.
    pub(super) start: Option<bool>,
    pub(super) clock: &'static str,
    pub(super) ports: &'static [&'static str],
}

/// A cell such as `$_DFF_PP0_`. Yosys inverts nets that force a register while they are 0.
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

/// The start value of a register with both a set and a reset is an attribute.
pub(super) fn cell_of(register: &RegisterNode, clock: &str, [next, value]: [&str; 2], forcing: &[&str]) -> String {
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
