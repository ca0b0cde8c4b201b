//! Images: their sets, and schedules and evolutions that show them.

use nbc_base::diag::{Code, Diagnostic, counted, suggest};
use nbc_base::model::ImageFileError;
use nbc_base::source::{FileError, Span};

/// An invalid set of images, or an invalid use of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum ImagesError {
    /// Rows or columns that an image cannot have.
    Size { most: usize },
    /// A stimulus that is declared again with another size.
    OtherSize { stimulus: String },
    /// A set of images for a stimulus that is present or absent everywhere.
    NoImage { stimulus: String },
    /// A file that cannot be read.
    Unreadable { file: String, error: FileError },
    /// A file that is not one of images of the size.
    File { file: String, error: ImageFileError },
    /// A label that no image has.
    NoLabel { label: String, known: Vec<String> },
    /// Fewer images than are to be taken.
    TooFew { last: u32, count: usize },
    /// A schedule with an image and other stimuli.
    Beside { stimulus: String },
    /// A set of images of another stimulus than the schedule's.
    OtherStimulus { set: String, stimulus: String },
    /// More sets than a behavior can tell apart.
    TooManySets { most: usize },
    /// A schedule of images for inputs.
    Inputs { schedule: String },
    /// An evolution whose objective is not that of its schedule.
    Objective { shows: bool },
    /// An evolution with one set of images.
    OneSet { schedule: String },
    /// A library of robots from an evolution of bodies that are not gates.
    NotGates { evolution: String },
}

impl ImagesError {
    /// The error at the name or value.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::Size { most } => {
                let label = format!("expected 1 to {most} rows and columns");
                Diagnostic::new(Code::OutOfRange, "an image cannot have this size", span, label)
            }
            Self::OtherSize { stimulus } => {
                let message = format!("`{stimulus}` is a stimulus of the prelude and has another size");
                Diagnostic::new(Code::Duplicate, message, span, "expected another name")
            }
            Self::NoImage { stimulus } => {
                let message = format!("the stimulus `{stimulus}` is not an image");
                Diagnostic::new(Code::Value, message, span, "expected a stimulus with rows and columns")
                    .with_help(format!("declare it with its size, for example `stimulus {stimulus}[8][8]`"))
            }
            Self::Unreadable { file, error } => Diagnostic::unreadable(&file, &error)
                .with_label(span, "used here")
                .with_help("the path is relative to the file that names it"),
            Self::File { file, error } => file_error(&file, &error, span),
            Self::NoLabel { label, known } => {
                let message = format!("no image has the label `{label}`");
                let labels = match known.is_empty() {
                    true => "the file has no labels".to_owned(),
                    false => format!("the file has {}", suggest::alternatives(&known, "and")),
                };
                Diagnostic::new(Code::Unknown, message, span, labels)
            }
            Self::TooFew { last, count } => {
                let message = format!("image {last} does not exist");
                Diagnostic::new(Code::OutOfRange, message, span, format!("there are {}", counted(count, "image")))
            }
            Self::Beside { stimulus } => {
                let message = format!("the schedule shows the image `{stimulus}` beside other stimuli");
                Diagnostic::new(Code::Value, message, span, "expected this stimulus alone")
                    .with_help("bodies that sense an image sense nothing else")
            }
            Self::OtherStimulus { set, stimulus } => {
                let message = format!("the images `{set}` are not for `{stimulus}`");
                Diagnostic::new(Code::Value, message, span, format!("expected images with `stimulus: {stimulus}`"))
            }
            Self::TooManySets { most } => {
                let message = "the schedule shows too many sets of images";
                Diagnostic::new(Code::OutOfRange, message, span, format!("expected at most {most}"))
            }
            Self::Inputs { schedule } => {
                let message = format!("the schedule `{schedule}` shows images");
                Diagnostic::new(Code::Value, message, span, "expected a schedule of the circuit's inputs")
            }
            Self::Objective { shows: true } => {
                let message = "this evolution is shown images, but its objective is not about them";
                Diagnostic::new(Code::Value, message, span, "expected `objective: images`")
                    .with_help("or name a schedule of other stimuli in `variable`")
            }
            Self::Objective { shows: false } => {
                let message = "the objective is about images, but the schedule shows none";
                Diagnostic::new(Code::Value, message, span, "expected a schedule of images")
                    .with_help("name one in `variable`, for example `schedule train(digit) { zeros for 250 steps }`")
            }
            Self::OneSet { schedule } => {
                let message = format!("the schedule `{schedule}` shows one set of images");
                Diagnostic::new(Code::Value, message, span, "expected two or more, which bodies tell apart")
            }
            Self::NotGates { evolution } => {
                let message = format!("the bodies of `{evolution}` see images; they are not gates");
                Diagnostic::new(Code::Value, message, span, "expected an evolution of gates")
            }
        }
    }
}

fn file_error(file: &str, error: &ImageFileError, span: Span) -> Diagnostic {
    let message = format!("cannot read images from `{file}`: {error}");
    let label = match error {
        ImageFileError::Format => "expected a file name ending in .csv, .pgm, .png or -ubyte",
        ImageFileError::NoPng => "expected .csv, .pgm or -ubyte",
        ImageFileError::Range { .. } => "expected smaller numbers, or another `white`",
        _ => "expected images of the size of the stimulus",
    };
    let found = Diagnostic::new(Code::Unreadable, message, span, label);
    match error {
        ImageFileError::Range { line: Some(_), .. } => {
            found.with_help("`white` is the number that stands for 1, for example `white: 255`")
        }
        _ => found,
    }
}
