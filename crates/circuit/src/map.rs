//! Technology mapping: makes a netlist in which every cell computes a function of the library.

use std::collections::BTreeMap;

use crate::cells::{CellKind, CellLibrary};
use crate::guarded::Guarded;
use crate::levels::most_before;
use crate::lowering::{gate_data, needed};
use crate::network::{Network, Signal, View};
use crate::options::{MapOptions, MappingObjective};
use crate::passes::{self, dissolve_wires, sweep};
use crate::proof::state_names;
use crate::recipes::{Operand, Recipe, Recipes};
use crate::signal_blocks::SignalBlocks;
use crate::synth::{CellNetwork, reduce_between_registers, widen};
use crate::{BlockId, MapError, NetId, Netlist, Node, RegisterNode};
use nbc_base::budget::Limit;
use nbc_base::model::Function;

pub fn map(netlist: &Netlist, library: &CellLibrary) -> Result<Netlist, MapError> {
    map_with(netlist, library, &MapOptions::default())
}

/// The netlist with its logic as cells of the library. Registers stay registers ([`crate::lower`] makes them cells);
/// memory elements that are written as cells stay with their guards, split into cells function by function.
pub fn map_with(netlist: &Netlist, library: &CellLibrary, options: &MapOptions) -> Result<Netlist, MapError> {
    let cells = netlist.size();
    if Limit::Cells.permit(cells as u64).is_err() {
        return Err(MapError::TooLarge { cells, most: Limit::Cells.most() });
    }
    let mut source = netlist.clone();
    gate_data(&mut source);
    passes::run(&mut source)?;
    match options.objective {
        MappingObjective::Area | MappingObjective::Delay => {}
        MappingObjective::Margin => return map_best(&source, library, options, |kind| kind.margin),
        MappingObjective::Sturdy => return map_best(&source, library, options, |kind| kind.radius),
    }
    let mut mapped = Mapper::new(&source, library).map(options)?;
    dissolve_wires(&mut mapped)?;
    sweep(&mut mapped);
    name_outputs(&mut mapped);
    Ok(mapped)
}

/// Maps with the robots of the highest quality that suffice for this circuit.
fn map_best(
    source: &Netlist,
    library: &CellLibrary,
    options: &MapOptions,
    quality: fn(&CellKind) -> f64,
) -> Result<Netlist, MapError> {
    let mut levels: Vec<f64> = library.kinds().map(|(_, kind)| quality(kind)).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let options = &MapOptions { objective: MappingObjective::Area, ..options.clone() };
    let best = levels.into_iter().rev().map(|least| library.with(quality, least));
    let mapped = best.map(|best| map_with(source, &best, options)).find(Result::is_ok);
    mapped.unwrap_or_else(|| map_with(source, library, options))
}

struct Mapper<'a> {
    source: &'a Netlist,
    library: &'a CellLibrary,
    guarded: Guarded,
    recipes: Recipes,
    mapped: Netlist,
    kept: Vec<NetId>,
    registers: Vec<NetId>,
    /// The nets of the mapped netlist that correspond to the inputs of the logic.
    net: BTreeMap<NetId, NetId>,
}

impl<'a> Mapper<'a> {
    fn new(source: &'a Netlist, library: &'a CellLibrary) -> Self {
        let guarded = Guarded::of(source);
        Self {
            source,
            library,
            kept: guarded.cells().collect(),
            registers: source.registers().map(|(id, _)| id).collect(),
            guarded,
            recipes: Recipes::of(library),
            mapped: Netlist::with_blocks_of(source),
            net: BTreeMap::new(),
        }
    }

    fn map(mut self, options: &MapOptions) -> Result<Netlist, MapError> {
        for &id in self.source.inputs() {
            let net = self.mapped.add_input(self.source.net_name(id));
            self.net.insert(id, net);
        }
        let memory = self.guarded.memory();
        let names = state_names(self.source, memory);
        for &id in &self.kept {
            // A guard has a wire without a name, which leaves no trace; a core cell keeps its name and start value.
            let name = names.get(&id).cloned().unwrap_or_default();
            let start = self.source.cell(id).and_then(|cell| cell.start).filter(|_| memory.contains(id));
            let wire = self.mapped.add_wire(name, start, None);
            self.net.insert(id, wire);
        }
        for &id in &self.registers {
            let register = self.source.register(id).expect("these are registers").clone();
            let made = self.mapped.add_loose_register(RegisterNode { name: names.get(&id).cloned(), ..register });
            self.mapped.put_into(made, self.source.block(id));
            self.net.insert(id, made);
        }
        let recipe = |function: &Function| self.recipes.get(*function).is_none();
        if let Some(function) = needed(self.source).find(recipe) {
            return Err(self.missing(function));
        }
        let cuts: Vec<NetId> = self.states().collect();
        let view = View::of(self.source, &cuts).expect("every loop passes through cells that are kept");
        let (network, sinks) = self.logic(&view);
        let reduced = reduce_between_registers(&network, &self.stages(), self.library, options);
        let reduced = reduced.map_err(|missing| self.missing(missing))?;
        let cells = widen(&network, &reduced, &self.stages(), self.library, options);
        let ports: Vec<usize> = (0..network.inputs).collect();
        let blocks = SignalBlocks::of(self.source, &view).of_cells(&network, &cells, &ports);
        let nets = self.copy(&cells, &blocks);
        let shown: BTreeMap<NetId, NetId> = sinks.into_iter().zip(nets).collect();
        for &id in &self.kept.clone() {
            let pins: Vec<_> = self.source.pins(id).iter().map(|pin| shown[pin]).collect();
            let net = self.split(id, &pins)?;
            self.mapped.drive(self.net[&id], 0, net);
        }
        for &id in &self.registers {
            for (pin, driver) in (0..).zip(self.source.pins(id)) {
                self.mapped.connect(self.net[&id], pin, shown[&driver]);
            }
        }
        for &id in self.source.outputs() {
            self.mapped.add_output(self.source.net_name(id), shown[&self.source.pins(id)[0]]);
        }
        Ok(self.mapped)
    }

    fn states(&self) -> impl Iterator<Item = NetId> + '_ {
        self.kept.iter().chain(&self.registers).copied()
    }

    fn logic(&self, view: &View) -> (Network, Vec<NetId>) {
        let sinks = self.source.outputs().iter().copied().chain(self.states());
        let mut sinks: Vec<_> = sinks.flat_map(|id| self.source.pins(id)).collect();
        sinks.sort_unstable();
        sinks.dedup();
        let mut network = view.network.clone();
        network.outputs = sinks.iter().map(|sink| view.signal[sink]).collect();
        (network, sinks)
    }

    /// For each input of the logic, the number of registers and kept cells before it: no cell may start to depend on a
    /// later one.
    fn stages(&self) -> Vec<u32> {
        let counts = |id| self.guarded.role(id).is_some() || self.source.register(id).is_some();
        let stages = most_before(self.source, counts);
        self.source.inputs().iter().copied().chain(self.states()).map(|id| stages[&id]).collect()
    }

    fn copy(&mut self, network: &CellNetwork, blocks: &[BlockId]) -> Vec<NetId> {
        let mut constants = [None; 2];
        let mut nets: Vec<Option<NetId>> = vec![None, None];
        nets.extend(self.source.inputs().iter().copied().chain(self.states()).map(|id| Some(self.net[&id])));
        let mapped = &mut self.mapped;
        let mut net = |mapped: &mut Netlist, nets: &[Option<NetId>], signal: Signal| {
            nets[signal as usize]
                .unwrap_or_else(|| *constants[signal as usize].get_or_insert_with(|| mapped.add_constant(signal == 1)))
        };
        for (cell, &block) in network.cells.iter().zip(blocks) {
            let pins: Vec<NetId> = cell.pins.iter().map(|&pin| net(mapped, &nets, pin)).collect();
            let made = mapped.add_gate(cell.function, &pins);
            mapped.put_into(made, block);
            nets.push(Some(made));
        }
        network.outputs.iter().map(|&output| net(mapped, &nets, output)).collect()
    }

    fn split(&mut self, id: NetId, pins: &[NetId]) -> Result<NetId, MapError> {
        let cell = self.source.cell(id).expect("kept cells are cells");
        let missing = || self.missing(cell.function);
        let Recipe { steps, result, .. } = self.recipes.get(cell.function).cloned().ok_or_else(missing)?;
        let mut nets: Vec<NetId> = Vec::with_capacity(steps.len());
        for step in &steps {
            let pins = step.pins.map(|operand| self.operand(operand, pins, &nets));
            let used = if step.function.depends_on(1) { 2 } else { 1 };
            let made = self.mapped.add_gate(step.function, &pins[..used]);
            self.mapped.put_into(made, self.source.block(id));
            nets.push(made);
        }
        let net = self.operand(result, pins, &nets);
        if let (Node::Cell(made), Operand::Step(_)) = (self.mapped.node_mut(net), result) {
            made.span = cell.span;
        }
        Ok(net)
    }

    fn missing(&self, function: Function) -> MapError {
        let known = self.library.functions().collect();
        MapError::Incomplete { missing: function, known, completions: self.library.completions() }
    }

    fn operand(&mut self, operand: Operand, pins: &[NetId], nets: &[NetId]) -> NetId {
        match operand {
            Operand::Input(pin) => pins[usize::from(pin).min(pins.len() - 1)],
            Operand::Step(i) => nets[usize::from(i)],
            Operand::Constant(value) => self.mapped.add_constant(value),
        }
    }
}

/// A cell without a name that drives an output takes the output's name.
pub(crate) fn name_outputs(netlist: &mut Netlist) {
    let names = netlist.cells().map(|(_, cell)| &cell.name);
    let names = names.chain(netlist.registers().map(|(_, register)| &register.name));
    let mut taken: std::collections::BTreeSet<String> = names.filter_map(Clone::clone).collect();
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
    use crate::CellKind;
    use crate::example::{full_adder, latch, library};
    use crate::proof::{Method, prove};

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
    fn every_cell_is_in_the_library() {
        for cells in ["nand", "nor", "nand not", "xor and", "a_or_notb", "nota_and_b not", "and not", "or xnor"] {
            let library = library(cells);
            for netlist in [latch(), full_adder()] {
                let mapped = map(&netlist, &library).unwrap();
                assert!(mapped.cells().all(|(_, cell)| library.get(cell.function).is_some()), "{cells}\n{mapped}");
            }
        }
    }

    #[test]
    fn a_library_without_cells_makes_nothing() {
        assert_eq!(map(&latch(), &library("")).unwrap_err().to_string(), "`not` cannot be made without cells");
    }

    fn chain(cells: usize) -> Netlist {
        let mut netlist = Netlist::new("chain");
        let inputs: Vec<_> = (0..20).map(|i| netlist.add_input(format!("i{i}"))).collect();
        let sum = |sum, i| netlist.add_gate(Function::XOR, &[sum, inputs[1 + i % 19]]);
        let last = (0..cells).fold(inputs[0], sum);
        netlist.add_output("q", last);
        netlist
    }

    #[test]
    fn a_long_chain_is_mapped_and_proved_without_recursion() {
        let source = chain(50_000);
        let mapped = map(&source, &library("nand not")).unwrap();
        assert_eq!(mapped.cells().count(), 200_000);
        assert_eq!(prove(&source, &mapped).unwrap().method, Method::Structural);
    }

    #[test]
    fn too_many_cells_are_rejected_with_their_number() {
        let error = map(&chain(1_000_001), &library("nand")).unwrap_err();
        assert_eq!(error.to_string(), "the circuit has 1000001 cells, expected at most 1000000");
    }

    #[test]
    fn the_margin_objective_accepts_more_robots() {
        let mut library = library("nand and or not");
        library.insert(Function::XOR, CellKind::uniform(1, 0.1));
        library.insert(Function::NAND, CellKind::uniform(1, 2.0));
        let cells = |objective| {
            let mapped = map_with(&full_adder(), &library, &MapOptions { objective, ..MapOptions::default() }).unwrap();
            let margins = mapped.cells().map(|(_, cell)| library.get(cell.function).unwrap().margin);
            (mapped.cells().count(), margins.fold(f64::INFINITY, f64::min))
        };
        assert_eq!(cells(MappingObjective::Area), (5, 0.1));
        assert_eq!(cells(MappingObjective::Margin), (9, 2.0));
    }

    #[test]
    fn the_sturdy_objective_takes_cells_of_the_largest_radius() {
        let mut library = library("xor and or not");
        let sturdy = CellKind { radius: 2.0, ..CellKind::uniform(1, 0.1) };
        library.insert(Function::NAND, sturdy.clone());
        library.insert(Function::AND, CellKind { radius: 1.5, ..sturdy });
        let options = MapOptions { objective: MappingObjective::Sturdy, ..MapOptions::default() };
        let mapped = map_with(&full_adder(), &library, &options).unwrap();
        assert!(mapped.cells().all(|(_, cell)| cell.function == Function::NAND));
    }

    #[test]
    fn the_delay_objective_accepts_more_robots() {
        let chain = |netlist: &mut Netlist| {
            let inputs: Vec<_> = (0..8).map(|i| netlist.add_input(format!("i{i}"))).collect();
            inputs[1..].iter().fold(inputs[0], |sum, &input| netlist.add_gate(Function::XOR, &[sum, input]))
        };
        let mut netlist = Netlist::new("parity");
        let sum = chain(&mut netlist);
        netlist.add_output("y", sum);
        let library = library("nand not");
        let hold = |objective| {
            let mapped = map_with(&netlist, &library, &MapOptions { objective, ..MapOptions::default() }).unwrap();
            crate::Timing::of(&mapped, &library).hold
        };
        let (area, delay) = (hold(MappingObjective::Area), hold(MappingObjective::Delay));
        assert!(delay < area, "{delay} cycles by delay, {area} by area");
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

    fn wide(cells: &str) -> CellLibrary {
        CellLibrary::uniform(cells.split(' ').flat_map(|name| Function::parse(name).unwrap().arrangements()))
    }

    #[test]
    fn cells_of_three_inputs_make_a_full_adder_of_three_cells_or_two() {
        for (cells, expected) in
            [("nand xor maj", 3), ("nand xor maj xor3", 2), ("nand not and or xor mux", 3), ("and3 nand", 9)]
        {
            let library = wide(cells);
            let mapped = map(&full_adder(), &library).unwrap();
            assert!(mapped.cells().count() <= expected, "{cells}\n{mapped}");
            assert!(mapped.cells().all(|(_, cell)| library.get(cell.function).is_some()), "{cells}\n{mapped}");
            prove(&full_adder(), &mapped).unwrap();
        }
    }

    #[test]
    fn slow_cells_of_three_inputs_are_left_out_where_the_delay_counts() {
        let mut library = wide("nand xor and or not");
        library.insert(Function::MAJ, CellKind::uniform(9, 1.0));
        let cells = |objective| {
            let mapped = map_with(&full_adder(), &library, &MapOptions { objective, ..MapOptions::default() }).unwrap();
            (mapped.cells().count(), count(&mapped, Function::MAJ))
        };
        assert_eq!(cells(MappingObjective::Area), (3, 1));
        assert_eq!(cells(MappingObjective::Delay).1, 0);
    }
}
