//! Circuits as checked source: names resolved, widths not yet computed. Expressions and sizes lie in arenas, children before parents,
//! so that no depth of nesting needs a deep stack.

use std::fmt;

use crate::source::Span;

/// A declared circuit.
#[derive(Clone, Debug, PartialEq)]
pub struct Circuit {
    /// The name.
    pub name: String,
    /// Where the name stands in the declaration.
    pub span: Span,
    /// The width parameters; their slots are the first variables.
    pub parameters: Vec<Parameter>,
    /// Every net: the input ports, the output ports, then those of the body.
    pub nets: Vec<Net>,
    /// How many of the nets are input ports.
    pub inputs: usize,
    /// How many of the nets, after the inputs, are output ports.
    pub outputs: usize,
    /// The integers of the body.
    pub sizes: Vec<Size>,
    /// The expressions of the body.
    pub expressions: Vec<Expression>,
    /// The truth tables of the body.
    pub tables: Vec<Table>,
    /// The body.
    pub body: Block,
    /// Integer slots: parameters, then loop variables.
    pub variables: usize,
}

impl Circuit {
    /// The first expression of the run that `root` ends: all parts of `root` lie in it, children before parents.
    pub fn first_leaf(&self, root: ExpressionId) -> ExpressionId {
        let mut at = root;
        while let Some(first) = self.expressions[at.0 as usize].first_part() {
            at = first;
        }
        at
    }
}

/// The place of an expression in [`Circuit::expressions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ExpressionId(pub u32);

/// The place of an integer in [`Circuit::sizes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SizeId(pub u32);

/// The place of a net in [`Circuit::nets`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NetSlot(pub u32);

/// The place of a circuit in [`super::Program::circuits`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CircuitId(pub u32);

/// A width parameter: an integer known when the circuit is built.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The name.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// Its value where a use gives none; an integer over the parameters before it.
    pub default: Option<SizeId>,
}

/// A net of a circuit.
#[derive(Clone, Debug, PartialEq)]
pub struct Net {
    /// The name.
    pub name: String,
    /// Where it is declared, or first driven.
    pub span: Span,
    /// The declared width in bits; `None` is one bit for a port, and the width of the driver for another net.
    pub width: Option<SizeId>,
}

/// Statements with the nets that belong to them; the body of a `for` has its own nets in each turn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// Nets that belong to this block, as a range of slots.
    pub nets: std::ops::Range<u32>,
    /// The statements in order of text; the order has no meaning.
    pub statements: Vec<Statement>,
}

/// One statement of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// Targets and what drives them.
    Drive {
        /// What is driven; more than one only for a call of a circuit with as many outputs.
        targets: Vec<Target>,
        /// What drives it.
        value: ExpressionId,
    },
    /// Statements repeated for each value of a variable.
    For {
        /// The variable's slot.
        variable: u32,
        /// Its first value.
        from: SizeId,
        /// One more than its last value.
        to: SizeId,
        /// Where the range stands.
        span: Span,
        /// What is repeated.
        body: Block,
    },
}

/// The left side of a statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The net; `None` drops the value (`_`).
    pub net: Option<NetSlot>,
    /// The bits driven, highest and lowest; `None` is the whole net.
    pub bits: Option<(SizeId, SizeId)>,
    /// The value before the first cycle.
    pub start: Option<SizeId>,
    /// Where it stands.
    pub span: Span,
}

/// An integer known when the circuit is built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// What it is.
    pub kind: SizeKind,
    /// Where it stands.
    pub span: Span,
}

/// What an integer is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SizeKind {
    /// A literal.
    Literal(i64),
    /// A parameter or loop variable, by slot.
    Variable(u32),
    /// The least number of bits that tell that many things apart.
    Log2(SizeId),
    /// An operation on two integers.
    Binary(SizeOperator, SizeId, SizeId),
}

/// An operation on integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SizeOperator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`, rounded down
    Divide,
    /// `%`
    Remainder,
    /// `**`
    Power,
}

/// An expression with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    /// What it is.
    pub kind: ExpressionKind,
    /// Where it stands.
    pub span: Span,
}

impl Expression {
    /// The first of the expressions it is made of.
    fn first_part(&self) -> Option<ExpressionId> {
        match &self.kind {
            ExpressionKind::Bits(_) | ExpressionKind::Number { .. } | ExpressionKind::Computed { .. } => None,
            ExpressionKind::Net(_) | ExpressionKind::Slice { .. } => None,
            ExpressionKind::Repetition { value, .. } => Some(*value),
            ExpressionKind::Choice { condition, .. } => Some(*condition),
            ExpressionKind::Concatenation(parts)
            | ExpressionKind::Operation { operands: parts, .. }
            | ExpressionKind::Call { operands: parts, .. }
            | ExpressionKind::Table { inputs: parts, .. } => parts.first().copied(),
        }
    }
}

/// What an expression is.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpressionKind {
    /// A bit pattern, most significant bit first.
    Bits(Vec<bool>),
    /// A number in a given width.
    Number {
        /// The width in bits.
        width: SizeId,
        /// The value.
        value: u128,
    },
    /// A computed number in a given width.
    Computed {
        /// The width in bits.
        width: SizeId,
        /// The value.
        value: SizeId,
    },
    /// A whole net.
    Net(NetSlot),
    /// Bits of a net, from the highest to the lowest, both included.
    Slice {
        /// The net.
        net: NetSlot,
        /// The highest bit.
        high: SizeId,
        /// The lowest bit.
        low: SizeId,
    },
    /// Values side by side, most significant first.
    Concatenation(Vec<ExpressionId>),
    /// A value side by side with itself.
    Repetition {
        /// How often.
        count: SizeId,
        /// The value.
        value: ExpressionId,
    },
    /// A bitwise operation on operands of one width.
    Operation {
        /// Which.
        operator: Operator,
        /// The operands: one for `not`, two or more for the others.
        operands: Vec<ExpressionId>,
    },
    /// One of two values of one width, by a bit.
    Choice {
        /// The bit.
        condition: ExpressionId,
        /// The value at 1.
        then: ExpressionId,
        /// The value at 0.
        otherwise: ExpressionId,
    },
    /// A circuit used as a function.
    Call {
        /// The circuit.
        circuit: CircuitId,
        /// The parameters given, in the circuit's order; `None` where the widths of the operands tell, or the default.
        arguments: Vec<Option<SizeId>>,
        /// The operands, one for each input port.
        operands: Vec<ExpressionId>,
    },
    /// A truth table over the bits of the inputs.
    Table {
        /// The inputs, most significant first.
        inputs: Vec<ExpressionId>,
        /// The place in [`Circuit::tables`].
        table: usize,
    },
}

/// A bitwise operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Operator {
    /// The opposite.
    Not,
    /// All.
    And,
    /// At least one.
    Or,
    /// An odd number.
    Xor,
    /// Not all.
    Nand,
    /// None.
    Nor,
    /// Two that are equal.
    Xnor,
}

impl Operator {
    /// All, in the order of precedence of the manual.
    pub const ALL: [Self; 7] = [Self::Not, Self::And, Self::Nand, Self::Xor, Self::Xnor, Self::Or, Self::Nor];

    /// The keyword.
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

    /// The operation of that keyword.
    pub fn parse(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|operator| operator.word() == word)
    }
}

impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.word())
    }
}

/// A truth table as written.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The rows.
    pub rows: Vec<TableRow>,
    /// The output of the patterns that no row names.
    pub otherwise: Option<TableOutput>,
    /// Where the table stands.
    pub span: Span,
}

/// One row of a truth table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableRow {
    /// The pattern, most significant bit first; `None` matches both values.
    pub pattern: Vec<Option<bool>>,
    /// Where the pattern stands.
    pub span: Span,
    /// The output.
    pub output: TableOutput,
}

/// The output of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct TableOutput {
    /// Most significant bit first; `None` leaves the bit to the compiler.
    pub bits: Vec<Option<bool>>,
    /// Where it stands.
    pub span: Span,
}

/// A circuit with values for its parameters.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Instance {
    /// The circuit's name.
    pub circuit: String,
    /// The parameters in order; those that are missing at the end have their default.
    pub arguments: Vec<u64>,
}

impl From<&str> for Instance {
    /// A circuit without parameters, or with all defaults.
    fn from(circuit: &str) -> Self {
        Self { circuit: circuit.to_owned(), arguments: Vec::new() }
    }
}

impl fmt::Display for Instance {
    /// As it is written: `adder[4]`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.arguments.is_empty() {
            return f.pad(&self.circuit);
        }
        let arguments: Vec<_> = self.arguments.iter().map(u64::to_string).collect();
        f.pad(&format!("{}[{}]", self.circuit, arguments.join(", ")))
    }
}

impl SizeOperator {
    /// All, with their signs.
    pub const SIGNS: [(Self, &'static str); 6] = [
        (Self::Add, "+"),
        (Self::Subtract, "-"),
        (Self::Multiply, "*"),
        (Self::Divide, "/"),
        (Self::Remainder, "%"),
        (Self::Power, "**"),
    ];

    /// The sign.
    pub fn sign(self) -> &'static str {
        Self::SIGNS.iter().find(|(operator, _)| *operator == self).expect("every operator has a sign").1
    }

    /// The operation of that sign.
    pub fn parse(sign: &str) -> Option<Self> {
        Self::SIGNS.iter().find(|(_, known)| *known == sign).map(|(operator, _)| *operator)
    }

    /// How tightly it binds: 1 loosest.
    pub fn precedence(self) -> u8 {
        match self {
            Self::Add | Self::Subtract => 1,
            Self::Multiply | Self::Divide | Self::Remainder => 2,
            Self::Power => 3,
        }
    }
}
