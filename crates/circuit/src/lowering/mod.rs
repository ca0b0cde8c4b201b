//! Registers become cells, which is the last step before robots: loops of NAND cells, or multiplexers that read
//! themselves. Wave machines need neither (`waves/`).

mod multiplexer;
mod nands;
#[cfg(test)]
mod templates;
mod wording;

use std::collections::BTreeMap;

use serde::Serialize;

use crate::cells::CellLibrary;
use crate::netlist::LoweredLatch;
use crate::passes::dissolve_wires;
use crate::recipes::{Operand, Recipe, Recipes};
use crate::register::Forcing;
use crate::{BlockId, Loops, MapError, NetId, Netlist, Node, RegisterKind, RegisterNode};
use nbc_base::model::Function;

pub use multiplexer::has_multiplexers;

/// What registers become.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RegisterForm {
    /// A latch of four NAND cells, or two of them for an edge.
    #[default]
    Nands,
    /// A multiplexer that reads itself, or two of them for an edge. Registers that are set or reset are of NAND cells.
    Multiplexers,
}

/// A mapped netlist whose registers are cells of a library, too.
pub fn lower(mapped: &Netlist, library: &CellLibrary, form: RegisterForm) -> Result<Netlist, MapError> {
    let mut netlist = mapped.clone();
    let recipes = Recipes::of(library);
    if let Some(missing) = needed(mapped).find(|&function| recipes.get(function).is_none()) {
        let known = library.functions().collect();
        return Err(MapError::Incomplete { missing, known, completions: library.completions() });
    }
    let latches = Lowering::new(&mut netlist, Some(recipes)).all(form);
    dissolve_wires(&mut netlist)?;
    netlist.latches = latches;
    Ok(netlist)
}

/// State that does not become multiplexers.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct KeptLatch {
    pub net: String,
    pub why: &'static str,
}

pub fn kept(mapped: &Netlist) -> Vec<KeptLatch> {
    let forced = mapped.registers().filter(|(_, register)| register.forcing != Forcing::Never);
    let forced = forced.map(|(id, _)| KeptLatch { net: mapped.net_name(id), why: wording::FORCED });
    let loops = Loops::memory(mapped);
    let loops = loops.cores().iter().map(|core| KeptLatch { net: mapped.net_name(core[0]), why: wording::LOOP });
    forced.chain(loops).collect()
}

/// The functions of the cells of registers, if there are any.
pub(crate) fn needed(netlist: &Netlist) -> impl Iterator<Item = Function> {
    let functions = [Function::NAND, Function::NOT, Function::AND];
    netlist.registers().next().into_iter().flat_map(move |_| functions)
}

/// A netlist as written with registers of NAND cells.
pub fn as_nands(source: &Netlist) -> Netlist {
    let mut netlist = source.clone();
    gate_data(&mut netlist);
    Lowering::new(&mut netlist, None).all(RegisterForm::Nands);
    // A net that nothing drives keeps its wire.
    let _ = dissolve_wires(&mut netlist);
    netlist
}

/// The data of registers that are set or reset agree with what forces them.
pub(crate) fn gate_data(netlist: &mut Netlist) {
    let unless = Function::AND.with_input_inverted(1);
    let forced: Vec<_> = netlist.registers().map(|(id, register)| (id, register.clone())).collect();
    for (id, register) in forced {
        let pins = netlist.pins(id);
        let data = match pins[2..] {
            [reset] if register.starts_at() => netlist.add_gate(Function::OR, &[pins[0], reset]),
            [reset] => netlist.add_gate(unless, &[pins[0], reset]),
            [set, reset] => {
                let either = netlist.add_gate(Function::OR, &[pins[0], set]);
                netlist.put_into(either, netlist.block(id));
                netlist.add_gate(unless, &[either, reset])
            }
            _ => continue,
        };
        netlist.put_into(data, netlist.block(id));
        netlist.drive(id, RegisterNode::DATA, data);
    }
}

struct Lowering<'n> {
    netlist: &'n mut Netlist,
    /// The cells of a library for each function; without them, every function is a cell.
    recipes: Option<Recipes>,
    block: BlockId,
    inverses: BTreeMap<NetId, NetId>,
    /// The cells made since a latch was begun.
    made: Vec<NetId>,
    latches: Vec<LoweredLatch>,
}

impl<'n> Lowering<'n> {
    fn new(netlist: &'n mut Netlist, recipes: Option<Recipes>) -> Self {
        let (inverses, made, latches) = (BTreeMap::new(), Vec::new(), Vec::new());
        Self { netlist, recipes, block: BlockId::TOP, inverses, made, latches }
    }

    fn all(mut self, form: RegisterForm) -> Vec<LoweredLatch> {
        let registers: Vec<_> = self.netlist.registers().map(|(id, register)| (id, register.clone())).collect();
        for (id, register) in registers {
            let mut pins = self.netlist.pins(id);
            if pins[0] == pins[1] {
                // What the clock is while the register takes it: its cells would see it too late.
                let value = matches!(register.kind, RegisterKind::Falling | RegisterKind::High);
                pins[0] = self.netlist.add_constant(value);
            }
            let (name, start) = (self.netlist.net_name(id), register.starts_at());
            self.block = self.netlist.block(id);
            self.netlist
                .replace_register(id, Node::Wire { name: name.clone(), start: Some(start), span: register.span });
            let shown = match form {
                RegisterForm::Multiplexers if register.forcing == Forcing::Never => {
                    self.multiplexers(&register, &name, &pins)
                }
                _ => self.nands(&register, &name, &pins),
            };
            self.netlist.connect(id, 0, shown);
            if register.kind.is_edge() && register.forcing == Forcing::Never {
                self.latches.last_mut().expect("an edge has two latches").is_second = true;
            }
        }
        self.latches
    }

    /// Notes the cells made, of which `shown` shows the bit, as a latch.
    fn note(&mut self, shown: NetId, enable: NetId, open: bool) {
        let others = std::mem::take(&mut self.made).into_iter().filter(|&cell| cell != shown);
        let cells = std::iter::once(shown).chain(others).collect();
        self.latches.push(LoweredLatch { cells, enable, open, is_second: false });
    }

    fn is_one_cell(&self, function: Function) -> bool {
        self.recipes.as_ref().and_then(|recipes| recipes.get(function)).is_some_and(|recipe| recipe.steps.len() == 1)
    }

    /// A net of a loop that is driven later.
    fn kept(&mut self, name: String, start: bool) -> NetId {
        let id = self.netlist.add_wire(name, Some(start), None);
        self.netlist.put_into(id, self.block);
        id
    }

    fn gate(&mut self, function: Function, pins: &[NetId]) -> NetId {
        let Some(recipes) = &self.recipes else { return self.cell(function, pins) };
        let Recipe { steps, result, .. } = recipes.get(function).cloned().expect("these cells were looked for");
        let mut nets: Vec<NetId> = Vec::with_capacity(steps.len());
        for step in &steps {
            let own = step.pins.map(|operand| self.operand(operand, pins, &nets));
            let used = if step.function.depends_on(1) { 2 } else { 1 };
            let made = self.cell(step.function, &own[..used]);
            nets.push(made);
        }
        self.operand(result, pins, &nets)
    }

    fn cell(&mut self, function: Function, pins: &[NetId]) -> NetId {
        let made = self.netlist.add_gate(function, pins);
        self.netlist.put_into(made, self.block);
        self.made.push(made);
        made
    }

    fn operand(&mut self, operand: Operand, pins: &[NetId], nets: &[NetId]) -> NetId {
        match operand {
            Operand::Input(pin) => pins[usize::from(pin).min(pins.len() - 1)],
            Operand::Step(i) => nets[usize::from(i)],
            Operand::Constant(value) => self.netlist.add_constant(value),
        }
    }

    /// The opposite of a net, which all registers share.
    fn inverse(&mut self, net: NetId) -> NetId {
        if let Some(&known) = self.inverses.get(&net) {
            return known;
        }
        let made = self.gate(Function::NOT, &[net]);
        self.inverses.insert(net, made);
        made
    }
}
