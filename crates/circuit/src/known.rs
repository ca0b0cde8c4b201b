//! Bits that may be unknown, and the functions of them.

use nbc_base::model::Function;

/// The known value of a bit; `None` if it may be either.
pub type TernaryBit = Option<bool>;

/// The value of a function where its inputs determine it.
pub fn answer(function: Function, [a, b]: [TernaryBit; 2]) -> TernaryBit {
    let either = |bit: TernaryBit| bit.map_or([false, true], |bit| [bit; 2]);
    let mut outputs = either(a).into_iter().flat_map(|a| either(b).map(|b| function.output(a, b)));
    let first = outputs.next();
    if outputs.all(|output| Some(output) == first) { first } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_input_may_decide() {
        assert_eq!(answer(Function::NAND, [Some(false), None]), Some(true));
        assert_eq!(answer(Function::NAND, [Some(true), None]), None);
        assert_eq!(answer(Function::XOR, [None, None]), None);
    }
}
