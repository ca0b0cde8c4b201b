//! Finds every bad part of a declaration that does not follow the grammar as a whole. Its statements, fields and rows
//! are cut apart by their lines and brackets, and each is parsed alone.

use std::ops::Range;

use pest::Parser;

use crate::syntax::arena::Arena;
use crate::syntax::convert::{Converter, parts};
use crate::syntax::expected;
use crate::syntax::grammar::NbParser;
use crate::syntax::lexer::{Token, TokenKind, bracket, tokens};
use crate::syntax::part::{PartKind, PartPlace};
use nbc_base::diag::Diagnostic;
use nbc_base::model::PropertyKind;
use nbc_base::source::FileId;

pub(crate) struct Recovered {
    pub(crate) errors: Vec<Diagnostic>,
    /// The first is the whole declaration if its own text is bad.
    pub(crate) broken: Vec<Range<usize>>,
    pub(crate) kept: Vec<(PartKind, Range<usize>)>,
}

/// `source` begins at `offset` of its file and follows the grammar up to `reached`.
pub(crate) fn recover(file: FileId, source: &str, offset: usize, reached: usize) -> Recovered {
    let tokens: Vec<_> = tokens(source).filter(|token| token.kind != TokenKind::Comment).collect();
    let all = 0..tokens.len();
    let found = Recovered { errors: Vec::new(), broken: Vec::new(), kept: Vec::new() };
    let mut recovery = Recovery { file, source, offset, reached, tokens, found };
    recovery.part(PartKind::Declaration, all);
    recovery.found
}

pub(crate) fn slips(converter: &mut Converter<'_>, kind: PartKind, source: &str) {
    let Some(pair) = NbParser::parse(kind.rule(), source).ok().and_then(|mut pairs| pairs.next()) else { return };
    let mut arena = Arena::default();
    match kind {
        PartKind::Statement => _ = converter.statements(pair, &mut arena),
        PartKind::Field => _ = converter.record(pair),
        PartKind::TableRow => parts(pair).for_each(|row| _ = converter.table_row(row, &mut arena)),
        PartKind::Declaration | PartKind::Spell | PartKind::Property | PartKind::Row => {}
    }
}

struct Recovery<'a> {
    file: FileId,
    source: &'a str,
    offset: usize,
    reached: usize,
    tokens: Vec<Token>,
    found: Recovered,
}

struct PartBlock {
    holds: PartKind,
    tokens: Range<usize>,
}

impl Recovery<'_> {
    fn word(&self, at: usize) -> &str {
        self.tokens.get(at).map_or("", |token| &self.source[token.range.clone()])
    }

    fn bytes(&self, tokens: &Range<usize>) -> Range<usize> {
        self.tokens[tokens.start].range.start..self.tokens[tokens.end - 1].range.end
    }

    /// Parses a part without the blocks in it, then the parts in these. Returns whether it can be kept.
    fn part(&mut self, kind: PartKind, tokens: Range<usize>) -> bool {
        let blocks = self.blocks(kind, &tokens);
        let range = self.bytes(&tokens);
        let cuts: Vec<_> = blocks.iter().map(|block| self.bytes(&block.tokens)).collect();
        let mut shell = String::new();
        let mut from = range.start;
        for cut in &cuts {
            shell += &self.source[from..cut.start];
            from = cut.end;
        }
        shell += &self.source[from..range.end];
        let mut keep = true;
        if let Err(error) = NbParser::parse(kind.rule(), &shell) {
            let mut at = range.start + expected::place(&error);
            for cut in cuts.iter().filter(|cut| !cut.is_empty()) {
                at += if at >= cut.start { cut.len() } else { 0 };
            }
            let (file, source, offset) = (self.file, self.source, self.offset);
            let place = PartPlace { file, source, offset, kind, start: range.start, end: range.end };
            self.found.errors.push(expected::diagnostic(&place, at, &error));
            keep = false;
        } else if blocks.is_empty() {
            self.found.kept.push((kind, range.clone()));
        }
        let at = self.found.broken.len();
        for block in blocks {
            let units = self.units(&block);
            for (unit, next) in units.iter().cloned().zip(units.iter().skip(1).map(Some).chain([None])) {
                if next.is_some_and(|next| self.is_passed(next)) {
                    self.found.kept.push((block.holds, self.bytes(&unit)));
                    continue;
                }
                // A table without one of its rows has another meaning.
                keep &= self.part(block.holds, unit) || block.holds != PartKind::TableRow;
            }
        }
        if !keep {
            self.found.broken.insert(at, range);
        }
        keep
    }

    /// Up to its first `=` or `:`, a part may read like the end of an incomplete one before it.
    fn is_passed(&self, part: &Range<usize>) -> bool {
        let sign = part.clone().find(|&at| matches!(self.word(at), "=" | ":"));
        let second = (part.start + 1).min(part.end - 1);
        self.reached > self.tokens[sign.unwrap_or(second)].range.start
    }

    fn blocks(&self, kind: PartKind, tokens: &Range<usize>) -> Vec<PartBlock> {
        let mut blocks = Vec::new();
        let mut at = tokens.start;
        let tables = match kind {
            PartKind::Statement | PartKind::Property => self.tables(tokens),
            _ => Vec::new(),
        };
        while at < tokens.end {
            let is_table = tables.contains(&at).then_some(PartKind::TableRow);
            if self.word(at) == "{"
                && let Some(holds) = self.holds(kind, tokens.start, at).or(is_table)
            {
                let end = self.closing(at, tokens.end);
                let mut start = at + 1;
                if kind == PartKind::Declaration && holds == PartKind::Row {
                    start += 1;
                    while start < end && !self.tokens[start].is_first {
                        start += 1;
                    }
                }
                if start < end {
                    blocks.push(PartBlock { holds, tokens: start..end });
                }
                at = end;
            }
            at += 1;
        }
        blocks
    }

    fn holds(&self, kind: PartKind, start: usize, at: usize) -> Option<PartKind> {
        match (kind, self.word(start)) {
            (PartKind::Declaration, "circuit" | "environment" | "module" | "fn" | "def" | "function") => {
                Some(PartKind::Statement)
            }
            (PartKind::Declaration, "test") if self.word(at - 1) == "inputs" => Some(PartKind::Statement),
            (PartKind::Declaration, "test") => Some(PartKind::Row),
            (PartKind::Declaration, "prove") => Some(PartKind::Property),
            (PartKind::Declaration, "schedule" | "simulate") => Some(PartKind::Spell),
            (PartKind::Declaration, "material" | "evolution" | "images" | "library" | "swarm" | "world") => {
                Some(PartKind::Field)
            }
            (PartKind::Statement, "for") => Some(PartKind::Statement),
            (PartKind::Row, "repeat") => Some(PartKind::Row),
            (PartKind::Field, _) => Some(PartKind::Field),
            _ => None,
        }
    }

    fn tables(&self, part: &Range<usize>) -> Vec<usize> {
        let mut tables = Vec::new();
        // Each open bracket, with the heads of tables in it that have no rows so far.
        let mut open: Vec<(usize, usize)> = vec![(part.start, 0)];
        for at in part.clone() {
            let (before, here, next) = (self.word(at.wrapping_sub(1)), self.word(at), self.word(at + 1));
            let ends_operand = at > part.start && !continues_after(before) && !matches!(before, "(" | "[" | "{");
            let heads = &mut open.last_mut().expect("the part itself is open").1;
            match here {
                "match" if !ends_operand && !matches!(next, "=" | "," | ")") => *heads += 1,
                "table" if next == "(" => *heads += 1,
                "{" if ends_operand && *heads > 0 => {
                    *heads -= 1;
                    tables.push(at);
                }
                _ => {}
            }
            match here {
                "(" | "[" | "{" => open.push((at, 0)),
                ")" | "]" | "}" if open.len() > 1 => _ = open.pop(),
                _ => {}
            }
        }
        tables
    }

    fn closing(&self, at: usize, end: usize) -> usize {
        let mut depth = 0;
        for place in at..end {
            match self.word(place) {
                "{" => depth += 1,
                "}" => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return place;
            }
        }
        end
    }

    fn units(&self, block: &PartBlock) -> Vec<Range<usize>> {
        let mut units: Vec<Range<usize>> = Vec::new();
        let mut open = Vec::new();
        for at in block.tokens.clone() {
            let within_braces = open.iter().any(|&open| self.word(open) == "{");
            let is_loose = open.is_empty() || !within_braces && self.is_new_statement(block.holds, at);
            match units.last_mut() {
                Some(unit) if !(is_loose && self.starts(block.holds, at)) => unit.end = at + 1,
                _ => {
                    open.clear();
                    units.push(at..at + 1);
                }
            }
            bracket(&mut open, self.word(at), at, |&open| self.word(open));
        }
        units
    }

    /// Whether a line begins like a statement, even within an unclosed parenthesis.
    fn is_new_statement(&self, holds: PartKind, at: usize) -> bool {
        holds == PartKind::Statement
            && self.tokens[at].is_first
            && (self.word(at + 1) == "=" || self.word(at + 2) == "in")
    }

    fn starts(&self, holds: PartKind, at: usize) -> bool {
        let (before, here, next) = (self.word(at - 1), self.word(at), self.word(at + 1));
        let is_first = self.tokens[at].is_first;
        match holds {
            PartKind::Row => is_first,
            PartKind::Property => is_first && PropertyKind::parse(here).is_some(),
            PartKind::Spell => is_first && here != "for" && before != "for",
            PartKind::Field => {
                let is_named = matches!(next, ":" | "=") && here.starts_with(|c: char| c.is_alphabetic() || c == '_');
                is_named || before == "," || is_first && !continues(before, here)
            }
            PartKind::TableRow => before == "," || is_first && (here == "-" || !continues(before, here)),
            _ => self.is_new_statement(holds, at) || is_first && !continues(before, here),
        }
    }
}

fn continues(before: &str, here: &str) -> bool {
    continues_after(before) || is_infix(here) || matches!(here, "{" | "x")
}

fn continues_after(before: &str) -> bool {
    is_infix(before) || matches!(before, "not" | "if" | "net" | "for" | "match" | "~" | "!")
}

fn is_infix(word: &str) -> bool {
    let words = ["and", "nand", "or", "nor", "xor", "xnor", "then", "else", "init", "in"];
    let signs = [
        "=", "=>", "+", "-", "*", "/", "%", "**", "<<", ">>", "..", "==", "!=", "<", "<=", ">", ">=", "&", "|", "^",
        "?", ":", ":=", ",",
    ];
    words.contains(&word) || signs.contains(&word)
}
