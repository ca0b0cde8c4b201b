//! What is around a language service: who does long work, and who has the files.

use nbc_base::source::SharedWorld;

/// Work that may take long.
pub type LanguageWork = Box<dyn FnOnce() + Send>;

/// What is around a language service.
pub trait LanguageShell: Send + Sync {
    /// The files that the client sees.
    fn world(&self) -> SharedWorld;

    /// The source files of folders and below them, in order.
    fn source_files(&self, folders: &[&str]) -> Vec<String>;

    /// Does work after all that was given before it. Whoever calls this does not wait for it. After it, the service is
    /// advanced.
    fn queue(&self, work: LanguageWork);

    /// Does work beside all other. After it, and after [`LanguageShell::wake`], the service is advanced.
    fn start(&self, work: LanguageWork);

    /// Has the service advanced soon. Work calls this when it has progress to report.
    fn wake(&self);

    /// Writes a text of the program to a file that the client can open. Returns its path; `None` if it cannot be
    /// written, or the client would not see it.
    fn write_text(&self, name: &str, text: &str) -> Option<String>;

    /// Whether the client sees the files of [`LanguageShell::write_result`].
    fn shows_results(&self) -> bool;

    /// Writes a result of a command, into a folder for those of one source. Returns its path.
    fn write_result(&self, folder: &str, name: &str, text: &str) -> Result<String, String>;
}
