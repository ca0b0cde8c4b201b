//! Why a file cannot be read.

/// The reason why a file could not be read as source text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileError {
    /// There is no file with this path.
    NotFound,
    /// The path leads to a folder, a pipe or a device; the text names it with its article.
    NotRegular(&'static str),
    /// The file is larger than the limit.
    TooLarge {
        /// The limit in bytes.
        limit: u64,
    },
    /// The bytes are not UTF-8 text.
    NotText {
        /// The offset of the first invalid byte.
        offset: usize,
    },
    /// The operating system's error message.
    Io(String),
}
