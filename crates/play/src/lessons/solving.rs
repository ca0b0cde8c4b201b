//! The solution of a step: what a test of the page does. The page never gets it.

use super::checking::{one_of, values};
use super::piece::Piece;
use super::wording::{BAD_NUMBER, INCOMPLETE, Mistaken, TOO_MUCH};

const DEEDS: [&str; 16] = [
    "set", "await", "wait", "pulse", "clock", "rewind", "circuit", "type", "test", "prove", "watch", "design",
    "mirror", "random", "evolve", "choose",
];

pub(super) fn deed<'a>(text: Piece<'a>, ports: &mut Vec<Piece<'a>>) -> Result<(), Mistaken> {
    let words = text.words();
    let Some((&first, rest)) = words.split_first() else {
        return Err(INCOMPLETE.at(text));
    };
    let count = |most: usize| match rest.get(most) {
        Some(&more) => Err(TOO_MUCH.at(more)),
        None if rest.len() < most => Err(INCOMPLETE.at(first)),
        None => Ok(()),
    };
    match one_of(first, &DEEDS)?.as_str() {
        "set" | "await" => values(first, rest, ports).map(|_| ()),
        "wait" => {
            count(1)?;
            let is_number = rest[0].text.parse::<u32>().is_ok();
            if is_number { Ok(()) } else { Err(BAD_NUMBER.at(rest[0])) }
        }
        "pulse" => {
            count(1)?;
            ports.push(rest[0]);
            Ok(())
        }
        "test" => {
            count(1)?;
            one_of(rest[0], &["logic", "physics"]).map(|_| ())
        }
        "design" | "circuit" => count(1),
        "choose" => {
            count(1)?;
            one_of(rest[0], &["niche"]).map(|_| ())
        }
        _ => count(0),
    }
}
