//! A program as it is written, as far as checks of lessons look at it: without comments and space.

use std::collections::BTreeSet;

use serde::Serialize;

use nbc_base::source::{Sources, Span};
use nbc_lang::syntax::tree::{Declaration, DeclarationKind, ExpressionSyntaxKind};
use nbc_lang::syntax::{TokenKind, parse, tokens};

/// Stands for every call of a circuit that the program does not declare.
pub(crate) const CALLS: &str = "calls";

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct WrittenProgram {
    /// Its tokens, with a space between two.
    pub(crate) text: String,
    /// The words and signs of its circuits, each once, and `calls` if they call circuits of other files.
    pub(crate) words: BTreeSet<String>,
    /// The lines of its tests and claims.
    pub(crate) kept: BTreeSet<String>,
}

impl WrittenProgram {
    pub(crate) fn of(text: &str) -> Self {
        let mut sources = Sources::default();
        let file = sources.add("", text);
        let tree = parse(&sources, file).tree;
        let code = |span: Span| sources.text(span);
        let mut written = Self { text: plain(text), ..Self::default() };
        for declaration in &tree.declarations {
            let Declaration { span, kind } = &**declaration;
            if matches!(kind, DeclarationKind::Circuit(_)) {
                written.words.extend(words(code(*span)).filter(|word| *word != "->").map(str::to_owned));
            }
            if matches!(kind, DeclarationKind::Test(_) | DeclarationKind::Prove(_)) {
                written.kept.extend(code(*span).lines().map(plain).filter(|line| !line.is_empty()));
            }
        }
        let circuits = tree.declarations.iter().filter_map(|declaration| match &declaration.kind {
            DeclarationKind::Circuit(circuit) => Some(circuit),
            _ => None,
        });
        let own: BTreeSet<&str> = circuits.clone().map(|circuit| circuit.name.text.as_str()).collect();
        let is_foreign = |kind: &ExpressionSyntaxKind| match kind {
            ExpressionSyntaxKind::Call { name, .. } => !own.contains(name.text.as_str()),
            _ => false,
        };
        if circuits.clone().flat_map(|circuit| &circuit.body.expressions).any(|one| is_foreign(&one.kind)) {
            written.words.insert(CALLS.to_owned());
        }
        written
    }
}

/// The tokens of a text without its comments.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let all = tokens(text).filter(|token| !matches!(token.kind, TokenKind::Comment | TokenKind::ForeignComment));
    all.map(|token| &text[token.range])
}

fn plain(text: &str) -> String {
    words(text).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_space_are_no_part_of_a_program() {
        let one = WrittenProgram::of("circuit g(a) -> (q) {\n    q = not a // xor\n}\n\n// more\n");
        assert_eq!(one, WrittenProgram::of("circuit g(a) -> (q) { q = not a }"));
        assert!(one.words.contains("not") && !one.words.contains("xor"));
    }

    #[test]
    fn calls_are_those_of_circuits_elsewhere() {
        let own = "circuit n(a) -> (q) {\n q = not a\n}\ncircuit g(a, b) -> (q) {\n q = n(a)\n}\n";
        assert!(!WrittenProgram::of(own).words.contains(CALLS));
        let foreign = WrittenProgram::of("circuit g(a, b) -> (q) {\n    q = all({a, b})\n}\n");
        assert!(foreign.words.contains(CALLS) && foreign.words.contains("all"));
    }

    #[test]
    fn what_is_kept_are_the_lines_of_tests_and_claims() {
        let text = "test g \"t\" {\n a   b | q // first\n}\nprove g \"p\" {\n always q\n}\n";
        let kept = WrittenProgram::of(text).kept;
        assert!(kept.contains("a b | q") && kept.contains("always q"), "{kept:?}");
    }
}
