//! From nb text to the tree and back: the grammar, the parser, the formatter. Names are not resolved here.

mod arena;
mod convert;
mod convert_circuit;
mod convert_expression;
mod convert_prove;
mod convert_record;
mod convert_test;
mod expected;
mod format;
mod grammar;
mod lexer;
mod parse;
mod part;
mod recover;
mod slips;
mod split;
pub mod tree;
mod wording;

pub use format::format;
pub use lexer::{Token, TokenKind, tokens, tokens_from};
pub(crate) use parse::parse_again;
pub use parse::{KnownTexts, Parsed, parse, parse_instance};
pub use split::KEYWORDS;
