//! The texts of lessons, as a shell finds them.

use std::io;

#[derive(Debug)]
pub enum LessonTexts {
    Shipped,
    Folder(LessonFiles),
}

/// The files `*.md` of a folder except `README.md`, in order.
#[derive(Debug)]
pub struct LessonFiles {
    pub folder: String,
    pub files: io::Result<Vec<(String, io::Result<String>)>>,
}

impl LessonFiles {
    /// The most bytes of a lesson. Of a larger file, one byte more is enough.
    pub const MOST_BYTES: usize = 64 << 10;
}
