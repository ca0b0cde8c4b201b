//! The messages about the declarations of a program: a file for each subject.

mod circuits;
mod evolutions;
mod files;
mod images;
mod names;
mod properties;
mod rows;
mod values;

pub(crate) use circuits::*;
pub(crate) use evolutions::*;
pub(crate) use files::*;
pub(crate) use images::*;
pub(crate) use names::*;
pub(crate) use properties::*;
pub(crate) use rows::*;
pub(crate) use values::*;
