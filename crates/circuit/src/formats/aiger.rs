//! AIGER, and-inverter graphs: ascii (`aag`) and binary (`aig`).

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::formats::design::{Design, Forcing, Register, RegisterKind};
use crate::formats::names::{FileNames, free};
use crate::formats::wording::{AigerError, AigerPlace};
use crate::network::{Gate, View};
use crate::{NetId, Netlist};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::Function;

/// What version 1.9 of the format adds to the header.
const EXTRA: [&str; 4] =
    ["bad-state properties", "invariant constraints", "justice properties", "fairness constraints"];

/// Reads a file; `clock` names the clock of its latches.
///
/// # Errors
/// The first error of the file, with its line or byte.
pub fn read(bytes: &[u8], clock: Option<&str>) -> Result<Design, Diagnostic> {
    Reader { bytes, at: 0, lines: 0, place: AigerPlace::Line(1) }.read(clock)
}

struct Reader<'b> {
    bytes: &'b [u8],
    at: usize,
    /// The lines read so far.
    lines: usize,
    /// The start of the last token.
    place: AigerPlace,
}

/// The numbers of the header.
struct Header {
    binary: bool,
    variables: usize,
    inputs: usize,
    latches: usize,
    outputs: usize,
    ands: usize,
}

/// A literal with its position.
type Placed = (usize, AigerPlace);

/// A latch: its literal, its next literal, its start value.
struct Latch {
    literal: usize,
    next: usize,
    start: Option<bool>,
    place: AigerPlace,
}

/// A gate: its literal and the literals of its pins.
#[derive(Clone, Copy)]
struct And {
    out: usize,
    pins: [usize; 2],
    place: AigerPlace,
}

/// The contents of a file before its symbols.
struct Graph {
    inputs: Vec<Placed>,
    latches: Vec<Latch>,
    outputs: Vec<Placed>,
    ands: Vec<And>,
}

impl<'b> Reader<'b> {
    fn fault<T>(&self, error: AigerError) -> Result<T, Diagnostic> {
        Err(error.at(self.place))
    }

    fn line(&mut self) -> Result<&'b str, Diagnostic> {
        let rest = &self.bytes[self.at..];
        self.lines += 1;
        self.place = AigerPlace::Line(self.lines);
        let Some(end) = rest.iter().position(|&byte| byte == b'\n') else {
            return self.fault(AigerError::EndOfFile);
        };
        let Ok(line) = std::str::from_utf8(&rest[..end]) else {
            return self.fault(AigerError::NotText);
        };
        self.at += end + 1;
        Ok(line.trim_end_matches('\r'))
    }

    fn numbers(&mut self) -> Result<Vec<usize>, Diagnostic> {
        let line = self.line()?;
        match line.split(' ').map(str::parse).collect() {
            Ok(numbers) => Ok(numbers),
            Err(_) => self.fault(AigerError::NotNumbers { found: excerpt(line) }),
        }
    }

    fn literal(&mut self, what: &'static str) -> Result<Placed, Diagnostic> {
        match self.numbers()?[..] {
            [literal] => Ok((literal, self.place)),
            ref numbers => self.fault(AigerError::PortLiterals { what, found: numbers.len() }),
        }
    }

    fn header(&mut self) -> Result<Header, Diagnostic> {
        let line = self.line()?;
        let mut words = line.split(' ');
        let binary = match words.next() {
            Some("aig") => true,
            Some("aag") => false,
            _ => return self.fault(AigerError::NotAiger { found: excerpt(line) }),
        };
        let Ok(numbers) = words.map(str::parse).collect::<Result<Vec<usize>, _>>() else {
            return self.fault(AigerError::Header { found: excerpt(line) });
        };
        let [variables, inputs, latches, outputs, ands, ref extra @ ..] = numbers[..] else {
            return self.fault(AigerError::HeaderNumbers { found: numbers.len() });
        };
        if extra.len() > EXTRA.len() {
            return self.fault(AigerError::HeaderNumbers { found: numbers.len() });
        }
        if let Some((&number, what)) = extra.iter().zip(EXTRA).find(|(number, _)| **number > 0) {
            return self.fault(AigerError::Property { what, number });
        }
        if let Some(&number) = numbers.iter().find(|&&number| Limit::AigerVariables.permit(number as u64).is_err()) {
            return self.fault(AigerError::TooLarge { number, most: Limit::AigerVariables.most() });
        }
        // A binary file only states the number of its inputs.
        if Limit::AigerPorts.permit(inputs.max(latches) as u64).is_err() {
            return self.fault(AigerError::TooManyPorts { most: Limit::AigerPorts.most() });
        }
        let used = inputs + latches + ands;
        if used > variables || binary && used != variables {
            return self.fault(AigerError::Sum { inputs, latches, ands, variables, binary });
        }
        // Every output takes at least two bytes and every gate two, so the header cannot announce more than the file
        // contains.
        if outputs + ands > self.bytes.len() {
            return self.fault(AigerError::TooShort { outputs, ands });
        }
        Ok(Header { binary, variables, inputs, latches, outputs, ands })
    }

    fn read(mut self, clock: Option<&str>) -> Result<Design, Diagnostic> {
        let header = self.header()?;
        let mut inputs = Vec::with_capacity(header.inputs);
        for i in 0..header.inputs {
            inputs.push(if header.binary { (2 * (i + 1), self.place) } else { self.literal("an input")? });
        }
        let latches = (0..header.latches).map(|i| self.latch(&header, i)).collect::<Result<_, _>>()?;
        let outputs = (0..header.outputs).map(|_| self.literal("an output")).collect::<Result<_, _>>()?;
        let ands = (0..header.ands).map(|i| self.and(&header, i)).collect::<Result<_, _>>()?;
        let mut design = build(&header, &Graph { inputs, latches, outputs, ands }, clock)?;
        self.symbols(&mut design)?;
        Ok(design)
    }

    fn latch(&mut self, header: &Header, i: usize) -> Result<Latch, Diagnostic> {
        let mut numbers = self.numbers()?;
        if header.binary {
            numbers.insert(0, 2 * (header.inputs + i + 1));
        }
        let (literal, next, start) = match numbers[..] {
            [latch, next] => (latch, next, Some(false)),
            [latch, next, start @ (0 | 1)] => (latch, next, Some(start == 1)),
            [latch, next, start] if start == latch => (latch, next, None),
            [latch, _, start] => return self.fault(AigerError::LatchStart { latch, start }),
            _ => return self.fault(AigerError::Latch),
        };
        Ok(Latch { literal, next, start, place: self.place })
    }

    fn and(&mut self, header: &Header, i: usize) -> Result<And, Diagnostic> {
        if !header.binary {
            return match self.numbers()?[..] {
                [out, a, b] => Ok(And { out, pins: [a, b], place: self.place }),
                ref numbers => self.fault(AigerError::GateLiterals { found: numbers.len() }),
            };
        }
        let out = 2 * (header.inputs + header.latches + i + 1);
        let place = AigerPlace::Byte(self.at);
        let (first, second) = (self.delta()?, self.delta()?);
        self.place = place;
        match out.checked_sub(first).and_then(|a| Some((a, a.checked_sub(second)?))) {
            Some((a, b)) if first > 0 => Ok(And { out, pins: [a, b], place }),
            _ => self.fault(AigerError::GateOrder { gate: out }),
        }
    }

    /// A number in groups of seven bits, the lowest first.
    fn delta(&mut self) -> Result<usize, Diagnostic> {
        self.place = AigerPlace::Byte(self.at);
        let mut value = 0;
        for shift in (0..35).step_by(7) {
            let Some(&byte) = self.bytes.get(self.at) else {
                return self.fault(AigerError::EndOfFile);
            };
            self.at += 1;
            value |= usize::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(value);
            }
        }
        self.fault(AigerError::LongNumber)
    }

    /// Reads the names of ports and latches after the gates.
    fn symbols(&mut self, design: &mut Design) -> Result<(), Diagnostic> {
        let (inputs, outputs) = (design.inputs(), design.outputs());
        while self.at < self.bytes.len() {
            let line = self.line()?;
            if line == "c" {
                break;
            }
            let symbol = line.split_once(' ').and_then(|(place, name)| {
                let (kind, number) = place.split_at_checked(1)?;
                Some((kind, number.parse::<usize>().ok()?, name))
            });
            let Some((kind, number, name)) = symbol.filter(|(_, _, name)| !name.is_empty()) else {
                return self.fault(AigerError::Symbol { found: excerpt(line) });
            };
            let known = match kind {
                "i" if number < inputs => Some(design.logic.inputs()[number]),
                "o" if number < outputs => Some(design.logic.outputs()[number]),
                "l" if number < design.registers.len() => {
                    design.registers[number].name = name.to_owned();
                    Some(design.logic.inputs()[inputs + number])
                }
                _ => None,
            };
            let Some(id) = known else {
                return self.fault(AigerError::UnknownSymbol { found: excerpt(line) });
            };
            design.logic.rename(id, name);
        }
        // Registers are known by their names.
        let mut taken = BTreeSet::new();
        for (at, register) in design.registers.iter_mut().enumerate() {
            let name = free(&mut taken, register.name.clone());
            if name != register.name {
                design.logic.rename(design.logic.inputs()[inputs + at], &name);
                register.name = name;
            }
        }
        Ok(())
    }
}

/// The start of a line, for messages.
fn excerpt(line: &str) -> String {
    line.chars().take(40).collect()
}

/// The design of a graph.
fn build(header: &Header, graph: &Graph, clock: Option<&str>) -> Result<Design, Diagnostic> {
    let Graph { inputs, latches, outputs, ands } = graph;
    let mut logic = Netlist::new("circuit");
    let mut nets: Vec<Option<NetId>> = vec![None; header.variables + 1];
    let ports = inputs.iter().enumerate().map(|(i, &placed)| (format!("i{i}"), placed));
    let states = latches.iter().enumerate().map(|(i, latch)| (format!("l{i}"), (latch.literal, latch.place)));
    for (name, (literal, place)) in ports.chain(states) {
        match nets.get_mut(literal / 2).filter(|net| literal > 1 && literal & 1 == 0 && net.is_none()) {
            Some(net) => *net = Some(logic.add_input(name)),
            None => return Err(AigerError::NotAnInput { literal }.at(place)),
        }
    }
    let mut literals = Literals { inverted: vec![None; header.variables + 1], constants: [None; 2], nets };
    for And { out, pins, .. } in sorted(ands, &literals.nets)? {
        literals.and(&mut logic, out, pins);
    }
    let shown = outputs.iter().enumerate().map(|(i, &placed)| (format!("o{i}"), placed));
    let nexts = latches.iter().enumerate().map(|(i, latch)| (format!("l{i}_next"), (latch.next, latch.place)));
    let drivers: Vec<_> = shown.chain(nexts).collect();
    let mut driven = Vec::with_capacity(drivers.len());
    for (name, (literal, place)) in drivers {
        match literals.net(&mut logic, literal) {
            Some(net) => driven.push((name, net)),
            None => return Err(AigerError::Undriven { literal }.at(place)),
        }
    }
    driven.into_iter().for_each(|(name, net)| {
        logic.add_output(name, net);
    });
    let clock = Some(clock.unwrap_or("clk").to_owned());
    let register = |(i, latch): (usize, &Latch)| Register {
        name: format!("l{i}"),
        kind: RegisterKind::Rising,
        clock: clock.clone(),
        start: latch.start,
        forcing: Forcing::Never,
    };
    let registers = latches.iter().enumerate().map(register).collect();
    Ok(Design::new(logic, registers))
}

/// The gates with drivers first.
fn sorted(ands: &[And], nets: &[Option<NetId>]) -> Result<Vec<And>, Diagnostic> {
    let gates = gates_by_variable(ands, nets)?;
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
                        return Err(AigerError::Loop { literal: out }.at(place));
                    }
                    Some(None) if literal > 1 && nets[literal / 2].is_none() => {
                        return Err(AigerError::Undriven { literal }.at(place));
                    }
                    None => return Err(AigerError::OverHeader { literal }.at(place)),
                    _ => {}
                }
            }
            if ready {
                state[i] = 2;
                order.push(ands[i]);
                open.pop();
            } else if open.len() > ands.len() + 2 {
                return Err(AigerError::Loop { literal: out }.at(place));
            }
        }
    }
    Ok(order)
}

/// The gate that defines each variable.
fn gates_by_variable(ands: &[And], nets: &[Option<NetId>]) -> Result<Vec<Option<usize>>, Diagnostic> {
    let mut gates: Vec<Option<usize>> = vec![None; nets.len()];
    for (i, &And { out, place, .. }) in ands.iter().enumerate() {
        let Some(gate) = gates.get_mut(out / 2).filter(|_| out > 1 && out & 1 == 0) else {
            return Err(AigerError::NotAGate { literal: out }.at(place));
        };
        if nets[out / 2].is_some() || gate.replace(i).is_some() {
            return Err(AigerError::DefinedTwice { literal: out }.at(place));
        }
    }
    Ok(gates)
}

/// Nets by literal; inverters are added where needed.
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

/// A design as AIGER, binary or as text.
///
/// # Panics
/// When the logic of the design has loops; a design that was read has none.
pub fn write(design: &Design, binary: bool) -> Vec<u8> {
    let view = View::of(&design.logic, &[]).expect("the logic of a design has no loops");
    let mut graph = Ands::new(view.network.inputs);
    let mut literals: Vec<usize> = vec![0, 1];
    literals.extend((0..view.network.inputs).map(|i| 2 * (i + 1)));
    for &Gate { function, pins } in &view.network.gates {
        let literal = graph.function(function, pins.map(|pin| literals[pin as usize]));
        literals.push(literal);
    }
    let outputs: Vec<_> = view.network.outputs.iter().map(|&output| literals[output as usize]).collect();
    graph.text(design, &outputs, binary)
}

/// An and-inverter graph that is being written.
struct Ands {
    inputs: usize,
    ands: Vec<[usize; 2]>,
    known: std::collections::BTreeMap<[usize; 2], usize>,
}

impl Ands {
    fn new(inputs: usize) -> Self {
        Self { inputs, ands: Vec::new(), known: std::collections::BTreeMap::new() }
    }

    fn and(&mut self, a: usize, b: usize) -> usize {
        match [a.max(b), a.min(b)] {
            [_, 0] => 0,
            [a, 1] => a,
            [a, b] if a == b => a,
            [a, b] if a ^ b == 1 => 0,
            pins => *self.known.entry(pins).or_insert_with(|| {
                self.ands.push(pins);
                2 * (self.inputs + self.ands.len())
            }),
        }
    }

    fn function(&mut self, function: Function, [a, b]: [usize; 2]) -> usize {
        if function.arity() < 2 {
            return match (function.depends_on(0), function.depends_on(1)) {
                (true, _) => a ^ usize::from(function == Function::NOT),
                (_, true) => b ^ usize::from(function == Function::NOT_B),
                _ => usize::from(function == Function::ONE),
            };
        }
        let minterms: Vec<_> = (0..4).filter(|i| function.bits() >> i & 1 == 1).collect();
        let literal = |i: usize| (a ^ usize::from(i >> 1 == 0), b ^ usize::from(i & 1 == 0));
        match minterms[..] {
            [i] => self.and(literal(i).0, literal(i).1),
            [i, j] => {
                let one = self.and(literal(i).0, literal(i).1);
                let two = self.and(literal(j).0, literal(j).1);
                self.and(one ^ 1, two ^ 1) ^ 1
            }
            _ => self.function(function.inverted(), [a, b]) ^ 1,
        }
    }

    fn text(&self, design: &Design, outputs: &[usize], binary: bool) -> Vec<u8> {
        let (ports, latches) = (design.inputs(), design.registers.len());
        let (shown, nexts) = outputs.split_at(design.outputs());
        let word = if binary { "aig" } else { "aag" };
        let total = self.inputs + self.ands.len();
        let mut text = format!("{word} {total} {ports} {latches} {} {}\n", shown.len(), self.ands.len());
        let own = |i: usize| 2 * (i + 1);
        if !binary {
            (0..ports).for_each(|i| text.push_str(&format!("{}\n", own(i))));
        }
        for (i, (register, next)) in design.registers.iter().zip(nexts).enumerate() {
            let latch = own(ports + i);
            let start = register.start.map_or(latch, usize::from);
            let _ = if binary { writeln!(text, "{next} {start}") } else { writeln!(text, "{latch} {next} {start}") };
        }
        shown.iter().for_each(|literal| text.push_str(&format!("{literal}\n")));
        let mut bytes = text.into_bytes();
        for (i, &[a, b]) in self.ands.iter().enumerate() {
            let out = own(self.inputs + i);
            if binary {
                push_delta(&mut bytes, out - a);
                push_delta(&mut bytes, a - b);
            } else {
                bytes.extend(format!("{out} {a} {b}\n").bytes());
            }
        }
        let readable = |name: &str| name.chars().map(|c| if c.is_control() { '_' } else { c }).collect::<String>();
        let legal = |name: &str| if name.is_empty() { "_".to_owned() } else { readable(name) };
        let names = FileNames::new(&design.logic, &design.registers, &[], true, legal);
        let label = |kind: &str, ids: &[NetId]| {
            let line = |(i, &id)| format!("{kind}{i} {}\n", names.net(id));
            ids.iter().enumerate().map(line).collect::<String>()
        };
        let (inputs, states) = design.logic.inputs().split_at(ports);
        bytes.extend(label("i", inputs).bytes());
        bytes.extend(label("l", states).bytes());
        bytes.extend(label("o", &design.logic.outputs()[..shown.len()]).bytes());
        bytes
    }
}

fn push_delta(bytes: &mut Vec<u8>, mut value: usize) {
    while value >= 0x80 {
        bytes.push((value & 0x7f) as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}
