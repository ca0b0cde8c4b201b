//! The tokens of a text, for requests about places that are not in the tree, such as in an incomplete declaration.

use nbc_lang::syntax;
use nbc_lang::syntax::{Token, TokenKind};

pub(super) fn tokens(text: &str) -> Vec<Token> {
    syntax::tokens(text).collect()
}

/// The token at a byte, or the word that ends there.
pub(super) fn at(tokens: &[Token], offset: usize) -> Option<&Token> {
    let next = tokens.partition_point(|token| token.range.start <= offset);
    let token = tokens[..next].last()?;
    let ends_here = token.range.end == offset && matches!(token.kind, TokenKind::Word | TokenKind::Number);
    (offset < token.range.end || ends_here).then_some(token)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_token_at_a_byte_is_found() {
        let found = |offset| at(&tokens("ab (c"), offset).map(|token| token.range.clone());
        assert_eq!([0, 2, 3, 4, 5].map(found), [Some(0..2), Some(0..2), Some(3..4), Some(4..5), Some(4..5)]);
    }
}
