//! The project's own language: a design as a circuit of calls.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::formats::names::cells_in_order;
use crate::formats::nb_names::{NamedBit, NamedNet, NbNames, word};
use crate::formats::{Design, Forcing, RegisterKind};
use crate::{Loops, NetId, Netlist, Node, RegisterNode};
use nbc_base::model::Function;

/// The most bits of one call of a register: its start value must be a literal.
const MOST_BITS: usize = 32;

pub fn write(design: &Design) -> String {
    let netlist = &design.netlist;
    let writer = Writer { netlist, names: NbNames::new(design), loops: Loops::of(netlist) };
    let mut statements = Vec::new();
    let declared = writer.registers(&mut statements);
    writer.cells(&mut statements);
    writer.copies(&mut statements);
    let mut text = writer.head();
    if !declared.is_empty() {
        let _ = writeln!(text, "    net {}", declared.join(", "));
    }
    statements.iter().for_each(|statement| {
        let _ = writeln!(text, "    {statement}");
    });
    text.push_str("}\n");
    text
}

struct Writer<'d> {
    netlist: &'d Netlist,
    names: NbNames,
    loops: Loops,
}

impl Writer<'_> {
    fn head(&self) -> String {
        let name = &self.netlist.name;
        let title = if name.is_empty() { "main".to_owned() } else { word(name) };
        let declared = |nets: &[NamedNet]| nets.iter().map(NamedNet::declared).collect::<Vec<_>>();
        let inputs = declared(&self.names.inputs);
        format!("circuit {title}({}) -> ({}) {{\n", inputs.join(", "), declared(&self.names.outputs).join(", "))
    }

    fn bit(&self, id: NetId) -> NamedBit {
        self.names.bit(self.netlist, id)
    }

    fn registers(&self, statements: &mut Vec<String>) -> Vec<String> {
        let shown = |(id, _)| (*self.names.stand_ins.get(&id).unwrap_or(&id), id);
        let registers: BTreeMap<NetId, NetId> = self.netlist.registers().map(shown).collect();
        let mut declared: Vec<_> =
            self.names.nexts.iter().filter(|net| net.bits.len() > 1).map(NamedNet::declared).collect();
        for (net, is_port) in
            self.names.outputs.iter().map(|net| (net, true)).chain(self.names.states.iter().map(|net| (net, false)))
        {
            let known: Vec<_> = net.bits.iter().filter_map(|bit| Some((*bit, *registers.get(bit)?))).collect();
            let calls = self.runs(&known, net.bits.len());
            if !is_port && calls.len() > 1 {
                declared.push(net.declared());
            }
            statements.extend(calls.iter().map(|run| self.register(run)));
        }
        declared
    }

    fn runs<'r>(&self, known: &'r [(NetId, NetId)], width: usize) -> Vec<&'r [(NetId, NetId)]> {
        let change = |id: NetId| {
            let register = self.node(id);
            (register.kind, register.forcing, self.netlist.pins(id).split_off(1))
        };
        let together = known.len() == width && known.windows(2).all(|pair| change(pair[0].1) == change(pair[1].1));
        known.chunks(if together { MOST_BITS } else { 1 }).collect()
    }

    fn node(&self, id: NetId) -> &RegisterNode {
        self.netlist.register(id).expect("these are registers")
    }

    fn register(&self, run: &[(NetId, NetId)]) -> String {
        let (register, pins) = (self.node(run[0].1), self.netlist.pins(run[0].1));
        let joined = |bits: Vec<NamedBit>| NamedBit::joined(&bits.into_iter().rev().collect::<Vec<_>>());
        let target = joined(run.iter().map(|(shown, _)| self.bit(*shown)).collect());
        let next = joined(run.iter().map(|(_, id)| self.bit(self.netlist.pins(*id)[0])).collect());
        let clock = self.bit(pins[1]).text();
        let (word, clock) = match register.kind {
            RegisterKind::Rising => ("register", clock),
            RegisterKind::Falling => ("register", format!("not {clock}")),
            RegisterKind::High => ("latch", clock),
            RegisterKind::Low => ("latch", format!("not {clock}")),
        };
        let word = match register.forcing {
            Forcing::Never => word.to_owned(),
            Forcing::ToStart => format!("async_{word}"),
            Forcing::SetReset => format!("set_reset_{word}"),
        };
        let forcing: String = pins[2..].iter().map(|&net| format!(", {}", self.bit(net).text())).collect();
        let start = run.iter().rev().fold(0, |sum, (_, id)| sum << 1 | u64::from(self.node(*id).starts_at()));
        let start = if start == 0 { String::new() } else { format!("[start = {start}]") };
        format!("{target} = {word}{start}({next}, {clock}{forcing})")
    }

    fn cells(&self, statements: &mut Vec<String>) {
        let logic = self.netlist;
        let init = |start: Option<bool>| start.map_or(String::new(), |start| format!(" init {}", u8::from(start)));
        for id in cells_in_order(logic) {
            let cell = logic.cell(id).expect("the order holds cells");
            let pins: Vec<_> = logic.operands(id).into_iter().map(|pin| self.bit(pin).text()).collect();
            let start = init(cell.start.filter(|_| self.loops.contains(id)));
            statements.push(format!("{}{start} = {}", self.bit(id).text(), expression(cell.function, &pins)));
        }
        for id in logic.ids() {
            if let Node::Wire { start, .. } = logic.node(id) {
                let driver = self.bit(logic.pins(id)[0]).text();
                statements.push(format!("{}{} = {driver}", self.bit(id).text(), init(*start)));
            }
        }
    }

    fn copies(&self, statements: &mut Vec<String>) {
        let logic = self.netlist;
        for &id in logic.outputs() {
            let driver = logic.pins(id)[0];
            if self.names.stand_ins.get(&driver) != Some(&id) {
                statements.push(format!("{} = {}", self.bit(id).text(), self.bit(driver).text()));
            }
        }
    }
}

fn expression(function: Function, pins: &[String]) -> String {
    let [a, b] = pins else {
        let [low, high] = function.halves().map(|half| expression(half, &pins[1..]));
        return format!("or(and({}, {high}), and(not {}, {low}))", pins[0], pins[0]);
    };
    match function.bits() {
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
