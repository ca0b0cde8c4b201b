//! What can be wrong with the declarations of a program, as data, and how it is worded: a file for each subject.

mod circuits;
mod evolutions;
mod files;
mod names;
mod rows;
mod values;

pub(crate) use circuits::{CircuitError, OperandError, StartEdit, TableError};
pub(crate) use evolutions::EvolutionError;
pub(crate) use files::{LoadError, at_use, of_translation};
pub(crate) use names::NameError;
pub(crate) use rows::{CellError, RowError};
pub(crate) use values::{Bounds, Expected, FieldError, Record, ValueError};
