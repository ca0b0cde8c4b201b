//! What can be wrong with the declarations of a program, as data, and how it is worded: a file for each subject.

mod circuits;
mod evolutions;
mod files;
mod images;
mod names;
mod properties;
mod rows;
mod values;

pub(crate) use circuits::{ArrayError, CircuitError, EnumerationError, OperandError, StartEdit};
pub(crate) use evolutions::EvolutionError;
pub(crate) use files::{LoadError, at_use};
pub(crate) use images::ImagesError;
pub(crate) use names::NameError;
pub(crate) use properties::PropertyError;
pub(crate) use rows::{CellError, EnvironmentError, RowError};
pub(crate) use values::{Bounds, Expected, FieldError, Record, ValueError};
