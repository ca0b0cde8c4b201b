//! Pest's pairs to the tree: properties of circuits.

use pest::iterators::Pair;

use crate::syntax::arena::Arena;
use crate::syntax::convert::{Converter, parts};
use crate::syntax::grammar::Rule;
use crate::syntax::tree::{PropertySyntax, Prove};
use nbc_base::model::PropertyKind;

impl Converter<'_> {
    pub(crate) fn prove(&mut self, pair: Pair<Rule>) -> Prove {
        let mut parts = parts(pair).peekable();
        let circuit = self.instance(parts.next().expect("a circuit"));
        let title = parts.next_if(|part| part.as_rule() == Rule::text).map(|title| self.quoted(title));
        let environment = self.named(Rule::beside, &mut parts);
        let mut arena = Arena::default();
        let properties = parts.map(|property| self.property(property, &mut arena)).collect();
        Prove { circuit, title, environment, properties, body: arena.body(Vec::new()) }
    }

    fn property(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> PropertySyntax {
        let span = self.span(&pair);
        let mut parts = parts(pair).peekable();
        let quantifier = parts.next().expect("a word");
        let kind = PropertyKind::parse(quantifier.as_str()).expect("the grammar knows the words");
        let first = self.expression(parts.next().expect("an expression"), arena);
        let (condition, value) = match parts.next_if(|part| part.as_rule() == Rule::implies) {
            Some(_) => (Some(first), self.expression(parts.next().expect("an expression"), arena)),
            None => (None, first),
        };
        let within = parts.next().map(|within| {
            let steps = crate::syntax::convert::parts(within).next().expect("a number");
            self.number(&steps)
        });
        PropertySyntax { kind, word: self.span(&quantifier), condition, value, within, span }
    }
}
