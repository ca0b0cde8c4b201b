//! What is around the pages: who does long work, and who has the files.

use std::sync::Arc;

use crate::crew_part::{CrewPart, GivenParts};
use crate::lesson_texts::LessonTexts;
use nbc_base::source::{FileError, SharedWorld};
use nbc_circuit::CancelFlag;

/// The kinds of long work. A shell can give each its own place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkKind {
    /// A check of a text while its user types.
    Check,
    Program,
    /// The measurement of a body that the user has just painted.
    Probe,
    Search,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Portion {
    Done,
    More,
    /// There will be more to do when the [`Crew`] brings something. Calling it earlier does no harm.
    Waits,
}

pub type Portions = Box<dyn FnMut() -> Portion + Send>;

pub trait Shell: Send + Sync {
    /// Starts work that may take long, and returns at once. The shell calls the portions until one is the last.
    fn start(&self, kind: WorkKind, portions: Portions);

    /// Keeps a file that a page will fetch once. Returns its address, relative to the page.
    fn keep(&self, name: &str, media_type: &'static str, bytes: Vec<u8>) -> String;

    /// The page without sources that live pages are made of.
    fn template(&self) -> Option<Arc<str>>;

    fn lessons(&self) -> Vec<LessonTexts>;

    /// The workers that simulate parts while the page does another.
    fn crew(&self) -> Option<&dyn Crew> {
        None
    }
}

/// Workers that simulate parts for a page.
pub trait Crew: Send + Sync {
    /// How many parts they simulate at the same time. With none, missing results will not come.
    fn size(&self) -> usize;

    /// Hands parts to the workers. Dropping the handle drops them.
    fn give(&self, parts: Vec<CrewPart>) -> Arc<GivenParts>;
}

/// Gives the flag that ends what begins now.
pub type CancelSource = Arc<dyn Fn() -> CancelFlag + Send + Sync>;

/// The files that a page may read and write. Paths are relative to the folder.
pub trait PageFolder: Send + Sync {
    fn name(&self) -> String;

    /// The URI of the folder, for the language server.
    fn uri(&self) -> String;

    /// Everything that can be read.
    fn world(&self) -> SharedWorld;

    /// The same, for checks and translations that end when a flag is raised.
    fn guarded(&self, cancel: CancelSource) -> SharedWorld;

    /// The paths and sizes in bytes of the files below the folder that are `wanted`, in order.
    fn files(&self, wanted: &dyn Fn(&str) -> bool) -> Vec<(String, u64)>;

    /// A text that changes with a file; `None` if there is no such file.
    fn stamp(&self, path: &str) -> Option<String>;

    /// Whether a file or folder may be made or replaced at `path`.
    fn may_write(&self, path: &str) -> Result<(), FileError>;

    fn write(&self, path: &str, text: &str) -> Result<(), String>;

    /// Makes a folder, unless it is there.
    fn make_folder(&self, path: &str) -> Result<(), String>;
}
