//! Technology mapping: a netlist whose every cell computes a function that the library holds.

use std::collections::BTreeMap;

use crate::circuit::cells::CellLibrary;
use crate::circuit::loops::Loops;
use crate::circuit::passes::{self, DissolveWires, Pass, Sweep};
use crate::circuit::proof::core_names;
use crate::circuit::recipes::{Operand, Recipe, Recipes};
use crate::circuit::{Cell, NetId, Netlist, NetlistError, Node};
use crate::model::Function;

/// A netlist that cannot be mapped.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MapError {
    /// The netlist is not well formed.
    #[error(transparent)]
    Netlist(#[from] NetlistError),
    /// The library's functions do not make what the circuit needs.
    #[error("`{}` cannot be made of {}", .missing.name(), list(.held, "no cells", " and "))]
    Incomplete {
        /// The function that is missing.
        missing: Function,
        /// The functions that the library holds.
        held: Vec<Function>,
        /// The functions each of which alone would complete the library; empty if no single one does.
        completions: Vec<Function>,
    },
}

impl MapError {
    /// What would mend it, where that can be said.
    pub fn help(&self) -> Option<String> {
        let Self::Incomplete { completions, .. } = self else {
            return None;
        };
        Some(match completions[..] {
            [] => "`nand` alone makes a library complete".to_owned(),
            _ => format!("any one of {} would complete the library", list(completions, "", " or ")),
        })
    }
}

/// The names of functions in backticks.
fn list(functions: &[Function], none: &str, joint: &str) -> String {
    let names: Vec<_> = functions.iter().map(|function| format!("`{}`", function.name())).collect();
    match names.split_last() {
        None => none.to_owned(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{}{joint}{last}", rest.join(", ")),
    }
}

/// Maps a netlist onto a library. Loop cores and their guards stay as written, split into cells function by function.
///
/// # Errors
/// When the netlist is not well formed or the library cannot make a function of it.
pub fn map(netlist: &Netlist, library: &CellLibrary) -> Result<Netlist, MapError> {
    let mut source = netlist.clone();
    passes::run(&mut source)?;
    let mut mapper = Mapper::new(&source, library);
    mapper.copy()?;
    let mut mapped = mapper.mapped;
    DissolveWires.run_on(&mut mapped)?;
    Sweep.run(&mut mapped)?;
    name_outputs(&mut mapped);
    Ok(mapped)
}

/// The mapping of one netlist.
struct Mapper<'a> {
    source: &'a Netlist,
    library: &'a CellLibrary,
    loops: Loops,
    recipes: Recipes,
    mapped: Netlist,
    net: BTreeMap<NetId, NetId>,
    known: BTreeMap<(Function, Vec<NetId>), NetId>,
    /// The names of nets on loops, which no other cell may take.
    core_names: BTreeMap<NetId, String>,
}

impl<'a> Mapper<'a> {
    fn new(source: &'a Netlist, library: &'a CellLibrary) -> Self {
        let loops = Loops::of(source);
        Self {
            source,
            library,
            core_names: core_names(source, &loops),
            loops,
            recipes: Recipes::of(library),
            mapped: Netlist::new(&source.name),
            net: BTreeMap::new(),
            known: BTreeMap::new(),
        }
    }

    fn copy(&mut self) -> Result<(), MapError> {
        for &id in self.source.inputs() {
            let net = self.mapped.add_input(self.source.net_name(id));
            self.net.insert(id, net);
        }
        for (id, name) in self.core_names.clone() {
            let start = self.source.cell(id).and_then(|cell| cell.start);
            let wire = self.mapped.add_wire(name, start, None);
            self.net.insert(id, wire);
        }
        for id in self.loops.order().to_vec() {
            self.copy_node(id)?;
        }
        for &id in self.source.outputs() {
            let driver = self.net[&self.source.pins(id)[0]];
            self.mapped.add_output(self.source.net_name(id), driver);
        }
        Ok(())
    }

    fn copy_node(&mut self, id: NetId) -> Result<(), MapError> {
        match self.source.node(id) {
            Node::Constant(value) => {
                let net = self.mapped.add_constant(*value);
                self.net.insert(id, net);
            }
            Node::Cell(cell) => {
                let pins: Vec<_> = self.source.pins(id).iter().map(|pin| self.net[pin]).collect();
                let core = self.loops.contains(id);
                let net = self.split(cell, &pins, core)?;
                if core {
                    self.mapped.drive(self.net[&id], 0, net);
                } else {
                    self.net.insert(id, net);
                }
            }
            Node::Input(_) | Node::Output(_) | Node::Wire { .. } => {}
        }
        Ok(())
    }

    /// Splits a cell into cells of the library.
    fn split(&mut self, cell: &Cell, pins: &[NetId], core: bool) -> Result<NetId, MapError> {
        let Recipe { steps, result, .. } = self.recipe(cell.function)?;
        let mut nets: Vec<NetId> = Vec::with_capacity(steps.len());
        for step in &steps {
            let pins = step.pins.map(|operand| self.operand(operand, pins, &nets));
            let net = if core { self.add(step.function, &pins) } else { self.share(step.function, pins) };
            nets.push(net);
        }
        let net = self.operand(result, pins, &nets);
        if let (Node::Cell(made), Operand::Step(_)) = (self.mapped.node_mut(net), result) {
            let free = |name: &String| !core && !self.core_names.values().any(|taken| taken == name);
            made.name = made.name.take().or_else(|| cell.name.clone().filter(free));
            made.span = made.span.or(cell.span);
        }
        Ok(net)
    }

    fn recipe(&self, function: Function) -> Result<Recipe, MapError> {
        self.recipes.get(function).cloned().ok_or_else(|| MapError::Incomplete {
            missing: function,
            held: self.library.functions().collect(),
            completions: self.library.completions(),
        })
    }

    fn operand(&mut self, operand: Operand, pins: &[NetId], nets: &[NetId]) -> NetId {
        match operand {
            Operand::Input(pin) => pins[usize::from(pin).min(pins.len() - 1)],
            Operand::Step(i) => nets[usize::from(i)],
            Operand::Constant(value) => self.mapped.add_constant(value),
        }
    }

    /// A cell outside loops: an equal one that is there already, or what a second inverter inverts.
    fn share(&mut self, function: Function, pins: [NetId; 2]) -> NetId {
        if let Some(Cell { function: Function::NOT, .. }) =
            self.mapped.cell(pins[0]).filter(|_| function == Function::NOT)
        {
            return self.mapped.pins(pins[0])[0];
        }
        let (function, pins) =
            if pins[1] < pins[0] && function.arity() == 2 && self.library.contains(function.swapped()) {
                (function.swapped(), [pins[1], pins[0]])
            } else {
                (function, pins)
            };
        let used = if function.depends_on(1) { 2 } else { 1 };
        if let Some(&net) = self.known.get(&(function, pins[..used].to_vec())) {
            return net;
        }
        let net = self.add(function, &pins);
        self.known.insert((function, pins[..used].to_vec()), net);
        net
    }

    fn add(&mut self, function: Function, pins: &[NetId]) -> NetId {
        let used = if function.depends_on(1) { 2 } else { 1 };
        self.mapped.add_gate(function, &pins[..used.min(pins.len())])
    }
}

/// Cells that drive an output and have no name take the output's.
pub fn name_outputs(netlist: &mut Netlist) {
    let mut taken: std::collections::BTreeSet<_> = netlist.cells().filter_map(|(_, cell)| cell.name.clone()).collect();
    for output in netlist.outputs().to_vec() {
        let driver = netlist.pins(output)[0];
        let name = netlist.net_name(output);
        if let Node::Cell(cell) = netlist.node_mut(driver)
            && cell.name.is_none()
            && taken.insert(name.clone())
        {
            cell.name = Some(name);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circuit::example::{full_adder, latch};

    fn library(names: &str) -> CellLibrary {
        CellLibrary::uniform(
            names.split(' ').filter(|name| !name.is_empty()).map(|name| Function::parse(name).unwrap()),
        )
    }

    fn count(netlist: &Netlist, function: Function) -> usize {
        netlist.cells().filter(|(_, cell)| cell.function == function).count()
    }

    #[test]
    fn the_papers_latch_is_four_nand_and_one_not() {
        let mapped = map(&latch(), &library("nand not and or xor")).unwrap();
        assert_eq!(count(&mapped, Function::NAND), 4);
        assert_eq!(count(&mapped, Function::NOT), 1);
        assert_eq!(mapped.cells().count(), 5);
        let starts: Vec<_> =
            mapped.cells().filter_map(|(_, cell)| Some((cell.name.as_deref()?, cell.start?))).collect();
        assert_eq!(starts, [("q", false), ("nq", true)]);
    }

    #[test]
    fn every_cell_is_one_that_the_library_holds() {
        for cells in ["nand", "nor", "nand not", "xor and", "a_or_notb", "nota_and_b not", "and not", "or xnor"] {
            let library = library(cells);
            for netlist in [latch(), full_adder()] {
                let mapped = map(&netlist, &library).unwrap();
                assert!(mapped.cells().all(|(_, cell)| library.contains(cell.function)), "{cells}\n{mapped}");
            }
        }
    }

    #[test]
    fn an_incomplete_library_names_what_is_missing_and_what_would_help() {
        let error = map(&full_adder(), &library("xor not")).unwrap_err();
        assert_eq!(error.to_string(), "`and` cannot be made of `not` and `xor`");
        assert_eq!(
            error.help().unwrap(),
            "any one of `nor`, `nota_and_b`, `a_and_notb`, `nand`, `and`, `nota_or_b`, `a_or_notb` or `or` would complete \
             the library"
        );
        assert_eq!(map(&latch(), &library("")).unwrap_err().to_string(), "`nand` cannot be made of no cells");
    }

    #[test]
    fn a_constant_output_needs_no_cell() {
        let mut netlist = Netlist::new("one");
        let a = netlist.add_input("a");
        let gate = netlist.add_gate(Function::XNOR, &[a, a]);
        let both = netlist.add_gate(Function::OR, &[a, gate]);
        netlist.add_output("q", both);
        netlist.add_output("p", a);
        let mapped = map(&netlist, &library("nand")).unwrap();
        let driver = mapped.pins(mapped.outputs()[0])[0];
        assert_eq!(mapped.node(driver), &Node::Constant(true));
        assert_eq!(mapped.cells().count(), 0);
    }
}
