//! The project's own language: a design as a circuit of calls.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::formats::names::cells_in_order;
use crate::formats::nb_names::{NamedBit, NamedNet, NbNames, word};
use crate::formats::{Design, Forcing, Register, RegisterKind};
use crate::{Loops, NetId, Node};
use nbc_base::model::Function;

/// The most bits of one call of a register: its start value must be a literal.
const MOST_BITS: usize = 32;

pub fn write(design: &Design) -> String {
    let (names, loops) = (NbNames::new(design), Loops::of(&design.logic));
    let writer = Writer { design, names, loops, forcing: design.forcing_nets() };
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
    design: &'d Design,
    names: NbNames,
    loops: Loops,
    forcing: Vec<Vec<NetId>>,
}

impl Writer<'_> {
    fn head(&self) -> String {
        let name = &self.design.logic.name;
        let title = if name.is_empty() { "main".to_owned() } else { word(name) };
        let declared = |nets: &[NamedNet]| nets.iter().map(NamedNet::declared).collect::<Vec<_>>();
        let mut inputs = declared(&self.names.inputs);
        inputs.extend(self.names.clocks.values().cloned());
        format!("circuit {title}({}) -> ({}) {{\n", inputs.join(", "), declared(&self.names.outputs).join(", "))
    }

    fn bit(&self, id: NetId) -> NamedBit {
        self.names.bit(&self.design.logic, id)
    }

    fn registers(&self, statements: &mut Vec<String>) -> Vec<String> {
        let logic = &self.design.logic;
        let states = &logic.inputs()[self.design.inputs()..];
        let shown = |(at, id): (usize, &NetId)| (*self.names.stand_ins.get(id).unwrap_or(id), at);
        let registers: BTreeMap<NetId, usize> = states.iter().enumerate().map(shown).collect();
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

    fn runs<'r>(&self, known: &'r [(NetId, usize)], width: usize) -> Vec<&'r [(NetId, usize)]> {
        let register = |at: usize| &self.design.registers[at];
        let change = |at: usize| {
            let register = register(at);
            (register.kind, &register.clock, register.forcing, &self.forcing[at])
        };
        let together = known.len() == width && known.windows(2).all(|pair| change(pair[0].1) == change(pair[1].1));
        known.chunks(if together { MOST_BITS } else { 1 }).collect()
    }

    fn register(&self, run: &[(NetId, usize)]) -> String {
        let logic = &self.design.logic;
        let register = &self.design.registers[run[0].1];
        let nexts = &logic.outputs()[self.design.outputs()..];
        let joined = |bits: Vec<NamedBit>| NamedBit::joined(&bits.into_iter().rev().collect::<Vec<_>>());
        let target = joined(run.iter().map(|(shown, _)| self.bit(*shown)).collect());
        let next = joined(run.iter().map(|(_, at)| self.bit(logic.pins(nexts[*at])[0])).collect());
        let clock = self.clock(register);
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
        let forcing: String = self.forcing[run[0].1].iter().map(|&net| format!(", {}", self.bit(net).text())).collect();
        let value = |at: usize| u64::from(self.design.registers[at].starts_at());
        let start = run.iter().rev().fold(0, |sum, (_, at)| sum << 1 | value(*at));
        let start = if start == 0 { String::new() } else { format!("[start = {start}]") };
        format!("{target} = {word}{start}({next}, {clock}{forcing})")
    }

    fn clock(&self, register: &Register) -> String {
        let clock = register.clock_name();
        match self.names.clocks.get(clock) {
            Some(own) => own.clone(),
            None => {
                let logic = &self.design.logic;
                let source = logic.inputs().iter().find(|&&id| logic.net_name(id) == clock);
                self.bit(*source.expect("a clock is an input, a register or its own")).text()
            }
        }
    }

    fn cells(&self, statements: &mut Vec<String>) {
        let logic = &self.design.logic;
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
        let logic = &self.design.logic;
        for &id in &logic.outputs()[..self.design.outputs()] {
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
