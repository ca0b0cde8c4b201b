//! AIGER, and-inverter graphs: ascii (`aag`) and binary (`aig`).

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::and_graph::{AndGraph, AndLiteral};
use crate::formats::design::Design;
use crate::formats::names::{FileNames, free};
use crate::formats::wording::aiger as wording;
use crate::formats::wording::aiger::{AigerPlace, BadLiteral};
use crate::formats::{Forcing, RegisterKind};
use crate::network::View;
use crate::{NetId, Netlist, RegisterNode};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::Function;

const EXTRA: [&str; 4] =
    ["bad-state properties", "invariant constraints", "justice properties", "fairness constraints"];

pub fn read(bytes: &[u8], clock: Option<&str>) -> Result<Design, Diagnostic> {
    AigerReader::new(bytes).read(clock)
}

pub(super) struct AigerReader<'b> {
    bytes: &'b [u8],
    at: usize,
    lines: usize,
    pub(super) place: AigerPlace,
}

pub(super) struct AigerHeader {
    binary: bool,
    pub(super) variables: usize,
    inputs: usize,
    latches: usize,
    outputs: usize,
    ands: usize,
    bad: usize,
    constraints: usize,
}

pub(super) type Placed = (usize, AigerPlace);

pub(super) struct AigerLatch {
    pub(super) literal: usize,
    pub(super) next: usize,
    pub(super) start: Option<bool>,
    pub(super) place: AigerPlace,
}

#[derive(Clone, Copy)]
pub(super) struct And {
    pub(super) out: usize,
    pub(super) pins: [usize; 2],
    pub(super) place: AigerPlace,
}

pub(super) struct AigerGraph {
    pub(super) inputs: Vec<Placed>,
    pub(super) latches: Vec<AigerLatch>,
    pub(super) outputs: Vec<Placed>,
    pub(super) bad: Vec<Placed>,
    pub(super) constraints: Vec<Placed>,
    pub(super) ands: Vec<And>,
}

impl<'b> AigerReader<'b> {
    pub(super) fn new(bytes: &'b [u8]) -> Self {
        Self { bytes, at: 0, lines: 0, place: AigerPlace::Line(1) }
    }

    fn line(&mut self) -> Result<&'b str, Diagnostic> {
        let rest = &self.bytes[self.at..];
        self.lines += 1;
        self.place = AigerPlace::Line(self.lines);
        let Some(end) = rest.iter().position(|&byte| byte == b'\n') else {
            return Err(wording::end_of_file(self.place));
        };
        let Ok(line) = std::str::from_utf8(&rest[..end]) else {
            return Err(wording::not_text(self.place));
        };
        self.at += end + 1;
        Ok(line.trim_end_matches('\r'))
    }

    fn numbers(&mut self) -> Result<Vec<usize>, Diagnostic> {
        let line = self.line()?;
        line.split(' ').map(str::parse).collect::<Result<_, _>>().map_err(|_| wording::not_numbers(line, self.place))
    }

    fn literal(&mut self, what: &'static str) -> Result<Placed, Diagnostic> {
        match self.numbers()?[..] {
            [literal] => Ok((literal, self.place)),
            ref numbers => Err(wording::port_literals(what, numbers.len(), self.place)),
        }
    }

    pub(super) fn header(&mut self) -> Result<AigerHeader, Diagnostic> {
        let line = self.line()?;
        let mut words = line.split(' ');
        let binary = match words.next() {
            Some("aig") => true,
            Some("aag") => false,
            _ => return Err(wording::not_aiger(line, self.place)),
        };
        let Ok(numbers) = words.map(str::parse).collect::<Result<Vec<usize>, _>>() else {
            return Err(wording::header(line, self.place));
        };
        let header_numbers = || wording::header_numbers(numbers.len(), self.place);
        let [variables, inputs, latches, outputs, ands, ref extra @ ..] = numbers[..] else {
            return Err(header_numbers());
        };
        if extra.len() > EXTRA.len() {
            return Err(header_numbers());
        }
        if let Some((&number, what)) = extra.iter().zip(EXTRA).skip(2).find(|(number, _)| **number > 0) {
            return Err(wording::liveness(what, number, self.place));
        }
        let [bad, constraints] = [0, 1].map(|at| extra.get(at).copied().unwrap_or(0));
        if let Some(&number) = numbers.iter().find(|&&number| Limit::AigerVariables.permit(number as u64).is_err()) {
            return Err(wording::too_large(number, self.place));
        }
        // A binary file only states the number of its inputs.
        if Limit::AigerPorts.permit(inputs.max(latches) as u64).is_err() {
            return Err(wording::too_many_ports(self.place));
        }
        let used = inputs + latches + ands;
        if used > variables || binary && used != variables {
            return Err(wording::sum([inputs, latches, ands], variables, binary, self.place));
        }
        // Every output takes at least two bytes and every gate two, so the header cannot announce more than the file
        // contains.
        if [outputs, ands, bad, constraints].into_iter().fold(0, usize::saturating_add) > self.bytes.len() {
            return Err(wording::too_short(outputs, ands, self.place));
        }
        Ok(AigerHeader { binary, variables, inputs, latches, outputs, ands, bad, constraints })
    }

    fn read(mut self, clock: Option<&str>) -> Result<Design, Diagnostic> {
        let header = self.header()?;
        let counts = [header.bad, header.constraints];
        if let Some((number, what)) = counts.into_iter().zip(EXTRA).find(|(number, _)| *number > 0) {
            return Err(wording::property(what, number, self.place));
        }
        let graph = self.graph(&header)?;
        let mut design = Design::new(build(&header, &graph)?);
        self.symbols(&mut design)?;
        // The clock may be an input that is a port, too.
        let registers: Vec<NetId> = design.netlist.registers().map(|(id, _)| id).collect();
        let clock = registers.first().map(|_| design.clock(clock.unwrap_or(Design::CLOCK)));
        let clocked = registers.into_iter().zip(clock.into_iter().cycle());
        clocked.for_each(|(id, clock)| design.netlist.connect(id, RegisterNode::CLOCK, clock));
        Ok(design)
    }

    pub(super) fn graph(&mut self, header: &AigerHeader) -> Result<AigerGraph, Diagnostic> {
        let mut inputs = Vec::with_capacity(header.inputs);
        for i in 0..header.inputs {
            inputs.push(if header.binary { (2 * (i + 1), self.place) } else { self.literal("an input")? });
        }
        let latches = (0..header.latches).map(|i| self.latch(header, i)).collect::<Result<_, _>>()?;
        let mut literals = |count: usize, what| (0..count).map(|_| self.literal(what)).collect::<Result<_, _>>();
        let outputs = literals(header.outputs, "an output")?;
        let bad = literals(header.bad, "a property")?;
        let constraints = literals(header.constraints, "a constraint")?;
        let ands = (0..header.ands).map(|i| self.and(header, i)).collect::<Result<_, _>>()?;
        Ok(AigerGraph { inputs, latches, outputs, bad, constraints, ands })
    }

    fn latch(&mut self, header: &AigerHeader, i: usize) -> Result<AigerLatch, Diagnostic> {
        let mut numbers = self.numbers()?;
        if header.binary {
            numbers.insert(0, 2 * (header.inputs + i + 1));
        }
        let (literal, next, start) = match numbers[..] {
            [latch, next] => (latch, next, Some(false)),
            [latch, next, start @ (0 | 1)] => (latch, next, Some(start == 1)),
            [latch, next, start] if start == latch => (latch, next, None),
            [latch, _, start] => return Err(wording::latch_start(latch, start, self.place)),
            _ => return Err(wording::latch(self.place)),
        };
        Ok(AigerLatch { literal, next, start, place: self.place })
    }

    fn and(&mut self, header: &AigerHeader, i: usize) -> Result<And, Diagnostic> {
        if !header.binary {
            return match self.numbers()?[..] {
                [out, a, b] => Ok(And { out, pins: [a, b], place: self.place }),
                ref numbers => Err(wording::gate_literals(numbers.len(), self.place)),
            };
        }
        let out = 2 * (header.inputs + header.latches + i + 1);
        let place = AigerPlace::Byte(self.at);
        let (first, second) = (self.delta()?, self.delta()?);
        match out.checked_sub(first).and_then(|a| Some((a, a.checked_sub(second)?))) {
            Some((a, b)) if first > 0 => Ok(And { out, pins: [a, b], place }),
            _ => Err(wording::gate_order(out, place)),
        }
    }

    /// A number in groups of seven bits, the lowest first.
    fn delta(&mut self) -> Result<usize, Diagnostic> {
        self.place = AigerPlace::Byte(self.at);
        let mut value = 0;
        for shift in (0..35).step_by(7) {
            let Some(&byte) = self.bytes.get(self.at) else {
                return Err(wording::end_of_file(self.place));
            };
            self.at += 1;
            value |= usize::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(value);
            }
        }
        Err(wording::long_number(self.place))
    }

    pub(super) fn symbol(&mut self) -> Result<Option<(&'b str, usize, &'b str)>, Diagnostic> {
        if self.at >= self.bytes.len() {
            return Ok(None);
        }
        let line = self.line()?;
        if line == "c" {
            return Ok(None);
        }
        let symbol = line.split_once(' ').and_then(|(place, name)| {
            let (kind, number) = place.split_at_checked(1)?;
            Some((kind, number.parse::<usize>().ok()?, name))
        });
        symbol.filter(|(_, _, name)| !name.is_empty()).map(Some).ok_or_else(|| wording::not_a_symbol(line, self.place))
    }

    fn symbols(&mut self, design: &mut Design) -> Result<(), Diagnostic> {
        let netlist = &mut design.netlist;
        let registers: Vec<NetId> = netlist.registers().map(|(id, _)| id).collect();
        while let Some((kind, number, name)) = self.symbol()? {
            let known = match kind {
                "i" => netlist.inputs().get(number),
                "o" => netlist.outputs().get(number),
                "l" => registers.get(number),
                _ => None,
            };
            let Some(&id) = known else {
                return Err(wording::unknown_symbol(&format!("{kind}{number} {name}"), self.place));
            };
            netlist.rename(id, name);
        }
        // Registers are known by their names.
        let mut taken = BTreeSet::new();
        for id in registers {
            let name = free(&mut taken, netlist.net_name(id));
            netlist.rename(id, &name);
        }
        Ok(())
    }
}

/// Its registers have no clock yet.
fn build(header: &AigerHeader, graph: &AigerGraph) -> Result<Netlist, Diagnostic> {
    let AigerGraph { inputs, latches, outputs, ands, .. } = graph;
    let mut logic = Netlist::new("circuit");
    let mut nets: Vec<Option<NetId>> = vec![None; header.variables + 1];
    let mut source = |id: NetId, (literal, place): Placed| {
        let net = nets.get_mut(literal / 2).filter(|net| literal > 1 && literal & 1 == 0 && net.is_none());
        let net = net.ok_or_else(|| wording::literal(BadLiteral::NotAnInput, literal, place))?;
        *net = Some(id);
        Ok(())
    };
    for (i, &placed) in inputs.iter().enumerate() {
        source(logic.add_input(format!("i{i}")), placed)?;
    }
    let mut registers = Vec::with_capacity(latches.len());
    for (i, &AigerLatch { literal, start, place, .. }) in latches.iter().enumerate() {
        let (kind, forcing, name) = (RegisterKind::Rising, Forcing::Never, Some(format!("l{i}")));
        let id = logic.add_loose_register(RegisterNode { kind, forcing, start, name, span: None });
        source(id, (literal, place))?;
        registers.push(id);
    }
    let mut literals = Literals { inverted: vec![None; header.variables + 1], constants: [None; 2], nets };
    let sources: Vec<bool> = literals.nets.iter().map(Option::is_some).collect();
    for And { out, pins, .. } in sorted(ands, &sources)? {
        literals.and(&mut logic, out, pins);
    }
    let undriven = |literal, place| wording::literal(BadLiteral::Undriven, literal, place);
    let mut driven = Vec::new();
    for &(literal, place) in outputs {
        driven.push(literals.net(&mut logic, literal).ok_or_else(|| undriven(literal, place))?);
    }
    for (id, &AigerLatch { next, place, .. }) in registers.into_iter().zip(latches) {
        let net = literals.net(&mut logic, next).ok_or_else(|| undriven(next, place))?;
        logic.connect(id, RegisterNode::DATA, net);
    }
    driven.into_iter().enumerate().for_each(|(i, net)| _ = logic.add_output(format!("o{i}"), net));
    Ok(logic)
}

/// The gates with drivers first; `sources` says which variables are inputs and latches.
pub(super) fn sorted(ands: &[And], sources: &[bool]) -> Result<Vec<And>, Diagnostic> {
    let gates = gates_by_variable(ands, sources)?;
    let mut state = vec![0u8; ands.len()];
    let mut order = Vec::with_capacity(ands.len());
    for root in 0..ands.len() {
        let mut open = vec![root];
        while let Some(&i) = open.last() {
            let And { out, pins, place } = ands[i];
            if state[i] == 2 {
                open.pop();
                continue;
            }
            state[i] = 1;
            let mut ready = true;
            for literal in pins {
                match gates.get(literal / 2) {
                    Some(Some(pin)) if state[*pin] == 0 => {
                        open.push(*pin);
                        ready = false;
                    }
                    Some(Some(pin)) if state[*pin] == 1 => {
                        return Err(wording::literal(BadLiteral::Loop, out, place));
                    }
                    Some(None) if literal > 1 && !sources[literal / 2] => {
                        return Err(wording::literal(BadLiteral::Undriven, literal, place));
                    }
                    None => return Err(wording::literal(BadLiteral::OverHeader, literal, place)),
                    _ => {}
                }
            }
            if ready {
                state[i] = 2;
                order.push(ands[i]);
                open.pop();
            } else if open.len() > ands.len() + 2 {
                return Err(wording::literal(BadLiteral::Loop, out, place));
            }
        }
    }
    Ok(order)
}

fn gates_by_variable(ands: &[And], sources: &[bool]) -> Result<Vec<Option<usize>>, Diagnostic> {
    let mut gates: Vec<Option<usize>> = vec![None; sources.len()];
    for (i, &And { out, place, .. }) in ands.iter().enumerate() {
        let Some(gate) = gates.get_mut(out / 2).filter(|_| out > 1 && out & 1 == 0) else {
            return Err(wording::literal(BadLiteral::NotAGate, out, place));
        };
        if sources[out / 2] || gate.replace(i).is_some() {
            return Err(wording::literal(BadLiteral::DefinedTwice, out, place));
        }
    }
    Ok(gates)
}

struct Literals {
    nets: Vec<Option<NetId>>,
    inverted: Vec<Option<NetId>>,
    constants: [Option<NetId>; 2],
}

impl Literals {
    fn net(&mut self, logic: &mut Netlist, literal: usize) -> Option<NetId> {
        if literal < 2 {
            return Some(*self.constants[literal].get_or_insert_with(|| logic.add_constant(literal == 1)));
        }
        let net = (*self.nets.get(literal / 2)?)?;
        if literal & 1 == 0 {
            return Some(net);
        }
        Some(*self.inverted[literal / 2].get_or_insert_with(|| logic.add_gate(Function::NOT, &[net])))
    }

    fn and(&mut self, logic: &mut Netlist, out: usize, pins: [usize; 2]) {
        let mut function = Function::AND;
        for (pin, literal) in pins.into_iter().enumerate() {
            function = if literal & 1 == 1 { function.with_input_inverted(pin) } else { function };
        }
        let nets = pins.map(|literal| self.net(logic, literal & !1).expect("the gates are sorted"));
        // A pin with constant 1 reads the inversion of literal 0, as for any other literal.
        self.nets[out / 2] = Some(logic.add_gate(function, &nets));
    }
}

/// # Panics
/// When the logic of the design has loops; a design that was read has none.
pub fn write(design: &Design, binary: bool) -> Vec<u8> {
    let registers: Vec<NetId> = design.netlist.registers().map(|(id, _)| id).collect();
    let view = View::of(&design.netlist, &registers).expect("the logic of a design has no loops");
    let ports = design.ports().len();
    let mut graph = AndGraph::new(ports + registers.len());
    // The clock has no literal.
    let clocks = design.own_clocks().iter().map(|_| 0);
    let mut sources: Vec<AndLiteral> = (0..ports).map(|at| graph.source(at)).chain(clocks).collect();
    sources.extend((0..registers.len()).map(|at| graph.source(ports + at)));
    let outputs = graph.outputs(&view.network, &sources);
    text(&graph, design, &outputs, binary)
}

/// The file of a graph whose outputs are those of the design and then the data and clocks of its registers.
fn text(graph: &AndGraph, design: &Design, outputs: &[AndLiteral], binary: bool) -> Vec<u8> {
    let registers: Vec<(NetId, &RegisterNode)> = design.netlist.registers().collect();
    let (ports, latches) = (design.ports().len(), registers.len());
    let (shown, pins) = outputs.split_at(design.netlist.outputs().len());
    let word = if binary { "aig" } else { "aag" };
    let total = graph.signals();
    let mut text = format!("{word} {total} {ports} {latches} {} {}\n", shown.len(), graph.ands.items.len());
    let own = |i: usize| 2 * (i + 1);
    if !binary {
        (0..ports).for_each(|i| text.push_str(&format!("{}\n", own(i))));
    }
    for (i, ((_, register), pins)) in registers.iter().zip(pins.chunks(2)).enumerate() {
        let (latch, next) = (own(ports + i), pins[0]);
        let start = register.start.map_or(latch, usize::from);
        let _ = if binary { writeln!(text, "{next} {start}") } else { writeln!(text, "{latch} {next} {start}") };
    }
    shown.iter().for_each(|literal| text.push_str(&format!("{literal}\n")));
    let mut bytes = text.into_bytes();
    for (i, &[a, b]) in graph.ands.items.iter().enumerate() {
        let out = own(ports + latches + i);
        if binary {
            push_delta(&mut bytes, out - a);
            push_delta(&mut bytes, a - b);
        } else {
            bytes.extend(format!("{out} {a} {b}\n").bytes());
        }
    }
    let readable = |name: &str| name.chars().map(|c| if c.is_control() { '_' } else { c }).collect::<String>();
    let legal = |name: &str| if name.is_empty() { "_".to_owned() } else { readable(name) };
    let names = FileNames::new(design, &[], true, legal);
    let label = |kind: &str, ids: &[NetId]| {
        ids.iter().enumerate().map(|(i, &id)| format!("{kind}{i} {}\n", names.net(id))).collect::<String>()
    };
    let registers: Vec<NetId> = registers.into_iter().map(|(id, _)| id).collect();
    bytes.extend(label("i", design.ports()).bytes());
    bytes.extend(label("l", &registers).bytes());
    bytes.extend(label("o", design.netlist.outputs()).bytes());
    bytes
}

fn push_delta(bytes: &mut Vec<u8>, mut value: usize) {
    while value >= 0x80 {
        bytes.push((value & 0x7f) as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}
