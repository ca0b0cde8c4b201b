//! The session of a page, in which its long requests check its texts, one after the other.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use crate::jobs::Job;
use crate::lock::lock;
use crate::refusal::Refused;
use crate::shell::PageFolder;
use nbc_circuit::CancelFlag;
use nbc_session::{Checked, Session};

pub(super) struct TextChecker {
    session: Mutex<Session>,
    /// What has changed since the last check, by path, so that a change never waits for a check.
    changes: Mutex<Changes>,
    cancel: Arc<Mutex<CancelFlag>>,
}

#[derive(Default)]
struct Changes {
    /// The new text of a file; `None` for that of the folder again.
    texts: BTreeMap<String, Option<String>>,
    /// Counts the texts of the page, so that each has a later revision than the one before.
    revision: u64,
}

impl TextChecker {
    pub(super) fn new(folder: &dyn PageFolder) -> Self {
        let cancel: Arc<Mutex<CancelFlag>> = Arc::default();
        let current = cancel.clone();
        let world = folder.guarded(Arc::new(move || lock(&current).clone()));
        Self { session: Mutex::new(Session::new(world)), changes: Mutex::default(), cancel }
    }

    pub(super) fn update(&self, path: String, text: String) {
        lock(&self.changes).texts.insert(path, Some(text));
    }

    pub(super) fn close(&self, path: String) {
        lock(&self.changes).texts.insert(path, None);
    }

    pub(super) fn checked(&self, path: &str, job: &Job) -> Result<Arc<Checked>, Refused> {
        self.with(job, |session| session.checked(path))
    }

    /// Gives the session to `work` alone. Other calls wait, so a page translates one Verilog file at a time.
    pub(super) fn with<R>(&self, job: &Job, work: impl FnOnce(&mut Session) -> R) -> Result<R, Refused> {
        let mut session = lock(&self.session);
        job.check()?;
        *lock(&self.cancel) = job.stop.clone();
        let mut changes = lock(&self.changes);
        for (path, text) in std::mem::take(&mut changes.texts) {
            changes.revision += 1;
            match text {
                Some(text) => session.update(&path, changes.revision, text),
                None => session.close(&path),
            }
        }
        drop(changes);
        let done = work(&mut session);
        job.check()?;
        Ok(done)
    }

    pub(super) fn open(&self, path: &str, job: &Job) -> Result<Arc<Checked>, Refused> {
        let checked = self.checked(path, job)?;
        if checked.has_errors() { Err(checked.fail(checked.diagnostics.clone()).into()) } else { Ok(checked) }
    }

    /// `more` is added to the text.
    pub(super) fn open_with(&self, path: &str, more: Option<&str>, job: &Job) -> Result<Arc<Checked>, Refused> {
        let checked = self.open(path, job)?;
        let Some(more) = more else { return Ok(checked) };
        let own = checked.file.map_or("", |file| &checked.sources.file(file).text);
        // Beside the source, so that it finds the same files, at a path that no page can have.
        let beside = format!("{path}\0");
        let checked = self.with(job, |session| {
            session.update(&beside, 0, format!("{own}\n{more}"));
            let checked = session.checked(&beside);
            session.close(&beside);
            checked
        })?;
        if checked.has_errors() { Err(checked.fail(checked.diagnostics.clone()).into()) } else { Ok(checked) }
    }
}
