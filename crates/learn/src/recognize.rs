//! Functions that are recognized: parity, functions of the number of ones, arithmetic, and chains of majorities.

use crate::arithmetic::{add, count, divide, entry, equal, less, multiply, root, subtract};
use crate::bits::Bits;
use crate::graph::{GateGraph, Literal};

pub type Guess = (Literal, String);

/// The exclusive or of some inputs, or its inverse, if that is what all rows are.
pub fn parity(graph: &mut GateGraph, inputs: &[Bits], target: &Bits) -> Option<Guess> {
    // A row of the system of equations: the input bits, a one for the constant, and the value.
    let width = inputs.len() + 2;
    let mut solved: Vec<(usize, Bits)> = Vec::new();
    for row in 0..target.rows() {
        let known = inputs.iter().map(|input| input.get(row)).chain([true, target.get(row)]);
        let mut equation = Bits::of(known);
        for (pivot, other) in &solved {
            if equation.get(*pivot) {
                equation = equation.xor(other);
            }
        }
        let first = equation.ones().next();
        match first {
            None => {}
            Some(pivot) if pivot == width - 1 => return None,
            Some(pivot) => {
                for (_, other) in &mut solved {
                    if other.get(pivot) {
                        *other = other.xor(&equation);
                    }
                }
                solved.push((pivot, equation));
            }
        }
    }
    // What no equation decides is 0, so an unknown is the value of its equation.
    let is_one = |place: usize| solved.iter().any(|(pivot, equation)| *pivot == place && equation.get(width - 1));
    let picked: Vec<usize> = (0..inputs.len()).filter(|&at| is_one(at)).collect();
    let start = Literal::constant(is_one(inputs.len()));
    let sum = picked.iter().fold(start, |sum, &at| graph.xor(graph.input(at), sum));
    Some((sum, format!("the parity of {} inputs", picked.len())))
}

/// What the rows mostly are for each number of ones.
pub fn of_count(graph: &mut GateGraph, inputs: &[Bits], target: &Bits) -> Guess {
    let mut tally = vec![[0usize; 2]; inputs.len() + 1];
    for row in 0..target.rows() {
        let ones = inputs.iter().filter(|input| input.get(row)).count();
        tally[ones][usize::from(target.get(row))] += 1;
    }
    // A number that no row has is as the one before, which needs no gates.
    let mut last = false;
    let table: Vec<bool> = tally
        .into_iter()
        .map(|[zeros, ones]| {
            last = if zeros == ones { last } else { ones > zeros };
            last
        })
        .collect();
    let literals = graph.inputs();
    let word = count(graph, &literals);
    (entry(graph, &word, &table), "a function of the number of ones".to_owned())
}

const MOST_WIDE: usize = 64;

fn pairs(bits: &[Literal]) -> Vec<(Vec<Literal>, Vec<Literal>)> {
    let half = bits.len() / 2;
    if !bits.len().is_multiple_of(2) || half == 0 {
        return Vec::new();
    }
    let turned = |word: &[Literal]| word.iter().rev().copied().collect::<Vec<_>>();
    let every_second = |first: usize| bits.iter().skip(first).step_by(2).copied().collect::<Vec<_>>();
    let (a, b) = bits.split_at(half);
    let (even, odd) = (every_second(0), every_second(1));
    let pair = |a: &[Literal], b: &[Literal]| [(turned(a), turned(b)), (a.to_vec(), b.to_vec())];
    [pair(a, b), pair(&even, &odd)].concat()
}

/// The bit of arithmetic of the inputs, in their order, that agrees with most rows. The inputs are a number, or two
/// numbers one after the other or bit by bit in turns, with the highest bit first or last.
pub fn arithmetic(graph: &mut GateGraph, inputs: &[Bits], target: &Bits) -> Option<Guess> {
    let bits = graph.inputs();
    let is_wide = bits.len() > MOST_WIDE;
    let mut guesses: Vec<Guess> = Vec::new();
    let mut word = |what: &str, word: Vec<Literal>| {
        guesses.extend(word.into_iter().enumerate().map(|(bit, literal)| (literal, format!("bit {bit} of {what}"))));
    };
    for (a, b) in pairs(&bits) {
        let (mut sum, carry) = add(graph, &a, &b, Literal::FALSE);
        sum.push(carry);
        word("a sum", sum);
        word("a difference", subtract(graph, &a, &b));
        word("a comparison by `<`", vec![less(graph, &a, &b)]);
        word("a comparison by `>`", vec![less(graph, &b, &a)]);
        word("a comparison by `==`", vec![equal(graph, &a, &b)]);
        if !is_wide {
            word("a product", multiply(graph, &a, &b));
            for (a, b) in [(&a, &b), (&b, &a)] {
                let (quotient, rest) = divide(graph, a, b);
                word("a quotient", quotient);
                word("a remainder", rest);
            }
        }
    }
    if !is_wide {
        let turned: Vec<Literal> = bits.iter().rev().copied().collect();
        for number in [&turned, &bits] {
            word("a square root", root(graph, number));
        }
    }
    let literals: Vec<Literal> = guesses.iter().map(|(literal, _)| *literal).collect();
    let values = graph.values(inputs, &literals);
    let mut best: Option<(usize, Guess)> = None;
    for ((literal, what), value) in guesses.into_iter().zip(values) {
        let wrong = value.xor(target).count();
        let (wrong, invert) = (wrong.min(target.rows() - wrong), wrong * 2 > target.rows());
        if best.as_ref().is_none_or(|(least, _)| wrong < *least) {
            let what = if invert { format!("not {what}") } else { what };
            best = Some((wrong, (literal.inverted_if(invert), what)));
        }
    }
    best.map(|(_, guess)| guess)
}

const TOLERATED: f64 = 0.01;

const FEWEST: usize = 12;

/// A chain of majorities, such as a carry or a comparison, of inputs in any order and perhaps inverted: where two
/// inputs agree they decide, and where they do not, the rest of the chain does. `None` if no two inputs decide.
pub fn chain(graph: &mut GateGraph, inputs: &[Bits], target: &Bits) -> Option<Guess> {
    let mut rows = Bits::all(target.rows(), true);
    let mut links: Vec<(Literal, Literal)> = Vec::new();
    let mut free: Vec<usize> = (0..inputs.len()).collect();
    loop {
        let ones = rows.count_and(target);
        let all = rows.count();
        let is_end = ones == 0 || ones == all || all < FEWEST;
        let link = if is_end { None } else { link(inputs, target, &rows, &free) };
        let Some((pair, inverted)) = link else {
            let end = Literal::constant(ones * 2 > all);
            let sum = links.iter().rev().fold(end, |sum, &(a, b)| graph.majority(a, b, sum));
            return (!links.is_empty()).then(|| (sum, format!("a chain of {} majorities", links.len())));
        };
        let [a, b] = [0, 1].map(|at| graph.input(pair[at]).inverted_if(inverted[at]));
        links.push((a, b));
        let differ = inputs[pair[0]].xor(&inputs[pair[1]]);
        // The rows that are left are those in which the literals differ.
        rows = if inverted[0] == inverted[1] { rows.and(&differ) } else { rows.and_not(&differ) };
        free.retain(|at| !pair.contains(at));
    }
}

/// The two inputs that decide with the fewest errors, of equal ones those that decide most rows, and whether each is
/// inverted; `None` if they are wrong too often.
fn link(inputs: &[Bits], target: &Bits, rows: &Bits, free: &[usize]) -> Option<([usize; 2], [bool; 2])> {
    let mut best: Option<(f64, usize, [usize; 2], [bool; 2])> = None;
    for (at, &one) in free.iter().enumerate() {
        let set = rows.and(&inputs[one]);
        let clear = rows.and_not(&inputs[one]);
        let (set_all, clear_all) = (set.count(), clear.count());
        let (set_ones, clear_ones) = (set.count_and(target), clear.count_and(target));
        for &two in &free[at + 1..] {
            let (set_both, clear_two) = (set.count_and(&inputs[two]), clear.count_and(&inputs[two]));
            let ones_both = set.count_and_3(&inputs[two], target);
            let ones_two = clear.count_and_3(&inputs[two], target);
            let cells = [
                [(clear_all - clear_two, clear_ones - ones_two), (clear_two, ones_two)],
                [(set_all - set_both, set_ones - ones_both), (set_both, ones_both)],
            ];
            for invert in [false, true] {
                let (low, high) = (cells[0][usize::from(invert)], cells[1][usize::from(!invert)]);
                let decided = low.0 + high.0;
                let wrong = low.1 + high.0 - high.1;
                for (wrong, negate) in [(wrong, false), (decided - wrong, true)] {
                    let share = wrong as f64 / decided.max(1) as f64;
                    let is_better =
                        best.is_none_or(|(least, most, ..)| share < least || share == least && decided > most);
                    if decided > 0 && is_better {
                        best = Some((share, decided, [one, two], [negate, negate != invert]));
                    }
                }
            }
        }
    }
    let (share, _, pair, inverted) = best?;
    (share <= TOLERATED).then_some((pair, inverted))
}
