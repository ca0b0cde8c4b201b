//! Schedules, simulations and tests: rows with aligned columns.

use crate::syntax::format::printer::Printer;
use crate::syntax::format::record::{instance, quantity};
use crate::syntax::tree::{
    NameSyntax, ScheduleSyntax, Simulate, SpellSyntax, StimulusSyntax, Test, TestItem, TestKind, TestRowSyntax,
    TestTable, With,
};
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
        if let Some(environment) = &test.environment {
            self.write(&format!("with {} ", environment.text));
        }
        self.write(&match &test.worlds[..] {
            [] => String::new(),
            [world] => in_world(Some(world)),
            worlds => format!("in [{}] ", names(worlds)),
        });
        match &test.kind {
            TestKind::Table(table) => self.test_table(table, span),
            TestKind::FromFile { path, at_least } => {
                let share = at_least.as_ref().map_or(String::new(), |share| format!(" at least {}", quantity(share)));
                self.write(&format!("from \"{}\"{share}", path.text));
            }
            TestKind::Against(other) => self.write(&format!("for all inputs against {}", instance(other))),
            TestKind::Ever(other) => self.write(&format!("against {} for ever", instance(other))),
            TestKind::Reference(body) => {
                self.write("for all inputs ");
                self.block(span.end, |printer| printer.statements(body, &body.statements));
            }
        }
    }

    fn test_table(&mut self, table: &TestTable, span: Span) {
        let mut rows = Vec::new();
        even_rows(&table.rows, &mut rows);
        let inputs = widths(rows.iter().map(|row| &row.inputs[..]).chain([&table.inputs[..]]));
        let outputs = widths(rows.iter().map(|row| &row.outputs[..]).chain([&table.outputs[..]]));
        let widths = [inputs, outputs];
        self.block(span.end, |printer| {
            let text = line(&widths, &table.inputs, &table.outputs);
            printer.item(table.header, |printer| printer.write(text.trim_end()));
            printer.test_rows(&table.rows, &widths);
        });
    }

    fn test_rows(&mut self, items: &[TestItem], widths: &[Vec<usize>; 2]) {
        for item in items {
            match item {
                TestItem::Row(row) => {
                    let text = self.test_row(row, widths);
                    self.item(row.span, |printer| printer.write(text.trim_end()));
                }
                TestItem::Repeat { times, rows, span } => {
                    let head = rows.first().map_or(span.end, |row| row.span().start);
                    self.item_with_inside(*span, head, |printer| {
                        printer.write(&format!("repeat {} ", times.text));
                        printer.block(span.end, |printer| printer.test_rows(rows, widths));
                    });
                }
            }
        }
    }

    fn test_row(&self, row: &TestRowSyntax, widths: &[Vec<usize>; 2]) -> String {
        // The checker reports rows that are out of order.
        if row.bars.len() != 1 {
            return self.text(row.span).to_owned();
        }
        let mut text = line(widths, &row.inputs, &row.outputs);
        text.extend(row.hold.iter().map(|hold| format!(" for {}", quantity(hold))));
        text.extend(row.until.iter().map(|until| {
            let value = until.value.as_ref().map_or(String::new(), |value| format!(" = {}", value.text));
            format!(" until {}{value}, at most {} rows", until.output.text, until.most.text)
        }));
        text
    }
}

fn line(widths: &[Vec<usize>; 2], left: &[NameSyntax], right: &[NameSyntax]) -> String {
    [aligned(left, &widths[0]), vec!["|".to_owned()], aligned(right, &widths[1])].concat().join(" ")
}

/// Repeated rows included.
fn even_rows<'t>(items: &'t [TestItem], rows: &mut Vec<&'t TestRowSyntax>) {
    for item in items {
        match item {
            TestItem::Row(row) if row.bars.len() == 1 => rows.push(row),
            TestItem::Row(_) => {}
            TestItem::Repeat { rows: inner, .. } => even_rows(inner, rows),
        }
    }
}

fn in_world(world: Option<&NameSyntax>) -> String {
    world.map_or(String::new(), |world| format!("in {} ", world.text))
}

pub(super) fn stimuli(stimuli: &[StimulusSyntax]) -> String {
    let one = |stimulus: &StimulusSyntax| match &stimulus.image {
        Some([rows, columns]) => format!("{}[{}][{}]", stimulus.name.text, rows.text, columns.text),
        None => stimulus.name.text.clone(),
    };
    stimuli.iter().map(one).collect::<Vec<_>>().join(", ")
}

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
