//! The argument `--as`: a kind of picture by its word.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::cli::draw::picture::PictureKind;
use crate::cli::draw::pictures::PICTURES;

#[derive(Clone, Copy)]
pub(super) struct Kind(pub(super) &'static dyn PictureKind);

pub(super) fn kinds() -> impl TypedValueParser<Value = Kind> {
    let value = |kind: &&dyn PictureKind| PossibleValue::new(kind.description().word).help(kind.description().about);
    PossibleValuesParser::new(PICTURES.iter().map(value)).try_map(|word| {
        let kind = PICTURES.into_iter().find(|kind| kind.description().word == word);
        kind.map(Kind).ok_or("not a kind of picture")
    })
}
