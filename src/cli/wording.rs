//! Messages of the command line. Those of one command stand in a wording file beside it.

use std::io;
use std::path::Path;

use nbc_base::diag::suggest::alternatives;
use nbc_base::diag::{Code, Diagnostic, Severity, Suggestion, counted, io_words};
use nbc_base::model::{ImageSize, SettingError};

fn bad(message: impl Into<String>) -> Diagnostic {
    Diagnostic::without_place(Code::BadValue, message)
}

/// Arguments that clap refuses, in its words.
pub(in crate::cli) fn arguments(message: String, help: String) -> Diagnostic {
    bad(message).with_help(help)
}

pub(in crate::cli) fn no_command() -> Diagnostic {
    bad("the command is missing").with_help("`nbc --help` lists the commands")
}

pub(in crate::cli) fn not_text(name: impl std::fmt::Display) -> Diagnostic {
    bad(format!("the name `{name}` is not valid UTF-8"))
        .with_help("rename the file or the folder; programs and messages name it as text")
}

pub(in crate::cli) fn same_robot(name: &str) -> Diagnostic {
    bad(format!("two robots would be called `{name}`")).with_help("rename one of the files")
}

pub(in crate::cli) fn robot_name(path: &Path) -> Diagnostic {
    bad(format!("no robot can have the name of `{}`", path.display()))
        .with_help("a name has letters, digits, `_`, `-`, `+` and `.`, and does not begin with `.`")
}

pub(in crate::cli) fn unstable_body(path: &Path, env_step: u32) -> Diagnostic {
    let message = format!("the body in `{}` is unstable at env step {env_step}", path.display());
    Diagnostic::without_place(Code::RobotFile, message)
        .with_help("a body of less swelling or other neighbors may be stable; `nbc simulate` shows it")
}

pub(in crate::cli) fn behavior_of_file() -> Diagnostic {
    bad("`--behavior` chooses among the robots of runs")
        .with_help("leave it out: a robot of your own has the behavior that it has")
}

pub(in crate::cli) fn unprintable(error: &io::Error) -> Diagnostic {
    Diagnostic::without_place(Code::Unwritable, format!("cannot write the output: {}", io_words(error)))
}

pub(in crate::cli) fn unreadable(path: &Path, error: &io::Error) -> Diagnostic {
    let message = format!("cannot read `{}`: {}", path.display(), io_words(error));
    Diagnostic::without_place(Code::Unreadable, message)
}

pub(in crate::cli) fn two_formats(option: &str) -> Diagnostic {
    bad(format!("`--format json` and `{option}` ask for two formats")).with_help("leave out one")
}

pub(in crate::cli) fn two_files(name: &str) -> Diagnostic {
    bad(format!("the file `{name}` is given twice")).with_help("leave out one")
}

pub(in crate::cli) fn no_json(what: &str) -> Diagnostic {
    bad(format!("{what} cannot be JSON")).with_help("leave out `--format json`")
}

pub(in crate::cli) fn unknown_code(word: &str) -> Diagnostic {
    bad(format!("no message has the code `{word}`"))
        .with_help("`nbc explain` lists the codes")
        .with_near(&Suggestion::near(word, Code::ALL.iter().map(|code| code.word())))
}

pub(in crate::cli) fn unknown_robot<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Diagnostic {
    Diagnostic::without_place(Code::UnknownRobot, format!("no robot of the library is called `{name}`"))
        .with_help("`nbc library list` lists the robots; a function such as `nand` means its best one")
        .with_near(&Suggestion::near(name, known))
}

pub(in crate::cli) fn no_robots(path: &Path) -> Diagnostic {
    Diagnostic::without_place(Code::Empty, format!("`{}` contains no robot files (.yaml)", path.display()))
        .with_help("`nbc library add RUN --into DIR` writes robot files")
}

pub(in crate::cli) fn threads(variable: &str, found: &str) -> Diagnostic {
    bad(format!("the environment variable `{variable}` is `{found}`, expected a number of threads"))
        .with_help("unset it to use every core")
}

pub(in crate::cli) fn nothing_to_export(path: &str) -> Diagnostic {
    Diagnostic::without_place(Code::Empty, format!("`{path}` contains neither a run nor robots"))
        .with_help("name the folder of a run such as `out/gates`, a folder of robot files, or `shipped`")
}

#[cfg(feature = "play")]
pub(in crate::cli) fn only_exported() -> Diagnostic {
    bad("`--circuit` and `--swarm` choose what `--export` writes")
        .with_help("add `--export FILE`, or leave them out: the page shows every circuit of the file")
}

#[cfg(feature = "play")]
pub(in crate::cli) fn no_live_pages() -> Diagnostic {
    bad("this program was built without the page of `--live`")
        .with_help("leave `--live` out for a recording, or build the program with the page (docs/packaging.md)")
}

pub(in crate::cli) fn witness_of_source() -> Diagnostic {
    bad("`--witness` is for one model in AIGER's format")
        .with_help("leave it out: a property of a program is refuted by a test")
}

pub(in crate::cli) fn no_images(size: ImageSize) -> Diagnostic {
    bad(format!("the body senses images of {size} pixels, but is shown none")).with_help(
        "name a file with sets of images in `--images`, and its sets in `--schedule`, for example `zeros*250steps`",
    )
}

pub(in crate::cli) fn nothing_sees() -> Diagnostic {
    bad("`--images` is for bodies that sense images")
        .with_help("leave it out: this body senses patterns of stimuli such as `01`")
}

/// A run where one body is expected, with the behaviors of its bodies.
pub(in crate::cli) fn body_of_run(path: &str, behaviors: &[String]) -> Diagnostic {
    bad(format!("`{path}` is a run, expected one `--behavior` of it"))
        .with_help(format!("it has bodies with {}", alternatives(behaviors, "and")))
}

pub(in crate::cli) fn no_worlds() -> Diagnostic {
    bad("none of these tests runs in a world")
        .with_help("leave out `--vary`: a test for ever is decided at the level of logic")
}

pub(in crate::cli) fn exists(file: &str) -> Diagnostic {
    Diagnostic::without_place(Code::Unwritable, format!("`{file}` exists already"))
        .with_help("choose another name, or remove the file")
}

pub(in crate::cli) fn no_word(file: &str) -> Diagnostic {
    bad(format!("no circuit can have the name of `{file}`"))
        .with_help("a name has letters, digits and `_`, begins with no digit, and is no reserved word")
}

pub(in crate::cli) fn setting(error: SettingError) -> Diagnostic {
    bad(match error {
        SettingError::WideWorld { width, most } => {
            format!("`--world-width {width}` is too wide, expected at most {most}")
        }
        SettingError::NarrowWorld { width, columns } => {
            format!("`--world-width {width}` is too narrow for a body of {}", counted(columns, "column"))
        }
        SettingError::OffGround { start, most, columns, width } => format!(
            "`--start-x {start}` is off the ground, expected at most {most} for {} on {}",
            counted(columns, "column"),
            counted(width, "voxel")
        ),
    })
}

/// A robot that left its ground of `width` voxels at that env step.
pub(in crate::cli) fn ground_ends(step: usize, width: usize) -> Diagnostic {
    let message = format!("the robot walked off the end of its ground at env step {step}");
    let fault = Diagnostic::without_place(Code::GroundEnds, message)
        .with_help(format!("give it more than {width} voxels with `--world-width`"));
    Diagnostic { severity: Severity::Warning, ..fault }
}

pub(in crate::cli) fn no_such(message: String, name: &str, known: &[String]) -> Diagnostic {
    Diagnostic::without_place(Code::Unknown, message)
        .with_help(format!("there are {}", alternatives(known, "and")))
        .with_near(&Suggestion::near(name, known.iter().map(String::as_str)))
}
