//! Expressions, the rows of tables in them, and operators, as written.

use nbc_base::model::Relation;
use nbc_base::source::Span;

use crate::syntax::tree::{Argument, ExpressionSyntaxId, Index, NameSyntax, SizeSyntaxId};

/// An expression with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionSyntax {
    /// A literal, a net, a call or another form.
    pub kind: ExpressionSyntaxKind,
    /// The place of the expression in the source.
    pub span: Span,
}

/// An expression: a constant, a net, or what is made of other expressions.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpressionSyntaxKind {
    /// Digits without a width.
    Digits(String),
    /// `4'b1010`
    Constant {
        /// The width: a literal or a parameter.
        width: SizeSyntaxId,
        /// `b`, `d` or `h`.
        base: char,
        /// The digits in that base.
        digits: String,
    },
    /// `n'd(i + 1)`
    Computed {
        /// The width: a literal or a parameter.
        width: SizeSyntaxId,
        /// The integer before it gets its width.
        value: SizeSyntaxId,
    },
    /// `a`, `a[3]`, `a[3..0]`
    Net {
        /// The net whose bits are taken.
        name: NameSyntax,
        /// The bits or the word, if not the whole net is read.
        index: Option<Index>,
        /// The bits of the word.
        second: Option<Index>,
    },
    /// `add[8](a, b)`
    Call {
        /// The circuit.
        name: NameSyntax,
        /// The parameters given.
        arguments: Vec<Argument>,
        /// The operands between the parentheses.
        operands: Vec<OperandSyntax>,
    },
    /// `(a)`
    Group(ExpressionSyntaxId),
    /// `{a, b}`
    Concatenation(Vec<ExpressionSyntaxId>),
    /// `{4{a, b}}`
    Repetition {
        /// The number of repetitions.
        count: SizeSyntaxId,
        /// The repeated value.
        values: Vec<ExpressionSyntaxId>,
    },
    /// `not a`
    Not(ExpressionSyntaxId),
    /// `a and b`
    Infix {
        /// The word or sign between the operands.
        operator: Infix,
        /// The place of the operator.
        place: Span,
        /// The left operand.
        left: ExpressionSyntaxId,
        /// The right operand.
        right: ExpressionSyntaxId,
    },
    /// `nand(a, b, c)`
    Operation {
        /// The operation.
        operator: nbc_base::model::Operator,
        /// The expressions between the operators.
        operands: Vec<ExpressionSyntaxId>,
    },
    /// `if c then a else b`
    Choice {
        /// The expression after `if`.
        condition: ExpressionSyntaxId,
        /// The value if it is 1.
        then: ExpressionSyntaxId,
        /// The value if it is 0.
        otherwise: ExpressionSyntaxId,
    },
    /// `table(a, b) { 00: 1, else: 0 }` or `match a { 0: 1, else: 0 }`
    Table {
        /// Whether it is written with `match`, which has one input.
        is_match: bool,
        /// The expressions whose bits select the row.
        inputs: Vec<ExpressionSyntaxId>,
        /// The rows in order of text.
        rows: Vec<TableRowSyntax>,
    },
}

/// An operand of a call: `a` or `enable: a`
#[derive(Clone, Debug, PartialEq)]
pub struct OperandSyntax {
    /// The port, if it is named.
    pub name: Option<NameSyntax>,
    /// The value for it.
    pub value: ExpressionSyntaxId,
}

/// `0-1: 1`, `load or store: 1` or `else: 0`
#[derive(Clone, Debug, PartialEq)]
pub struct TableRowSyntax {
    /// The patterns; none is `else`.
    pub patterns: Vec<NameSyntax>,
    /// What the row shows.
    pub output: TableOutputSyntax,
    /// The place of the row.
    pub span: Span,
}

/// The output of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum TableOutputSyntax {
    /// `0-1`
    Bits(NameSyntax),
    /// The value of an expression.
    Value(ExpressionSyntaxId),
}

/// The operators between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Infix {
    /// A bitwise operation.
    Bitwise(nbc_base::model::Operator),
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `<<`
    ShiftLeft,
    /// `>>`
    ShiftRight,
    /// A comparison.
    Compare(Relation),
}

impl Infix {
    /// The operators written as symbols, but for the comparisons.
    const SIGNS: [(Self, &'static str); 5] = [
        (Self::Add, "+"),
        (Self::Subtract, "-"),
        (Self::Multiply, "*"),
        (Self::ShiftLeft, "<<"),
        (Self::ShiftRight, ">>"),
    ];

    /// The notation of the language.
    pub fn word(self) -> &'static str {
        match self {
            Self::Bitwise(operator) => operator.word(),
            Self::Compare(relation) => relation.sign(),
            _ => Self::SIGNS.iter().find(|(infix, _)| *infix == self).expect("every sign has its word").1,
        }
    }

    /// The operator with that symbol, if there is one.
    pub fn of_sign(sign: &str) -> Option<Self> {
        let known = Self::SIGNS.iter().find(|(_, known)| *known == sign).map(|(infix, _)| *infix);
        known.or_else(|| Relation::parse(sign).map(Self::Compare))
    }

    /// The precedence: 1 is the loosest.
    pub fn precedence(self) -> u8 {
        use nbc_base::model::Operator;
        match self {
            Self::Bitwise(Operator::Or | Operator::Nor) => 1,
            Self::Bitwise(Operator::Xor | Operator::Xnor) => 2,
            Self::Bitwise(_) => 3,
            Self::ShiftLeft | Self::ShiftRight => 5,
            Self::Add | Self::Subtract => 6,
            Self::Multiply => 7,
            Self::Compare(_) => 4,
        }
    }

    /// Whether `a op b op c` is unambiguous if it follows `before`, which has the same precedence.
    pub(crate) fn chains_after(self, before: Self) -> bool {
        use nbc_base::model::Operator;
        match self {
            Self::Add | Self::Subtract | Self::Multiply => true,
            Self::Bitwise(Operator::And | Operator::Or | Operator::Xor) => self == before,
            _ => false,
        }
    }
}
