//! Declarations at another place: a text that has not changed has the same tree there, with other spans.

use std::sync::Arc;

use super::*;
use nbc_base::source::FileId;

/// How far a span moves, modulo 2^32, and its file then.
#[derive(Clone, Copy)]
struct Way {
    file: FileId,
    by: u32,
}

/// `start` is the first byte of the declaration.
pub(crate) fn moved(mut declaration: Arc<Declaration>, file: FileId, start: u32) -> Arc<Declaration> {
    let way = Way { file, by: start.wrapping_sub(declaration.span.start) };
    if way.by != 0 || file != declaration.span.file {
        // It is copied only if the last tree is still used.
        Arc::make_mut(&mut declaration).shift(way);
    }
    declaration
}

trait Shift {
    fn shift(&mut self, way: Way);
}

impl Shift for Span {
    fn shift(&mut self, Way { file, by }: Way) {
        *self = Self { file, start: self.start.wrapping_add(by), end: self.end.wrapping_add(by) };
    }
}

impl<T: Shift> Shift for Vec<T> {
    fn shift(&mut self, way: Way) {
        self.iter_mut().for_each(|one| one.shift(way));
    }
}

impl<T: Shift, const N: usize> Shift for [T; N] {
    fn shift(&mut self, way: Way) {
        self.iter_mut().for_each(|one| one.shift(way));
    }
}

impl<T: Shift> Shift for Option<T> {
    fn shift(&mut self, way: Way) {
        self.iter_mut().for_each(|one| one.shift(way));
    }
}

impl<T: Shift> Shift for Box<T> {
    fn shift(&mut self, way: Way) {
        (**self).shift(way);
    }
}

/// What has no place of its own.
macro_rules! fixed {
    ($($name:ty),* $(,)?) => { $(impl Shift for $name { fn shift(&mut self, _: Way) {} })* };
}

/// All fields are named, so that none is forgotten.
macro_rules! structs {
    ($($name:ident { $($field:ident),* })*) => { $(impl Shift for $name {
        fn shift(&mut self, way: Way) {
            let Self { $($field),* } = self;
            $($field.shift(way);)*
        }
    })* };
}

macro_rules! enums {
    ($($name:ident { $($variant:ident { $($field:tt $part:ident),* })* })*) => { $(impl Shift for $name {
        fn shift(&mut self, way: Way) {
            match self {
                $(Self::$variant { $($field: $part),* } => { $($part.shift(way);)* })*
            }
        }
    })* };
}

fixed! {
    bool, char, String, ExpressionSyntaxId, SizeSyntaxId, Grouping, Infix, IndexKind, RecordKeyword, SizeSyntaxKind,
    nbc_base::model::Operator, nbc_base::model::PropertyKind, nbc_base::model::Relation,
}

structs! {
    Declaration { span, kind }
    NameSyntax { text, span }
    Text { text, span }
    EnumerationSyntax { name, encoding, members }
    MemberSyntax { name, value }
    LetSyntax { name, sizes }
    FileSyntax { name, path }
    CircuitSyntax { is_environment, name, parameters, inputs, outputs, body }
    BodySyntax { statements, expressions, sizes }
    ParameterSyntax { name, default }
    Port { name, words, width, members, absent, contents }
    StatementSyntax { kind, span }
    TargetSyntax { name, index, second, start, span }
    ExpressionSyntax { kind, span }
    OperandSyntax { name, value }
    TableRowSyntax { patterns, output, span }
    Prove { circuit, title, environment, properties, body }
    PropertySyntax { kind, word, condition, value, within, span }
    StimulusSyntax { name, image }
    RecordDeclaration { keyword, name, record }
    RecordSyntax { fields, span }
    Field { name, value }
    ValueSyntax { kind, span }
    Number { text, span }
    Quantity { number, unit }
    InstanceSyntax { name, arguments, sizes }
    ScheduleSyntax { name, columns, spells }
    SpellSyntax { cells, length, span }
    Index { kind, span }
    SizeSyntax { kind, span }
    Argument { name, value, span }
    Simulate { swarm, world, with }
    Test { circuit, title, environment, worlds, kind }
    TestTable { inputs, outputs, rows, header }
    UntilSyntax { output, value, most }
    TestRowSyntax { inputs, bars, outputs, hold, until, span }
}

enums! {
    DeclarationKind {
        Use { 0 a } Stimulus { 0 a } Record { 0 a } Schedule { 0 a } Simulate { 0 a } Circuit { 0 a }
        Enumeration { 0 a } Let { 0 a } File { 0 a } Prove { 0 a } Test { 0 a }
    }
    StatementKind {
        Drive { targets a, grouping b, value c }
        Nets { 0 a }
        For { variable a, from b, to c, statements d }
        Let { name a, value b }
        If { left a, comparison b, right c, then d, otherwise e, blocks f }
    }
    ExpressionSyntaxKind {
        Digits { 0 a }
        Constant { width a, base b, digits c }
        Computed { width a, value b }
        Net { name a, index b, second c }
        Call { name a, arguments b, operands c }
        Group { 0 a }
        Concatenation { 0 a }
        Repetition { count a, values b }
        Not { 0 a }
        Infix { operator a, place b, left c, right d }
        Operation { operator a, operands b }
        Choice { condition a, then b, otherwise c }
        Table { is_match a, inputs b, rows c }
    }
    TableOutputSyntax { Bits { 0 a } Value { 0 a } }
    ValueKind {
        Record { 0 a } List { 0 a } Text { 0 a } Quantity { 0 a } Range { 0 a, 1 b } Product { 0 a, 1 b }
        Bins { 0 a, 1 b } Applied { 0 a, 1 b } Instance { 0 a }
    }
    With { Named { 0 a } Spells { columns a, spells b } }
    TestKind { Table { 0 a } FromFile { path a, at_least b } Against { 0 a } Ever { 0 a } Reference { 0 a } }
    TestItem { Row { 0 a } Repeat { times a, rows b, span c } }
}
