//! Robot files and folders of them.

use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic, folder_error};
use nbc_base::model::{Behavior, BodyError};
use nbc_base::source::{FileError, SourceFile, Span};

pub(crate) fn too_large(file: &SourceFile) -> Diagnostic {
    let (name, most) = (&file.name, Limit::RobotBytes.most());
    Diagnostic::without_place(Code::RobotFile, format!("`{name}` is not a robot file: larger than {most} bytes"))
}

pub(crate) fn too_much(file: &SourceFile) -> Diagnostic {
    let (name, most) = (&file.name, Limit::RobotTextBytes.most());
    let message = format!("`{name}` is not a robot file: with its aliases it has more than {most} bytes of text");
    Diagnostic::without_place(Code::RobotFile, message)
}

pub(crate) fn too_deep(file: &SourceFile, span: Span) -> Diagnostic {
    let (name, most) = (&file.name, Limit::RobotNesting.most());
    let message = format!("`{name}` is not a robot file: brackets are nested more than {most} levels deep");
    Diagnostic::new(Code::RobotFile, message, span, "the limit is reached here")
}

pub(crate) fn not_robot(file: &SourceFile, words: &str, span: Span) -> Diagnostic {
    Diagnostic::new(Code::RobotFile, format!("`{}` is not a robot file: {words}", file.name), span, "here")
}

pub(crate) fn robot_format(file: &SourceFile, found: u32, expected: u32, span: Span) -> Diagnostic {
    let message = format!("`{}` is a robot file of format {found}, expected format {expected}", file.name);
    Diagnostic::new(Code::ForeignFormat, message, span, "written by another version of nbc")
}

pub(crate) fn no_body(file: &SourceFile, error: &BodyError, span: Span) -> Diagnostic {
    Diagnostic::new(Code::RobotFile, format!("`{}` has no valid body: {error}", file.name), span, "here")
        .with_help("a body is a rectangle of material codes, top row first, 0 for empty")
}

pub(crate) fn two_pieces(file: &SourceFile, span: Span) -> Diagnostic {
    let message = format!("the body in `{}` is not in one piece", file.name);
    Diagnostic::new(Code::RobotFile, message, span, "this body")
        .with_help("the voxels of a robot are connected by their sides")
}

pub(crate) fn unsound(file: &SourceFile, flaw: &str, span: Span) -> Diagnostic {
    Diagnostic::new(Code::RobotFile, format!("`{}` is not a valid robot file: {flaw}", file.name), span, "here")
}

pub(crate) fn with_body_example(error: Diagnostic) -> Diagnostic {
    error.with_help("write the body's rows, top row first: `body: [\"00345\", \"33333\"]`")
}

pub(crate) fn unreadable_library(folder: &str, error: &FileError) -> Diagnostic {
    let message = format!("cannot read the library `{folder}`: {}", folder_error(error));
    Diagnostic::without_place(Code::Unreadable, message)
}

pub(crate) fn bad_name(name: &str, most: usize) -> String {
    format!("invalid name `{name}`; expected up to {most} letters, digits, `_`, `-`, `+` and `.`")
}

pub(crate) fn bad_provenance(field: &str, most: usize) -> String {
    format!("`{field}` is longer than {most} bytes or has control characters")
}

pub(crate) fn other_behavior(found: Behavior, expected: Behavior) -> String {
    format!("behavior `{found}`, but the displacements are those of `{expected}`")
}

pub(crate) fn bad_cycles(of: &str, cycles: u32, most: u32) -> String {
    format!("{of} of {cycles} cycles, expected 1 to {most}")
}

pub(crate) fn bad_share(field: &str, share: f64) -> String {
    format!("`{field}` of {share}, expected a share from 0 to 1")
}

pub(crate) fn not_finite(what: &str) -> String {
    format!("{what} is not a finite number")
}

pub(crate) fn bad_radius() -> String {
    "the radius is not a finite number of changes such as `friction=10%`".to_owned()
}
