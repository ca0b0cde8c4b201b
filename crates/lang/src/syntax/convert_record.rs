//! Pest's pairs to the tree: records and their values.

use pest::iterators::Pair;

use crate::syntax::arena::Arena;
use crate::syntax::convert::{Converter, parts};
use crate::syntax::grammar::Rule;
use crate::syntax::tree::{Field, InstanceSyntax, RecordSyntax, ValueKind, ValueSyntax};
use crate::syntax::wording;

impl Converter<'_> {
    pub(crate) fn record(&mut self, pair: Pair<Rule>) -> RecordSyntax {
        let span = self.span(&pair);
        RecordSyntax { fields: parts(pair).map(|field| self.field(field)).collect(), span }
    }

    fn field(&mut self, pair: Pair<Rule>) -> Field {
        let mut parts = parts(pair).peekable();
        let name = self.name(&parts.next().expect("a name"));
        if let Some(slip) = parts.next_if(|part| part.as_rule() == Rule::slip_equals) {
            self.errors.push(wording::field_sign(&name.text, self.span(&slip)));
        }
        Field { name, value: self.value(parts.next().expect("a value")) }
    }

    fn value(&mut self, pair: Pair<Rule>) -> ValueSyntax {
        let span = self.span(&pair);
        let kind = match pair.as_rule() {
            Rule::record => ValueKind::Record(self.record(pair)),
            Rule::list => ValueKind::List(parts(pair).map(|value| self.value(value)).collect()),
            Rule::text => ValueKind::Text(self.quoted(pair).text),
            Rule::quantity => ValueKind::Quantity(self.quantity(pair)),
            Rule::instance => ValueKind::Instance(self.instance(pair)),
            Rule::function => {
                ValueKind::Instance(InstanceSyntax { name: self.name(&pair), arguments: Vec::new(), sizes: Vec::new() })
            }
            rule => self.pair_of_values(rule, pair),
        };
        ValueSyntax { kind, span }
    }

    fn pair_of_values(&mut self, rule: Rule, pair: Pair<Rule>) -> ValueKind {
        let mut parts = parts(pair);
        let first = parts.next().expect("a first value");
        match rule {
            Rule::product => {
                ValueKind::Product(self.number(&first), self.number(&parts.next().expect("a second number")))
            }
            Rule::bins => ValueKind::Bins(self.name(&first), self.number(&parts.next().expect("a number of bins"))),
            Rule::applied => ValueKind::Applied(self.name(&first), parts.map(|value| self.value(value)).collect()),
            Rule::range => {
                let low = self.quantity(first);
                ValueKind::Range(low, self.quantity(parts.next().expect("an end")))
            }
            rule => unreachable!("a value is not {rule:?}"),
        }
    }

    pub(crate) fn instance(&mut self, pair: Pair<Rule>) -> InstanceSyntax {
        let mut arena = Arena::default();
        let mut parts = parts(pair);
        let name = self.name(&parts.next().expect("a name"));
        let arguments = parts.next().map_or(Vec::new(), |arguments| self.arguments(arguments, &mut arena));
        InstanceSyntax { name, arguments, sizes: arena.sizes }
    }
}
