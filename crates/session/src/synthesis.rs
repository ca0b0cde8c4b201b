//! Designs of other tools, mapped onto cells of few robots and proved.

use crate::compile::synthesize;
use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Function, Library};
use nbc_circuit::correspondence::{self, Removed};
use nbc_circuit::formats::Design;
use nbc_circuit::{CellKind, CellLibrary, MapOptions, MappingObjective, Netlist, RegisterForm};

/// How a design is mapped.
#[derive(Clone, Debug)]
pub struct SynthesisOptions {
    pub cells: CellLibrary,
    pub map: MapOptions,
    pub expand: bool,
    /// Functions for which to count the cells that a robot would save.
    pub what_if: Vec<Function>,
}

impl SynthesisOptions {
    pub fn onto(cells: CellLibrary) -> Self {
        Self { cells, map: MapOptions::default(), expand: false, what_if: Vec::new() }
    }
}

/// A design as cells.
#[derive(Clone, Debug)]
pub struct Synthesis {
    /// Without the registers that it does not need.
    pub design: Design,
    /// The cells and the remaining registers.
    pub result: Design,
    pub removed: Removed,
    /// Cells that a robot for each of the functions would save; negative if it needs more.
    pub what_if: Vec<(Function, i64)>,
}

impl Synthesis {
    /// Maps and proves a design. Panics if the result differs from it, which is a fault of the compiler.
    pub fn of(read: &Design, options: &SynthesisOptions) -> Result<Self, Diagnostic> {
        let (design, removed) = correspondence::reduce(read);
        let whole = Made::of(design, options)?;
        // The result with its registers is proved to be what was read, too. For registers made of cells, the design
        // without needless registers was proved, and then the logic between its registers.
        if !options.expand
            && let Err(error) = correspondence::prove(read, &whole.result, &removed)
        {
            panic!("the circuit `{}` differs from its file: {error}", read.netlist.name);
        }
        let Made { design, source, result } = whole;
        let mut synthesis = Self { design, result, removed, what_if: Vec::new() };
        for &function in &options.what_if {
            let mut more = options.cells.clone();
            more.insert(function, CellKind::uniform(1, 1.0));
            let found = synthesize(source.clone(), &more, &options.map, RegisterForm::Nands)?.netlist.cells().count();
            synthesis.what_if.push((function, synthesis.cells() as i64 - found as i64));
        }
        Ok(synthesis)
    }

    pub fn cells(&self) -> usize {
        self.result.netlist.cells().count()
    }
}

pub fn named_functions(names: &[String]) -> Result<Vec<Function>, Diagnostic> {
    names.iter().map(|name| Function::parse(name.trim()).ok_or_else(|| wording::unknown_function(name))).collect()
}

/// Cells of equal cost. `all` alone means all functions of two inputs, `all3` those of two and three.
pub fn cell_library(names: &[String]) -> Result<CellLibrary, Diagnostic> {
    let of_two = || Function::all().filter(|function| function.arity() == 2 || *function == Function::NOT);
    Ok(match names {
        [all] if all == "all" => CellLibrary::uniform(of_two()),
        [all] if all == "all3" => {
            CellLibrary::uniform(of_two().chain(Function::all_of(3).filter(|function| function.arity() == 3)))
        }
        // A robot of three stimuli can be wired in any order.
        names => {
            let arranged = |one: Function| if one.inputs() == 3 { one.arrangements() } else { vec![one] };
            CellLibrary::uniform(named_functions(names)?.into_iter().flat_map(arranged))
        }
    })
}

pub fn robot_cells(robots: Library, objective: MappingObjective) -> CellLibrary {
    nbc_swarm::cells(&nbc_swarm::prefer(robots, objective))
}

struct Made {
    design: Design,
    source: Netlist,
    result: Design,
}

impl Made {
    fn of(design: Design, options: &SynthesisOptions) -> Result<Self, Diagnostic> {
        let source = if options.expand { design.netlist.clone() } else { design.opened() };
        let logic = synthesize(source.clone(), &options.cells, &options.map, RegisterForm::Nands)?.netlist;
        let result = match options.expand {
            // Cells read the clock, so that it is a port.
            true => Design { netlist: logic, clocks: 0, ..design.clone() },
            false => design.closed(logic),
        };
        Ok(Self { design, source, result })
    }
}
