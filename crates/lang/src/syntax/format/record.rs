//! Records: on one line if they fit, else one field per line.

use std::sync::Arc;

use crate::syntax::format::expression::arguments;
use crate::syntax::format::layout::WIDTH;
use crate::syntax::format::printer::Printer;
use crate::syntax::tree::{
    Declaration, DeclarationKind, EnumerationSyntax, Field, InstanceSyntax, Quantity, RecordDeclaration, RecordSyntax,
    ValueKind, ValueSyntax,
};
use nbc_base::source::Span;

const ROW_WIDTH: usize = 120;

/// A run that is too wide is tried again from its second record on.
const MOST_ROWS: usize = 200;

impl Printer<'_> {
    pub(super) fn record_run(&self, declarations: &[Arc<Declaration>]) -> Vec<String> {
        let mut run: Vec<(&RecordDeclaration, Span)> = Vec::new();
        for declaration in declarations {
            let DeclarationKind::Record(record) = &declaration.kind else { break };
            let follows = run
                .last()
                .is_none_or(|(first, span)| first.keyword == record.keyword && self.adjacent(*span, declaration.span));
            if !follows || run.len() == MOST_ROWS || self.has_comment_inside(declaration.span) {
                break;
            }
            run.push((record, declaration.span));
        }
        let mut texts = aligned(&run);
        // The first record that is too long ends the run; the others may be narrower without it.
        while let Some(long) = texts.iter().position(|text| text.chars().count() > ROW_WIDTH) {
            run.truncate(long);
            texts = aligned(&run);
        }
        // A single record is printed like any other declaration, with a blank line around it.
        if texts.len() > 1 { texts } else { Vec::new() }
    }

    /// On one line if it fits and no member has a value.
    pub(super) fn enumeration(&mut self, enumeration: &EnumerationSyntax, span: Span) {
        let encoding = enumeration.encoding.as_ref().map_or(String::new(), |word| format!(": {}", word.text));
        self.write(&format!("enum {}{encoding} ", enumeration.name.text));
        let names: Vec<&str> = enumeration.members.iter().map(|member| member.name.text.as_str()).collect();
        let flat = format!("{{ {} }}", names.join(", "));
        let plain = enumeration.members.iter().all(|member| member.value.is_none());
        // Comments before the brace are printed before the declaration.
        let brace = self.text(span).find('{').map_or(span, |at| Span { start: span.start + at as u32, ..span });
        if plain && !self.has_comment_inside(brace) && self.column() + flat.chars().count() <= WIDTH {
            return self.write(&flat);
        }
        let width = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
        self.block(span.end, |printer| {
            for member in &enumeration.members {
                let name = &member.name;
                let text = match &member.value {
                    Some(value) => format!("{:width$} = {},", name.text, value.text),
                    None => format!("{},", name.text),
                };
                let place = member.value.as_ref().map_or(name.span, |value| name.span.to(value.span));
                printer.item(place, |printer| printer.write(&text));
            }
        });
    }

    pub(super) fn record_declaration(&mut self, declaration: &RecordDeclaration) {
        self.write(&format!("{} {} ", declaration.keyword.word(), declaration.name.text));
        self.record(&declaration.record);
    }

    fn record(&mut self, record: &RecordSyntax) {
        let flat = flat_record(record);
        if !self.has_comment_inside(record.span) && self.column() + flat.chars().count() <= WIDTH {
            return self.write(&flat);
        }
        let width = record.fields.iter().map(|field| field.name.text.chars().count() + 1).max().unwrap_or(0);
        self.block(record.span.end, |printer| {
            for field in &record.fields {
                printer.item(field.name.span.to(field.value.span), |printer| printer.field(field, width));
            }
        });
    }

    fn field(&mut self, field: &Field, width: usize) {
        self.write(&format!("{:width$} ", format!("{}:", field.name.text)));
        let flat = value(&field.value);
        match &field.value.kind {
            ValueKind::List(values) if self.column() + flat.chars().count() > WIDTH => self.long_list(values),
            _ => self.write(&flat),
        }
    }

    fn long_list(&mut self, values: &[ValueSyntax]) {
        self.write("[");
        self.indent += super::printer::INDENT;
        for one in values {
            self.line();
            self.write(&format!("{},", value(one)));
        }
        self.indent -= super::printer::INDENT;
        self.line();
        self.write("]");
    }
}

/// Aligns the braces of all records, and the values of neighbors with the same fields.
fn aligned(run: &[(&RecordDeclaration, Span)]) -> Vec<String> {
    let names = run.iter().map(|(record, _)| record.name.text.chars().count()).max().unwrap_or(0);
    let same = |a: &(&RecordDeclaration, Span), b: &(&RecordDeclaration, Span)| {
        a.0.record.fields.iter().map(|field| &field.name.text).eq(b
            .0
            .record
            .fields
            .iter()
            .map(|field| &field.name.text))
    };
    let mut lines = Vec::new();
    for group in run.chunk_by(same) {
        let columns = group[0].0.record.fields.len();
        let width = |record: &RecordSyntax, at: usize| value(&record.fields[at].value).chars().count();
        let widest = |at: usize| group.iter().map(|(record, _)| width(&record.record, at)).max().unwrap_or(0);
        let widths: Vec<_> = (0..columns).map(widest).collect();
        for (record, _) in group {
            let fields = row(&record.record, &widths);
            lines.push(format!("{} {:names$} {fields}", record.keyword.word(), record.name.text));
        }
    }
    lines
}

/// Numbers are aligned to the right, other values to the left.
fn row(record: &RecordSyntax, widths: &[usize]) -> String {
    let mut text = String::new();
    for (at, (field, width)) in record.fields.iter().zip(widths).enumerate() {
        let shown = value(&field.value);
        let blanks = " ".repeat(width - shown.chars().count());
        let (before, after) = match field.value.kind {
            ValueKind::Quantity(_) => (blanks.as_str(), ""),
            _ => ("", blanks.as_str()),
        };
        let separator = if at + 1 < record.fields.len() { format!(", {after}") } else { String::new() };
        text += &format!("{}: {before}{shown}{separator}", field.name.text);
    }
    if text.is_empty() { "{}".to_owned() } else { format!("{{ {text} }}") }
}

fn flat_record(record: &RecordSyntax) -> String {
    let field = |field: &Field| format!("{}: {}", field.name.text, value(&field.value));
    match &record.fields[..] {
        [] => "{}".to_owned(),
        fields => format!("{{ {} }}", fields.iter().map(field).collect::<Vec<_>>().join(", ")),
    }
}

fn value(value_: &ValueSyntax) -> String {
    let list = |values: &[ValueSyntax]| values.iter().map(value).collect::<Vec<_>>().join(", ");
    match &value_.kind {
        ValueKind::Record(record) => flat_record(record),
        ValueKind::List(values) => format!("[{}]", list(values)),
        ValueKind::Text(text) => format!("\"{text}\""),
        ValueKind::Quantity(amount) => quantity(amount),
        ValueKind::Range(low, high) => format!("{}..{}", quantity(low), quantity(high)),
        ValueKind::Product(width, height) => format!("{} x {}", width.text, height.text),
        ValueKind::Bins(name, bins) => format!("{} in {} bins", name.text, bins.text),
        ValueKind::Applied(name, values) => format!("{}({})", name.text, list(values)),
        ValueKind::Instance(one) => instance(one),
    }
}

pub(super) fn quantity(quantity: &Quantity) -> String {
    match &quantity.unit {
        Some(unit) if unit.text == "%" => format!("{}%", quantity.number.text),
        Some(unit) => format!("{} {}", quantity.number.text, unit.text),
        None => quantity.number.text.clone(),
    }
}

pub(super) fn instance(instance: &InstanceSyntax) -> String {
    format!("{}{}", instance.name.text, arguments(&instance.sizes, &instance.arguments))
}
