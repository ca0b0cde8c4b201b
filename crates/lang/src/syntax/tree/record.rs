//! Records and their fields, instances, and schedules, as written.

use nbc_base::source::Span;

use crate::syntax::tree::{Argument, NameSyntax, SizeSyntax};

/// The keyword of a declaration that is a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RecordKeyword {
    /// `material`
    Material,
    /// `evolution`
    Evolution,
    /// `images`
    Images,
    /// `library`
    Library,
    /// `swarm`
    Swarm,
    /// `world`
    World,
}

impl RecordKeyword {
    /// The keyword as written.
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

/// A stimulus that is declared.
#[derive(Clone, Debug, PartialEq)]
pub struct StimulusSyntax {
    /// Its name.
    pub name: NameSyntax,
    /// The rows and columns of an image.
    pub image: Option<[Number; 2]>,
}

/// A declaration that is a name and a record.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordDeclaration {
    /// The word that begins the declaration.
    pub keyword: RecordKeyword,
    /// The name that is declared.
    pub name: NameSyntax,
    /// The fields in braces after the name.
    pub record: RecordSyntax,
}

/// Fields in braces: `{ name: value, … }`.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordSyntax {
    /// The fields in order of text.
    pub fields: Vec<Field>,
    /// The place, including the braces.
    pub span: Span,
}

impl RecordSyntax {
    /// The first field of that name.
    pub fn field(&self, name: &str) -> Option<&Field> {
        self.fields.iter().find(|field| field.name.text == name)
    }
}

/// A field of a record: `name: value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The word before the colon.
    pub name: NameSyntax,
    /// What is after the colon.
    pub value: ValueSyntax,
}

/// A value with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueSyntax {
    /// A number, a word, a list or another form.
    pub kind: ValueKind,
    /// The place of the value in the source.
    pub span: Span,
}

/// The forms of the value of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum ValueKind {
    /// `{ name: value, … }`
    Record(RecordSyntax),
    /// `[value, …]`
    List(Vec<ValueSyntax>),
    /// `"text"`
    Text(String),
    /// `84 steps`
    Quantity(Quantity),
    /// `0.6..1.6`
    Range(Quantity, Quantity),
    /// `5 x 5`
    Product(Number, Number),
    /// `voxels in 4 bins`
    Bins(NameSyntax, Number),
    /// `pareto(8)`
    Applied(NameSyntax, Vec<ValueSyntax>),
    /// A word, or a circuit with its parameters.
    Instance(InstanceSyntax),
}

/// A number as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number {
    /// The digits, with sign and point.
    pub text: String,
    /// The place of the number in the source.
    pub span: Span,
}

/// A number with its unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// The digits and what they are worth.
    pub number: Number,
    /// The word or sign after the number, such as `cycles` or `%`.
    pub unit: Option<NameSyntax>,
}

impl Quantity {
    /// The place of the number and its unit.
    pub fn span(&self) -> Span {
        self.unit.as_ref().map_or(self.number.span, |unit| self.number.span.to(unit.span))
    }
}

/// A circuit's name with values for its parameters, which are sizes of the surrounding arena.
#[derive(Clone, Debug, PartialEq)]
pub struct InstanceSyntax {
    /// The name of the circuit.
    pub name: NameSyntax,
    /// The values in brackets, in order of text.
    pub arguments: Vec<Argument>,
    /// The sizes of the parameters, if the instance is not inside a circuit.
    pub sizes: Vec<SizeSyntax>,
}

/// `schedule sweep(s1, s2) { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct ScheduleSyntax {
    /// The name of the schedule.
    pub name: NameSyntax,
    /// The stimuli, one for each column of the spells.
    pub columns: Vec<NameSyntax>,
    /// The spells in order of time.
    pub spells: Vec<SpellSyntax>,
}

/// `0 1 for 10 cycles`
#[derive(Clone, Debug, PartialEq)]
pub struct SpellSyntax {
    /// The values, one for each column.
    pub cells: Vec<NameSyntax>,
    /// The time for which the values stay, such as `10 cycles`.
    pub length: Quantity,
    /// The place of the spell in the source.
    pub span: Span,
}
