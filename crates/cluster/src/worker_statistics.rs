//! The workers that have reported to a search in the last seconds, and the number of their results.

use std::collections::{BTreeMap, VecDeque};
use std::time::{Duration, Instant};

use crate::message::WorkerNote;
use nbc_base::diag::counted;

const GONE: Duration = Duration::from_secs(10);
const WINDOW: Duration = Duration::from_secs(10);
const FRESH: Duration = Duration::from_millis(200);

#[derive(Default)]
pub struct WorkerStatistics {
    workers: BTreeMap<String, (WorkerNote, Instant)>,
    taken: u64,
    history: VecDeque<(Instant, u64)>,
    summary: Option<(Instant, Summary)>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    pub workers: usize,
    pub threads: usize,
    pub evaluations: u64,
    pub rate: f64,
    pub redelivered: u64,
}

impl WorkerStatistics {
    pub fn take(&mut self, note: WorkerNote) {
        self.workers.insert(note.name.clone(), (note, Instant::now()));
    }

    pub fn has(&self, name: &str) -> bool {
        self.workers.get(name).is_some_and(|(_, seen)| seen.elapsed() < GONE)
    }

    pub fn count(&mut self) {
        self.taken += 1;
    }

    pub fn summary(&mut self) -> Summary {
        let now = Instant::now();
        if let Some((_, summary)) = self.summary.filter(|(made, _)| now - *made < FRESH) {
            return summary;
        }
        let rate = self.rate(now);
        let present = || self.workers.values().filter(|(_, seen)| now - *seen < GONE).map(|(note, _)| note);
        let summary = Summary {
            workers: present().count(),
            threads: present().map(|note| note.threads as usize).sum(),
            evaluations: self.taken,
            redelivered: self.workers.values().map(|(note, _)| note.redelivered).sum(),
            rate,
        };
        self.summary = Some((now, summary));
        summary
    }

    fn rate(&mut self, now: Instant) -> f64 {
        self.history.push_back((now, self.taken));
        while self.history.len() > 1 && now - self.history[0].0 > WINDOW {
            self.history.pop_front();
        }
        let (since, before) = self.history[0];
        (self.taken - before) as f64 / (now - since).max(FRESH).as_secs_f64()
    }
}

impl Summary {
    pub fn describe(&self) -> String {
        let workers = counted(self.workers, "worker");
        format!("{workers}, {:.1} evaluations/s, {} redelivered", self.rate, self.redelivered)
    }
}
