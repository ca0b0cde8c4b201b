//! Prices: the cost of each cell of a library, and the cheapest cells for each function of two signals.

use crate::cells::{CellKind, CellLibrary};
use crate::recipes::{Recipe, Recipes};
use nbc_base::model::Function;

#[derive(Clone, Debug)]
pub struct Prices {
    cells: [u32; 16],
    clocks: [u32; 16],
    recipes: Recipes,
}

impl Prices {
    pub fn of(library: &CellLibrary) -> Self {
        let (mut cells, mut clocks) = ([0; 16], [0; 16]);
        for (function, kind) in library.kinds() {
            cells[usize::from(function.bits())] = kind.cost;
            clocks[usize::from(function.bits())] = kind.clock;
        }
        Self { cells, clocks, recipes: Recipes::of(library) }
    }

    /// All functions at two units, inverters free: the first aim for libraries without XOR.
    pub(crate) fn abstracted(exclusive: u32) -> Self {
        let price = |function: Function| match function {
            Function::XOR | Function::XNOR => exclusive,
            _ if function.arity() == 2 => 2,
            _ => 0,
        };
        let kind = |function| (function, CellKind { cost: price(function), ..CellKind::uniform(1, 1.0) });
        Self::of(&complete().map(kind).collect())
    }

    pub(crate) fn ideal(&self) -> Self {
        let exclusive = self.cost(Function::XOR).unwrap_or(4);
        Self::abstracted(if exclusive > 1 { 2 * exclusive - 1 } else { 2 })
    }

    /// Prices between the abstract ones and these: every function is one cell, and each inverter in it costs half.
    pub fn halfway(&self) -> Self {
        let price = |function: Function| match function {
            Function::NOT => 1,
            Function::XOR | Function::XNOR => 2 * self.cost(function).unwrap_or(4) - 1,
            _ => 1 + self.cost(function).unwrap_or(3),
        };
        let kind = |function| (function, CellKind { cost: price(function), ..CellKind::uniform(1, 1.0) });
        Self::of(&complete().map(kind).collect())
    }

    /// The cost of the cheapest function of two signals that is not an exclusive or.
    pub fn unit(&self) -> u32 {
        let both = [Function::AND, Function::NAND, Function::OR, Function::NOR];
        both.into_iter().filter_map(|function| self.cost(function)).min().unwrap_or(1).max(1)
    }

    pub fn cell(&self, function: Function) -> u32 {
        self.cells[usize::from(function.bits())]
    }

    pub(crate) fn are_even(&self) -> bool {
        self.cells.iter().all(|&cost| cost <= 1)
    }

    pub fn clock(&self, function: Function) -> u32 {
        self.clocks[usize::from(function.bits())]
    }

    pub fn recipe(&self, function: Function) -> Option<&Recipe> {
        self.recipes.get(function)
    }

    pub fn cost(&self, function: Function) -> Option<u32> {
        self.recipes.cost(function)
    }
}

pub(crate) fn complete() -> impl Iterator<Item = Function> {
    Function::all().filter(|function| function.arity() == 2 || *function == Function::NOT)
}
