//! Errors of `nbc draw` and their messages.

use nbc_base::diag::suggest::alternatives;
use nbc_base::diag::{Code, Diagnostic, Severity, Suggestion};
use nbc_base::model::Behavior;

use crate::cli::wording::no_such;

/// A picture that cannot be drawn as requested; `what` is the subject as the user named it.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::cli) enum DrawError {
    /// A file name without an extension of that kind of picture.
    Extension { path: String, expected: Vec<String>, kind: &'static str },
    /// A kind of picture that the subject does not have.
    Kind { what: String, given: &'static str, expected: &'static str, kind: &'static str },
    /// An option that would have no effect.
    Option { what: String, option: &'static str, kind: &'static str, applies_to: &'static str },
    /// A moment after the end of the schedule.
    AfterEnd { at: f64, end: f64 },
    /// A behavior without a robot.
    UnknownBehavior { what: String, behavior: Behavior },
    /// A file or circuit without tests and simulations.
    NoRun { what: String },
    /// A test that the file does not have.
    UnknownTest { file: String, name: String, known: Vec<String> },
    /// A net that is not driven by a robot.
    UnknownNet { net: String, known: Vec<String> },
    /// A folder without a run.
    NoRunInFolder { folder: String },
    /// A checkpoint of an old version, without its axes.
    NoAxes { path: String },
    /// A checkpoint of a different declaration than those before it.
    OtherDeclaration { path: String },
    /// A second checkpoint of a seed.
    SameSeed { path: String, seed: u64 },
    /// A number of axes other than two.
    AxisCount { found: usize, axes: Vec<String> },
    /// An axis that the archive does not have.
    UnknownAxis { name: String, axes: Vec<String> },
    /// The same axis twice.
    SameAxis { name: String, axes: Vec<String> },
}

impl From<DrawError> for Diagnostic {
    fn from(error: DrawError) -> Self {
        let bad = |message: String| Self::without_place(Code::BadValue, message);
        let unknown = |message: String| Self::without_place(Code::Unknown, message);
        let run = |message: String, help: &str| Self::without_place(Code::Checkpoint, message).with_help(help);
        match error {
            DrawError::Extension { path, expected, kind } => bad(format!(
                "unrecognized picture format of `{path}`; expected a name that ends in {} for `--as {kind}`",
                expected.join(" or ")
            )),
            DrawError::Kind { what, given, expected, kind } => {
                bad(format!("`{what}` is {given}, expected {expected} for `--as {kind}`"))
            }
            DrawError::Option { what, option, kind, applies_to } => {
                bad(format!("`{option}` does not apply to `{what}` drawn as `{kind}`"))
                    .with_help(format!("it is for {applies_to}"))
            }
            DrawError::AfterEnd { at, end } => {
                bad(format!("`--at {at}` is after the end of the schedule at cycle {end}"))
            }
            DrawError::UnknownBehavior { what, behavior } => {
                unknown(format!("`{what}` has no robot of the behavior `{behavior}`"))
            }
            DrawError::NoRun { what } => {
                let message = format!("`{what}` has no test and no simulation, so there is no run to draw");
                Self::without_place(Code::Empty, message).with_help("`--as schematic` and `--as dot` need none")
            }
            DrawError::UnknownTest { file, name, known } => {
                no_such(format!("no test of `{file}` is called `{name}`"), &name, &known)
            }
            DrawError::UnknownNet { net, known } => unknown(format!("no robot drives `{net}`"))
                .with_help(format!("the robots drive {}", alternatives(&known, "and")))
                .with_near(&Suggestion::near(&net, known.iter().map(String::as_str))),
            DrawError::AxisCount { found, axes } => {
                with_axes(bad(format!("{found} axes were given, expected two such as `voxels,active`")), &axes)
            }
            DrawError::UnknownAxis { name, axes } => {
                with_axes(bad(format!("`{name}` is not an axis of this archive")), &axes)
                    .with_near(&Suggestion::near(&name, axes.iter().map(String::as_str)))
            }
            DrawError::SameAxis { name, axes } => {
                with_axes(bad(format!("both axes are `{name}`, expected two different ones")), &axes)
            }
            DrawError::NoRunInFolder { folder } => {
                run(format!("`{folder}` contains no run"), "name the folder of a run, such as `out/gates`")
            }
            DrawError::NoAxes { path } => {
                run(format!("`{path}` does not say the axes of its archive"), "`nbc evolve --resume` writes them")
            }
            DrawError::OtherDeclaration { path } => run(
                format!("`{path}` was made by a different declaration than the runs beside it"),
                "draw the folder of one seed",
            ),
            DrawError::SameSeed { path, seed } => run(
                format!("`{path}` has seed {seed}, like another run in the folder"),
                "each run counts once; move the copy out of the folder",
            ),
        }
    }
}

/// A robot that a picture shows up to its fault only.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FaultyRobot {
    /// The robot, its fault, and when that was.
    pub(super) fault: String,
}

impl From<FaultyRobot> for Diagnostic {
    fn from(FaultyRobot { fault }: FaultyRobot) -> Self {
        let fault = Self::without_place(Code::Fault, fault);
        Self { severity: Severity::Warning, ..fault }.with_help("the picture shows it up to there")
    }
}

fn with_axes(error: Diagnostic, axes: &[String]) -> Diagnostic {
    error.with_help(format!("the archive has the axes {}", alternatives(axes, "and")))
}
