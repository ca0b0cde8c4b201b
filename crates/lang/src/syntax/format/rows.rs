//! Schedules, simulations and tests: rows with aligned columns.

use crate::syntax::format::printer::Printer;
use crate::syntax::format::record::{instance, quantity};
use crate::syntax::tree::{NameSyntax, ScheduleSyntax, Simulate, SpellSyntax, Test, TestKind, TestTable, With};
use nbc_base::source::Span;

impl Printer<'_> {
    pub(super) fn schedule(&mut self, schedule: &ScheduleSyntax, span: Span) {
        self.write(&format!("schedule {}({}) ", schedule.name.text, names(&schedule.columns)));
        self.spells(&schedule.spells, span);
    }

    pub(super) fn simulate(&mut self, simulate: &Simulate, span: Span) {
        self.write(&format!("simulate {} {}with ", simulate.swarm.text, in_world(simulate.world.as_ref())));
        match &simulate.with {
            With::Named(name) => self.write(&name.text),
            With::Spells { columns, spells } => {
                self.write(&format!("schedule ({}) ", names(columns)));
                self.spells(spells, span);
            }
        }
    }

    fn spells(&mut self, spells: &[SpellSyntax], span: Span) {
        let widths = widths(spells.iter().map(|spell| &spell.cells[..]));
        self.block(span.end, |printer| {
            for spell in spells {
                let cells = aligned(&spell.cells, &widths);
                let text = format!("{} for {}", cells.join(" "), quantity(&spell.length)).trim_start().to_owned();
                printer.item(spell.span, |printer| printer.write(&text));
            }
        });
    }

    pub(super) fn test(&mut self, test: &Test, span: Span) {
        self.write(&format!("test {} ", instance(&test.circuit)));
        if let Some(title) = &test.title {
            self.write(&format!("\"{}\" ", title.text));
        }
        self.write(&in_world(test.world.as_ref()));
        match &test.kind {
            TestKind::Table(table) => self.test_table(table, span),
            TestKind::Against(other) => self.write(&format!("for all inputs against {}", instance(other))),
            TestKind::Reference(body) => {
                self.write("for all inputs ");
                self.block(span.end, |printer| printer.statements(body, &body.statements));
            }
        }
    }

    fn test_table(&mut self, table: &TestTable, span: Span) {
        let even = |row: &&crate::syntax::tree::TestRowSyntax| row.bars.len() == 1;
        let header = [&table.inputs[..], &table.outputs[..]];
        let rows: Vec<_> = table.rows.iter().filter(even).collect();
        let inputs = widths(rows.iter().map(|row| &row.inputs[..]).chain([header[0]]));
        let outputs = widths(rows.iter().map(|row| &row.outputs[..]).chain([header[1]]));
        let line = |left: &[NameSyntax], right: &[NameSyntax]| {
            let words = [aligned(left, &inputs), vec!["|".to_owned()], aligned(right, &outputs)].concat();
            words.join(" ")
        };
        self.block(span.end, |printer| {
            let text = line(&table.inputs, &table.outputs);
            printer.item(table.header, |printer| printer.write(text.trim_end()));
            for row in &table.rows {
                let text = match (row.bars.len(), &row.hold) {
                    (1, None) => line(&row.inputs, &row.outputs),
                    (1, Some(hold)) => format!("{} for {}", line(&row.inputs, &row.outputs), quantity(hold)),
                    // The checker reports rows that are out of order.
                    _ => printer.text(row.span).to_owned(),
                };
                printer.item(row.span, |printer| printer.write(text.trim_end()));
            }
        });
    }
}

/// `in slippery `
fn in_world(world: Option<&NameSyntax>) -> String {
    world.map_or(String::new(), |world| format!("in {} ", world.text))
}

/// `a, b`
pub(super) fn names(names: &[NameSyntax]) -> String {
    names.iter().map(|name| name.text.as_str()).collect::<Vec<_>>().join(", ")
}

fn widths<'a>(rows: impl Iterator<Item = &'a [NameSyntax]>) -> Vec<usize> {
    let mut widths = Vec::new();
    for row in rows {
        for (at, name) in row.iter().enumerate() {
            let width = name.text.chars().count();
            if at < widths.len() {
                widths[at] = width.max(widths[at]);
            } else {
                widths.push(width);
            }
        }
    }
    widths
}

fn aligned(row: &[NameSyntax], widths: &[usize]) -> Vec<String> {
    row.iter().zip(widths).map(|(name, &width)| format!("{:width$}", name.text)).collect()
}
