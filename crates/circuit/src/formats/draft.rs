//! Drafts: named nets with their definitions in any order, as in the text formats, before they become a design.

use std::collections::BTreeMap;

use crate::formats::forced::force;
use crate::formats::wording::text as wording;
use crate::formats::{Design, Forcing, RegisterKind};
use crate::proof::prove;
use crate::{NetId, Netlist, RegisterNode};
use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic};
use nbc_base::model::Function;
use nbc_base::source::Span;

pub type NetName = u32;

#[derive(Clone, Debug)]
pub enum Definition {
    Gate(Function, bool, Vec<NetName>),
    /// A sum of cubes, each with a digit `0`, `1` or `-` per pin; the net is `value` if one of them matches.
    Cover {
        pins: Vec<NetName>,
        cubes: Vec<Vec<u8>>,
        value: bool,
    },
}

impl Definition {
    fn pins(&self) -> &[NetName] {
        match self {
            Self::Gate(_, _, pins) | Self::Cover { pins, .. } => pins,
        }
    }

    fn size(&self) -> usize {
        match self {
            Self::Gate(_, _, pins) => pins.len(),
            Self::Cover { pins, cubes, .. } => pins.len() * cubes.len().max(1),
        }
    }
}

#[derive(Clone, Debug)]
pub struct DraftRegister {
    pub kind: RegisterKind,
    pub forcing: Forcing,
    pub start: Option<bool>,
    pub output: NetName,
    pub next: NetName,
    pub clock: NetName,
    /// What forces it.
    pub nets: Vec<NetName>,
    pub span: Span,
}

#[derive(Clone, Debug, Default)]
pub struct Draft {
    pub title: String,
    pub inputs: Vec<(NetName, Span)>,
    pub outputs: Vec<(NetName, Span)>,
    pub registers: Vec<DraftRegister>,
    names: Vec<String>,
    numbers: BTreeMap<String, NetName>,
    definitions: Vec<Option<(Definition, Span)>>,
    /// The nets with a start value: feedback may pass through them.
    starts: BTreeMap<NetName, bool>,
    pub errors: Vec<Diagnostic>,
    size: usize,
}

pub const MOST_ERRORS: usize = 20;

impl Draft {
    pub fn titled(title: &str) -> Self {
        Self { title: title.to_owned(), ..Self::default() }
    }

    pub fn name(&mut self, name: &str) -> NetName {
        if let Some(&number) = self.numbers.get(name) {
            return number;
        }
        let number = self.names.len() as NetName;
        self.names.push(name.to_owned());
        self.definitions.push(None);
        self.numbers.insert(name.to_owned(), number);
        number
    }

    pub fn text(&self, name: NetName) -> &str {
        &self.names[name as usize]
    }

    pub fn fault(&mut self, error: Diagnostic) {
        if self.errors.len() < MOST_ERRORS {
            self.errors.push(error);
        }
    }

    pub fn define(&mut self, name: NetName, definition: Definition, span: Span) {
        self.size += 1 + definition.size();
        if Limit::FilePins.permit(self.size as u64).is_err() {
            if self.errors.last().is_none_or(|fault| fault.code != Code::TooLarge) {
                self.errors.push(wording::too_many_pins(span));
            }
            return;
        }
        if let Some((_, first)) = self.definitions[name as usize] {
            self.fault(wording::defined_twice(self.text(name), first, span));
        } else {
            self.definitions[name as usize] = Some((definition, span));
        }
    }

    pub fn start(&mut self, name: NetName, value: bool) {
        self.starts.insert(name, value);
    }

    fn source(&self, name: NetName) -> NetName {
        let mut at = name;
        for _ in 0..self.names.len() {
            match &self.definitions[at as usize] {
                Some((Definition::Cover { pins, cubes, value: true }, _)) if pins.len() == 1 && *cubes == [b"1"] => {
                    at = pins[0];
                }
                _ => break,
            }
        }
        at
    }

    /// Registers must be clocked by inputs or registers: logic between them would be lost when registers are kept. A
    /// latch that is always open is a wire.
    fn resolve_clocks(&mut self) {
        let mut wires = Vec::new();
        let mut known = BTreeMap::new();
        for at in 0..self.registers.len() {
            let DraftRegister { kind, span, output, next, clock, nets, .. } = self.registers[at].clone();
            let source = self.source(clock);
            if self.definitions[source as usize].is_none() {
                self.registers[at].clock = source;
                continue;
            }
            let open = match kind {
                RegisterKind::High => Some(true),
                RegisterKind::Low => Some(false),
                RegisterKind::Rising | RegisterKind::Falling => None,
            };
            match open {
                Some(open)
                    if nets.is_empty()
                        && *known.entry((source, open)).or_insert_with(|| self.is_always(source, open, span)) =>
                {
                    wires.push((at, output, next, span));
                }
                // What opens it is looked for when all logic is there.
                Some(_) if nets.is_empty() => {}
                Some(_) => self.fault(wording::logic_enable(self.text(output), span)),
                None => self.fault(wording::logic_clock(self.text(clock), self.text(output), span)),
            }
        }
        for &(at, output, next, span) in wires.iter().rev() {
            self.registers.remove(at);
            self.define(output, Definition::Cover { pins: vec![next], cubes: vec![b"1".to_vec()], value: true }, span);
        }
    }

    fn is_always(&self, net: NetName, value: bool, span: Span) -> bool {
        let states = self.registers.iter().map(|register| (register.output, register.span));
        let inputs = self.inputs.iter().copied().chain(states).collect();
        let (errors, registers) = (Vec::new(), Vec::new());
        let Ok(probe) = (Self { inputs, outputs: vec![(net, span)], registers, errors, ..self.clone() }).finish()
        else {
            return false;
        };
        let mut constant = Netlist::new(self.title.clone());
        for &input in probe.netlist.inputs() {
            constant.add_input(probe.netlist.net_name(input));
        }
        let driver = constant.add_constant(value);
        constant.add_output(probe.netlist.net_name(probe.netlist.outputs()[0]), driver);
        prove(&probe.netlist, &constant).is_ok()
    }

    pub fn finish(mut self) -> Result<Design, Vec<Diagnostic>> {
        if Limit::FilePins.permit(self.size as u64).is_err() {
            return Err(self.errors);
        }
        self.resolve_clocks();
        let mut logic = Netlist::new(self.title.clone());
        let mut nets: Vec<Option<NetId>> = vec![None; self.names.len()];
        let states = self.registers.iter().map(|register| (register.output, register.span));
        let sources: Vec<_> = self.inputs.iter().copied().chain(states).collect();
        let mut made = Vec::new();
        for (at, &(name, span)) in sources.iter().enumerate() {
            if nets[name as usize].is_some() || self.definitions[name as usize].is_some() {
                self.fault(wording::driven_twice(self.text(name), span));
                continue;
            }
            let text = self.text(name);
            nets[name as usize] = Some(match at.checked_sub(self.inputs.len()) {
                None => logic.add_input(text),
                Some(at) => {
                    let DraftRegister { kind, forcing, start, .. } = self.registers[at];
                    let name = Some(text.to_owned());
                    let id = logic.add_loose_register(RegisterNode { kind, forcing, start, name, span: None });
                    made.push(id);
                    id
                }
            });
        }
        let is_logic = |clock: &NetName| self.definitions[*clock as usize].is_some();
        let pins = |register: &DraftRegister| {
            let DraftRegister { span, next, clock, nets, .. } = register;
            let nets = nets.iter().chain(Some(clock).filter(|clock| is_logic(clock)));
            std::iter::once(next).chain(nets).map(|&net| (net, *span)).collect::<Vec<_>>()
        };
        let sinks: Vec<_> = self.outputs.iter().copied().chain(self.registers.iter().flat_map(pins)).collect();
        let feedback = self.feedback(&mut logic, &mut nets);
        for &(name, span) in &sinks {
            self.build(name, span, &mut logic, &mut nets);
        }
        for (name, wire) in feedback {
            let (definition, span) = self.definitions[name as usize].clone().expect("feedback is defined");
            definition.pins().iter().for_each(|&pin| self.build(pin, span, &mut logic, &mut nets));
            let driver = add(&mut logic, &definition, &nets);
            logic.drive(wire, 0, driver);
        }
        if !self.errors.is_empty() {
            return Err(self.errors);
        }
        let net = |name: NetName| nets[name as usize].expect("every output was built");
        for &(name, _) in &self.outputs {
            logic.add_output(self.text(name), net(name));
        }
        let is_own = |clock: &NetName| nets[*clock as usize].is_none();
        let clocks = self.registers.iter().map(|register| register.clock).filter(is_own);
        let own: BTreeMap<&str, NetName> = clocks.map(|clock| (self.text(clock), clock)).collect();
        let own: BTreeMap<NetName, NetId> =
            own.into_iter().map(|(name, clock)| (clock, logic.add_input(name))).collect();
        for (register, &id) in self.registers.iter().zip(&made) {
            let clock = own.get(&register.clock).copied().unwrap_or_else(|| net(register.clock));
            let forcing = register.nets.iter().map(|&name| net(name));
            let pins = [net(register.next), clock].into_iter().chain(forcing);
            (0..).zip(pins).for_each(|(pin, driver)| logic.connect(id, pin, driver));
        }
        let opened = self.registers.iter().zip(made).filter(|(one, _)| self.definitions[one.clock as usize].is_some());
        let opened: Vec<(&DraftRegister, NetId)> = opened.collect();
        let left = force(&mut logic, &opened.iter().map(|&(_, id)| id).collect::<Vec<_>>());
        let left = opened.iter().filter(|(_, id)| left.contains(id));
        let fault = |&(one, _): &(&DraftRegister, NetId)| wording::logic_enable(self.text(one.output), one.span);
        let errors: Vec<Diagnostic> = left.map(fault).take(MOST_ERRORS).collect();
        if errors.is_empty() { Ok(Design { clocks: own.len(), ..Design::new(logic) }) } else { Err(errors) }
    }

    fn feedback(&self, logic: &mut Netlist, nets: &mut [Option<NetId>]) -> Vec<(NetName, NetId)> {
        let mut wires = Vec::new();
        for (&name, &start) in &self.starts {
            if nets[name as usize].is_none() && self.definitions[name as usize].is_some() {
                let wire = logic.add_wire(self.text(name), Some(start), None);
                nets[name as usize] = Some(wire);
                wires.push((name, wire));
            }
        }
        wires
    }

    fn build(&mut self, root: NetName, used: Span, logic: &mut Netlist, nets: &mut [Option<NetId>]) {
        let mut open = vec![(root, used, 0usize)];
        let mut on_path = std::collections::BTreeSet::from([root]);
        while let Some((name, used, pin)) = open.last_mut().map(|top| {
            top.2 += 1;
            (top.0, top.1, top.2 - 1)
        }) {
            if nets[name as usize].is_some() {
                open.pop();
                on_path.remove(&name);
                continue;
            }
            let Some((definition, span)) = &self.definitions[name as usize] else {
                self.fault(wording::undefined(self.text(name), used));
                nets[name as usize] = Some(logic.add_constant(false));
                continue;
            };
            let span = *span;
            match definition.pins().get(pin).copied() {
                Some(next) if nets[next as usize].is_some() => {}
                Some(next) if on_path.insert(next) => open.push((next, span, 0)),
                Some(next) => {
                    self.fault(wording::net_loop(self.text(next), span));
                    nets[next as usize] = Some(logic.add_constant(false));
                }
                None => nets[name as usize] = Some(add(logic, definition, nets)),
            }
        }
    }
}

fn add(logic: &mut Netlist, definition: &Definition, nets: &[Option<NetId>]) -> NetId {
    let net = |name: &NetName| nets[*name as usize].expect("pins are built first");
    match definition {
        Definition::Gate(function, inverted, pins) => gate(logic, *function, *inverted, pins.iter().map(net).collect()),
        Definition::Cover { pins, cubes, value } => {
            cover(logic, &pins.iter().map(net).collect::<Vec<_>>(), cubes, *value)
        }
    }
}

fn gate(logic: &mut Netlist, function: Function, inverted: bool, mut nets: Vec<NetId>) -> NetId {
    while nets.len() > 2 {
        nets =
            nets.chunks(2).map(|pair| if pair.len() == 2 { logic.add_gate(function, pair) } else { pair[0] }).collect();
    }
    match nets[..] {
        [] => logic.add_constant((function == Function::AND) != inverted),
        [one] if inverted => logic.add_gate(Function::NOT, &[one]),
        [one] => one,
        _ => logic.add_gate(if inverted { function.inverted() } else { function }, &nets),
    }
}

fn cover(logic: &mut Netlist, pins: &[NetId], cubes: &[Vec<u8>], value: bool) -> NetId {
    if pins.len() == 2 {
        let holds = |cube: &[u8], x: u8, y: u8| (cube[0] == b'-' || cube[0] == x) && (cube[1] == b'-' || cube[1] == y);
        let bits = [(b'0', b'0'), (b'0', b'1'), (b'1', b'0'), (b'1', b'1')]
            .into_iter()
            .enumerate()
            .fold(0, |bits, (i, (x, y))| bits | u8::from(cubes.iter().any(|cube| holds(cube, x, y)) == value) << i);
        return logic.add_gate(Function::new(bits), pins);
    }
    let terms: Vec<_> = cubes.iter().map(|cube| product(logic, pins, cube)).collect();
    gate(logic, Function::OR, !value, terms)
}

fn product(logic: &mut Netlist, pins: &[NetId], cube: &[u8]) -> NetId {
    let mut literals = Vec::new();
    for (&net, digit) in pins.iter().zip(cube) {
        match digit {
            b'1' => literals.push(net),
            b'0' => literals.push(logic.add_gate(Function::NOT, &[net])),
            _ => {}
        }
    }
    gate(logic, Function::AND, false, literals)
}
