//! Records and their fields, instances, and schedules, as written.

use nbc_base::source::Span;

use crate::syntax::tree::{Argument, NameSyntax, SizeSyntax};

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RecordKeyword {
    Material,
    Evolution,
    Images,
    Library,
    Swarm,
    World,
}

impl RecordKeyword {
    pub fn word(self) -> &'static str {
        match self {
            Self::Material => "material",
            Self::Evolution => "evolution",
            Self::Images => "images",
            Self::Library => "library",
            Self::Swarm => "swarm",
            Self::World => "world",
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct StimulusSyntax {
    pub name: NameSyntax,
    /// Rows and columns.
    pub image: Option<[Number; 2]>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct RecordDeclaration {
    pub keyword: RecordKeyword,
    pub name: NameSyntax,
    pub record: RecordSyntax,
}

#[derive(Clone, Debug, PartialEq)]
pub struct RecordSyntax {
    pub fields: Vec<Field>,
    pub span: Span,
}

impl RecordSyntax {
    pub fn field(&self, name: &str) -> Option<&Field> {
        self.fields.iter().find(|field| field.name.text == name)
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    pub name: NameSyntax,
    pub value: ValueSyntax,
}

#[derive(Clone, Debug, PartialEq)]
pub struct ValueSyntax {
    pub kind: ValueKind,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub enum ValueKind {
    Record(RecordSyntax),
    List(Vec<ValueSyntax>),
    Text(String),
    Quantity(Quantity),
    Range(Quantity, Quantity),
    Product(Number, Number),
    Bins(NameSyntax, Number),
    Applied(NameSyntax, Vec<ValueSyntax>),
    /// A word, or a circuit with its parameters.
    Instance(InstanceSyntax),
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number {
    pub text: String,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    pub number: Number,
    pub unit: Option<NameSyntax>,
}

impl Quantity {
    pub fn span(&self) -> Span {
        self.unit.as_ref().map_or(self.number.span, |unit| self.number.span.to(unit.span))
    }
}

/// Parameters are sizes of the surrounding arena.
#[derive(Clone, Debug, PartialEq)]
pub struct InstanceSyntax {
    pub name: NameSyntax,
    pub arguments: Vec<Argument>,
    /// Empty inside a circuit.
    pub sizes: Vec<SizeSyntax>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct ScheduleSyntax {
    pub name: NameSyntax,
    pub columns: Vec<NameSyntax>,
    pub spells: Vec<SpellSyntax>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct SpellSyntax {
    pub cells: Vec<NameSyntax>,
    pub length: Quantity,
    pub span: Span,
}
