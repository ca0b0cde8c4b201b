//! Recipes: the cheapest cells of a library for each two-input function, found by exhaustive search.

use std::collections::{BTreeMap, BTreeSet};

use crate::cells::{CellLibrary, compose};
use nbc_base::model::Function;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Operand {
    /// Input `a` (0) or `b` (1).
    Input(u8),
    Constant(bool),
    Step(u8),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    pub function: Function,
    pub pins: [Operand; 2],
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recipe {
    pub steps: Vec<Step>,
    pub result: Operand,
    pub cost: u32,
}

#[derive(Clone, Debug)]
pub struct Recipes {
    recipes: Vec<Option<Recipe>>,
}

/// A way to a set of functions: cost, the set as bits, the steps with the bits of their results.
type Path = (u32, u16, Vec<(Step, u8)>);

impl Recipes {
    pub fn of(library: &CellLibrary) -> Self {
        let reachable = library.reachable();
        let mut recipes = vec![None; 16];
        let mut found = 0u16;
        let mut seen = BTreeSet::new();
        let mut pending: BTreeMap<u32, Vec<Path>> = BTreeMap::new();
        let start = START.iter().fold(0, |set, &(bits, _)| set | 1 << bits);
        pending.insert(0, vec![(0, start, Vec::new())]);
        while found != reachable {
            let Some((_, paths)) = pending.pop_first() else {
                break;
            };
            for (cost, set, steps) in paths {
                if !seen.insert(set) {
                    continue;
                }
                for bits in (0..16u8).filter(|bits| set >> bits & 1 == 1 && found >> bits & 1 == 0) {
                    recipes[usize::from(bits)] = Some(recipe(cost, &steps, bits));
                }
                found |= set;
                for (more, next) in extensions(library, set, &steps) {
                    let mut steps = steps.clone();
                    steps.push(next);
                    pending.entry(cost + more).or_default().push((cost + more, set | 1 << next.1, steps));
                }
            }
        }
        Self { recipes }
    }

    pub fn get(&self, function: Function) -> Option<&Recipe> {
        self.recipes[usize::from(function.bits())].as_ref()
    }

    pub fn cost(&self, function: Function) -> Option<u32> {
        self.get(function).map(|recipe| recipe.cost)
    }
}

const START: [(u8, Operand); 4] = [
    (0b1100, Operand::Input(0)),
    (0b1010, Operand::Input(1)),
    (0b0000, Operand::Constant(false)),
    (0b1111, Operand::Constant(true)),
];

fn operands(steps: &[(Step, u8)]) -> Vec<(u8, Operand)> {
    let results = steps.iter().enumerate().map(|(i, &(_, bits))| (bits, Operand::Step(i as u8)));
    START.into_iter().chain(results).collect()
}

/// Of several cells for the same function: the cheapest, then the function's own cell, then the first.
fn extensions(library: &CellLibrary, set: u16, steps: &[(Step, u8)]) -> Vec<(u32, (Step, u8))> {
    let operands = operands(steps);
    let rank = |cost: u32, step: Step, bits: u8| (cost, step.function.bits() != bits);
    let mut extensions: Vec<(u32, (Step, u8))> = Vec::new();
    for (function, kind) in library.kinds() {
        for &(a_bits, a) in &operands {
            for &(b_bits, b) in &operands {
                let bits = compose(function, a_bits, b_bits);
                if set >> bits & 1 == 1 {
                    continue;
                }
                let step = Step { function, pins: [a, b] };
                match extensions.iter_mut().find(|(_, (_, known))| *known == bits) {
                    None => extensions.push((kind.cost, (step, bits))),
                    Some(known) if rank(kind.cost, step, bits) < rank(known.0, known.1.0, bits) => {
                        *known = (kind.cost, (step, bits))
                    }
                    Some(_) => {}
                }
            }
        }
    }
    extensions
}

fn recipe(cost: u32, steps: &[(Step, u8)], bits: u8) -> Recipe {
    let result = operands(steps).into_iter().find(|&(made, _)| made == bits).map(|(_, operand)| operand);
    let result = result.expect("a function that was found is at hand");
    let steps = steps.iter().map(|&(step, _)| step).collect();
    Recipe { steps, result, cost }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::library;

    fn value(recipe: &Recipe, a: bool, b: bool) -> bool {
        let mut values = Vec::new();
        let read = |values: &[bool], operand| match operand {
            Operand::Input(0) => a,
            Operand::Input(_) => b,
            Operand::Constant(value) => value,
            Operand::Step(i) => values[usize::from(i)],
        };
        for step in &recipe.steps {
            let value = step.function.output(read(&values, step.pins[0]), read(&values, step.pins[1]));
            values.push(value);
        }
        read(&values, recipe.result)
    }

    fn costs(cells: &str) -> Vec<u32> {
        let recipes = Recipes::of(&library(cells));
        Function::all()
            .map(|function| {
                let recipe = recipes.get(function).unwrap();
                for (a, b) in [(false, false), (false, true), (true, false), (true, true)] {
                    assert_eq!(value(recipe, a, b), function.output(a, b), "{function}");
                }
                recipe.cost
            })
            .collect()
    }

    #[test]
    fn nand_and_not_make_every_function() {
        assert_eq!(costs("nand not"), [0, 4, 3, 1, 3, 1, 4, 1, 2, 5, 0, 2, 0, 2, 3, 0]);
    }

    #[test]
    fn a_function_with_its_own_cell_uses_that_cell() {
        let recipes = Recipes::of(&CellLibrary::uniform(Function::all()));
        let own = |function: Function| {
            recipes.get(function).unwrap().steps.iter().map(|step| step.function).collect::<Vec<_>>()
        };
        assert_eq!(own(Function::NOT), [Function::NOT]);
        assert_eq!(own(Function::NOR), [Function::NOR]);
    }

    #[test]
    fn other_complete_libraries_make_every_function_too() {
        assert_eq!(costs("nand"), costs("nand not"));
        assert_eq!(costs("xor and")[usize::from(Function::OR.bits())], 3);
        assert_eq!(costs("a_or_notb")[usize::from(Function::NOT.bits())], 1);
    }
}
