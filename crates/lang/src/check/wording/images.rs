//! Images: their sets, and schedules and evolutions that show them.

use crate::syntax::tree::NameSyntax;
use nbc_base::diag::{Code, Diagnostic, counted, suggest};
use nbc_base::model::ImageFileError;
use nbc_base::source::Span;

pub(crate) fn image_size(most: usize, at: Span) -> Diagnostic {
    let label = format!("expected 1 to {most} rows and columns");
    Diagnostic::new(Code::OutOfRange, "an image cannot have this size", at, label)
}

pub(crate) fn other_size(stimulus: &NameSyntax) -> Diagnostic {
    let message = format!("`{}` is a stimulus of the prelude and has another size", stimulus.text);
    Diagnostic::new(Code::Duplicate, message, stimulus.span, "expected another name")
}

pub(crate) fn no_image(stimulus: &NameSyntax) -> Diagnostic {
    let NameSyntax { text: name, span } = stimulus;
    let message = format!("the stimulus `{name}` is not an image");
    Diagnostic::new(Code::Value, message, *span, "expected a stimulus with rows and columns")
        .with_help(format!("declare it with its size, for example `stimulus {name}[8][8]`"))
}

pub(crate) fn no_label(label: &str, known: &[String], at: Span) -> Diagnostic {
    let labels = if known.is_empty() {
        "the file has no labels".to_owned()
    } else {
        format!("the file has {}", suggest::alternatives(known, "and"))
    };
    Diagnostic::new(Code::Unknown, format!("no image has the label `{label}`"), at, labels)
}

pub(crate) fn few_images(last: u32, count: usize, at: Span) -> Diagnostic {
    let message = format!("image {last} does not exist");
    Diagnostic::new(Code::OutOfRange, message, at, format!("there are {}", counted(count, "image")))
}

pub(crate) fn image_beside_stimuli(stimulus: &NameSyntax) -> Diagnostic {
    let message = format!("the schedule shows the image `{}` beside other stimuli", stimulus.text);
    Diagnostic::new(Code::Value, message, stimulus.span, "expected this stimulus alone")
        .with_help("bodies that sense an image sense nothing else")
}

pub(crate) fn other_stimulus(set: &NameSyntax, stimulus: &str) -> Diagnostic {
    let message = format!("the images `{}` are not for `{stimulus}`", set.text);
    Diagnostic::new(Code::Value, message, set.span, format!("expected images with `stimulus: {stimulus}`"))
}

pub(crate) fn many_sets(most: usize, at: Span) -> Diagnostic {
    let message = "the schedule shows too many sets of images";
    Diagnostic::new(Code::OutOfRange, message, at, format!("expected at most {most}"))
}

pub(crate) fn images_as_inputs(schedule: &str, at: Span) -> Diagnostic {
    let message = format!("the schedule `{schedule}` shows images");
    Diagnostic::new(Code::Value, message, at, "expected a schedule of the circuit's inputs")
}

pub(crate) fn images_without_objective(at: Span) -> Diagnostic {
    let message = "this evolution is shown images, but its objective is not about them";
    Diagnostic::new(Code::Value, message, at, "expected `objective: images`")
        .with_help("or name a schedule of other stimuli in `variable`")
}

pub(crate) fn objective_without_images(at: Span) -> Diagnostic {
    let message = "the objective is about images, but the schedule shows none";
    Diagnostic::new(Code::Value, message, at, "expected a schedule of images")
        .with_help("name one in `variable`, for example `schedule train(digit) { zeros for 250 steps }`")
}

pub(crate) fn one_set(schedule: &NameSyntax) -> Diagnostic {
    let message = format!("the schedule `{}` shows one set of images", schedule.text);
    Diagnostic::new(Code::Value, message, schedule.span, "expected two or more, which bodies tell apart")
}

pub(crate) fn not_gates(evolution: &str, at: Span) -> Diagnostic {
    let message = format!("the bodies of `{evolution}` see images; they are not gates");
    Diagnostic::new(Code::Value, message, at, "expected an evolution of gates")
}

pub(crate) fn image_file(file: &str, error: &ImageFileError, at: Span) -> Diagnostic {
    let message = format!("cannot read images from `{file}`: {error}");
    let label = match error {
        ImageFileError::Format => "expected a file name ending in .csv, .pgm, .png or -ubyte",
        ImageFileError::NoPng => "expected .csv, .pgm or -ubyte",
        ImageFileError::Range { .. } => "expected smaller numbers, or another `white`",
        _ => "expected images of the size of the stimulus",
    };
    let found = Diagnostic::new(Code::Unreadable, message, at, label);
    match error {
        ImageFileError::Range { line: Some(_), .. } => {
            found.with_help("`white` is the number that stands for 1, for example `white: 255`")
        }
        _ => found,
    }
}
