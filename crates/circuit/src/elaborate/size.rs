//! Integers that are known when a circuit is built.

use crate::elaborate::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Size, SizeId, SizeKind};

pub(super) fn value(sizes: &[Size], root: SizeId, variables: &[i128]) -> Result<i128, Diagnostic> {
    let first = Size::first_part(sizes, root);
    if first == root {
        return Ok(leaf(sizes[root.0 as usize].kind, variables));
    }
    let mut done: Vec<i128> = Vec::new();
    for at in first.0..=root.0 {
        let size = sizes[at as usize];
        let value = match size.kind {
            SizeKind::Log2(_) => Some(SizeKind::log2(done.pop().expect("an operand"))),
            SizeKind::Binary(operator, ..) => {
                let right = done.pop().expect("a right operand");
                operator.apply(done.pop().expect("a left operand"), right)
            }
            kind => Some(leaf(kind, variables)),
        };
        done.push(value.ok_or_else(|| wording::overflow(size.span))?);
    }
    Ok(done.pop().expect("a size has a value"))
}

fn leaf(kind: SizeKind, variables: &[i128]) -> i128 {
    match kind {
        SizeKind::Literal(value) => value,
        SizeKind::Variable(slot) => variables[slot as usize],
        _ => unreachable!("a leaf is a literal or a variable"),
    }
}
