//! Messages of `nbc draw`.

use std::path::Path;

use nbc_base::diag::suggest::alternatives;
use nbc_base::diag::{Code, Diagnostic, Severity, Suggestion};
use nbc_base::model::Behavior;

use crate::cli::wording::no_such;

fn bad(message: String) -> Diagnostic {
    Diagnostic::without_place(Code::BadValue, message)
}

fn bad_run(message: String, help: &str) -> Diagnostic {
    Diagnostic::without_place(Code::Checkpoint, message).with_help(help)
}

pub(super) fn extension(path: &Path, expected: &[String], kind: &str) -> Diagnostic {
    bad(format!(
        "unrecognized picture format of `{}`; expected a name that ends in {} for `--as {kind}`",
        path.display(),
        expected.join(" or ")
    ))
}

pub(super) fn other_kind(what: &str, given: &str, expected: &str, kind: &str) -> Diagnostic {
    bad(format!("`{what}` is {given}, expected {expected} for `--as {kind}`"))
}

pub(super) fn option_without_effect(what: &str, option: &str, kind: &str, applies_to: &str) -> Diagnostic {
    bad(format!("`{option}` does not apply to `{what}` drawn as `{kind}`")).with_help(format!("it is for {applies_to}"))
}

pub(super) fn after_end(at: f64, end: f64) -> Diagnostic {
    bad(format!("`--at {at}` is after the end of the schedule at cycle {end}"))
}

pub(in crate::cli) fn unknown_behavior(what: &str, behavior: Behavior) -> Diagnostic {
    Diagnostic::without_place(Code::Unknown, format!("`{what}` has no robot of the behavior `{behavior}`"))
}

pub(super) fn no_run(what: &str) -> Diagnostic {
    let message = format!("`{what}` has no test and no simulation, so there is no run to draw");
    Diagnostic::without_place(Code::Empty, message).with_help("`--as schematic` and `--as dot` need none")
}

pub(super) fn unknown_test(file: &str, name: &str, known: &[String]) -> Diagnostic {
    no_such(format!("no test of `{file}` is called `{name}`"), name, known)
}

pub(super) fn unknown_net(net: &str, known: &[String]) -> Diagnostic {
    Diagnostic::without_place(Code::Unknown, format!("no robot drives `{net}`"))
        .with_help(format!("the robots drive {}", alternatives(known, "and")))
        .with_near(&Suggestion::near(net, known.iter().map(String::as_str)))
}

pub(super) fn no_run_in_folder(folder: &Path) -> Diagnostic {
    bad_run(format!("`{}` contains no run", folder.display()), "name the folder of a run, such as `out/gates`")
}

pub(super) fn no_axes(path: &Path) -> Diagnostic {
    let message = format!("`{}` does not say the axes of its archive", path.display());
    bad_run(message, "`nbc evolve --resume` writes them")
}

pub(super) fn other_declaration(path: &Path) -> Diagnostic {
    let message = format!("`{}` was made by a different declaration than the runs beside it", path.display());
    bad_run(message, "draw the folder of one seed")
}

pub(super) fn same_seed(path: &Path, seed: u64) -> Diagnostic {
    let message = format!("`{}` has seed {seed}, like another run in the folder", path.display());
    bad_run(message, "each run counts once; move the copy out of the folder")
}

pub(super) fn axis_count(found: usize, axes: &[String]) -> Diagnostic {
    with_axes(bad(format!("{found} axes were given, expected two such as `voxels,active`")), axes)
}

pub(super) fn unknown_axis(name: &str, axes: &[String]) -> Diagnostic {
    with_axes(bad(format!("`{name}` is not an axis of this archive")), axes)
        .with_near(&Suggestion::near(name, axes.iter().map(String::as_str)))
}

pub(super) fn same_axis(name: &str, axes: &[String]) -> Diagnostic {
    with_axes(bad(format!("both axes are `{name}`, expected two different ones")), axes)
}

fn with_axes(error: Diagnostic, axes: &[String]) -> Diagnostic {
    error.with_help(format!("the archive has the axes {}", alternatives(axes, "and")))
}

/// A robot that a picture shows up to its fault only.
pub(super) fn faulty_robot(fault: String) -> Diagnostic {
    let fault = Diagnostic::without_place(Code::Fault, fault);
    Diagnostic { severity: Severity::Warning, ..fault }.with_help("the picture shows it up to there")
}
