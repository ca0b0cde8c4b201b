//! Integers that are known when a circuit is built.

use crate::elaborate::wording::RangeError;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Size, SizeId, SizeKind, SizeOperator};

/// The value of a size, from its leaves to its root without recursion.
pub(super) fn value(sizes: &[Size], root: SizeId, variables: &[i64]) -> Result<i64, Diagnostic> {
    let first = first_leaf(sizes, root);
    if first == root {
        return Ok(leaf(sizes[root.0 as usize].kind, variables));
    }
    let mut done: Vec<i64> = Vec::new();
    for at in first.0..=root.0 {
        let size = sizes[at as usize];
        let value = match size.kind {
            SizeKind::Log2(_) => Some(log2(done.pop().expect("an operand"))),
            SizeKind::Binary(operator, ..) => {
                let right = done.pop().expect("a right operand");
                binary(operator, done.pop().expect("a left operand"), right)
            }
            kind => Some(leaf(kind, variables)),
        };
        done.push(value.ok_or_else(|| RangeError::Overflow.at(size.span))?);
    }
    Ok(done.pop().expect("a size has a value"))
}

fn leaf(kind: SizeKind, variables: &[i64]) -> i64 {
    match kind {
        SizeKind::Literal(value) => value,
        SizeKind::Variable(slot) => variables[slot as usize],
        _ => unreachable!("a leaf is a literal or a variable"),
    }
}

fn binary(operator: SizeOperator, left: i64, right: i64) -> Option<i64> {
    match operator {
        SizeOperator::Add => left.checked_add(right),
        SizeOperator::Subtract => left.checked_sub(right),
        SizeOperator::Multiply => left.checked_mul(right),
        SizeOperator::Divide => left.checked_div_euclid(right),
        SizeOperator::Remainder => left.checked_rem_euclid(right),
        SizeOperator::Power => left.checked_pow(u32::try_from(right).ok()?),
    }
}

/// The number of bits needed for `things` different values; zero for one value.
fn log2(things: i64) -> i64 {
    if things <= 1 { 0 } else { i64::from(i64::BITS - (things - 1).leading_zeros()) }
}

fn first_leaf(sizes: &[Size], root: SizeId) -> SizeId {
    let mut at = root;
    loop {
        at = match sizes[at.0 as usize].kind {
            SizeKind::Literal(_) | SizeKind::Variable(_) => return at,
            SizeKind::Log2(inner) | SizeKind::Binary(_, inner, _) => inner,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn log2_is_the_number_of_bits_for_that_many_values() {
        assert_eq!([0, 1, 2, 3, 4, 5, 8, 9].map(log2), [0, 0, 1, 2, 2, 3, 3, 4]);
    }

    #[test]
    fn overflow_and_division_by_zero_have_no_value() {
        assert_eq!(binary(SizeOperator::Divide, 1, 0), None);
        assert_eq!(binary(SizeOperator::Power, 2, 64), None);
        assert_eq!(binary(SizeOperator::Power, 2, -1), None);
        assert_eq!(binary(SizeOperator::Subtract, 3, 5), Some(-2));
    }
}
