//! The shell of the language service: its work waits for its turn in the tab's thread, and its files are the tab's.

use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError};

use nbc_base::source::SharedWorld;
use nbc_lsp::{LanguageShell, LanguageWork};
use nbc_play::{MemoryFolder, PageFolder};

pub(super) struct LanguageQueue {
    folder: MemoryFolder,
    work: Mutex<VecDeque<LanguageWork>>,
}

impl LanguageQueue {
    pub(super) fn new(folder: MemoryFolder) -> Self {
        Self { folder, work: Mutex::default() }
    }

    pub(super) fn has_work(&self) -> bool {
        !self.work.lock().unwrap_or_else(PoisonError::into_inner).is_empty()
    }

    pub(super) fn advance(&self) {
        let next = self.work.lock().unwrap_or_else(PoisonError::into_inner).pop_front();
        next.into_iter().for_each(|work| work());
    }
}

impl LanguageShell for LanguageQueue {
    fn world(&self) -> SharedWorld {
        self.folder.world()
    }

    fn source_files(&self, _folders: &[&str]) -> Vec<String> {
        let files = self.folder.files(&|path| path.ends_with(".nb"));
        files.into_iter().map(|(path, _)| format!("/{path}")).collect()
    }

    fn queue(&self, work: LanguageWork) {
        self.work.lock().unwrap_or_else(PoisonError::into_inner).push_back(work);
    }

    fn start(&self, work: LanguageWork) {
        self.queue(work);
    }

    fn wake(&self) {}

    fn write_text(&self, _name: &str, _text: &str) -> Option<String> {
        None
    }

    fn shows_results(&self) -> bool {
        false
    }

    fn write_result(&self, _folder: &str, _name: &str, _text: &str) -> Result<String, String> {
        Err("a browser tab has no folder for results".to_owned())
    }
}
