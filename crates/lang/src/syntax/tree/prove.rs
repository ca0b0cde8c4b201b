//! Properties of circuits, as written.

use nbc_base::model::PropertyKind;
use nbc_base::source::Span;

use crate::syntax::tree::{BodySyntax, ExpressionSyntaxId, InstanceSyntax, NameSyntax, Number, Text};

#[derive(Clone, Debug, PartialEq)]
pub struct Prove {
    pub circuit: InstanceSyntax,
    pub title: Option<Text>,
    pub environment: Option<NameSyntax>,
    pub properties: Vec<PropertySyntax>,
    /// Without statements.
    pub body: BodySyntax,
}

#[derive(Clone, Debug, PartialEq)]
pub struct PropertySyntax {
    pub kind: PropertyKind,
    pub word: Span,
    pub condition: Option<ExpressionSyntaxId>,
    pub value: ExpressionSyntaxId,
    pub within: Option<Number>,
    pub span: Span,
}
