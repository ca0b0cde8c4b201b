//! What is around the pages: who does long work, and who has the files.

use std::sync::Arc;

use crate::crew_part::{CrewPart, GivenParts};
use crate::lesson_texts::LessonTexts;
use nbc_base::source::{FileError, SharedWorld};
use nbc_circuit::CancelFlag;

/// The kinds of long work. A shell can give each its own place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkKind {
    /// A check of a text, which the page asks for while its user types.
    Check,
    /// Work on a program, its circuits and its swarms.
    Program,
    /// The measurement of a body that the user has just painted.
    Probe,
    /// A search, or a measurement that takes as long.
    Search,
}

/// What there is after a portion of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Portion {
    /// It is done.
    Done,
    /// There is more to do.
    More,
    /// There will be when the [`Crew`] brings something. It does no harm to call it before.
    Waits,
}

/// Does a portion of the work.
pub type Portions = Box<dyn FnMut() -> Portion + Send>;

/// What is around the pages of a site.
pub trait Shell: Send + Sync {
    /// Does work that may take long, by calling the portions until one is the last. Whoever calls this does not wait
    /// for it.
    fn start(&self, kind: WorkKind, portions: Portions);

    /// Keeps a file that a page will fetch once. Returns its address, relative to the page.
    fn keep(&self, name: &str, media_type: &'static str, bytes: Vec<u8>) -> String;

    /// The page without sources that live pages are made of, if there is one.
    fn template(&self) -> Option<Arc<str>>;

    /// The lessons of the page, as their files are now.
    fn lessons(&self) -> Vec<LessonTexts>;

    /// Who does parts of simulations while the page does another, if there is anybody.
    fn crew(&self) -> Option<&dyn Crew> {
        None
    }
}

/// Others that do parts of simulations.
pub trait Crew: Send + Sync {
    /// How many parts they do at the same time. When there are none, what was given to them will not come.
    fn size(&self) -> usize;

    /// Gives them parts. They are dropped with the handle.
    fn give(&self, parts: Vec<CrewPart>) -> Arc<GivenParts>;
}

/// Gives the flag that ends what begins now.
pub type CancelSource = Arc<dyn Fn() -> CancelFlag + Send + Sync>;

/// The files that a page may read and write. Paths are relative to the folder.
pub trait PageFolder: Send + Sync {
    /// The name of the folder, for people.
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

    /// Writes a file.
    fn write(&self, path: &str, text: &str) -> Result<(), String>;

    /// Makes a folder, unless it is there.
    fn make_folder(&self, path: &str) -> Result<(), String>;
}
