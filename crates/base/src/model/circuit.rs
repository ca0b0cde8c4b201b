//! Circuits as checked source: names are resolved, widths not yet computed. Expressions and sizes are stored in arenas,
//! children before parents, so that deep nesting needs no deep stack.

use std::fmt;

use crate::source::Span;

/// A declared circuit: its ports and parameters, and a body of statements.
#[derive(Clone, Debug, PartialEq)]
pub struct Circuit {
    /// The name as written; unique among the circuits of a program.
    pub name: String,
    /// The place of the name in the declaration.
    pub span: Span,
    /// The width parameters; their slots are the first variables.
    pub parameters: Vec<Parameter>,
    /// Every net: the input ports, the output ports, then those of the body.
    pub nets: Vec<Net>,
    /// The number of input ports among the nets.
    pub inputs: usize,
    /// The number of output ports; they follow the inputs.
    pub outputs: usize,
    /// The integers of the body.
    pub sizes: Vec<Size>,
    /// The expressions of the body.
    pub expressions: Vec<Expression>,
    /// The truth tables of the body.
    pub tables: Vec<Table>,
    /// The statements between the braces, with the nets declared there.
    pub body: Block,
    /// The number of integer slots: parameters, then loop variables.
    pub variables: usize,
}

impl Circuit {
    /// The first expression of the range that ends with `root`. The range contains all parts of `root`, children before
    /// parents.
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
    /// The name as written; sizes refer to it.
    pub name: String,
    /// The place of the declaration.
    pub span: Span,
    /// The default value: an integer over the parameters before it.
    pub default: Option<SizeId>,
}

/// A net of a circuit.
#[derive(Clone, Debug, PartialEq)]
pub struct Net {
    /// The name as written; unique in its circuit.
    pub name: String,
    /// The place of the declaration or of the first driver.
    pub span: Span,
    /// The declared width in bits. `None` means one bit for a port, and the width of the driver for another net.
    pub width: Option<SizeId>,
}

/// Statements with their nets; the body of a `for` has its own nets in each iteration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// The nets of this block, as a range of slots.
    pub nets: std::ops::Range<u32>,
    /// The statements in order of text; their order does not matter.
    pub statements: Vec<Statement>,
}

/// One statement of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// Targets and their driver.
    Drive {
        /// The targets; several only for a call of a circuit with the same number of outputs.
        targets: Vec<Target>,
        /// The driver.
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
        /// The place of the range.
        span: Span,
        /// The repeated statements.
        body: Block,
    },
}

/// The left side of a statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The net; `None` discards the value (`_`).
    pub net: Option<NetSlot>,
    /// The bits driven, highest and lowest; `None` is the whole net.
    pub bits: Option<(SizeId, SizeId)>,
    /// The value before the first cycle (`init`), if it is given.
    pub start: Option<SizeId>,
    /// The place of the target in the source.
    pub span: Span,
}

/// An integer known when the circuit is built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// A literal, a variable or an operation.
    pub kind: SizeKind,
    /// The place of the integer in the source.
    pub span: Span,
}

/// What an integer is: a number, a variable, or an operation on others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SizeKind {
    /// A number as written.
    Literal(i64),
    /// A parameter or loop variable, by slot.
    Variable(u32),
    /// The number of bits needed for that many different values.
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
    /// What is computed, and from which other expressions.
    pub kind: ExpressionKind,
    /// The place of the expression in the source.
    pub span: Span,
}

impl Expression {
    /// The first of its parts.
    fn first_part(&self) -> Option<ExpressionId> {
        match &self.kind {
            ExpressionKind::Bits(_) | ExpressionKind::Number { .. } | ExpressionKind::Computed { .. } => None,
            ExpressionKind::Net(_) | ExpressionKind::Slice { .. } => None,
            ExpressionKind::Repetition { value, .. } => Some(*value),
            ExpressionKind::Choice { condition, .. } => Some(*condition),
            ExpressionKind::Concatenation(parts)
            | ExpressionKind::Operation { operands: parts, .. }
            | ExpressionKind::Call { operands: parts, .. } => parts.first().copied(),
            ExpressionKind::Table { inputs, outputs, .. } => inputs.first().or(outputs.first()).copied(),
        }
    }
}

/// What an expression is: a constant, a net, or what is made of other expressions.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpressionKind {
    /// A bit pattern, most significant bit first.
    Bits(Vec<bool>),
    /// A number in a given width.
    Number {
        /// The width in bits.
        width: SizeId,
        /// An unsigned number that fits into the width.
        value: u128,
    },
    /// A computed number in a given width.
    Computed {
        /// The width in bits.
        width: SizeId,
        /// The integer; that it fits into the width is checked when the circuit is built.
        value: SizeId,
    },
    /// A whole net.
    Net(NetSlot),
    /// Bits of a net, from the highest to the lowest, including both.
    Slice {
        /// The net whose bits are taken.
        net: NetSlot,
        /// The highest bit.
        high: SizeId,
        /// The lowest bit.
        low: SizeId,
    },
    /// Concatenated values, most significant first.
    Concatenation(Vec<ExpressionId>),
    /// A value repeated.
    Repetition {
        /// The number of repetitions.
        count: SizeId,
        /// What is repeated.
        value: ExpressionId,
    },
    /// A bitwise operation on operands of one width.
    Operation {
        /// The operation.
        operator: Operator,
        /// The operands: one for `not`, two or more for the others.
        operands: Vec<ExpressionId>,
    },
    /// A choice between two values of the same width by a bit.
    Choice {
        /// A value of one bit.
        condition: ExpressionId,
        /// The value if it is 1.
        then: ExpressionId,
        /// The value if it is 0.
        otherwise: ExpressionId,
    },
    /// A call of a circuit.
    Call {
        /// The declared circuit of which the call makes an instance.
        circuit: CircuitId,
        /// The parameters, in the circuit's order; `None` to infer it from the widths of the operands or use the
        /// default.
        arguments: Vec<Option<SizeId>>,
        /// The operands, one for each input port.
        operands: Vec<ExpressionId>,
    },
    /// A truth table over the bits of the inputs.
    Table {
        /// The inputs, most significant first.
        inputs: Vec<ExpressionId>,
        /// The outputs that are expressions.
        outputs: Vec<ExpressionId>,
        /// The index in [`Circuit::tables`].
        table: usize,
    },
}

/// An operation on each bit of values of one width.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Operator {
    /// `not`
    Not,
    /// `and`
    And,
    /// `or`
    Or,
    /// `xor`
    Xor,
    /// `nand`
    Nand,
    /// `nor`
    Nor,
    /// `xnor`
    Xnor,
}

impl Operator {
    /// All, in the order of precedence of the manual.
    pub const ALL: [Self; 7] = [Self::Not, Self::And, Self::Nand, Self::Xor, Self::Xnor, Self::Or, Self::Nor];

    /// The keyword of the language for it.
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

    /// The operation for a keyword.
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
    /// In the order of the source. No two patterns match the same inputs.
    pub rows: Vec<TableRow>,
    /// The output for the patterns without a row.
    pub otherwise: Option<TableOutput>,
    /// The place of the table.
    pub span: Span,
}

impl Table {
    /// The output of each row, and then the one of the other patterns.
    pub fn outputs(&self) -> impl Iterator<Item = &TableOutput> {
        self.rows.iter().map(|row| &row.output).chain(&self.otherwise)
    }
}

/// One row of a truth table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableRow {
    /// The pattern, most significant bit first; `None` matches both values.
    pub pattern: Vec<Option<bool>>,
    /// The place of the pattern.
    pub span: Span,
    /// What the table shows for these inputs.
    pub output: TableOutput,
}

/// The output of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct TableOutput {
    /// One bit for each output, or a value that is computed.
    pub value: OutputValue,
    /// The place of the output in the source.
    pub span: Span,
}

/// The value of an output.
#[derive(Clone, Debug, PartialEq)]
pub enum OutputValue {
    /// Most significant bit first; the compiler chooses a bit that is `None`.
    Bits(Vec<Option<bool>>),
    /// This one of the expressions of the table.
    Expression(usize),
}

/// A circuit with values for its parameters.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Instance {
    /// The name of the circuit.
    pub circuit: String,
    /// The parameters in order; missing ones at the end have their defaults.
    pub arguments: Vec<u64>,
}

impl From<&str> for Instance {
    /// A circuit without parameters, or with all defaults.
    fn from(circuit: &str) -> Self {
        Self { circuit: circuit.to_owned(), arguments: Vec::new() }
    }
}

impl fmt::Display for Instance {
    /// The notation of the language: `adder[4]`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.arguments.is_empty() {
            return f.pad(&self.circuit);
        }
        let arguments: Vec<_> = self.arguments.iter().map(u64::to_string).collect();
        f.pad(&format!("{}[{}]", self.circuit, arguments.join(", ")))
    }
}

impl SizeOperator {
    /// All operations, each with its symbol in the language.
    pub const SIGNS: [(Self, &'static str); 6] = [
        (Self::Add, "+"),
        (Self::Subtract, "-"),
        (Self::Multiply, "*"),
        (Self::Divide, "/"),
        (Self::Remainder, "%"),
        (Self::Power, "**"),
    ];

    /// The symbol of the language for it.
    pub fn sign(self) -> &'static str {
        Self::SIGNS.iter().find(|(operator, _)| *operator == self).expect("every operator has a sign").1
    }

    /// The operation with that symbol, if there is one.
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
