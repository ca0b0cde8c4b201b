//! Figures of circuits, which are compiled apart, so that diagnostics never wait for a compilation.

use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Weak};

use crate::figures::{Figures, Subject};
use crate::shell::LanguageShell;
use nbc_circuit::CancelFlag;
use nbc_session::Checked;

type Key = (String, Subject);

const MOST: usize = 4096;

pub(super) struct Compiler {
    shell: Arc<dyn LanguageShell>,
    results: (Sender<Compilation>, Receiver<Compilation>),
    known: BTreeMap<Key, (Weak<Checked>, Option<Figures>)>,
    asked: BTreeSet<Key>,
    flags: Vec<(Weak<Checked>, CancelFlag)>,
}

struct Job {
    checked: Weak<Checked>,
    key: Key,
    cancel: CancelFlag,
}

pub(super) struct Compilation {
    checked: Weak<Checked>,
    key: Key,
    figures: Option<Figures>,
}

pub(super) enum FigureState<'a> {
    NotYet,
    Done(Option<&'a Figures>),
}

impl Compiler {
    pub(super) fn new(shell: Arc<dyn LanguageShell>) -> Self {
        Self { shell, results: channel(), known: BTreeMap::new(), asked: BTreeSet::new(), flags: Vec::new() }
    }

    pub(super) fn result(&self) -> Option<Compilation> {
        self.results.1.try_recv().ok()
    }

    pub(super) fn ask(&mut self, checked: &Arc<Checked>, subject: &Subject) -> FigureState<'_> {
        let key = (checked.path.clone(), subject.clone());
        if checked.has_errors() {
            return FigureState::Done(None);
        }
        let is_known = self.known.get(&key).is_some_and(|(of, _)| is_same(of, checked));
        if is_known {
            return FigureState::Done(self.known[&key].1.as_ref());
        }
        if self.asked.insert(key.clone()) {
            let cancel = CancelFlag::default();
            self.flags.push((Arc::downgrade(checked), cancel.clone()));
            let job = Job { checked: Arc::downgrade(checked), key, cancel };
            let results = self.results.0.clone();
            self.shell.queue(Box::new(move || _ = results.send(job.done())));
        }
        FigureState::NotYet
    }

    /// `None` while it is being compiled.
    pub(super) fn known(&self, path: &str, subject: &Subject) -> Option<Option<&Figures>> {
        let key = (path.to_owned(), subject.clone());
        if self.asked.contains(&key) { None } else { Some(self.known.get(&key).and_then(|(_, found)| found.as_ref())) }
    }

    pub(super) fn keep(&mut self, done: Compilation) {
        let Compilation { checked, key, figures } = done;
        self.asked.remove(&key);
        if self.asked.is_empty() {
            self.flags.clear();
        }
        if self.known.len() >= MOST {
            self.known.retain(|_, (of, _)| of.strong_count() > 0);
        }
        self.known.insert(key, (checked, figures));
    }

    pub(super) fn cancel_stale<'a>(&mut self, current: impl Iterator<Item = &'a Weak<Checked>> + Clone) {
        self.flags.retain(|(checked, flag)| {
            let is_stale = current.clone().all(|known| !known.ptr_eq(checked));
            if is_stale {
                flag.raise();
            }
            !is_stale
        });
    }

    pub(super) fn is_idle(&self) -> bool {
        self.asked.is_empty()
    }
}

fn is_same(of: &Weak<Checked>, checked: &Arc<Checked>) -> bool {
    std::ptr::eq(of.as_ptr(), Arc::as_ptr(checked))
}

impl Job {
    fn done(self) -> Compilation {
        let Self { checked, key, cancel } = self;
        // A bug in compiling one circuit must not end whoever does the work.
        let compile = |checked: Arc<Checked>| {
            catch_unwind(AssertUnwindSafe(|| key.1.compile(&checked, &cancel))).unwrap_or_default()
        };
        // A compilation that was cancelled may have more robots than needed.
        let figures = checked.upgrade().and_then(compile).filter(|_| !cancel.is_raised());
        Compilation { checked, key, figures }
    }
}
