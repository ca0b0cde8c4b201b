//! Properties of circuits, as written.

use nbc_base::model::PropertyKind;
use nbc_base::source::Span;

use crate::syntax::tree::{BodySyntax, ExpressionSyntaxId, InstanceSyntax, NameSyntax, Number, Text};

/// `prove lights "never both green" { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct Prove {
    /// The circuit, with values for its parameters.
    pub circuit: InstanceSyntax,
    /// The text after the circuit.
    pub title: Option<Text>,
    /// The environment after `with`, if it is given.
    pub environment: Option<NameSyntax>,
    /// The properties in order of text.
    pub properties: Vec<PropertySyntax>,
    /// The expressions of the properties; it has no statements.
    pub body: BodySyntax,
}

/// `always a => b within 8 steps`
#[derive(Clone, Debug, PartialEq)]
pub struct PropertySyntax {
    /// What the first word says.
    pub kind: PropertyKind,
    /// The place of the first word.
    pub word: Span,
    /// The expression before `=>`.
    pub condition: Option<ExpressionSyntaxId>,
    /// The expression.
    pub value: ExpressionSyntaxId,
    /// The number of steps after `within`.
    pub within: Option<Number>,
    /// The place of the property.
    pub span: Span,
}
