//! Parts of a declaration that are parsed alone.

use crate::syntax::grammar::Rule;
use nbc_base::source::FileId;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PartKind {
    Declaration,
    Statement,
    Field,
    Spell,
    Property,
    Row,
    TableRow,
}

impl PartKind {
    pub(crate) fn rule(self) -> Rule {
        match self {
            Self::Declaration => Rule::declaration,
            Self::Statement => Rule::some_statements,
            Self::Field => Rule::some_fields,
            Self::Spell => Rule::some_spells,
            Self::Property => Rule::some_properties,
            Self::Row => Rule::some_row,
            Self::TableRow => Rule::some_table_rows,
        }
    }
}

#[derive(Clone, Copy)]
pub(crate) struct PartPlace<'a> {
    pub(crate) file: FileId,
    pub(crate) source: &'a str,
    pub(crate) offset: usize,
    pub(crate) kind: PartKind,
    pub(crate) start: usize,
    pub(crate) end: usize,
}
