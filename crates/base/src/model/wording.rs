//! What can be wrong with bodies, materials, patterns and simulations, as data, and how it is worded.

use std::error::Error;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::ImageSize;

/// The reason why rows of text are not a body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BodyError {
    /// No rows, or rows without columns.
    Empty,
    /// Rows of different width.
    Ragged {
        /// The row, from 1.
        row: usize,
        /// Its width.
        found: usize,
        /// The first row's width.
        expected: usize,
    },
    /// A character that is not a material code of the palette.
    UnknownCode {
        /// The row, from 1.
        row: usize,
        /// The column, from 1.
        column: usize,
        /// The character found.
        digit: char,
        /// The highest valid code.
        highest: char,
    },
    /// A number that is not a material code of the palette.
    CodeRange {
        /// The row, from 1.
        row: usize,
        /// The column, from 1.
        column: usize,
        /// The number found.
        code: u8,
        /// The highest valid code.
        highest: u8,
    },
    /// More rows or columns than allowed.
    TooLarge {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// The most rows or columns.
        most: usize,
    },
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
    /// Not JSON, or not that of a world.
    NotWorld {
        /// The first error in it.
        reason: String,
    },
    /// An object with more or fewer codes than cells.
    Uneven {
        /// The object.
        object: String,
        /// The number of its cells.
        cells: usize,
        /// The number of its codes.
        codes: usize,
    },
    /// An object with voxels that move.
    NotFixed {
        /// The object.
        object: String,
    },
    /// A number that is not a cell.
    Cell {
        /// The object.
        object: String,
        /// The number.
        cell: String,
    },
    /// A voxel too far from the lower left corner.
    TooLarge {
        /// The voxel's column, from 0.
        column: usize,
        /// Its row, from 0.
        row: usize,
        /// The most columns.
        most_columns: usize,
        /// The most rows.
        most_rows: usize,
    },
    /// No voxels.
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

/// The reason why values are not an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ImageError {
    /// Too many rows or columns, or none.
    Size {
        /// The number of rows.
        rows: usize,
        /// The number of columns.
        columns: usize,
        /// The most of each.
        most: usize,
    },
    /// Rows of different length.
    Ragged {
        /// The row, from 1.
        row: usize,
        /// The number of its pixels.
        found: usize,
        /// The first row's number.
        expected: usize,
    },
    /// Another number of pixels than rows and columns have.
    Pixels {
        /// The number of pixels.
        found: usize,
        /// The number of rows.
        rows: usize,
        /// The number of columns.
        columns: usize,
    },
    /// A pixel that is not from 0 to 1.
    Range {
        /// The row, from 1.
        row: usize,
        /// The column, from 1.
        column: usize,
        /// The pixel.
        found: String,
    },
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { rows, columns, most } => {
                write!(f, "the image has {rows} rows and {columns} columns, expected 1 to {most} of each")
            }
            Self::Ragged { row, found, expected } => {
                write!(f, "row {row} has {found} pixels, expected {expected} as in row 1")
            }
            Self::Pixels { found, rows, columns } => {
                write!(
                    f,
                    "the image has {found} pixels, expected {} in {rows} rows and {columns} columns",
                    rows * columns
                )
            }
            Self::Range { row, column, found } => {
                write!(f, "row {row}, column {column}: the pixel is {found}, expected 0 to 1")
            }
        }
    }
}

impl Error for ImageError {}

/// The reason why a file is not one of images.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ImageFileError {
    /// A name of another ending.
    Format,
    /// A PNG, in a program without them.
    NoPng,
    /// No images.
    Empty,
    /// A file of rows that is not text.
    NotText,
    /// A row of another number of values.
    Row {
        /// The line, from 1.
        line: usize,
        /// The number of values.
        found: usize,
        /// The number of pixels.
        expected: usize,
    },
    /// A value that is not a number.
    Value {
        /// The line, from 1.
        line: usize,
        /// The value.
        text: String,
    },
    /// A number that is below 0, or above that which stands for 1.
    Range {
        /// The line, from 1, in a file of rows.
        line: Option<usize>,
        /// The number.
        found: String,
        /// The number that stands for 1.
        white: String,
    },
    /// Images of another size.
    Size {
        /// Theirs.
        found: ImageSize,
        /// That of the stimulus.
        expected: ImageSize,
    },
    /// A file that ends too early, or does not begin as its format does.
    Damaged {
        /// The name of the format.
        format: &'static str,
        /// The part that is missing.
        what: &'static str,
    },
    /// Values that are not an image.
    Image(ImageError),
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
            Self::Image(error) => error.fmt(f),
        }
    }
}

impl Error for ImageFileError {}

/// The reason why materials are not a palette.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PaletteError {
    /// No materials, or more than codes can name.
    Size {
        /// The number of materials.
        found: usize,
        /// The most materials.
        most: usize,
    },
    /// Two materials of one name.
    Twice(String),
    /// A name that the language could not write.
    Name(String),
}

impl fmt::Display for PaletteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { found, most } => write!(f, "{found} materials, expected 1 to {most}"),
            Self::Twice(name) => write!(f, "two materials are called `{name}`"),
            Self::Name(name) => {
                write!(f, "`{name}` is not the name of a material; expected a letter, then letters, digits and `_`")
            }
        }
    }
}

impl Error for PaletteError {}

/// The reason why fields are not a material.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialError {
    /// A field that the kind needs is missing.
    Missing {
        /// The material's name.
        material: String,
        /// The field, as it is written in the language.
        field: &'static str,
    },
    /// A field that this kind does not have.
    Foreign {
        /// The material's name.
        material: String,
        /// The field, as it is written in the language.
        field: &'static str,
    },
    /// A number that a material cannot have.
    OutOfRange {
        /// The material's name.
        material: String,
        /// The field, as it is written in the language.
        field: &'static str,
        /// Its value.
        found: String,
        /// The valid values.
        expected: MaterialNumber,
    },
}

/// The valid values of a number of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialNumber {
    /// A period in env steps.
    Period {
        /// The longest.
        most: u32,
    },
    /// A phase in degrees.
    Phase,
    /// The smallest and the largest width.
    Widths,
    /// The number of a stimulus.
    Stimulus {
        /// The highest.
        most: usize,
    },
    /// A width.
    Width,
    /// The rows and the columns of an image.
    Image {
        /// The most of each.
        most: usize,
    },
}

impl fmt::Display for MaterialNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Period { most } => write!(f, "1 to {most} env steps"),
            Self::Phase => f.write_str("a finite number of degrees"),
            Self::Widths => f.write_str("widths from 0.6 to 1.6, the smallest first"),
            Self::Stimulus { most } => write!(f, "1 to {most}"),
            Self::Width => f.write_str("a width from 0.6 to 1.6"),
            Self::Image { most } => write!(f, "1 to {most} rows and columns"),
        }
    }
}

impl fmt::Display for MaterialError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing { material, field } => write!(f, "the material `{material}` lacks the field `{field}`"),
            Self::Foreign { material, field } => {
                write!(f, "the material `{material}` cannot have the field `{field}`, because its kind has none")
            }
            Self::OutOfRange { material, field, found, expected } => {
                write!(f, "the material `{material}` has `{field}: {found}`, expected {expected}")
            }
        }
    }
}

impl Error for MaterialError {}

/// A word that is not a behavior.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BehaviorError(pub(super) String);

impl fmt::Display for BehaviorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "`{}` is not a behavior; expected four letters L or R such as `RRRL`, or eight for three stimuli",
            self.0
        )
    }
}

impl Error for BehaviorError {}

/// A number of displacements that are not one for each pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DisplacementsError(pub(super) usize);

impl fmt::Display for DisplacementsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} displacements, expected 4 of a body with two stimuli or 8 of one with three", self.0)
    }
}

impl Error for DisplacementsError {}

/// A text that is not a pattern.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PatternError {
    /// Not a pattern of any number of stimuli.
    Digits {
        /// The text.
        found: String,
        /// The most stimuli.
        most: usize,
    },
    /// Not a pattern of two or three stimuli.
    Senses {
        /// The text.
        found: String,
    },
}

impl fmt::Display for PatternError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Digits { found, most } => write!(
                f,
                "`{found}` is not a pattern; expected a digit 0 or 1 for each of at most {most} stimuli, such as `01`"
            ),
            Self::Senses { found } => {
                write!(f, "`{found}` is not a pattern; expected two digits 0 or 1, or three for three stimuli")
            }
        }
    }
}

impl Error for PatternError {}

/// The reason why a body cannot stand on a ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SettingError {
    /// A ground that is too wide.
    WideWorld {
        /// Its voxels.
        width: usize,
        /// The most voxels.
        most: usize,
    },
    /// A ground narrower than the body.
    NarrowWorld {
        /// Its voxels.
        width: usize,
        /// The body's columns.
        columns: usize,
    },
    /// A start beyond the ground.
    OffGround {
        /// The start column.
        start: usize,
        /// The last valid one.
        most: usize,
        /// The body's columns.
        columns: usize,
        /// The ground's voxels.
        width: usize,
    },
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

/// The reason why a text is not a variation of worlds.
#[derive(Clone, Debug, PartialEq)]
pub enum VariationError {
    /// A part without `=`.
    NoAmount(String),
    /// A quantity that worlds do not have, and those that they have.
    Unknown(String, &'static [&'static str]),
    /// An amount that is not a number in its range.
    Amount {
        /// The quantity.
        name: String,
        /// The text.
        found: String,
        /// The largest amount.
        most: f64,
    },
}

impl fmt::Display for VariationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAmount(part) => write!(f, "`{part}` has no amount; expected a change such as `friction=10%`"),
            Self::Unknown(name, known) => {
                write!(f, "`{name}` does not vary; expected `all`, `{}`", known.join("`, `"))
            }
            Self::Amount { name, found, most } => {
                write!(f, "`{found}` is not an amount of `{name}`; expected a number from 0 to {most}, or percent")
            }
        }
    }
}

impl Error for VariationError {}

/// The reason why a simulation failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
    /// What became of the robot.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Unstable => "became unstable",
            Self::NonFinite => "left the range of numbers",
            Self::Stopped => "was stopped",
        })
    }
}
