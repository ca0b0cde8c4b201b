//! Boolean functions of two and three inputs, computed by gates.

use std::fmt;

use super::Pattern;

/// A boolean function of two or three inputs `a`, `b` and `c`. Bit `2a + b` of its bits is the output of one of two
/// inputs, bit `4a + 2b + c` that of one of three.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Function {
    // Compared first: those of two inputs come before those of three.
    inputs: u8,
    bits: u8,
}

/// Every function of two inputs with its name, in the order of [`Function::bits`].
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

/// The functions of three inputs that have a usual name; the others are `f3_` and their bits in hexadecimal.
const THREE: [(&str, u8); 19] = [
    ("zero3", 0x00),
    ("one3", 0xff),
    ("and3", 0x80),
    ("nand3", 0x7f),
    ("or3", 0xfe),
    ("nor3", 0x01),
    ("xor3", 0x96),
    ("xnor3", 0x69),
    ("maj", 0xe8),
    ("minority", 0x17),
    // a ? b : c, and its inverse
    ("mux", 0xca),
    ("muxi", 0x35),
    // (a and b) or c, and so on
    ("and_or", 0xea),
    ("and_or_invert", 0x15),
    ("or_and", 0xa8),
    ("or_and_invert", 0x57),
    ("one_hot", 0x16),
    ("all_equal", 0x81),
    ("gamble", 0x7e),
];

const HEXADECIMAL: &[[u8; 5]; 256] = &{
    const DIGITS: &[u8; 16] = b"0123456789abcdef";
    let mut names = [*b"f3_00"; 256];
    let mut bits = 0;
    while bits < 256 {
        names[bits][3] = DIGITS[bits >> 4];
        names[bits][4] = DIGITS[bits & 15];
        bits += 1;
    }
    names
};

impl Function {
    pub const MOST_INPUTS: usize = 3;

    pub const ZERO: Self = Self::new(0b0000);
    pub const NOR: Self = Self::new(0b0001);
    pub const NOT: Self = Self::new(0b0011);
    pub const NOT_B: Self = Self::new(0b0101);
    pub const XOR: Self = Self::new(0b0110);
    pub const NAND: Self = Self::new(0b0111);
    pub const AND: Self = Self::new(0b1000);
    pub const XNOR: Self = Self::new(0b1001);
    pub const BUF_B: Self = Self::new(0b1010);
    pub const BUF: Self = Self::new(0b1100);
    pub const OR: Self = Self::new(0b1110);
    pub const ONE: Self = Self::new(0b1111);
    pub const MAJ: Self = Self::three(0xe8);
    /// `b` if `a`, else `c`.
    pub const MUX: Self = Self::three(0xca);
    pub const XOR3: Self = Self::three(0x96);

    pub const fn new(bits: u8) -> Self {
        assert!(bits < 16, "a two-input function has four outputs");
        Self { inputs: 2, bits }
    }

    pub const fn three(bits: u8) -> Self {
        Self { inputs: 3, bits }
    }

    pub const fn of(inputs: usize, bits: u8) -> Self {
        match inputs {
            2 => Self::new(bits),
            3 => Self::three(bits),
            _ => panic!("a function has two or three inputs"),
        }
    }

    pub fn all() -> impl Iterator<Item = Self> {
        Self::all_of(2)
    }

    pub fn all_of(inputs: usize) -> impl Iterator<Item = Self> {
        let last = Self::last(inputs);
        (0..=last).map(move |bits| Self::of(inputs, bits))
    }

    /// All of two inputs, and those of three that have a usual name.
    pub fn named() -> impl Iterator<Item = Self> {
        Self::all().chain(THREE.iter().map(|&(_, bits)| Self::three(bits)))
    }

    fn last(inputs: usize) -> u8 {
        assert!(matches!(inputs, 2 | 3), "a function has two or three inputs");
        if inputs == 2 { 0b1111 } else { u8::MAX }
    }

    pub fn inputs(self) -> usize {
        usize::from(self.inputs)
    }

    pub fn bits(self) -> u8 {
        self.bits
    }

    pub fn output(self, a: bool, b: bool) -> bool {
        assert_eq!(self.inputs, 2, "the function has two inputs");
        self.row(usize::from(a) * 2 + usize::from(b))
    }

    /// The output at these inputs, `a` first.
    pub fn at(self, inputs: impl IntoIterator<Item = bool>) -> bool {
        let (row, count) =
            inputs.into_iter().fold((0, 0), |(row, count), bit| (row << 1 | usize::from(bit), count + 1));
        assert_eq!(count, self.inputs(), "a value for each input");
        self.row(row)
    }

    /// The output at row `2a + b` or `4a + 2b + c` of the truth table.
    pub fn row(self, row: usize) -> bool {
        self.bits >> row & 1 == 1
    }

    /// The bit of input `input` (0 is `a`) in a row of the truth table.
    pub fn input_at(self, input: usize, row: usize) -> bool {
        row >> (self.inputs() - 1 - input) & 1 == 1
    }

    pub fn under(self, pattern: Pattern) -> bool {
        self.row(pattern.number(self.inputs()))
    }

    pub fn depends_on(self, input: usize) -> bool {
        let (zero, place) = self.zero_rows(input);
        (self.bits >> place ^ self.bits) & zero != 0
    }

    /// The rows of the truth table in which an input is 0, as bits, and how far before the others they are.
    fn zero_rows(self, input: usize) -> (u8, usize) {
        const ZERO: [u8; 3] = [0x0f, 0x33, 0x55];
        match self.inputs().checked_sub(input + 1) {
            Some(after) => (ZERO[2 - after] & Self::last(self.inputs()), 1 << after),
            None => (0, 0),
        }
    }

    pub fn arity(self) -> usize {
        (0..self.inputs()).filter(|&input| self.depends_on(input)).count()
    }

    /// The function of two inputs with exchanged inputs; of one of three, the first two are exchanged.
    pub fn swapped(self) -> Self {
        if self.inputs == 3 {
            return self.permuted(&[1, 0, 2]);
        }
        Self { bits: self.bits & 0b1001 | (self.bits & 0b0010) << 1 | (self.bits & 0b0100) >> 1, ..self }
    }

    /// The function whose input `i` is input `order[i]` of this one.
    pub fn permuted(self, order: &[usize]) -> Self {
        assert_eq!(order.len(), self.inputs(), "each input has a place");
        let place = |input: usize| 1usize << (self.inputs() - 1 - input);
        let before = |row: usize| {
            order.iter().enumerate().filter(|&(i, _)| row & place(i) > 0).map(|(_, &to)| place(to)).sum::<usize>()
        };
        let bits = (0..1usize << self.inputs).fold(0, |bits, row| bits | u8::from(self.row(before(row))) << row);
        Self { bits, ..self }
    }

    pub fn inverted(self) -> Self {
        Self { bits: !self.bits & Self::last(self.inputs()), ..self }
    }

    pub fn with_input_inverted(self, input: usize) -> Self {
        let (zero, place) = self.zero_rows(input);
        Self { bits: (self.bits & zero) << place | self.bits >> place & zero, ..self }
    }

    /// Of a function of three inputs, the functions of `b` and `c` that it is while `a` is 0 and while it is 1.
    pub fn halves(self) -> [Self; 2] {
        assert_eq!(self.inputs, 3, "the function has three inputs");
        [Self::new(self.bits & 0b1111), Self::new(self.bits >> 4)]
    }

    /// The functions that follow from this one by exchanging inputs, with itself, in order of their bits.
    pub fn arrangements(self) -> Vec<Self> {
        let mut found: Vec<Self> = orders(self.inputs()).iter().map(|order| self.permuted(order)).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// One of its arrangements, the same for all of them: one with a usual name, or else that with the lowest bits.
    pub fn arranged(self) -> Self {
        let found = self.arrangements();
        let is_named = |function: &&Self| Self::named().any(|named| named == **function);
        *found.iter().find(is_named).unwrap_or(&found[0])
    }

    /// The functions that inverting and exchanging inputs and inverting the output give, in order of their bits.
    pub fn class(self) -> Vec<Self> {
        let inverted = |phase: usize| {
            let inputs = (0..self.inputs()).filter(|input| phase >> input & 1 == 1);
            let made = inputs.fold(self, |made, input| made.with_input_inverted(input));
            if phase >> self.inputs & 1 == 1 { made.inverted() } else { made }
        };
        let phases = (0..2usize << self.inputs).map(inverted);
        let mut class: Vec<Self> =
            phases.flat_map(|made| orders(self.inputs()).iter().map(move |order| made.permuted(order))).collect();
        class.sort_unstable();
        class.dedup();
        class
    }

    /// The lower-case name: `nand`, `xor`, `a_and_notb`, …; `not` and `buf` for functions of the first input alone;
    /// `maj`, `mux`, … and `f3_` with the bits in hexadecimal for functions of three inputs.
    pub fn name(self) -> &'static str {
        if self.inputs == 3 {
            let usual = THREE.iter().find(|(_, bits)| *bits == self.bits).map(|(name, _)| *name);
            let digits = || std::str::from_utf8(&HEXADECIMAL[usize::from(self.bits)]).expect("digits are ASCII");
            return usual.unwrap_or_else(digits);
        }
        match self {
            Self::NOT => "not",
            Self::BUF => "buf",
            _ => NAMES[usize::from(self.bits)],
        }
    }

    pub fn parse(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        let is_named = |function: &Self| {
            function.name() == name || function.inputs == 2 && NAMES[usize::from(function.bits)] == name
        };
        Self::all().chain(Self::all_of(3)).find(is_named)
    }
}

fn orders(inputs: usize) -> &'static [&'static [usize]] {
    match inputs {
        2 => &[&[0, 1], &[1, 0]],
        _ => &[&[0, 1, 2], &[0, 2, 1], &[1, 0, 2], &[1, 2, 0], &[2, 0, 1], &[2, 1, 0]],
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
        for function in Function::all().chain(Function::all_of(3)) {
            assert_eq!(Function::parse(function.name()), Some(function));
        }
        assert_eq!(Function::three(0x1e).name(), "f3_1e");
    }

    #[test]
    fn dependence_is_on_the_inputs_that_matter() {
        assert_eq!(Function::NOT.arity(), 1);
        assert!(Function::NOT.depends_on(0) && !Function::NOT.depends_on(1));
        assert!(Function::BUF_B.depends_on(1) && !Function::BUF_B.depends_on(0));
        assert_eq!(Function::XOR.arity(), 2);
        assert_eq!(Function::ONE.arity(), 0);
    }

    fn at(function: Function, [a, b, c]: [bool; 3]) -> bool {
        function.row(usize::from(a) * 4 + usize::from(b) * 2 + usize::from(c))
    }

    #[test]
    fn functions_of_three_inputs_are_those_of_their_names() {
        for row in 0..8usize {
            let inputs = [row & 4 > 0, row & 2 > 0, row & 1 > 0];
            let [a, b, c] = inputs;
            let check = |name: &str, expected: bool| {
                assert_eq!(at(Function::parse(name).unwrap(), inputs), expected, "{name} at {row}");
            };
            check("maj", row.count_ones() >= 2);
            check("minority", row.count_ones() < 2);
            check("mux", if a { b } else { c });
            check("muxi", if a { !b } else { !c });
            check("and_or", a && b || c);
            check("and_or_invert", !(a && b || c));
            check("or_and", (a || b) && c);
            check("or_and_invert", !((a || b) && c));
            check("and3", a && b && c);
            check("nor3", !(a || b || c));
            check("xor3", a ^ b ^ c);
            check("one_hot", row.count_ones() == 1);
            check("all_equal", a == b && b == c);
            check("gamble", !(a == b && b == c));
            for function in Function::all_of(3) {
                assert_eq!(at(function.permuted(&[2, 0, 1]), inputs), at(function, [b, c, a]));
                assert_eq!(at(function.with_input_inverted(1), [a, !b, c]), at(function, inputs));
                assert_eq!((0..3).map(|i| function.input_at(i, row)).collect::<Vec<_>>(), inputs);
            }
        }
        assert!(
            Function::MUX.arity() == 3 && Function::three(0xc0).arity() == 2 && !Function::three(0xc0).depends_on(2)
        );
    }

    #[test]
    fn there_are_four_classes_of_two_inputs_and_fourteen_of_three() {
        for (inputs, expected) in [(2, 4), (3, 14)] {
            let mut classes: Vec<Vec<Function>> = Function::all_of(inputs).map(Function::class).collect();
            classes.sort();
            classes.dedup();
            assert_eq!(classes.len(), expected);
            assert_eq!(classes.iter().map(Vec::len).sum::<usize>(), Function::all_of(inputs).count());
        }
        assert_eq!(Function::XOR3.class().len(), 2);
        let arranged: Vec<Function> =
            Function::all_of(3).filter(|one| one.arity() == 3 && one.arranged() == *one).collect();
        assert!(arranged.len() == 68 && arranged.contains(&Function::MUX), "{}", arranged.len());
    }
}
