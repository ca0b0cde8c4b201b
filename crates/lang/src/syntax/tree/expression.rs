//! Expressions, the rows of tables in them, and operators, as written.

use nbc_base::model::Relation;
use nbc_base::source::Span;

use crate::syntax::tree::{Argument, ExpressionSyntaxId, Index, NameSyntax, SizeSyntaxId};

#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionSyntax {
    pub kind: ExpressionSyntaxKind,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub enum ExpressionSyntaxKind {
    Digits(String),
    Constant {
        width: SizeSyntaxId,
        /// `b`, `d` or `h`.
        base: char,
        digits: String,
    },
    Computed {
        width: SizeSyntaxId,
        value: SizeSyntaxId,
    },
    Net {
        name: NameSyntax,
        index: Option<Index>,
        second: Option<Index>,
    },
    Call {
        name: NameSyntax,
        arguments: Vec<Argument>,
        operands: Vec<OperandSyntax>,
    },
    Group(ExpressionSyntaxId),
    Concatenation(Vec<ExpressionSyntaxId>),
    Repetition {
        count: SizeSyntaxId,
        values: Vec<ExpressionSyntaxId>,
    },
    Not(ExpressionSyntaxId),
    Infix {
        operator: Infix,
        place: Span,
        left: ExpressionSyntaxId,
        right: ExpressionSyntaxId,
    },
    Operation {
        operator: nbc_base::model::Operator,
        operands: Vec<ExpressionSyntaxId>,
    },
    Choice {
        condition: ExpressionSyntaxId,
        then: ExpressionSyntaxId,
        otherwise: ExpressionSyntaxId,
    },
    Table {
        is_match: bool,
        inputs: Vec<ExpressionSyntaxId>,
        rows: Vec<TableRowSyntax>,
    },
}

#[derive(Clone, Debug, PartialEq)]
pub struct OperandSyntax {
    pub name: Option<NameSyntax>,
    pub value: ExpressionSyntaxId,
}

/// `0-1: 1`, `load or store: 1` or `else: 0`
#[derive(Clone, Debug, PartialEq)]
pub struct TableRowSyntax {
    /// None is `else`.
    pub patterns: Vec<NameSyntax>,
    pub output: TableOutputSyntax,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub enum TableOutputSyntax {
    Bits(NameSyntax),
    Value(ExpressionSyntaxId),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Infix {
    Bitwise(nbc_base::model::Operator),
    Add,
    Subtract,
    Multiply,
    ShiftLeft,
    ShiftRight,
    Compare(Relation),
}

impl Infix {
    const SIGNS: [(Self, &'static str); 5] = [
        (Self::Add, "+"),
        (Self::Subtract, "-"),
        (Self::Multiply, "*"),
        (Self::ShiftLeft, "<<"),
        (Self::ShiftRight, ">>"),
    ];

    pub fn word(self) -> &'static str {
        match self {
            Self::Bitwise(operator) => operator.word(),
            Self::Compare(relation) => relation.sign(),
            _ => Self::SIGNS.iter().find(|(infix, _)| *infix == self).expect("every sign has its word").1,
        }
    }

    pub fn of_sign(sign: &str) -> Option<Self> {
        let known = Self::SIGNS.iter().find(|(_, known)| *known == sign).map(|(infix, _)| *infix);
        known.or_else(|| Relation::parse(sign).map(Self::Compare))
    }

    /// 1 is the loosest.
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

    /// Whether `a op b op c` is unambiguous if this operator follows `before`, which has the same precedence.
    pub(crate) fn chains_after(self, before: Self) -> bool {
        use nbc_base::model::Operator;
        match self {
            Self::Add | Self::Subtract | Self::Multiply => true,
            Self::Bitwise(Operator::And | Operator::Or | Operator::Xor) => self == before,
            _ => false,
        }
    }
}
