//! The reasons for which requests of a page are refused, and their messages.

use serde::Serialize;

use nbc_base::diag::{Diagnostic, Diagnostics, Finding, io_words, visible};
use nbc_base::model::Fault;
use nbc_base::source::FileError;

#[derive(Clone, Debug)]
pub(super) enum Refused {
    Message(String),
    NoSwarm,
    Bits { expected: usize },
    Cycle { first: u32, last: u32 },
    NoTest,
    NoClaim,
    TooManyRobots { robots: usize, most: usize },
    NumberInUse { id: u64 },
    RobotExists { path: String, free: String, is_replaceable: bool },
    Busy { most: usize },
    Cancelled,
    TimedOut { seconds: u64 },
    Unreadable { path: String, error: FileError },
    Unwritable { path: String, reason: String },
    Changed { path: String },
    Ending { path: String, expected: &'static str },
    HiddenInPath { path: String },
    NotOwn { path: String, own: String },
    NotJoined,
    NoExample(String),
    Name(String),
    Body(String),
    NoClass,
    ClassFull { most: usize },
    ClassName { most: usize },
    ClassNameTaken { name: String },
    Internal,
    NoLivePages,
    Source(Diagnostics),
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct Refusal {
    message: String,
    help: Option<String>,
    /// A word for what a page reacts to.
    code: Option<&'static str>,
    /// The path that could be saved at instead.
    instead: Option<String>,
    diagnostics: Vec<Finding>,
}

impl Refused {
    pub(super) fn unwritable(path: &str, error: &std::io::Error) -> Self {
        Self::Unwritable { path: path.to_owned(), reason: io_words(error) }
    }

    pub(super) fn fault(fault: Fault) -> Self {
        Self::Body(format!("its simulation {} in env step {}", fault.kind, fault.env_step))
    }

    fn message(&self) -> String {
        match self {
            Self::Message(reason) => format!("the message is not a request: {reason}"),
            Self::NoSwarm => "no circuit has been compiled".to_owned(),
            Self::Bits { expected } => format!("expected {expected} input bits, such as `{}`", "0".repeat(*expected)),
            Self::Cycle { first, last } => format!("the log goes from cycle {first} to {last}"),
            Self::NoTest => "the program has no such test or row".to_owned(),
            Self::NoClaim => "the program claims nothing of that number".to_owned(),
            Self::TooManyRobots { robots, most } => {
                format!("the circuit needs {robots} robots; the page runs at most {most}")
            }
            Self::NumberInUse { id } => format!("request {id} is still running"),
            Self::RobotExists { path, .. } => format!("`{path}` is there already"),
            Self::Busy { most } => format!("{most} requests of this page are still running"),
            Self::Cancelled => "it was cancelled".to_owned(),
            Self::TimedOut { seconds } => format!("it took longer than {seconds} seconds and was stopped"),
            Self::Unreadable { path, error } => Diagnostic::unreadable(path, error).message,
            Self::Unwritable { path, reason } => format!("cannot write `{path}`: {reason}"),
            Self::Changed { path } => format!("`{path}` has been changed on disk"),
            Self::Ending { path, expected } => format!("`{path}` does not end in `{expected}`"),
            Self::HiddenInPath { path } => format!("`{}` has characters that cannot be seen", visible(path)),
            Self::NotOwn { path, .. } => format!("`{path}` is not a file of yours: the class shares this folder"),
            Self::NotJoined => "the class shares this folder: join it with a name, so that you have files".to_owned(),
            Self::NoExample(name) => format!("there is no example `{name}`"),
            Self::Name(name) => format!("`{name}` cannot be the name of a robot"),
            Self::Body(reason) => reason.clone(),
            Self::NoLivePages => "this nbc has nothing to make live pages of".to_owned(),
            Self::NoClass => "this page is in no class".to_owned(),
            Self::ClassFull { most } => format!("the class has {most} members, and no room for another one"),
            Self::ClassName { most } => format!("a name has 1 to {most} letters, in one line"),
            Self::ClassNameTaken { name } => format!("somebody else is called {name}"),
            Self::Internal => "the program failed; its log says where".to_owned(),
            Self::Source(found) => match found.list.iter().find(|one| one.is_error()) {
                Some(first) => first.message.clone(),
                None => "the source has errors".to_owned(),
            },
        }
    }

    fn help(&self) -> Option<String> {
        match self {
            Self::Changed { .. } => Some("load it, or save again to replace it".to_owned()),
            Self::Name(_) => Some("use letters, digits, `_` and `-`".to_owned()),
            Self::NumberInUse { .. } => Some("give each request a number of its own".to_owned()),
            Self::RobotExists { free, .. } => Some(format!("the name `{free}` is free")),
            Self::HiddenInPath { .. } => Some("use letters, digits, `_`, `-`, `.` and `/`".to_owned()),
            Self::NotOwn { own, .. } => Some(format!("save it as `{own}`")),
            Self::ClassNameTaken { .. } => Some("choose another name".to_owned()),
            Self::Busy { .. } => Some("wait for one of them, or cancel it".to_owned()),
            Self::TooManyRobots { .. } => Some("test it with `nbc test`".to_owned()),
            Self::NoLivePages => Some("take a recorded page".to_owned()),
            Self::Source(found) => found.list.iter().find(|one| one.is_error())?.help.clone(),
            _ => None,
        }
    }

    fn code(&self) -> Option<&'static str> {
        match self {
            Self::Cancelled => Some("cancelled"),
            Self::TimedOut { .. } => Some("timed-out"),
            Self::Changed { .. } => Some("changed"),
            Self::NumberInUse { .. } => Some("in-use"),
            Self::RobotExists { is_replaceable: true, .. } => Some("exists"),
            Self::NotOwn { .. } => Some("not-own"),
            Self::Busy { .. } => Some("busy"),
            _ => None,
        }
    }
}

impl From<Refused> for Refusal {
    fn from(refused: Refused) -> Self {
        let diagnostics = match &refused {
            Refused::Source(found) => found.findings(),
            _ => Vec::new(),
        };
        let (message, help, code) = (refused.message(), refused.help(), refused.code());
        let instead = if let Refused::NotOwn { own, .. } = refused { Some(own) } else { None };
        Self { message, help, code, instead, diagnostics }
    }
}

impl From<Diagnostics> for Refused {
    fn from(found: Diagnostics) -> Self {
        Self::Source(found)
    }
}
