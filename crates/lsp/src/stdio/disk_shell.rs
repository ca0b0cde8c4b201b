//! The disk and the threads around a language service.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::{fs, thread};

use crossbeam_channel::{Sender, unbounded};

use crate::shell::{LanguageShell, LanguageWork};
use crate::stdio::pending::Pending;
use crate::stdio::results::{self, ResultFolder};
use nbc_base::source::{EntryKind, SharedWorld, SourceWorld};
use nbc_session::store::{self, GuardedWorld};

pub(super) struct DiskShell<W> {
    world: W,
    pending: Pending,
    queue: Sender<LanguageWork>,
    wake: Sender<()>,
    results: Mutex<ResultFolder>,
    /// The paths of written texts by their names. A name always has the same text.
    written: Mutex<BTreeMap<String, PathBuf>>,
}

impl<W: SourceWorld> DiskShell<W> {
    /// `wake` receives when there is something to do.
    pub(super) fn new(world: W, pending: Pending, wake: Sender<()>) -> Self {
        results::remove_leftovers();
        let (queue, inbox) = unbounded::<LanguageWork>();
        let done = wake.clone();
        thread::spawn(move || {
            for work in inbox {
                work();
                let _ = done.try_send(());
            }
        });
        Self { world, pending, queue, wake, results: Mutex::default(), written: Mutex::default() }
    }

    pub(super) fn remove_results(&self) {
        *self.results.lock().unwrap_or_else(PoisonError::into_inner) = ResultFolder::default();
    }
}

impl<W: SourceWorld + Clone + Send + Sync + 'static> LanguageShell for DiskShell<W> {
    fn world(&self) -> SharedWorld {
        let waiting = self.pending.clone();
        Arc::new(GuardedWorld::new(self.world.clone(), move || waiting.cancel()))
    }

    fn source_files(&self, folders: &[&str]) -> Vec<String> {
        // What the client does not see is not looked at.
        let folders = folders.iter().filter(|folder| self.world.kind(folder) == Some(EntryKind::Folder));
        store::source_files(folders.map(Into::into), |path| path.ends_with(".nb"))
    }

    fn queue(&self, work: LanguageWork) {
        let _ = self.queue.send(work);
    }

    fn start(&self, work: LanguageWork) {
        let done = self.wake.clone();
        thread::spawn(move || {
            work();
            let _ = done.try_send(());
        });
    }

    fn wake(&self) {
        // Several calls before the service is advanced are one.
        let _ = self.wake.try_send(());
    }

    fn write_text(&self, name: &str, text: &str) -> Option<String> {
        let mut written = self.written.lock().unwrap_or_else(PoisonError::into_inner);
        let path = match written.get(name).filter(|path| path.exists()) {
            Some(path) => path,
            None => {
                let path = store::temporary_folder().ok().filter(|_| self.shows_results())?.join(name);
                if fs::read_to_string(&path).ok().as_deref() != Some(text) {
                    store::write(&path, text.as_bytes()).ok()?;
                }
                written.entry(name.to_owned()).insert_entry(path).into_mut()
            }
        };
        Some(path.to_string_lossy().into_owned())
    }

    fn shows_results(&self) -> bool {
        // A client that is served another folder does not see it.
        let folder = store::temporary_folder().ok();
        folder.is_some_and(|folder| self.world.kind(&folder.to_string_lossy()) == Some(EntryKind::Folder))
    }

    fn write_result(&self, folder: &str, name: &str, text: &str) -> Result<String, String> {
        let folder = self.results.lock().unwrap_or_else(PoisonError::into_inner).path()?.join(folder);
        let path = folder.join(name);
        let done = store::create_folder(&folder).and_then(|()| store::write(&path, text.as_bytes()));
        done.map_err(|error| format!("cannot write `{}`: {error}", path.display()))?;
        Ok(path.to_string_lossy().into_owned())
    }
}
