//! The texts of lessons, as a shell finds them.

use std::io;

/// Lessons of one source.
#[derive(Debug)]
pub enum LessonTexts {
    /// Those that come with the program.
    Shipped,
    /// Those of a folder.
    Folder(LessonFiles),
}

/// The lesson files of a folder: its files `*.md` but for `README.md`, in order.
#[derive(Debug)]
pub struct LessonFiles {
    /// The folder, as the user gave it.
    pub folder: String,
    /// The paths of the files, and their texts.
    pub files: io::Result<Vec<(String, io::Result<String>)>>,
}

impl LessonFiles {
    /// The most bytes of a lesson. Of a larger file, the first bytes that are too many suffice.
    pub const MOST_BYTES: usize = 64 << 10;
}
