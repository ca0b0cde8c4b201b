//! What is around the pages: who does long work, and who has the files.

use std::sync::Arc;

use crate::crew_part::{CrewPart, GivenParts};
use crate::lesson_texts::LessonTexts;
use nbc_base::source::{FileError, SharedWorld};
use nbc_circuit::CancelFlag;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkKind {
    Check,
    Program,
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

    fn template(&self) -> Option<Arc<str>>;

    fn lessons(&self) -> Vec<LessonTexts>;

    fn crew(&self) -> Option<&dyn Crew> {
        None
    }
}

pub trait Crew: Send + Sync {
    /// How many parts they simulate at the same time. With none, missing results will not come.
    fn size(&self) -> usize;

    /// Dropping the handle drops the parts.
    fn give(&self, parts: Vec<CrewPart>) -> Arc<GivenParts>;
}

pub type CancelSource = Arc<dyn Fn() -> CancelFlag + Send + Sync>;

/// The files that a page may read and write. Paths are relative to the folder.
pub trait PageFolder: Send + Sync {
    fn name(&self) -> String;

    fn uri(&self) -> String;

    fn world(&self) -> SharedWorld;

    fn guarded(&self, cancel: CancelSource) -> SharedWorld;

    /// The paths and sizes in bytes of the files below the folder that are `wanted`, in order.
    fn files(&self, wanted: &dyn Fn(&str) -> bool) -> Vec<(String, u64)>;

    /// A text that changes with a file; `None` if there is no such file.
    fn stamp(&self, path: &str) -> Option<String>;

    fn may_write(&self, path: &str) -> Result<(), FileError>;

    fn write(&self, path: &str, text: &str) -> Result<(), String>;

    fn make_folder(&self, path: &str) -> Result<(), String>;
}
