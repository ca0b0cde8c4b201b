//! Circuits as checked source: names are resolved, widths not yet computed. Expressions and sizes are stored in arenas,
//! children before parents, so that deep nesting needs no deep stack.

use std::fmt;

use serde::Serialize;

use super::{Forcing, Function, RegisterKind, Table};
use crate::source::Span;

#[derive(Clone, Debug, PartialEq)]
pub struct Circuit {
    pub name: String,
    pub span: Span,
    /// The width parameters; their slots are the first variables.
    pub parameters: Vec<Parameter>,
    /// Every net: the input ports, the output ports, then those of the body.
    pub nets: Vec<Net>,
    pub inputs: usize,
    pub outputs: usize,
    pub sizes: Vec<Size>,
    pub expressions: Vec<Expression>,
    pub tables: Vec<Table>,
    pub body: Block,
    /// The number of integer slots: parameters, then loop variables and integers with names.
    pub variables: usize,
    pub memories: Vec<MemoryArray>,
    /// The body of a circuit of another tool's file: its bits, from the first output on.
    pub bits: Vec<DrivenBit>,
}

/// A bit of a net, and its value before the first cycle if it is state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrivenBit {
    pub driver: BitDriver,
    pub start: Option<bool>,
}

/// What drives a bit. Bits 0 and 1 are the constants; then come those of the nets, the lowest bit of a net first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BitDriver {
    Bit(u32),
    Gate(Function, [u32; 2]),
    /// Its data, its clock, a set and a reset.
    Register(RegisterKind, Forcing, [u32; 4]),
}

impl DrivenBit {
    pub const CONSTANTS: u32 = 2;
}

/// A memory of an environment: an array that is no net, with nets for each access.
#[derive(Clone, Debug, PartialEq)]
pub struct MemoryArray {
    /// The net that gives it its name; it has no bits.
    pub net: NetSlot,
    pub words: SizeId,
    pub width: SizeId,
    pub contents: Option<usize>,
    pub reads: Vec<MemoryRead>,
    pub writes: Vec<MemoryWrite>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryRead {
    pub address: NetSlot,
    pub data: NetSlot,
}

/// A write: when the clock rises, the word at the address takes the data if it is enabled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryWrite {
    pub address: NetSlot,
    pub data: NetSlot,
    pub enable: NetSlot,
    pub clk: NetSlot,
}

impl Circuit {
    /// The first expression of the contiguous range that ends with `root`, children before parents.
    pub fn first_leaf(&self, root: ExpressionId) -> ExpressionId {
        let mut at = root;
        while let Some(first) = self.expressions[at.0 as usize].first_part() {
            at = first;
        }
        at
    }

    pub fn each_span(&mut self, visit: &mut dyn FnMut(&mut Span)) {
        visit(&mut self.span);
        self.parameters.iter_mut().for_each(|parameter| visit(&mut parameter.span));
        self.nets.iter_mut().for_each(|net| visit(&mut net.span));
        self.sizes.iter_mut().for_each(|size| visit(&mut size.span));
        self.expressions.iter_mut().for_each(|expression| visit(&mut expression.span));
        for table in &mut self.tables {
            visit(&mut table.span);
            table.rows.iter_mut().for_each(|row| visit(&mut row.span));
            let rows = table.rows.iter_mut().map(|row| &mut row.output);
            rows.chain(&mut table.otherwise).for_each(|output| visit(&mut output.span));
        }
        self.body.each_span(visit);
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ExpressionId(pub u32);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SizeId(pub u32);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NetSlot(pub u32);

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CircuitId(pub u32);

#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    pub name: String,
    pub span: Span,
    /// The default value: an integer over the parameters before it.
    pub default: Option<SizeId>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Net {
    pub name: String,
    pub span: Span,
    /// The declared width in bits; of an array, that of a word. `None` means one bit for a port, and the width of the
    /// driver for another net.
    pub width: Option<SizeId>,
    /// The number of words of an array, of which word 0 has the lowest bits.
    pub words: Option<SizeId>,
    /// The value of an input port that a call leaves out, if it may.
    pub default: Option<SizeId>,
    /// The enumeration whose members the values are, as its place in [`super::Program::enumerations`].
    pub members: Option<usize>,
    /// The array of which its values select a word, to write it; of a memory, also to read it.
    pub selects: Option<NetSlot>,
    /// Whether it writes text: an output of an environment, whose highest bit says whether the others are a character.
    pub is_text: bool,
}

/// Statements with their nets; the body of a `for` has its own nets in each iteration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    pub nets: std::ops::Range<u32>,
    /// The statements in order of text; their order does not matter.
    pub statements: Vec<Statement>,
}

impl Block {
    fn each_span(&mut self, visit: &mut dyn FnMut(&mut Span)) {
        for statement in &mut self.statements {
            match statement {
                Statement::Drive { targets, .. } => targets.iter_mut().for_each(|target| visit(&mut target.span)),
                Statement::For { span, body, .. } => {
                    visit(span);
                    body.each_span(visit);
                }
                Statement::If { then, otherwise, .. } => {
                    [then, otherwise].into_iter().for_each(|block| block.each_span(visit));
                }
                Statement::Scope(block) => block.each_span(visit),
                Statement::Let { .. } => {}
            }
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    Drive {
        targets: Vec<Target>,
        /// Whether they are the parts of one value, the highest first. Otherwise several are the outputs of a call.
        joined: bool,
        value: ExpressionId,
    },
    For {
        variable: u32,
        from: SizeId,
        /// One more than its last value.
        to: SizeId,
        span: Span,
        body: Block,
    },
    If {
        condition: Condition,
        then: Block,
        otherwise: Block,
    },
    Scope(Block),
    Let {
        variable: u32,
        value: SizeId,
    },
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    pub left: SizeId,
    pub comparison: Relation,
    pub right: SizeId,
}

/// How one number compares with another: integers when a circuit is built, or the values of nets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    Equal,
    NotEqual,
    Less,
    Greater,
    AtMost,
    AtLeast,
}

impl Relation {
    pub const SIGNS: [(Self, &'static str); 6] = [
        (Self::Equal, "=="),
        (Self::NotEqual, "!="),
        (Self::Less, "<"),
        (Self::Greater, ">"),
        (Self::AtMost, "<="),
        (Self::AtLeast, ">="),
    ];

    pub fn sign(self) -> &'static str {
        Self::SIGNS.iter().find(|(comparison, _)| *comparison == self).expect("every comparison has a sign").1
    }

    pub fn parse(sign: &str) -> Option<Self> {
        Self::SIGNS.iter().find(|(_, known)| *known == sign).map(|(comparison, _)| *comparison)
    }

    pub fn holds<T: Ord>(self, left: &T, right: &T) -> bool {
        match self {
            Self::Equal => left == right,
            Self::NotEqual => left != right,
            Self::Less => left < right,
            Self::Greater => left > right,
            Self::AtMost => left <= right,
            Self::AtLeast => left >= right,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The net; `None` discards the value (`_`).
    pub net: Option<NetSlot>,
    /// The word driven, if the net is an array; `None` is all of it.
    pub word: Option<SizeId>,
    pub bits: Option<(SizeId, SizeId)>,
    pub start: Option<SizeId>,
    pub span: Span,
}

/// An integer known when the circuit is built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    pub kind: SizeKind,
    pub span: Span,
}

impl Size {
    /// The first integer of the contiguous range that ends with `root`, children before parents.
    pub fn first_part(sizes: &[Self], root: SizeId) -> SizeId {
        let mut at = root;
        loop {
            at = match sizes[at.0 as usize].kind {
                SizeKind::Literal(_) | SizeKind::Variable(_) => return at,
                SizeKind::Log2(inner) | SizeKind::Binary(_, inner, _) => inner,
            };
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SizeKind {
    Literal(i128),
    /// A parameter or loop variable, by slot.
    Variable(u32),
    Log2(SizeId),
    Binary(SizeOperator, SizeId, SizeId),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SizeOperator {
    Add,
    Subtract,
    Multiply,
    /// `/`, rounded down
    Divide,
    Remainder,
    Power,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    pub kind: ExpressionKind,
    pub span: Span,
}

impl Expression {
    fn first_part(&self) -> Option<ExpressionId> {
        match &self.kind {
            ExpressionKind::Bits(_) | ExpressionKind::Number { .. } | ExpressionKind::Computed { .. } => None,
            ExpressionKind::Unsized(_) | ExpressionKind::Net(_) | ExpressionKind::Slice { .. } => None,
            ExpressionKind::Repetition { value, .. } => Some(*value),
            ExpressionKind::Element { index, .. } => Some(*index),
            ExpressionKind::Choice { condition, .. } => Some(*condition),
            ExpressionKind::Concatenation(parts) | ExpressionKind::Operation { operands: parts, .. } => {
                parts.first().copied()
            }
            // Operands with names may stand in any order.
            ExpressionKind::Call { operands, .. } => operands.iter().flatten().min().copied(),
            ExpressionKind::Table { inputs, outputs, .. } => inputs.first().or(outputs.first()).copied(),
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub enum ExpressionKind {
    /// A bit pattern, most significant bit first.
    Bits(Vec<bool>),
    Number {
        width: SizeId,
        value: u128,
    },
    Computed {
        width: SizeId,
        /// The integer; that it fits into the width is checked when the circuit is built.
        value: SizeId,
    },
    /// A number as wide as its context needs.
    Unsized(FreeNumber),
    Net(NetSlot),
    /// A word of an array, bits of a net from the highest to the lowest, including both, or such bits of a word.
    Slice {
        net: NetSlot,
        word: Option<SizeId>,
        bits: Option<(SizeId, SizeId)>,
    },
    Element {
        net: NetSlot,
        index: ExpressionId,
        bits: Option<(SizeId, SizeId)>,
    },
    /// Concatenated values, most significant first.
    Concatenation(Vec<ExpressionId>),
    Repetition {
        count: SizeId,
        value: ExpressionId,
    },
    Operation {
        operator: Operator,
        operands: Vec<ExpressionId>,
    },
    Choice {
        condition: ExpressionId,
        then: ExpressionId,
        otherwise: ExpressionId,
    },
    Call {
        circuit: CircuitId,
        /// The parameters, in the circuit's order; `None` to infer it from the widths of the operands or use the
        /// default.
        arguments: Vec<Option<SizeId>>,
        /// The operands, one for each input port; `None` to use the default.
        operands: Vec<Option<ExpressionId>>,
    },
    Table {
        /// The inputs, most significant first.
        inputs: Vec<ExpressionId>,
        outputs: Vec<ExpressionId>,
        /// The index in [`Circuit::tables`].
        table: usize,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FreeNumber {
    Literal(u128),
    Size(SizeId),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Operator {
    Not,
    And,
    Or,
    Xor,
    Nand,
    Nor,
    Xnor,
}

impl Operator {
    /// All, in the order of precedence of the manual.
    pub const ALL: [Self; 7] = [Self::Not, Self::And, Self::Nand, Self::Xor, Self::Xnor, Self::Or, Self::Nor];

    pub fn word(self) -> &'static str {
        match self {
            Self::Not => "not",
            Self::And => "and",
            Self::Or => "or",
            Self::Xor => "xor",
            Self::Nand => "nand",
            Self::Nor => "nor",
            Self::Xnor => "xnor",
        }
    }

    pub fn parse(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|operator| operator.word() == word)
    }
}

impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.word())
    }
}

/// A circuit with values for its parameters.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "String", inline))]
#[serde(into = "String")]
pub struct Instance {
    pub circuit: String,
    /// The parameters in order; missing ones at the end have their defaults.
    pub arguments: Vec<u64>,
}

impl From<&str> for Instance {
    fn from(circuit: &str) -> Self {
        Self { circuit: circuit.to_owned(), arguments: Vec::new() }
    }
}

impl From<Instance> for String {
    fn from(instance: Instance) -> Self {
        instance.to_string()
    }
}

impl fmt::Display for Instance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.arguments.is_empty() {
            return f.pad(&self.circuit);
        }
        let arguments: Vec<_> = self.arguments.iter().map(u64::to_string).collect();
        f.pad(&format!("{}[{}]", self.circuit, arguments.join(", ")))
    }
}

impl SizeKind {
    /// The number of bits needed for `things` different values; zero for one value.
    pub fn log2(things: i128) -> i128 {
        if things <= 1 { 0 } else { i128::from(i128::BITS - (things - 1).leading_zeros()) }
    }
}

impl SizeOperator {
    pub fn apply(self, left: i128, right: i128) -> Option<i128> {
        match self {
            Self::Add => left.checked_add(right),
            Self::Subtract => left.checked_sub(right),
            Self::Multiply => left.checked_mul(right),
            Self::Divide => left.checked_div_euclid(right),
            Self::Remainder => left.checked_rem_euclid(right),
            Self::Power => left.checked_pow(u32::try_from(right).ok()?),
        }
    }

    pub const SIGNS: [(Self, &'static str); 6] = [
        (Self::Add, "+"),
        (Self::Subtract, "-"),
        (Self::Multiply, "*"),
        (Self::Divide, "/"),
        (Self::Remainder, "%"),
        (Self::Power, "**"),
    ];

    pub fn sign(self) -> &'static str {
        Self::SIGNS.iter().find(|(operator, _)| *operator == self).expect("every operator has a sign").1
    }

    pub fn parse(sign: &str) -> Option<Self> {
        Self::SIGNS.iter().find(|(_, known)| *known == sign).map(|(operator, _)| *operator)
    }

    /// The precedence: 1 is the loosest.
    pub fn precedence(self) -> u8 {
        match self {
            Self::Add | Self::Subtract => 1,
            Self::Multiply | Self::Divide | Self::Remainder => 2,
            Self::Power => 3,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn log2_is_the_number_of_bits_for_that_many_values() {
        assert_eq!([0, 1, 2, 3, 4, 5, 8, 9].map(SizeKind::log2), [0, 0, 1, 2, 2, 3, 3, 4]);
    }

    #[test]
    fn overflow_and_division_by_zero_have_no_value() {
        assert_eq!(SizeOperator::Divide.apply(1, 0), None);
        assert_eq!(SizeOperator::Power.apply(2, 127), None);
        assert_eq!(SizeOperator::Power.apply(2, -1), None);
        assert_eq!(SizeOperator::Subtract.apply(3, 5), Some(-2));
    }
}
