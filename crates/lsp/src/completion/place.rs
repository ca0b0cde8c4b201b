//! Where in a declaration a place is, read from the tokens before it, because a text that is being written seldom
//! parses.

use std::ops::Range;

use nbc_lang::check::{Holds, NameKind, record_fields};
use nbc_lang::syntax::{KEYWORDS, Token, TokenKind};

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Place<'t> {
    Name(NameKind),
    Outside,
    NewName,
    Unit,
    Field(&'t str),
    Value(&'t str, &'t str),
    Statement,
    Operand,
    Infix,
    Size,
    /// The ports of the tested circuit of that name, or of the simulated swarm.
    Columns(&'t str),
    Row,
    Schedule,
    UsedFile,
}

pub(super) struct Before<'t> {
    pub(super) text: &'t str,
    /// From the keyword on, without the word that is being written.
    pub(super) tokens: &'t [Token],
    /// As indices.
    open: Vec<usize>,
}

impl<'t> Before<'t> {
    pub(super) fn of(text: &'t str, tokens: &'t [Token], offset: usize) -> Self {
        let is_before = |token: &Token| match token.kind {
            TokenKind::Word | TokenKind::Number => token.range.end < offset,
            _ => token.range.end <= offset,
        };
        let end = tokens.iter().take_while(|token| is_before(token)).count();
        let start = (0..end).rev().find(|&at| begins(text, tokens, at)).unwrap_or(end);
        let tokens = &tokens[start..end];
        let mut open = Vec::new();
        for (at, token) in tokens.iter().enumerate() {
            match &text[token.range.clone()] {
                "{" | "(" | "[" => open.push(at),
                "}" | ")" | "]" => _ = open.pop(),
                _ => {}
            }
        }
        Self { text, tokens, open }
    }

    fn word(&self, at: usize) -> &'t str {
        self.tokens.get(at).map_or("", |token| &self.text[token.range.clone()])
    }

    fn last(&self) -> &'t str {
        self.tokens.len().checked_sub(1).map_or("", |last| self.word(last))
    }

    fn bracket(&self) -> &'t str {
        self.open.last().map_or("", |&at| self.word(at))
    }

    pub(super) fn place(&self, offset: usize) -> Place<'t> {
        let is_number = self.tokens.last().is_some_and(|token| token.kind == TokenKind::Number);
        match self.word(0) {
            "" => Place::Outside,
            _ if self.is_complete(offset) => Place::Outside,
            "use" => Place::UsedFile,
            "circuit" => self.in_circuit(offset),
            "test" => self.in_test(offset),
            "prove" => match self.open.first() {
                None if self.tokens.len() == 1 => Place::Name(NameKind::Circuit),
                None => Place::NewName,
                Some(_) => Place::Columns(self.word(1)),
            },
            "simulate" | "schedule" if is_number && self.last_word_before() == "for" => Place::Unit,
            "simulate" => self.in_simulation(),
            "schedule" => match self.bracket() {
                "(" => Place::Name(NameKind::Stimulus),
                "{" => Place::Row,
                _ => Place::NewName,
            },
            "material" | "evolution" | "images" | "library" | "swarm" | "world" => self.in_record(is_number),
            _ => Place::NewName,
        }
    }

    fn last_word_before(&self) -> &'t str {
        self.tokens.len().checked_sub(2).map_or("", |at| self.word(at))
    }

    fn is_complete(&self, offset: usize) -> bool {
        let has_braces = self.tokens.iter().any(|token| &self.text[token.range.clone()] == "{");
        let has_ended =
            self.open.is_empty() && self.last() != "," && (has_braces || matches!(self.word(0), "use" | "stimulus"));
        has_ended && self.is_first(offset)
    }

    fn is_first(&self, offset: usize) -> bool {
        let last = self.tokens.last().map_or(0, |token| token.range.end);
        self.text[last.min(offset)..offset].contains('\n')
    }

    fn in_circuit(&self, offset: usize) -> Place<'t> {
        let body = self.open.iter().position(|&at| self.word(at) == "{");
        match (body, self.bracket()) {
            (None, "[") => Place::Size,
            (None, _) => Place::NewName,
            (Some(_), "[") => Place::Size,
            (Some(_), _) => self.in_body(offset),
        }
    }

    fn in_body(&self, offset: usize) -> Place<'t> {
        let last = self.last();
        let is_value = self.tokens.last().is_some_and(|token| match token.kind {
            TokenKind::Number => true,
            TokenKind::Word => !WORDS_BEFORE_VALUES.contains(&last),
            _ => matches!(last, ")" | "]" | "}"),
        });
        match last {
            "net" => Place::NewName,
            "in" | "init" | ".." => Place::Size,
            "{" if self.is_block() => Place::Statement,
            _ if self.bracket() == "{" && self.is_block() && self.is_first(offset) && (is_value || last == "}") => {
                Place::Statement
            }
            _ if is_value => Place::Infix,
            _ => Place::Operand,
        }
    }

    fn is_block(&self) -> bool {
        let Some(&at) = self.open.last() else { return false };
        let line = self.text[..self.tokens[at].range.start].rfind('\n').map_or(0, |end| end + 1);
        let is_loop = self.text[line..].trim_start().starts_with("for ");
        self.open.len() == 1 || is_loop
    }

    fn in_test(&self, offset: usize) -> Place<'t> {
        let has = |word: &str| (1..self.tokens.len()).any(|at| self.word(at) == word);
        match self.open.first().map(|&at| self.word(at)) {
            _ if self.tokens.len() == 1 || self.last() == "against" => Place::Name(NameKind::Circuit),
            None if self.last() == "in" => Place::Name(NameKind::World),
            Some("{") if has("all") && has("inputs") => self.in_body(offset),
            Some("{") if has("|") && self.is_row(offset) => match self.tokens.last().map(|token| token.kind) {
                Some(TokenKind::Number) if self.last_word_before() == "for" => Place::Unit,
                _ => Place::Row,
            },
            Some("{") => Place::Columns(self.word(1)),
            Some(_) => Place::Size,
            None => Place::NewName,
        }
    }

    fn is_row(&self, offset: usize) -> bool {
        let bar = self.tokens.iter().find(|token| &self.text[token.range.clone()] == "|");
        bar.is_some_and(|bar| self.text[bar.range.end..offset].contains('\n'))
    }

    fn in_simulation(&self) -> Place<'t> {
        match (self.tokens.len(), self.last(), self.bracket()) {
            (1, ..) => Place::Name(NameKind::Swarm),
            (_, "in", _) => Place::Name(NameKind::World),
            (_, "with", _) => Place::Schedule,
            (.., "(") => Place::Columns(self.word(1)),
            (.., "{") => Place::Row,
            _ => Place::NewName,
        }
    }

    fn in_record(&self, is_number: bool) -> Place<'t> {
        let Some(&brace) = self.open.first() else { return Place::NewName };
        if is_number {
            return Place::Unit;
        }
        // The last field whose colon is directly in the record.
        let mut field = None;
        let mut depth = 0;
        for at in brace + 1..self.tokens.len() {
            match self.word(at) {
                "{" | "[" | "(" => depth += 1,
                "}" | "]" | ")" => depth -= 1,
                ":" if depth == 0 => field = Some(self.word(at - 1)),
                "," if depth == 0 => field = None,
                _ => {}
            }
        }
        let holds = record_fields(self.word(0)).iter().find(|known| Some(known.name) == field).map(|known| known.holds);
        match field {
            Some(_)
                if depth > 0
                    && let Some(Holds::Record(inner)) = holds =>
            {
                Place::Field(inner)
            }
            Some(_) if depth == 0 && self.last() != ":" => Place::Field(self.word(0)),
            Some(field) => Place::Value(self.word(0), field),
            None => Place::Field(self.word(0)),
        }
    }
}

const WORDS_BEFORE_VALUES: [&str; 10] = ["and", "else", "if", "nand", "nor", "not", "or", "then", "xnor", "xor"];

fn begins(text: &str, tokens: &[Token], at: usize) -> bool {
    let Range { start, .. } = tokens[at].range;
    KEYWORDS.contains(&&text[tokens[at].range.clone()]) && (start == 0 || text[..start].ends_with(['\n', '\r']))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tokens::tokens;

    fn place(text: &str) -> String {
        let offset = text.find('$').unwrap();
        let text = text.replace('$', "");
        format!("{:?}", Before::of(&text, &tokens(&text), offset).place(offset))
    }

    #[test]
    fn places_of_circuits() {
        let body = |rest: &str| place(&format!("circuit f(a, b) -> (q) {{\n    {rest}"));
        assert_eq!([body("$"), body("q = a\n    $"), body("for i in 0..2 {\n    $")], ["Statement"; 3]);
        assert_eq!([body("q = $"), body("q = a and $"), body("q = f(a, $"), body("q = {a, $")], ["Operand"; 4]);
        assert_eq!([body("q = a $"), body("q = f(a) $"), body("q = if a $")], ["Infix"; 3]);
        assert_eq!([body("q = a[$"), body("q init $"), body("for i in 0..$")], ["Size"; 3]);
        assert_eq!([body("net $"), place("circuit $"), place("circuit f($")], ["NewName"; 3]);
    }

    #[test]
    fn places_of_other_declarations() {
        assert_eq!([place("$"), place("use \"a\"\n$"), place("circuit f(a) -> (q) { q = a }\n\n$")], ["Outside"; 3]);
        assert_eq!([place("use $"), place("use \"a\",\n    $")], ["UsedFile"; 2]);
        assert_eq!(
            [place("test $"), place("test f for all inputs against $"), place("test f \"as\" against $")],
            ["Name(Circuit)"; 3]
        );
        assert_eq!(place("test f {\n    a $"), "Columns(\"f\")");
        assert_eq!(place("test f {\n    a | q\n    0 $"), "Row");
        assert_eq!(place("test f {\n    a | q\n    0 | 1 for 3 $"), "Unit");
        assert_eq!(place("test f for all inputs {\n    q = $"), "Operand");
        assert_eq!(place("swarm s { $"), "Field(\"swarm\")");
        assert_eq!(place("swarm s { circuit: $"), "Value(\"swarm\", \"circuit\")");
        assert_eq!(place("swarm s {\n    circuit: f\n    $"), "Field(\"swarm\")");
        assert_eq!(place("library l { from: shipped, behaviors: [nand, $"), "Value(\"library\", \"behaviors\")");
        assert_eq!(place("evolution e { mutation: { $"), "Field(\"mutation\")");
        assert_eq!(place("evolution e { vary: { all: 5%, $"), "Field(\"variation\")");
        assert_eq!(place("material m { period: 3 $"), "Unit");
        assert_eq!([place("simulate $"), place("simulate s with $")], ["Name(Swarm)", "Schedule"]);
        assert_eq!(place("simulate s with schedule ($"), "Columns(\"s\")");
        assert_eq!([place("simulate s in $"), place("test f \"t\" in $")], ["Name(World)"; 2]);
        assert_eq!(place("world w { from: $"), "Value(\"world\", \"from\")");
        assert_eq!([place("schedule s($"), place("schedule s(a) {\n    $")], ["Name(Stimulus)", "Row"]);
        assert_eq!(place("schedule s(a) {\n    0 for 3 $"), "Unit");
    }
}
