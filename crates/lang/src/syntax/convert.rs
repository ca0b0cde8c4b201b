//! From pest's pairs to the tree: the parts shared by all kinds of declarations. Mistakes that the grammar recognizes
//! become diagnostics here.

use std::ops::Range;

use pest::iterators::{Pair, Pairs};

use crate::syntax::arena::Arena;
use crate::syntax::grammar::Rule;
use crate::syntax::lexer::is_word;
use crate::syntax::tree::{
    CircuitSyntax, Declaration, DeclarationKind, EnumerationSyntax, FileSyntax, LetSyntax, MemberSyntax, NameSyntax,
    Number, Quantity, RecordDeclaration, RecordKeyword, StimulusSyntax, Text,
};
use crate::syntax::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::source::{FileId, Span};

pub(crate) struct Converter<'a> {
    pub(crate) file: FileId,
    /// The text of the declaration; `comments` are those of the whole file.
    pub(crate) source: &'a str,
    pub(crate) comments: &'a [Range<usize>],
    pub(crate) offset: usize,
    pub(crate) errors: Vec<Diagnostic>,
    /// Statements whose meaning is unknown.
    pub(crate) lost: Vec<Span>,
}

impl<'a> Converter<'a> {
    pub(crate) fn new(file: FileId, source: &'a str, comments: &'a [Range<usize>], offset: usize) -> Self {
        Self { file, source, comments, offset, errors: Vec::new(), lost: Vec::new() }
    }

    /// `None` for a common mistake without a tree.
    pub(crate) fn declaration(&mut self, pairs: Pairs<Rule>) -> Option<Declaration> {
        let pair = solid(pairs).next().expect("a parsed declaration has a pair");
        let span = self.span(&pair);
        let kind = match pair.as_rule() {
            Rule::use_file => DeclarationKind::Use(parts(pair).map(|path| self.quoted(path)).collect()),
            Rule::stimulus => DeclarationKind::Stimulus(parts(pair).map(|sensed| self.sensed(sensed)).collect()),
            Rule::material => self.record_declaration(RecordKeyword::Material, pair),
            Rule::images => self.record_declaration(RecordKeyword::Images, pair),
            Rule::evolution => self.record_declaration(RecordKeyword::Evolution, pair),
            Rule::library => self.record_declaration(RecordKeyword::Library, pair),
            Rule::swarm => self.record_declaration(RecordKeyword::Swarm, pair),
            Rule::world => self.record_declaration(RecordKeyword::World, pair),
            Rule::schedule => DeclarationKind::Schedule(self.schedule(pair)),
            Rule::simulate => DeclarationKind::Simulate(self.simulate(pair)),
            Rule::circuit => DeclarationKind::Circuit(self.circuit(pair, false)),
            Rule::environment => DeclarationKind::Circuit(self.circuit(pair, true)),
            Rule::enumeration => DeclarationKind::Enumeration(self.enumeration(pair)),
            Rule::constant_integer => {
                let (mut arena, mut parts) = (Arena::default(), parts(pair));
                let name = self.name(&parts.next().expect("a name"));
                self.size(parts.next().expect("an integer"), &mut arena);
                DeclarationKind::Let(LetSyntax { name, sizes: arena.sizes })
            }
            Rule::file_name => {
                let mut parts = parts(pair);
                let name = self.name(&parts.next().expect("a name"));
                DeclarationKind::File(FileSyntax { name, path: self.quoted(parts.next().expect("a path")) })
            }
            Rule::prove => DeclarationKind::Prove(self.prove(pair)),
            Rule::test => DeclarationKind::Test(self.test(pair)),
            Rule::slip_declaration => {
                self.slip_declaration(pair);
                return None;
            }
            rule => unreachable!("a declaration is not {rule:?}"),
        };
        Some(Declaration { span, kind })
    }

    fn slip_declaration(&mut self, pair: Pair<Rule>) {
        let word = pair.as_str().split(|c: char| !is_word(c)).next().unwrap_or_default();
        let start = self.span(&pair).start as usize;
        let span = Span::new(self.file, start, start + word.len());
        self.errors.push(wording::foreign_circuit(word, span));
    }

    fn sensed(&mut self, pair: Pair<Rule>) -> StimulusSyntax {
        let mut parts = parts(pair);
        let name = self.name(&parts.next().expect("a name"));
        let image = parts.next().zip(parts.next()).map(|(rows, columns)| [self.number(&rows), self.number(&columns)]);
        StimulusSyntax { name, image }
    }

    fn record_declaration(&mut self, keyword: RecordKeyword, pair: Pair<Rule>) -> DeclarationKind {
        let mut parts = parts(pair);
        let name = self.name(&parts.next().expect("a name"));
        let record = self.record(parts.next().expect("a record"));
        DeclarationKind::Record(RecordDeclaration { keyword, name, record })
    }

    fn enumeration(&mut self, pair: Pair<Rule>) -> EnumerationSyntax {
        let mut parts = parts(pair).peekable();
        let name = self.name(&parts.next().expect("a name"));
        let encoding = parts.next_if(|part| part.as_rule() == Rule::encoding);
        let encoding = encoding.map(|word| self.name(&crate::syntax::convert::parts(word).next().expect("a name")));
        let member = |pair: Pair<Rule>| {
            let mut parts = crate::syntax::convert::parts(pair);
            let name = self.name(&parts.next().expect("a name"));
            MemberSyntax { name, value: parts.next().map(|value| self.name(&value)) }
        };
        let members = parts.map(member).collect();
        EnumerationSyntax { name, encoding, members }
    }

    fn circuit(&mut self, pair: Pair<Rule>, is_environment: bool) -> CircuitSyntax {
        let mut arena = Arena::default();
        let mut parts = parts(pair).peekable();
        if let Some(word) = parts.next_if(|part| part.as_rule() == Rule::slip_circuit) {
            self.errors.push(wording::circuit_keyword(word.as_str(), self.span(&word)));
        }
        let name = self.name(&parts.next().expect("a name"));
        let parameters = match parts.peek().map(Pair::as_rule) {
            Some(Rule::parameters) => self.parameters(parts.next().expect("parameters"), &mut arena),
            _ => Vec::new(),
        };
        let inputs = self.ports(parts.next().expect("inputs"), &mut arena);
        let outputs = self.outputs(parts.next().expect("outputs"), &mut arena);
        let statements = self.statements(parts.next().expect("a body"), &mut arena);
        CircuitSyntax { is_environment, name, parameters, inputs, outputs, body: arena.body(statements) }
    }

    pub(crate) fn span(&self, pair: &Pair<Rule>) -> Span {
        let span = pair.as_span();
        let start = self.offset + span.start();
        Span::new(self.file, start, self.solid_end(start, self.offset + span.end()))
    }

    pub(crate) fn text(&self, span: Span) -> &str {
        &self.source[span.start as usize - self.offset..span.end as usize - self.offset]
    }

    /// Pest includes the spaces and comments after a text.
    fn solid_end(&self, start: usize, mut end: usize) -> usize {
        loop {
            end = start + self.source[start - self.offset..end - self.offset].trim_end().len();
            let after = self.comments.partition_point(|comment| comment.start < end);
            match after.checked_sub(1).map(|last| &self.comments[last]) {
                Some(last) if last.start > start && last.end >= end => end = last.start,
                _ => return end,
            }
        }
    }

    pub(crate) fn name(&self, pair: &Pair<Rule>) -> NameSyntax {
        NameSyntax { text: pair.as_str().to_owned(), span: self.span(pair) }
    }

    pub(crate) fn number(&self, pair: &Pair<Rule>) -> Number {
        Number { text: pair.as_str().to_owned(), span: self.span(pair) }
    }

    pub(crate) fn quoted(&self, pair: Pair<Rule>) -> Text {
        let span = self.span(&pair);
        Text { text: parts(pair).map(|part| part.as_str().to_owned()).collect(), span }
    }

    pub(crate) fn quantity(&self, pair: Pair<Rule>) -> Quantity {
        let mut parts = parts(pair);
        let number = self.number(&parts.next().expect("a number"));
        Quantity { number, unit: parts.next().map(|unit| self.name(&unit)) }
    }
}

pub(crate) fn parts(pair: Pair<Rule>) -> impl Iterator<Item = Pair<Rule>> {
    solid(pair.into_inner())
}

fn solid(pairs: Pairs<Rule>) -> impl Iterator<Item = Pair<Rule>> {
    // The grammar has these words one after another.
    let words = Rule::circuit_word..=Rule::log2_word;
    pairs.filter(move |pair| {
        let rule = pair.as_rule();
        !matches!(rule, Rule::EOI | Rule::COMMENT) && !words.contains(&rule)
    })
}
