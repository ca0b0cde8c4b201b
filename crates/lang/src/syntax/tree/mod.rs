//! The syntax tree: declarations as written, with unresolved names. Expressions and sizes are stored in arenas,
//! children before parents, so that deep nesting needs no deep stack.

mod circuit;
mod expression;
mod prove;
mod record;
mod size;
mod test;

use nbc_base::source::Span;

pub use circuit::{
    BodySyntax, CircuitSyntax, Grouping, ParameterSyntax, Port, StatementKind, StatementSyntax, TargetSyntax,
};
pub use expression::{ExpressionSyntax, ExpressionSyntaxKind, Infix, OperandSyntax, TableOutputSyntax, TableRowSyntax};
pub use prove::{PropertySyntax, Prove};
pub use record::{
    Field, InstanceSyntax, Number, Quantity, RecordDeclaration, RecordKeyword, RecordSyntax, ScheduleSyntax,
    SpellSyntax, StimulusSyntax, ValueKind, ValueSyntax,
};
pub use size::{Argument, ExpressionSyntaxId, Index, IndexKind, SizeSyntax, SizeSyntaxId, SizeSyntaxKind};
pub use test::{Simulate, Test, TestItem, TestKind, TestRowSyntax, TestTable, UntilSyntax, With};

/// A file's declarations and its comments, both in order of text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tree {
    /// The declarations that could be parsed.
    pub declarations: Vec<Declaration>,
    /// The parts that could not be parsed, and that are missing in the declarations.
    pub broken: Vec<BrokenSyntax>,
    /// The places of all comments, each from its `//` to the end of its line.
    pub comments: Vec<Span>,
}

/// A part that could not be parsed: a declaration, or a statement, field or row of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BrokenSyntax {
    /// The place of the part that is missing.
    pub span: Span,
    /// The place of the declaration that it belongs to.
    pub declaration: Span,
}

/// A declaration with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    /// From its keyword to its last character.
    pub span: Span,
    /// The declaration itself.
    pub kind: DeclarationKind,
}

/// A declaration, by its keyword.
#[derive(Clone, Debug, PartialEq)]
pub enum DeclarationKind {
    /// `use "file.nb"`, or several files
    Use(Vec<Text>),
    /// `stimulus s1, s2`, or of an image `stimulus digit[8][8]`
    Stimulus(Vec<StimulusSyntax>),
    /// `material`, `images`, `evolution`, `library`, `swarm`, `world`: a name and a record.
    Record(RecordDeclaration),
    /// `schedule`
    Schedule(ScheduleSyntax),
    /// `simulate`
    Simulate(Simulate),
    /// `circuit` or `environment`
    Circuit(CircuitSyntax),
    /// `enum phase { fetch, execute }`
    Enumeration(EnumerationSyntax),
    /// `let n = 8`
    Let(LetSyntax),
    /// `file program = "hello.hex"`
    File(FileSyntax),
    /// `prove`
    Prove(Prove),
    /// `test`
    Test(Test),
}

/// A name with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameSyntax {
    /// The name as written.
    pub text: String,
    /// The place of the name in the source.
    pub span: Span,
}

/// A text in quotes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    /// The text between the quotes.
    pub text: String,
    /// The place, including the quotes.
    pub span: Span,
}

/// `enum phase: gray { fetch, execute }`
#[derive(Clone, Debug, PartialEq)]
pub struct EnumerationSyntax {
    /// The name of the enumeration.
    pub name: NameSyntax,
    /// The word that says how its members get values.
    pub encoding: Option<NameSyntax>,
    /// The members in order of text.
    pub members: Vec<MemberSyntax>,
}

/// A member of an enumeration: `fetch` or `load = 5'b00000`
#[derive(Clone, Debug, PartialEq)]
pub struct MemberSyntax {
    /// The name of the member.
    pub name: NameSyntax,
    /// The constant that is its value, as written.
    pub value: Option<NameSyntax>,
}

/// `let n = 8`
#[derive(Clone, Debug, PartialEq)]
pub struct LetSyntax {
    /// The name of the integer.
    pub name: NameSyntax,
    /// The integer, in an arena of its own.
    pub sizes: Vec<SizeSyntax>,
}

/// `file program = "hello.hex"`
#[derive(Clone, Debug, PartialEq)]
pub struct FileSyntax {
    /// What memories and the command line call the file.
    pub name: NameSyntax,
    /// The file unless the command line names another.
    pub path: Text,
}
