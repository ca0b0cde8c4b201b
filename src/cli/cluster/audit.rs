//! Checks of workers: some of their work is done here, too.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use tokio::runtime::Handle;
use tokio::task::JoinSet;

use crate::cli::cluster::message::TaskKey;
use nbc_sim::Simulator;
use nbc_swarm::{Task, TaskResult, perform};

/// The share of the time that is spent on workers that have passed.
const SHARE: f64 = 0.02;

/// The audits in progress, and what is known of the workers.
pub struct Auditor {
    handle: Handle,
    /// Whether all workers are trusted.
    trusting: bool,
    workers: BTreeMap<String, Standing>,
    audits: JoinSet<Audit>,
    started: Instant,
    spent: Duration,
}

/// What is known of a worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Standing {
    /// Its first result is being checked.
    New,
    /// Its first result was right.
    Passed,
}

/// A task that was done here.
pub struct Audit {
    pub key: TaskKey,
    /// What workers claimed.
    pub claims: Vec<(String, TaskResult)>,
    pub correct: TaskResult,
    took: Duration,
}

impl Audit {
    /// The workers whose claims were wrong.
    pub fn wrong(&self) -> impl Iterator<Item = &str> {
        self.claims.iter().filter(|(_, claim)| *claim != self.correct).map(|(worker, _)| worker.as_str())
    }
}

impl Auditor {
    /// Knows no workers.
    pub fn new(handle: Handle, trusting: bool) -> Self {
        let (started, spent) = (Instant::now(), Duration::ZERO);
        Self { handle, trusting, workers: BTreeMap::new(), audits: JoinSet::new(), started, spent }
    }

    /// Whether a result of the worker should be checked: its first, and later ones as far as there is time.
    pub fn wants(&mut self, worker: &str) -> bool {
        let allowed = self.started.elapsed().mul_f64(SHARE);
        if self.trusting {
            return false;
        }
        match self.workers.get(worker) {
            None => {
                self.workers.insert(worker.to_owned(), Standing::New);
                true
            }
            Some(Standing::New) => false,
            Some(Standing::Passed) => self.audits.is_empty() && self.spent < allowed,
        }
    }

    /// Does a task on another thread.
    pub fn start(&mut self, key: TaskKey, task: Task, claims: Vec<(String, TaskResult)>) {
        let check = move || {
            let started = Instant::now();
            let correct = perform(&Simulator::default(), &[task]).remove(0);
            Audit { key, claims, correct, took: started.elapsed() }
        };
        self.audits.spawn_blocking_on(check, &self.handle);
    }

    /// The next audit that ends; `None` if there is none in progress.
    pub async fn next(&mut self) -> Option<Audit> {
        let audit = self.audits.join_next().await?.expect("tasks do not panic");
        self.spent += audit.took;
        for (worker, claim) in &audit.claims {
            if *claim == audit.correct {
                self.workers.insert(worker.clone(), Standing::Passed);
            }
        }
        Some(audit)
    }

    /// Whether results of the worker can be used.
    pub fn trusts(&self, worker: &str) -> bool {
        self.trusting || self.workers.get(worker) == Some(&Standing::Passed)
    }
}
