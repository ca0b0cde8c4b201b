//! Messages about bodies, materials, patterns and simulations.

use std::error::Error;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::ImageSize;

/// The reason why rows of text are not a body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BodyError {
    Empty,
    Ragged { row: usize, found: usize, expected: usize },
    UnknownCode { row: usize, column: usize, digit: char, highest: char },
    CodeRange { row: usize, column: usize, code: u8, highest: u8 },
    TooLarge { width: usize, height: usize, most: usize },
}

impl fmt::Display for BodyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("the body has no voxels"),
            Self::Ragged { row, found, expected } => {
                let voxels = if *found == 1 { "voxel" } else { "voxels" };
                write!(f, "row {row} has {found} {voxels}, expected {expected} as in row 1")
            }
            Self::UnknownCode { row, column, digit, highest } => {
                write!(f, "row {row}, column {column}: `{digit}` is not a material code; expected 0 to {highest}")
            }
            Self::CodeRange { row, column, code, highest } => {
                write!(f, "row {row}, column {column}: {code} is not a material code; expected 0 to {highest}")
            }
            Self::TooLarge { width, height, most } => {
                write!(f, "the body is {width} x {height}, expected at most {most} x {most}")
            }
        }
    }
}

impl Error for BodyError {}

/// The reason why a text is not ground of Evolution Gym.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GroundFileError {
    NotWorld { reason: String },
    Uneven { object: String, cells: usize, codes: usize },
    NotFixed { object: String },
    Cell { object: String, cell: String },
    TooLarge { column: usize, row: usize, most_columns: usize, most_rows: usize },
    Empty,
}

impl fmt::Display for GroundFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotWorld { reason } => write!(f, "it is not a world of Evolution Gym: {reason}"),
            Self::Uneven { object, cells, codes } => {
                write!(f, "the object `{object}` has {cells} voxels and {codes} codes, expected as many")
            }
            Self::NotFixed { object } => write!(f, "the object `{object}` has voxels that are not fixed"),
            Self::Cell { object, cell } => {
                write!(f, "the object `{object}` has a voxel at {cell}, expected the number of a cell")
            }
            Self::TooLarge { column, row, most_columns, most_rows } => write!(
                f,
                "it has a voxel in column {column} and row {row}, expected at most {most_columns} columns and \
                 {most_rows} rows"
            ),
            Self::Empty => f.write_str("it has no voxels"),
        }
    }
}

impl Error for GroundFileError {}

pub(super) fn image_size(rows: usize, columns: usize) -> String {
    let most = ImageSize::MAX_SIDE;
    format!("the image has {rows} rows and {columns} columns, expected 1 to {most} of each")
}

pub(super) fn ragged_image(row: usize, found: usize, expected: usize) -> String {
    format!("row {row} has {found} pixels, expected {expected} as in row 1")
}

pub(super) fn image_pixels(found: usize, rows: usize, columns: usize) -> String {
    format!("the image has {found} pixels, expected {} in {rows} rows and {columns} columns", rows * columns)
}

/// Row and column are counted from 1.
pub(super) fn pixel_range(row: usize, column: usize, found: f64) -> String {
    format!("row {row}, column {column}: the pixel is {found}, expected 0 to 1")
}

/// The reason why a file is not one of images.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ImageFileError {
    Format,
    NoPng,
    Empty,
    NotText,
    Row { line: usize, found: usize, expected: usize },
    Value { line: usize, text: String },
    Range { line: Option<usize>, found: String, white: String },
    Size { found: ImageSize, expected: ImageSize },
    Damaged { format: &'static str, what: &'static str },
    Image(String),
}

impl fmt::Display for ImageFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Format => f.write_str("it has none of the formats of images"),
            Self::NoPng => f.write_str("this program was built without PNG"),
            Self::Empty => f.write_str("it has no images"),
            Self::NotText => f.write_str("it is not valid UTF-8"),
            Self::Row { line, found, expected } => {
                write!(f, "line {line}: {found} values, expected {expected} and perhaps a label")
            }
            Self::Value { line, text } => write!(f, "line {line}: `{text}` is not a number"),
            Self::Range { line, found, white } => {
                let place = line.map_or(String::new(), |line| format!("line {line}: "));
                write!(f, "{place}the pixel is {found}, expected 0 to {white}")
            }
            Self::Size { found: ImageSize { rows, columns }, expected } => {
                let (high, wide) = (expected.rows, expected.columns);
                write!(f, "its images have {rows} rows and {columns} columns, expected {high} and {wide}")
            }
            Self::Damaged { format, what } => {
                let verb = if what.ends_with('s') { "are" } else { "is" };
                write!(f, "it is a damaged {format} file: {what} {verb} not complete")
            }
            Self::Image(words) => f.write_str(words),
        }
    }
}

impl Error for ImageFileError {}

pub(super) fn palette_size(found: usize, most: usize) -> String {
    format!("{found} materials, expected 1 to {most}")
}

pub(super) fn same_material(name: &str) -> String {
    format!("two materials are called `{name}`")
}

pub(super) fn material_name(name: &str) -> String {
    format!("`{name}` is not the name of a material; expected a letter, then letters, digits and `_`")
}

pub(super) fn missing_field(material: &str, field: &str) -> String {
    format!("the material `{material}` lacks the field `{field}`")
}

pub(super) fn foreign_field(material: &str, field: &str) -> String {
    format!("the material `{material}` cannot have the field `{field}`, because its kind has none")
}

/// `expected` follows the word "expected".
pub(super) fn material_number(material: &str, field: &str, found: &str, expected: &str) -> String {
    format!("the material `{material}` has `{field}: {found}`, expected {expected}")
}

pub(super) fn not_behavior(word: &str) -> String {
    format!("`{word}` is not a behavior; expected four letters L or R such as `RRRL`, or eight for three stimuli")
}

pub(super) fn displacement_count(found: usize) -> String {
    format!("{found} displacements, expected 4 of a body with two stimuli or 8 of one with three")
}

pub(super) fn not_pattern(found: &str, most: usize) -> String {
    format!("`{found}` is not a pattern; expected a digit 0 or 1 for each of at most {most} stimuli, such as `01`")
}

pub(super) fn not_gate_pattern(found: &str) -> String {
    format!("`{found}` is not a pattern; expected two digits 0 or 1, or three for three stimuli")
}

/// The reason why a body cannot stand on a ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SettingError {
    WideWorld { width: usize, most: usize },
    NarrowWorld { width: usize, columns: usize },
    OffGround { start: usize, most: usize, columns: usize, width: usize },
}

impl fmt::Display for SettingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WideWorld { width, most } => {
                write!(f, "the world width {width} is too large, expected at most {most}")
            }
            Self::NarrowWorld { width, columns } => {
                write!(f, "the world width {width} is too small, expected at least the body's {columns}")
            }
            Self::OffGround { start, most, columns, width } => write!(
                f,
                "the start column {start} is off the ground, expected at most {most} for a body of width {columns} in \
                 a world of {width}"
            ),
        }
    }
}

impl Error for SettingError {}

pub(super) fn no_amount(part: &str) -> String {
    format!("`{part}` has no amount; expected a change such as `friction=10%`")
}

pub(super) fn does_not_vary(name: &str, known: &[&str]) -> String {
    format!("`{name}` does not vary; expected `all`, `{}`", known.join("`, `"))
}

pub(super) fn variation_amount(name: &str, found: &str, most: f64) -> String {
    format!("`{found}` is not an amount of `{name}`; expected a number from 0 to {most}, or percent")
}

/// The reason why a simulation failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum FaultKind {
    /// Too many of the body's voxels overlap (docs/physics.md 9).
    Unstable,
    /// A position was no finite number.
    NonFinite,
    /// It was ended from outside.
    Stopped,
}

impl fmt::Display for FaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Unstable => "became unstable",
            Self::NonFinite => "left the range of numbers",
            Self::Stopped => "was stopped",
        })
    }
}
