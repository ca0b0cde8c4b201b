//! What is around a language service: who does long work, and who has the files.

use nbc_base::source::SharedWorld;

pub type LanguageWork = Box<dyn FnOnce() + Send>;

pub trait LanguageShell: Send + Sync {
    fn world(&self) -> SharedWorld;

    /// In order, also below the folders.
    fn source_files(&self, folders: &[&str]) -> Vec<String>;

    /// Does work after all that was queued before it, without waiting for it. Then the service is advanced.
    fn queue(&self, work: LanguageWork);

    /// Does work in parallel. After it, and after [`LanguageShell::wake`], the service is advanced.
    fn start(&self, work: LanguageWork);

    /// Work calls this to have its progress reported.
    fn wake(&self);

    /// Writes a file that the client can open; `None` if it cannot be written, or the client would not see it.
    fn write_text(&self, name: &str, text: &str) -> Option<String>;

    /// Whether the client sees the files of [`LanguageShell::write_result`].
    fn shows_results(&self) -> bool;

    /// `folder` is for the results of one source. Returns the path.
    fn write_result(&self, folder: &str, name: &str, text: &str) -> Result<String, String>;
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ServerEnd {
    /// The client asked the server to shut down, or vanished.
    Orderly,
    /// The client ended the server without a request to shut down, which is a failure by the protocol.
    Abandoned,
}
