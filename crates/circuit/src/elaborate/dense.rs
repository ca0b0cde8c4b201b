//! A function of a few bits as a list of outputs, decomposed input by input (Shannon). Equal parts are shared; outputs
//! that do not matter are chosen to make parts equal.

use crate::interned::Interned;
use nbc_base::model::{Function, Table};

/// The value of a function for each pattern of its inputs, in counting order; `None` is a don't-care.
pub(super) type Outputs = Vec<Option<bool>>;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Shape {
    Constant(bool),
    /// An input, counted from the lowest.
    Input(usize),
    Not(usize),
    Gate(Function, usize, usize),
    /// By the first part, the second at 1, the third at 0.
    Select(usize, usize, usize),
}

pub(super) fn outputs(table: &Table, inputs: usize, values: &[Option<bool>], otherwise: Option<bool>) -> Outputs {
    let mut outputs = vec![otherwise; 1 << inputs];
    for (row, output_bit) in table.rows.iter().zip(values) {
        let value =
            |wanted| row.bits().iter().fold(0usize, |sum, digit| sum << 1 | usize::from(*digit == Some(wanted)));
        let (ones, zeros) = (value(true), value(false));
        for (pattern, output) in outputs.iter_mut().enumerate() {
            if pattern & ones == ones && pattern & zeros == 0 {
                *output = *output_bit;
            }
        }
    }
    outputs
}

pub(super) fn shape(outputs: &[Option<bool>]) -> Vec<Shape> {
    let mut parts = Interned::default();
    let whole = part(&mut parts, outputs);
    // The last entry may not be the whole function, if the whole is part of a part.
    parts.items.truncate(whole + 1);
    parts.items
}

/// Halves the function, so the recursion is no deeper than the number of inputs.
fn part(parts: &mut Interned<Shape>, outputs: &[Option<bool>]) -> usize {
    if let Some(value) = constant(outputs) {
        return parts.number(Shape::Constant(value));
    }
    let (low, high) = outputs.split_at(outputs.len() / 2);
    if let Some(both) = agreed(low, high) {
        return part(parts, &both);
    }
    let input = parts.number(Shape::Input(outputs.len().trailing_zeros() as usize - 1));
    let (function, rest) = match (constant(low), constant(high)) {
        (Some(false), Some(_)) => return input,
        (Some(true), Some(_)) => return parts.number(Shape::Not(input)),
        (Some(false), None) => (Function::AND, high.to_vec()),
        (Some(true), None) => (Function::OR.with_input_inverted(0), high.to_vec()),
        (None, Some(false)) => (Function::AND.with_input_inverted(0), low.to_vec()),
        (None, Some(true)) => (Function::OR, low.to_vec()),
        (None, None) => match agreed(&inverted(low), high) {
            Some(opposite) => (Function::XOR, inverted(&opposite)),
            None => {
                let (then, otherwise) = (part(parts, high), part(parts, low));
                return parts.number(Shape::Select(input, then, otherwise));
            }
        },
    };
    let rest = part(parts, &rest);
    parts.number(Shape::Gate(function, input, rest))
}

fn constant(outputs: &[Option<bool>]) -> Option<bool> {
    let mut known = outputs.iter().flatten();
    let first = *known.next().unwrap_or(&false);
    known.all(|&output| output == first).then_some(first)
}

fn agreed(low: &[Option<bool>], high: &[Option<bool>]) -> Option<Outputs> {
    let one = |(a, b): (&Option<bool>, &Option<bool>)| match (a, b) {
        (Some(a), Some(b)) if a != b => None,
        _ => Some(a.or(*b)),
    };
    low.iter().zip(high).map(one).collect()
}

fn inverted(outputs: &[Option<bool>]) -> Outputs {
    outputs.iter().map(|output| output.map(|value| !value)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn evaluate(shape: &[Shape], pattern: usize) -> bool {
        let mut values: Vec<bool> = Vec::new();
        for part in shape {
            let value = match *part {
                Shape::Constant(value) => value,
                Shape::Input(input) => pattern >> input & 1 == 1,
                Shape::Not(part) => !values[part],
                Shape::Gate(function, a, b) => function.output(values[a], values[b]),
                Shape::Select(condition, then, otherwise) => {
                    if values[condition] {
                        values[then]
                    } else {
                        values[otherwise]
                    }
                }
            };
            values.push(value);
        }
        *values.last().unwrap()
    }

    #[test]
    fn decomposition_preserves_every_function_of_three_bits() {
        for bits in 0..256usize {
            let outputs: Vec<_> = (0..8).map(|pattern| Some(bits >> pattern & 1 == 1)).collect();
            let shape = shape(&outputs);
            for (pattern, output) in outputs.iter().enumerate() {
                assert_eq!(Some(evaluate(&shape, pattern)), *output, "function {bits}, pattern {pattern}");
            }
        }
    }

    #[test]
    fn dont_cares_are_chosen_to_share_parts() {
        let outputs = vec![Some(false), None, Some(false), Some(true)];
        assert_eq!(shape(&outputs), [Shape::Input(0)]);
    }
}
