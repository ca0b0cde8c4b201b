//! Selections around a place, from the word to the whole file.

use gen_lsp_types::SelectionRange;

use crate::spot::Spot;
use crate::tokens;
use nbc_base::source::Span;
use nbc_lang::syntax::tree::{
    BodySyntax, Declaration, DeclarationKind, Field, RecordSyntax, StatementKind, StatementSyntax, Test, TestItem,
    TestKind, ValueKind, ValueSyntax, With,
};

/// The smallest range, with those around it as its parents.
pub(super) fn around(spot: &Spot<'_>) -> SelectionRange {
    let text = spot.text();
    let whole = Span::new(spot.file, 0, text.len());
    let tokens = tokens::tokens(text);
    let word = tokens::at(&tokens, spot.offset).map(|token| Span::new(spot.file, token.range.start, token.range.end));
    let mut spans: Vec<Span> = spot.around().map(parts).unwrap_or_default();
    spans.retain(|span| spot.is_in(*span));
    spans.extend(word);
    spans.push(whole);
    spans.sort_by_key(|span| (span.end - span.start, span.start));
    spans.dedup();
    // Spans that end at the place may overlap others without containing them.
    let mut nested: Vec<Span> = Vec::new();
    for span in spans {
        if nested.last().is_none_or(|inner| span.start <= inner.start && inner.end <= span.end) {
            nested.push(span);
        }
    }
    let outward = nested.into_iter().rev().fold(None, |parent, span| {
        Some(SelectionRange { range: spot.files.range(span), parent: parent.map(Box::new) })
    });
    outward.expect("the whole file is around every place")
}

fn parts(declaration: &Declaration) -> Vec<Span> {
    let mut spans = vec![declaration.span];
    match &declaration.kind {
        DeclarationKind::Use(_) | DeclarationKind::Stimulus(_) | DeclarationKind::File(_) => {}
        DeclarationKind::Enumeration(one) => spans.extend(one.members.iter().map(|member| member.name.span)),
        DeclarationKind::Let(integer) => spans.extend(integer.sizes.iter().map(|size| size.span)),
        DeclarationKind::Record(record) => of_record(&record.record, &mut spans),
        DeclarationKind::Schedule(schedule) => spans.extend(schedule.spells.iter().map(|spell| spell.span)),
        DeclarationKind::Simulate(simulate) => {
            if let With::Spells { spells, .. } = &simulate.with {
                spans.extend(spells.iter().map(|spell| spell.span));
            }
        }
        DeclarationKind::Circuit(circuit) => of_body(&circuit.body, &mut spans),
        DeclarationKind::Prove(claim) => {
            of_body(&claim.body, &mut spans);
            spans.extend(claim.properties.iter().map(|property| property.span));
        }
        DeclarationKind::Test(test) => of_test(test, &mut spans),
    }
    spans
}

fn of_body(body: &BodySyntax, spans: &mut Vec<Span>) {
    spans.extend(body.expressions.iter().map(|expression| expression.span));
    spans.extend(body.sizes.iter().map(|size| size.span));
    of_statements(&body.statements, spans);
}

fn of_statements(statements: &[StatementSyntax], spans: &mut Vec<Span>) {
    let (Some(first), Some(last)) = (statements.first(), statements.last()) else { return };
    spans.push(first.span.to(last.span));
    for statement in statements {
        spans.push(statement.span);
        match &statement.kind {
            StatementKind::Drive { targets, .. } => spans.extend(targets.iter().map(|target| target.span)),
            StatementKind::Nets(_) | StatementKind::Let { .. } => {}
            StatementKind::If { then, otherwise, blocks, .. } => {
                spans.extend(blocks);
                of_statements(then, spans);
                of_statements(otherwise, spans);
            }
            StatementKind::For { statements, .. } => of_statements(statements, spans),
        }
    }
}

fn of_test(test: &Test, spans: &mut Vec<Span>) {
    match &test.kind {
        TestKind::Table(table) => {
            spans.push(table.header);
            of_rows(&table.rows, spans);
        }
        TestKind::Against(_) | TestKind::Ever(_) | TestKind::FromFile { .. } => {}
        TestKind::Reference(body) => of_body(body, spans),
    }
}

fn of_rows(rows: &[TestItem], spans: &mut Vec<Span>) {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else { return };
    spans.push(first.span().to(last.span()));
    for item in rows {
        spans.push(item.span());
        if let TestItem::Repeat { rows, .. } = item {
            of_rows(rows, spans);
        }
    }
}

fn of_record(record: &RecordSyntax, spans: &mut Vec<Span>) {
    spans.push(record.span);
    for Field { name, value } in &record.fields {
        spans.push(name.span.to(value.span));
        of_value(value, spans);
    }
}

fn of_value(value: &ValueSyntax, spans: &mut Vec<Span>) {
    spans.push(value.span);
    match &value.kind {
        ValueKind::Record(record) => of_record(record, spans),
        ValueKind::List(values) | ValueKind::Applied(_, values) => {
            values.iter().for_each(|value| of_value(value, spans));
        }
        _ => {}
    }
}
