//! Two-input boolean functions, computed by gates.

use std::fmt;

/// One of the sixteen functions of two inputs `a` and `b`: bit `2a + b` is the output (so bit 0 is the output at 00).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Function(u8);

/// Every function with its name, in the order of [`Function::bits`].
const NAMES: [&str; 16] = [
    "zero",
    "nor",
    "nota_and_b",
    "nota",
    "a_and_notb",
    "notb",
    "xor",
    "nand",
    "and",
    "xnor",
    "b",
    "nota_or_b",
    "a",
    "a_or_notb",
    "or",
    "one",
];

impl Function {
    /// Always 0.
    pub const ZERO: Self = Self(0b0000);
    /// `nor`
    pub const NOR: Self = Self(0b0001);
    /// `not a`
    pub const NOT: Self = Self(0b0011);
    /// `not b`
    pub const NOT_B: Self = Self(0b0101);
    /// `xor`
    pub const XOR: Self = Self(0b0110);
    /// `nand`
    pub const NAND: Self = Self(0b0111);
    /// `and`
    pub const AND: Self = Self(0b1000);
    /// `xnor`
    pub const XNOR: Self = Self(0b1001);
    /// `b`
    pub const BUF_B: Self = Self(0b1010);
    /// `a`
    pub const BUF: Self = Self(0b1100);
    /// `or`
    pub const OR: Self = Self(0b1110);
    /// Always 1.
    pub const ONE: Self = Self(0b1111);

    /// The function whose output at inputs (a, b) is bit `2a + b` of `bits`.
    ///
    /// # Panics
    /// When `bits` is 16 or more.
    pub const fn new(bits: u8) -> Self {
        assert!(bits < 16, "a two-input function has four outputs");
        Self(bits)
    }

    /// All sixteen, in order of their bits.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..16).map(Self)
    }

    /// The outputs as bits, bit `2a + b` at inputs (a, b).
    pub fn bits(self) -> u8 {
        self.0
    }

    /// The output at inputs (a, b).
    pub fn output(self, a: bool, b: bool) -> bool {
        self.0 >> (u8::from(a) * 2 + u8::from(b)) & 1 == 1
    }

    /// Whether input `a` (0) or `b` (1) can change the output.
    pub fn depends_on(self, input: usize) -> bool {
        match input {
            0 => (self.0 >> 2) != (self.0 & 0b11),
            _ => (self.0 >> 1 & 0b101) != (self.0 & 0b101),
        }
    }

    /// The number of inputs that can change the output: 0, 1 or 2.
    pub fn arity(self) -> usize {
        usize::from(self.depends_on(0)) + usize::from(self.depends_on(1))
    }

    /// The function with exchanged inputs.
    pub fn swapped(self) -> Self {
        Self(self.0 & 0b1001 | (self.0 & 0b0010) << 1 | (self.0 & 0b0100) >> 1)
    }

    /// The function with the inverted output.
    pub fn inverted(self) -> Self {
        Self(!self.0 & 0b1111)
    }

    /// The function with input `a` (0) or `b` (1) inverted.
    pub fn with_input_inverted(self, input: usize) -> Self {
        match input {
            0 => Self((self.0 & 0b0011) << 2 | self.0 >> 2),
            _ => Self((self.0 & 0b0101) << 1 | (self.0 & 0b1010) >> 1),
        }
    }

    /// The lower-case name: `nand`, `xor`, `a_and_notb`, …; `not` and `buf` for functions of the first input alone.
    pub fn name(self) -> &'static str {
        match self {
            Self::NOT => "not",
            Self::BUF => "buf",
            _ => NAMES[usize::from(self.0)],
        }
    }

    /// The function with this name, in upper or lower case.
    pub fn parse(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        Self::all().find(|function| function.name() == name || NAMES[usize::from(function.0)] == name)
    }
}

impl fmt::Display for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_outputs_agree() {
        for (a, b) in [(false, false), (false, true), (true, false), (true, true)] {
            assert_eq!(Function::NAND.output(a, b), !(a && b));
            assert_eq!(Function::XOR.output(a, b), a != b);
            assert_eq!(Function::NOT.output(a, b), !a);
            assert_eq!(Function::parse("a_and_notb").unwrap().output(a, b), a && !b);
            assert_eq!(Function::parse("nota_or_b").unwrap().output(a, b), !a || b);
            for function in Function::all() {
                assert_eq!(function.swapped().output(b, a), function.output(a, b));
                assert_eq!(function.inverted().output(a, b), !function.output(a, b));
                assert_eq!(function.with_input_inverted(0).output(!a, b), function.output(a, b));
                assert_eq!(function.with_input_inverted(1).output(a, !b), function.output(a, b));
            }
        }
    }

    #[test]
    fn every_name_reads_back() {
        for function in Function::all() {
            assert_eq!(Function::parse(function.name()), Some(function));
        }
    }

    #[test]
    fn dependence_is_on_the_inputs_that_matter() {
        assert_eq!(Function::NOT.arity(), 1);
        assert!(Function::NOT.depends_on(0) && !Function::NOT.depends_on(1));
        assert!(Function::BUF_B.depends_on(1) && !Function::BUF_B.depends_on(0));
        assert_eq!(Function::XOR.arity(), 2);
        assert_eq!(Function::ONE.arity(), 0);
    }
}
