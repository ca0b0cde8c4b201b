//! Why a file cannot be read.

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileError {
    NotFound,
    /// The path leads to a folder, a pipe or a device; the text names it with its article.
    NotRegular(&'static str),
    TooLarge {
        limit: u64,
    },
    NotText {
        /// The offset of the first invalid byte.
        offset: usize,
    },
    Io(String),
}

impl FileError {
    /// The text of a file with these bytes.
    pub fn text(bytes: Vec<u8>) -> Result<String, Self> {
        String::from_utf8(bytes).map_err(|error| Self::NotText { offset: error.utf8_error().valid_up_to() })
    }
}
