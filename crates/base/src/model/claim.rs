//! Claims: what is said of every step of a circuit, for all inputs.

use serde::{Serialize, Serializer};

use super::{Circuit, CircuitId, Column, Instance};
use crate::source::Span;

/// A declared claim. The source is needed for messages only.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Claim {
    pub circuit: Instance,
    pub title: String,
    #[serde(skip)]
    pub span: Span,
    pub file: String,
    pub line: usize,
    pub inputs: Vec<Column>,
    pub outputs: Vec<Column>,
    #[serde(skip)]
    pub inner: Vec<InnerNet>,
    #[serde(skip)]
    pub environment: Option<CircuitId>,
    /// As data, those that are to be proved.
    #[serde(serialize_with = "wanted")]
    pub properties: Vec<Property>,
    /// What the properties say, as a circuit: its inputs are the ports of the circuit, the nets inside it,
    /// and a clock that rises between two steps, its outputs those of [`Property::outputs`].
    #[serde(skip)]
    pub monitor: Box<Circuit>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct InnerNet {
    pub column: Column,
    pub declared: Span,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Property {
    #[serde(skip)]
    pub kind: PropertyKind,
    #[serde(rename = "property")]
    pub text: String,
    #[serde(skip)]
    pub span: Span,
    pub line: usize,
    /// Whether it is said only of steps in which a condition holds, which stands before `=>`.
    #[serde(skip)]
    pub has_condition: bool,
    /// The number of steps within which what it says must happen; `None` if it must be in the same step.
    #[serde(skip)]
    pub within: Option<usize>,
    /// The number of steps before that it looks at: it is said of the steps after so many.
    #[serde(skip)]
    pub before: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PropertyKind {
    Always,
    Never,
    /// Steps in which it is 0, and all that follows them, do not count.
    Assume,
}

impl PropertyKind {
    pub fn word(self) -> &'static str {
        match self {
            Self::Always => "always",
            Self::Never => "never",
            Self::Assume => "assume",
        }
    }

    pub fn parse(word: &str) -> Option<Self> {
        [Self::Always, Self::Never, Self::Assume].into_iter().find(|kind| kind.word() == word)
    }
}

impl Property {
    /// The number of outputs that the monitor has for it: the condition, if there is one, and the expression.
    pub fn outputs(&self) -> usize {
        1 + usize::from(self.has_condition)
    }
}

impl Claim {
    /// The properties that are to be proved: all but the assumptions.
    pub fn wanted(&self) -> impl Iterator<Item = &Property> {
        self.properties.iter().filter(|property| property.kind != PropertyKind::Assume)
    }
}

fn wanted<S: Serializer>(properties: &[Property], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(properties.iter().filter(|property| property.kind != PropertyKind::Assume))
}
