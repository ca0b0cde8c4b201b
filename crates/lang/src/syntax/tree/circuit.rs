//! Circuits and their statements, as written.

use nbc_base::model::Relation;
use nbc_base::source::Span;

use crate::syntax::tree::{ExpressionSyntax, ExpressionSyntaxId, Index, NameSyntax, SizeSyntax, SizeSyntaxId};

/// `circuit half_adder(a, b) -> (s, c) { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct CircuitSyntax {
    /// Whether it is the environment of circuits, and not one itself.
    pub is_environment: bool,
    /// The name of the circuit.
    pub name: NameSyntax,
    /// The width parameters in brackets.
    pub parameters: Vec<ParameterSyntax>,
    /// The input ports, before the arrow.
    pub inputs: Vec<Port>,
    /// The output ports, after the arrow.
    pub outputs: Vec<Port>,
    /// The body; it also has the sizes of the ports.
    pub body: BodySyntax,
}

/// Statements and the arenas they point into.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodySyntax {
    /// The statements in order of text.
    pub statements: Vec<StatementSyntax>,
    /// The expressions, children before parents.
    pub expressions: Vec<ExpressionSyntax>,
    /// The sizes, children before parents.
    pub sizes: Vec<SizeSyntax>,
}

/// `n` or `start = 0` in a circuit's parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterSyntax {
    /// The name of the parameter.
    pub name: NameSyntax,
    /// The value if an instance gives none.
    pub default: Option<SizeSyntaxId>,
}

/// A port or another net with its width: `a`, `a[8]` or `r[32][8]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Port {
    /// The name of the net.
    pub name: NameSyntax,
    /// The number of words, if it is an array.
    pub words: Option<SizeSyntaxId>,
    /// The width in bits, if it is given; of an array, that of a word.
    pub width: Option<SizeSyntaxId>,
    /// The enumeration of its values: `state: phase`.
    pub members: Option<NameSyntax>,
    /// The value of an input that a call leaves out: `enable = 1`.
    pub absent: Option<SizeSyntaxId>,
    /// The file with the first contents of a memory: `init program`.
    pub contents: Option<NameSyntax>,
}

impl Port {
    /// A net of one bit, or of the width that is given.
    pub fn new(name: NameSyntax, width: Option<SizeSyntaxId>) -> Self {
        Self { name, words: None, width, members: None, absent: None, contents: None }
    }
}

/// A statement with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct StatementSyntax {
    /// A driver, nets, or a loop.
    pub kind: StatementKind,
    /// The place of the statement in the source.
    pub span: Span,
}

/// A statement of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum StatementKind {
    /// `q init 0 = nand(s, nq)`
    Drive {
        /// What is driven, left of the `=`.
        targets: Vec<TargetSyntax>,
        /// How the targets are written.
        grouping: Grouping,
        /// The driver.
        value: ExpressionSyntaxId,
    },
    /// `net c[9]`
    Nets(Vec<Port>),
    /// `for i in 0..8 { … }`
    For {
        /// The loop's variable.
        variable: NameSyntax,
        /// Its first value.
        from: SizeSyntaxId,
        /// One more than its last value.
        to: SizeSyntaxId,
        /// The repeated statements.
        statements: Vec<StatementSyntax>,
    },
    /// `let n = 8`
    Let {
        /// The name of the integer.
        name: NameSyntax,
        /// The integer.
        value: SizeSyntaxId,
    },
    /// `if n == 1 { … } else { … }`
    If {
        /// The left integer.
        left: SizeSyntaxId,
        /// How it must compare with the right one.
        comparison: Relation,
        /// The right integer.
        right: SizeSyntaxId,
        /// The statements if it does.
        then: Vec<StatementSyntax>,
        /// The statements if it does not; those after `else if` are one statement.
        otherwise: Vec<StatementSyntax>,
        /// The places of both blocks.
        blocks: [Span; 2],
    },
}

/// How the targets of a drive are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    /// `a = …`
    Single,
    /// `(a, b) = …`: the outputs of a call.
    Outputs,
    /// `{a, b} = …`: the parts of a value.
    Joined,
}

/// The left side of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetSyntax {
    /// The net that is driven, or `_`.
    pub name: NameSyntax,
    /// The bits or the word, if not the whole net is driven.
    pub index: Option<Index>,
    /// The bits of the word.
    pub second: Option<Index>,
    /// The value before the first cycle, if it is given: `init 0`.
    pub start: Option<SizeSyntaxId>,
    /// The place of the target in the source.
    pub span: Span,
}
