//! Bits that may be unknown, and the functions of them.

use nbc_base::model::Function;

/// The known value of a bit; `None` if it may be either.
pub type TernaryBit = Option<bool>;

pub fn answer(function: Function, inputs: &[TernaryBit]) -> TernaryBit {
    assert_eq!(inputs.len(), function.inputs(), "a bit for each input");
    let agrees =
        |row: usize| inputs.iter().enumerate().all(|(i, bit)| bit.is_none_or(|bit| bit == function.input_at(i, row)));
    let mut outputs = (0..1 << function.inputs()).filter(|&row| agrees(row)).map(|row| function.row(row));
    let first = outputs.next();
    if outputs.all(|output| Some(output) == first) { first } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_input_may_decide() {
        assert_eq!(answer(Function::NAND, &[Some(false), None]), Some(true));
        assert_eq!(answer(Function::NAND, &[Some(true), None]), None);
        assert_eq!(answer(Function::XOR, &[None, None]), None);
        assert_eq!(answer(Function::MAJ, &[Some(true), None, Some(true)]), Some(true));
        assert_eq!(answer(Function::MUX, &[None, Some(false), Some(false)]), Some(false));
    }
}
