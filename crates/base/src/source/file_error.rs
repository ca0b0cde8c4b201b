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
