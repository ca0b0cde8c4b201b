//! Arithmetic of words of literals, the lowest bit first.

use std::ops::Not;

use crate::graph::{GateGraph, Literal};

fn full_adder(graph: &mut GateGraph, a: Literal, b: Literal, carry: Literal) -> (Literal, Literal) {
    let half = graph.xor(a, b);
    (graph.xor(half, carry), graph.mux(half, carry, a))
}

pub fn add(graph: &mut GateGraph, a: &[Literal], b: &[Literal], mut carry: Literal) -> (Vec<Literal>, Literal) {
    let mut sum = Vec::new();
    for (&a, &b) in a.iter().zip(b) {
        let (bit, next) = full_adder(graph, a, b, carry);
        sum.push(bit);
        carry = next;
    }
    (sum, carry)
}

fn inverted(word: &[Literal]) -> Vec<Literal> {
    word.iter().map(|bit| bit.not()).collect()
}

pub fn less(graph: &mut GateGraph, a: &[Literal], b: &[Literal]) -> Literal {
    a.iter().zip(b).fold(Literal::FALSE, |less, (&a, &b)| graph.majority(a.not(), b, less))
}

pub fn equal(graph: &mut GateGraph, a: &[Literal], b: &[Literal]) -> Literal {
    let same = a.iter().zip(b).map(|(&a, &b)| graph.xor(a, b).not()).collect();
    graph.every(same)
}

pub fn subtract(graph: &mut GateGraph, a: &[Literal], b: &[Literal]) -> Vec<Literal> {
    add(graph, a, &inverted(b), Literal::TRUE).0
}

pub fn multiply(graph: &mut GateGraph, a: &[Literal], b: &[Literal]) -> Vec<Literal> {
    let mut product = vec![Literal::FALSE; a.len() + b.len()];
    for (at, &bit) in b.iter().enumerate() {
        let part: Vec<Literal> = a.iter().map(|&a| graph.and(a, bit)).collect();
        let (sum, carry) = add(graph, &product[at..at + a.len()], &part, Literal::FALSE);
        product[at..at + a.len()].copy_from_slice(&sum);
        product[at + a.len()] = carry;
    }
    product
}

/// The whole part of a quotient, and the remainder; all ones and something if the divisor is 0.
pub fn divide(graph: &mut GateGraph, a: &[Literal], b: &[Literal]) -> (Vec<Literal>, Vec<Literal>) {
    let mut wide = b.to_vec();
    wide.push(Literal::FALSE);
    let mut rest = vec![Literal::FALSE; wide.len()];
    let mut quotient = vec![Literal::FALSE; a.len()];
    for at in (0..a.len()).rev() {
        rest.rotate_right(1);
        rest[0] = a[at];
        quotient[at] = take(graph, &mut rest, &wide);
    }
    rest.pop();
    (quotient, rest)
}

pub fn root(graph: &mut GateGraph, word: &[Literal]) -> Vec<Literal> {
    let mut word = word.to_vec();
    if word.len() % 2 == 1 {
        word.push(Literal::FALSE);
    }
    let half = word.len() / 2;
    let mut root: Vec<Literal> = Vec::new();
    // Two bits of the word are added to the remainder for each bit of the root.
    let mut rest = vec![Literal::FALSE; half + 2];
    for at in (0..half).rev() {
        rest.rotate_right(2);
        (rest[0], rest[1]) = (word[2 * at], word[2 * at + 1]);
        let mut tried = vec![Literal::TRUE, Literal::FALSE];
        tried.extend(&root);
        tried.resize(half + 2, Literal::FALSE);
        let bit = take(graph, &mut rest, &tried);
        root.insert(0, bit);
    }
    root
}

/// Subtracts a word if that leaves no negative number, and says whether.
fn take(graph: &mut GateGraph, from: &mut [Literal], word: &[Literal]) -> Literal {
    let (difference, fits) = add(graph, from, &inverted(word), Literal::TRUE);
    for (bit, less) in from.iter_mut().zip(difference) {
        *bit = graph.mux(fits, less, *bit);
    }
    fits
}

pub fn count(graph: &mut GateGraph, bits: &[Literal]) -> Vec<Literal> {
    let (mut column, mut word) = (bits.to_vec(), Vec::new());
    loop {
        let mut carries = Vec::new();
        while column.len() > 1 {
            let (a, b) = (column.remove(0), column.remove(0));
            let c = if column.is_empty() { Literal::FALSE } else { column.remove(0) };
            let (sum, carry) = full_adder(graph, a, b, c);
            column.push(sum);
            carries.push(carry);
        }
        word.push(column.pop().unwrap_or(Literal::FALSE));
        if carries.is_empty() {
            return word;
        }
        column = carries;
    }
}
/// The majority of votes, of which there is one less than a power of two: the highest bit of their count.
pub fn majority(graph: &mut GateGraph, votes: &[Literal]) -> Literal {
    assert!((votes.len() + 1).is_power_of_two(), "the highest bit of the count is the majority");
    *count(graph, votes).last().expect("a count has a bit")
}

/// The entry of a table at the number that a word is; entries after the last are that one.
pub fn entry(graph: &mut GateGraph, word: &[Literal], table: &[bool]) -> Literal {
    let Some((&high, rest)) = word.split_last() else { return Literal::constant(table[0]) };
    let half = 1 << rest.len();
    if table.len() <= half {
        return entry(graph, rest, table);
    }
    let (low, upper) = table.split_at(half);
    let (yes, no) = (entry(graph, rest, upper), entry(graph, rest, low));
    graph.mux(high, yes, no)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bits::Bits;

    fn values(graph: &GateGraph, inputs: usize, word: &[Literal]) -> Vec<usize> {
        let columns: Vec<Bits> =
            (0..inputs).map(|bit| Bits::of((0..1usize << inputs).map(|row| row >> bit & 1 == 1))).collect();
        let bits = graph.values(&columns, word);
        let number = |row: usize| bits.iter().enumerate().map(|(at, bit)| usize::from(bit.get(row)) << at).sum();
        (0..1 << inputs).map(number).collect()
    }

    #[test]
    fn words_are_computed_as_numbers() {
        let mut graph = GateGraph::new(8);
        let all = graph.inputs();
        let (a, b) = all.split_at(4);
        let check = |graph: &GateGraph, word: &[Literal], expected: &dyn Fn(usize, usize) -> usize| {
            for (row, found) in values(graph, 8, word).into_iter().enumerate() {
                assert_eq!(found, expected(row & 15, row >> 4), "{row}");
            }
        };
        let (mut sum, carry) = add(&mut graph, a, b, Literal::FALSE);
        sum.push(carry);
        check(&graph, &sum, &|a, b| a + b);
        let difference = subtract(&mut graph, a, b);
        check(&graph, &difference, &|a, b| a.wrapping_sub(b) & 15);
        let product = multiply(&mut graph, a, b);
        check(&graph, &product, &|a, b| a * b);
        let (quotient, rest) = divide(&mut graph, a, b);
        check(&graph, &quotient, &|a, b| a.checked_div(b).unwrap_or(15));
        check(&graph, &rest, &|a, b| a.checked_rem(b).unwrap_or(a));
        let compared = [less(&mut graph, a, b), equal(&mut graph, a, b)];
        check(&graph, &compared, &|a, b| usize::from(a < b) + 2 * usize::from(a == b));
        let roots = root(&mut graph, &all);
        check(&graph, &roots, &|a, b| (a + 16 * b).isqrt());
        let odd = root(&mut graph, &all[..7]);
        check(&graph, &odd, &|a, b| (a + 16 * (b & 7)).isqrt());
        let ones = count(&mut graph, &all);
        check(&graph, &ones, &|a, b| (a + 16 * b).count_ones() as usize);
        let table = [true, false, false, true, true];
        let found = entry(&mut graph, &ones, &table);
        check(&graph, &[found], &|a, b| usize::from(table[((a + 16 * b).count_ones() as usize).min(4)]));
    }
}
