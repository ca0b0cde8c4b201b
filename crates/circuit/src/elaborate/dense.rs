//! A function of a few bits as a list of outputs, decomposed input by input (Shannon). Equal parts are shared; outputs
//! that do not matter are chosen to make parts equal.

use std::collections::BTreeMap;

use nbc_base::model::{Function, Table};

/// The outputs of a function for every pattern of its inputs, in counting order; `None` is a don't-care.
pub(super) struct Dense {
    outputs: Vec<Option<bool>>,
}

/// A part of a decomposed function, made of earlier parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Shape {
    /// Always the same.
    Constant(bool),
    /// An input, counted from the lowest.
    Input(usize),
    /// The opposite of a part.
    Not(usize),
    /// A gate of two parts.
    Gate(Function, usize, usize),
    /// By the first part, the second at 1, the third at 0.
    Select(usize, usize, usize),
}

impl Dense {
    /// One output bit of a table with that many inputs: its value in each row, and for the other patterns.
    pub(super) fn of(table: &Table, inputs: usize, values: &[Option<bool>], otherwise: Option<bool>) -> Self {
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
        Self { outputs }
    }

    /// The function as parts, the whole last.
    pub(super) fn shape(&self) -> Vec<Shape> {
        let mut parts = Parts::default();
        let whole = parts.function(&self.outputs);
        // The last entry may not be the whole function, if the whole is part of a part.
        parts.list.truncate(whole + 1);
        parts.list
    }
}

#[derive(Default)]
struct Parts {
    list: Vec<Shape>,
    known: BTreeMap<Shape, usize>,
}

impl Parts {
    fn part(&mut self, shape: Shape) -> usize {
        *self.known.entry(shape).or_insert_with(|| {
            self.list.push(shape);
            self.list.len() - 1
        })
    }

    /// A function by its outputs; it is halved, so the recursion is no deeper than the number of inputs.
    fn function(&mut self, outputs: &[Option<bool>]) -> usize {
        if let Some(value) = constant(outputs) {
            return self.part(Shape::Constant(value));
        }
        let (low, high) = outputs.split_at(outputs.len() / 2);
        if let Some(both) = agreed(low, high) {
            return self.function(&both);
        }
        let input = self.part(Shape::Input(outputs.len().trailing_zeros() as usize - 1));
        match (constant(low), constant(high)) {
            (Some(false), Some(_)) => input,
            (Some(true), Some(_)) => self.part(Shape::Not(input)),
            (Some(false), None) => self.gate(Function::AND, input, high),
            (Some(true), None) => self.gate(Function::new(0b1011), input, high),
            (None, Some(false)) => self.gate(Function::new(0b0010), input, low),
            (None, Some(true)) => self.gate(Function::OR, input, low),
            (None, None) => match agreed(&inverted(low), high) {
                Some(opposite) => self.gate(Function::XOR, input, &inverted(&opposite)),
                None => {
                    let (then, otherwise) = (self.function(high), self.function(low));
                    self.part(Shape::Select(input, then, otherwise))
                }
            },
        }
    }

    fn gate(&mut self, function: Function, input: usize, rest: &[Option<bool>]) -> usize {
        let rest = self.function(rest);
        self.part(Shape::Gate(function, input, rest))
    }
}

fn constant(outputs: &[Option<bool>]) -> Option<bool> {
    let mut known = outputs.iter().flatten();
    let first = *known.next().unwrap_or(&false);
    known.all(|&output| output == first).then_some(first)
}

/// A common completion of both halves, if there is one.
fn agreed(low: &[Option<bool>], high: &[Option<bool>]) -> Option<Vec<Option<bool>>> {
    let one = |(a, b): (&Option<bool>, &Option<bool>)| match (a, b) {
        (Some(a), Some(b)) if a != b => None,
        _ => Some(a.or(*b)),
    };
    low.iter().zip(high).map(one).collect()
}

fn inverted(outputs: &[Option<bool>]) -> Vec<Option<bool>> {
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
            let shape = Dense { outputs: outputs.clone() }.shape();
            for (pattern, output) in outputs.iter().enumerate() {
                assert_eq!(Some(evaluate(&shape, pattern)), *output, "function {bits}, pattern {pattern}");
            }
        }
    }

    #[test]
    fn dont_cares_are_chosen_to_share_parts() {
        let outputs = vec![Some(false), None, Some(false), Some(true)];
        assert_eq!(Dense { outputs }.shape(), [Shape::Input(0)]);
    }
}
