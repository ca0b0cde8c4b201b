//! What an editor shows about a place: the meaning of a name, of a keyword, of a field or of a constant.

mod circuit;
mod constant;
mod declaration;
mod manual;
mod net;
mod picture;
mod robots;
mod waves;

use crate::figures::Subject;
use crate::spot::Spot;
use crate::tokens;
use nbc_base::model::Operator;
use nbc_base::source::Span;
use nbc_lang::check::{NameKind, NameUse};
use nbc_lang::syntax::TokenKind;
use nbc_lang::syntax::tree::DeclarationKind;

pub(super) struct Shown {
    pub(super) place: Span,
    /// Markdown.
    pub(super) text: String,
    pub(super) subject: Option<Subject>,
}

pub(super) fn show(spot: &Spot<'_>, pictures: bool) -> Option<Shown> {
    if let Some(found) = spot.name() {
        return Some(of_name(spot, found, pictures));
    }
    let text = spot.text();
    let tokens = spot.tokens();
    let token = tokens::at(&tokens, spot.offset)?;
    let word = &text[token.range.clone()];
    let shown = match token.kind {
        TokenKind::Number => constant::text(word),
        TokenKind::Word => of_word(spot, word, pictures),
        _ => None,
    }?;
    let place = Span::new(spot.file, token.range.start, token.range.end);
    Some(Shown { place, text: shown, subject: None })
}

fn of_name(spot: &Spot<'_>, found: NameUse, pictures: bool) -> Shown {
    let mut text = declaration::text(&spot.files, found);
    let name = spot.files.checked.sources.text(found.declared);
    let (more, subject) = match found.kind {
        NameKind::Circuit => circuit::text(&spot.files, found.declared),
        NameKind::Net => net::text(&spot.files, found.declared),
        NameKind::Swarm => (None, circuit::of_swarm(&spot.files, name)),
        NameKind::Material => (waves::material(&spot.files, name, pictures), None),
        NameKind::Schedule => (waves::schedule(&spot.files, name, pictures), None),
        NameKind::Library => (robots::of_library(&spot.files, name, pictures), None),
        _ => (None, None),
    };
    if let Some(more) = more {
        text.push_str(&format!("\n{more}\n"));
    }
    Shown { place: found.place, text, subject }
}

fn of_word(spot: &Spot<'_>, word: &str, pictures: bool) -> Option<String> {
    let around = spot.around();
    if let Some(DeclarationKind::Record(record)) = around.map(|around| &around.kind)
        && spot.offset > record.name.span.end as usize
    {
        let robot = robots::of_behavior(&spot.files, &record.name.text, word, pictures);
        return robot.or_else(|| manual::field(record.keyword, word));
    }
    let mut text = manual::keyword(word)?;
    if Operator::parse(word).is_some()
        && let Some(robot) = robots::of_operator(spot, around, word, pictures)
    {
        text.push_str(&format!("\n{robot}"));
    }
    Some(text)
}
