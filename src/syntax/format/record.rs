//! Records: on one line where they fit, else a field a line.

use crate::source::Span;
use crate::syntax::format::expression::arguments;
use crate::syntax::format::layout::WIDTH;
use crate::syntax::format::printer::Printer;
use crate::syntax::tree::{
    Declaration, DeclarationKind, Field, Instance, Quantity, Record, RecordDeclaration, Value, ValueKind,
};

impl Printer<'_> {
    /// The texts of the one-line records of one kind that follow each other, with their braces aligned.
    pub(super) fn record_run(&self, declarations: &[Declaration]) -> Vec<String> {
        let mut run: Vec<(&RecordDeclaration, Span)> = Vec::new();
        for declaration in declarations {
            let DeclarationKind::Record(record) = &declaration.kind else { break };
            let follows = run
                .last()
                .is_none_or(|(first, span)| first.keyword == record.keyword && self.adjacent(*span, declaration.span));
            if !follows || self.has_comment_inside(declaration.span) {
                break;
            }
            run.push((record, declaration.span));
        }
        let name = run.iter().map(|(record, _)| record.name.text.chars().count()).max().unwrap_or(0);
        let text = |(record, _): &(&RecordDeclaration, Span)| {
            format!("{} {:name$} {}", record.keyword.word(), record.name.text, flat_record(&record.record))
        };
        // A lone record stands as any other declaration does, with a blank line around it.
        let texts: Vec<_> = run.iter().map(text).take_while(|text| text.chars().count() <= WIDTH).collect();
        if texts.len() == run.len() && texts.len() > 1 { texts } else { Vec::new() }
    }

    pub(super) fn record_declaration(&mut self, declaration: &RecordDeclaration) {
        self.write(&format!("{} {} ", declaration.keyword.word(), declaration.name.text));
        self.record(&declaration.record);
    }

    fn record(&mut self, record: &Record) {
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

    fn long_list(&mut self, values: &[Value]) {
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

fn flat_record(record: &Record) -> String {
    let field = |field: &Field| format!("{}: {}", field.name.text, value(&field.value));
    match &record.fields[..] {
        [] => "{}".to_owned(),
        fields => format!("{{ {} }}", fields.iter().map(field).collect::<Vec<_>>().join(", ")),
    }
}

fn value(value_: &Value) -> String {
    let list = |values: &[Value]| values.iter().map(value).collect::<Vec<_>>().join(", ");
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

/// `10 cycles`
pub(super) fn quantity(quantity: &Quantity) -> String {
    match &quantity.unit {
        Some(unit) => format!("{} {}", quantity.number.text, unit.text),
        None => quantity.number.text.clone(),
    }
}

/// `add[8]`
pub(super) fn instance(instance: &Instance) -> String {
    format!("{}{}", instance.name.text, arguments(&instance.sizes, &instance.arguments))
}
