//! Pest's pairs to the tree: schedules, simulations and tests.

use std::iter::Peekable;

use pest::iterators::Pair;

use crate::syntax::arena::Arena;
use crate::syntax::convert::{Converter, parts};
use crate::syntax::grammar::Rule;
use crate::syntax::tree::{
    NameSyntax, ScheduleSyntax, Simulate, SpellSyntax, Test, TestItem, TestKind, TestRowSyntax, TestTable, UntilSyntax,
    With,
};

impl Converter<'_> {
    pub(crate) fn schedule(&mut self, pair: Pair<Rule>) -> ScheduleSyntax {
        let mut parts = parts(pair);
        let name = self.name(&parts.next().expect("a name"));
        let columns = self.names(parts.next().expect("columns"));
        ScheduleSyntax { name, columns, spells: self.spells(parts.next().expect("spells")) }
    }

    pub(crate) fn simulate(&mut self, pair: Pair<Rule>) -> Simulate {
        let mut parts = parts(pair).peekable();
        let swarm = self.name(&parts.next().expect("a name"));
        let world = self.named(Rule::in_world, &mut parts);
        let what = parts.next().expect("a schedule");
        let with = match what.as_rule() {
            Rule::name => With::Named(self.name(&what)),
            _ => With::Spells { columns: self.names(what), spells: self.spells(parts.next().expect("spells")) },
        };
        Simulate { swarm, world, with }
    }

    fn names(&self, pair: Pair<Rule>) -> Vec<NameSyntax> {
        parts(pair).map(|name| self.name(&name)).collect()
    }

    fn spells(&self, pair: Pair<Rule>) -> Vec<SpellSyntax> {
        parts(pair).map(|spell| self.spell(spell)).collect()
    }

    fn spell(&self, pair: Pair<Rule>) -> SpellSyntax {
        let span = self.span(&pair);
        let (cells, rest): (Vec<_>, Vec<_>) = parts(pair).partition(|part| part.as_rule() == Rule::cell);
        let length = self.quantity(rest.into_iter().next().expect("a length"));
        SpellSyntax { cells: cells.iter().map(|cell| self.name(cell)).collect(), length, span }
    }

    pub(super) fn named<'p>(
        &self,
        rule: Rule,
        parts: &mut Peekable<impl Iterator<Item = Pair<'p, Rule>>>,
    ) -> Option<NameSyntax> {
        let named = parts.next_if(|part| part.as_rule() == rule)?;
        super::convert::parts(named).next().map(|name| self.name(&name))
    }

    pub(crate) fn test(&mut self, pair: Pair<Rule>) -> Test {
        let mut parts = parts(pair).peekable();
        let circuit = self.instance(parts.next().expect("a circuit"));
        let title = parts.next_if(|part| part.as_rule() == Rule::text).map(|title| self.quoted(title));
        let environment = self.named(Rule::beside, &mut parts);
        let worlds = parts.next_if(|part| part.as_rule() == Rule::in_worlds).map_or(Vec::new(), |all| self.names(all));
        let what = parts.next().expect("what the circuit must do");
        let kind = match what.as_rule() {
            Rule::test_table => TestKind::Table(self.test_table(what)),
            Rule::from_file => self.rows_from_file(what),
            Rule::for_ever => TestKind::Ever(self.instance(super::convert::parts(what).next().expect("a circuit"))),
            _ => self.for_all(what),
        };
        Test { circuit, title, environment, worlds, kind }
    }

    fn rows_from_file(&self, pair: Pair<Rule>) -> TestKind {
        let mut parts = parts(pair);
        let path = self.quoted(parts.next().expect("a path"));
        let share = parts.next().and_then(|at_least| super::convert::parts(at_least).next());
        TestKind::FromFile { path, at_least: share.map(|share| self.quantity(share)) }
    }

    fn for_all(&mut self, pair: Pair<Rule>) -> TestKind {
        let reference = parts(pair).next().expect("a reference");
        match reference.as_rule() {
            Rule::instance => TestKind::Against(self.instance(reference)),
            _ => {
                let mut arena = Arena::default();
                let statements = self.statements(reference, &mut arena);
                TestKind::Reference(Box::new(arena.body(statements)))
            }
        }
    }

    fn test_table(&self, pair: Pair<Rule>) -> TestTable {
        let mut parts = parts(pair);
        let header = parts.next().expect("a header");
        let span = self.span(&header);
        let (inputs, _, outputs) = self.columns_of(header);
        TestTable { inputs, outputs, rows: parts.map(|row| self.test_item(row)).collect(), header: span }
    }

    fn test_item(&self, pair: Pair<Rule>) -> TestItem {
        if pair.as_rule() == Rule::row {
            return TestItem::Row(Box::new(self.test_row(pair)));
        }
        let span = self.span(&pair);
        let mut parts = parts(pair);
        let times = self.number(&parts.next().expect("a number"));
        TestItem::Repeat { times, rows: parts.map(|row| self.test_item(row)).collect(), span }
    }

    fn test_row(&self, pair: Pair<Rule>) -> TestRowSyntax {
        let span = self.span(&pair);
        let hold = parts(pair.clone()).find(|part| part.as_rule() == Rule::held);
        let hold = hold.map(|held| self.quantity(parts(held).next().expect("a quantity")));
        let until = parts(pair.clone()).find(|part| part.as_rule() == Rule::until).map(|until| self.until(until));
        let (inputs, bars, outputs) = self.columns_of(pair);
        TestRowSyntax { inputs, bars, outputs, hold, until, span }
    }

    fn until(&self, pair: Pair<Rule>) -> UntilSyntax {
        let mut parts = parts(pair).peekable();
        let output = self.name(&parts.next().expect("a name"));
        let value = parts.next_if(|part| part.as_rule() == Rule::cell).map(|value| self.name(&value));
        UntilSyntax { output, value, most: self.number(&parts.next().expect("a number")) }
    }

    fn columns_of(&self, pair: Pair<Rule>) -> (Vec<NameSyntax>, Vec<nbc_base::source::Span>, Vec<NameSyntax>) {
        let (mut before, mut bars, mut after) = (Vec::new(), Vec::new(), Vec::new());
        for part in parts(pair) {
            match part.as_rule() {
                Rule::bar => bars.push(self.span(&part)),
                Rule::held | Rule::until => {}
                _ if bars.is_empty() => before.push(self.name(&part)),
                _ => after.push(self.name(&part)),
            }
        }
        (before, bars, after)
    }
}
