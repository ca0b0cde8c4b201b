//! Checks the results of workers: whether a task can have such a result, and some of them by doing the task here, too.

mod plausible;

use std::collections::{BTreeMap, BTreeSet};
use std::time::{Duration, Instant};

use tokio::runtime::Handle;
use tokio::task::JoinSet;

use crate::Log;
use crate::message::TaskKey;
use nbc_sim::Simulator;
use nbc_swarm::{Task, TaskResult, perform};

pub use plausible::is_plausible;

/// The share of the time that is spent on further checks of workers that have passed their first.
const SHARE: f64 = 0.02;
const JUNK_LINES: u64 = 8;
/// A worker is refused after wrong results of so many tasks. Anybody who can use the server can send one in its name.
const MOST_WRONG: usize = 3;

pub struct Checker {
    handle: Handle,
    log: Log,
    is_trusting: bool,
    workers: BTreeMap<String, Known>,
    unsound: Option<String>,
    junk: u64,
    checks: JoinSet<Check>,
    started: Instant,
    spent: Duration,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Known {
    standing: Standing,
    is_used: bool,
    wrong: BTreeSet<TaskKey>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Standing {
    #[default]
    Unknown,
    New,
    Passed,
    Refused,
}

pub struct Check {
    pub key: TaskKey,
    claims: Vec<(String, TaskResult)>,
    pub correct: TaskResult,
    took: Duration,
}

impl Check {
    pub fn wrong(&self) -> impl Iterator<Item = &str> {
        self.claims.iter().filter(|(_, claim)| *claim != self.correct).map(|(worker, _)| worker.as_str())
    }
}

impl Checker {
    pub fn new(handle: Handle, is_trusting: bool, log: Log) -> Self {
        Self {
            handle,
            log,
            is_trusting,
            workers: BTreeMap::new(),
            unsound: None,
            junk: 0,
            checks: JoinSet::new(),
            started: Instant::now(),
            spent: Duration::ZERO,
        }
    }

    /// Whether a result of the worker should be checked: its first, and later ones as far as there is time.
    pub fn wants(&mut self, worker: &str) -> bool {
        let allowed = self.started.elapsed().mul_f64(SHARE);
        if self.is_trusting {
            return false;
        }
        let known = self.known(worker);
        match known.standing {
            Standing::Unknown => {
                known.standing = Standing::New;
                true
            }
            Standing::New | Standing::Refused => false,
            Standing::Passed => self.checks.is_empty() && self.spent < allowed,
        }
    }

    pub fn start(&mut self, key: TaskKey, task: Task, claims: Vec<(String, TaskResult)>) {
        let check = move || {
            let started = Instant::now();
            let correct = perform(&Simulator::default(), &[task], &|| ()).remove(0);
            Check { key, claims, correct, took: started.elapsed() }
        };
        self.checks.spawn_blocking_on(check, &self.handle);
    }

    pub async fn next(&mut self) -> Option<Check> {
        let check = self.checks.join_next().await?.expect("tasks do not panic");
        self.spent += check.took;
        for (worker, claim) in &check.claims {
            let known = self.known(worker);
            if *claim == check.correct && known.standing != Standing::Refused {
                known.standing = Standing::Passed;
            }
        }
        Some(check)
    }

    pub fn trusts(&self, worker: &str) -> bool {
        self.is_trusting || self.standing(worker) == Standing::Passed
    }

    pub fn has_answered(&self, name: &str) -> bool {
        self.workers.iter().any(|(sender, known)| name_of(sender) == name && *known != Known::default())
    }

    pub fn set_used(&mut self, workers: impl IntoIterator<Item = String>) {
        workers.into_iter().for_each(|worker| self.known(&worker).is_used = true);
    }

    pub fn is_refused(&self, worker: &str) -> bool {
        self.standing(worker) == Standing::Refused
    }

    pub fn refused(&self) -> usize {
        self.workers.values().filter(|known| known.standing == Standing::Refused).count()
    }

    pub fn refuse(&mut self, worker: &str, reason: &str) {
        let known = self.known(worker);
        if known.standing != Standing::Refused {
            known.standing = Standing::Refused;
            (self.log)(&format!("refused worker `{}`: {reason}\n", name_of(worker)));
        }
    }

    /// Returns how many more lead to its refusal. Its next result is checked here before others are used.
    pub fn count_wrong(&mut self, worker: &str, key: TaskKey, reason: &str) -> usize {
        let known = self.known(worker);
        if known.standing == Standing::Refused || !known.wrong.insert(key) {
            return 0;
        }
        let (count, is_used) = (known.wrong.len(), known.is_used);
        if count < MOST_WRONG {
            known.standing = Standing::Unknown;
            let name = name_of(worker);
            (self.log)(&format!("dropped a result in the name of `{name}`: {reason} ({count} of {MOST_WRONG})\n"));
            return MOST_WRONG - count;
        }
        self.refuse(worker, reason);
        if is_used {
            self.unsound = Some(name_of(worker).to_owned());
        }
        0
    }

    pub fn readmit(&mut self, name: &str) {
        if self.is_refused(name) {
            self.workers.remove(name);
        }
    }

    pub fn unsound(&self) -> Option<&str> {
        self.unsound.as_deref()
    }

    /// Anybody can send one in the name of a worker, so the worker is not refused. After a few, only some are logged.
    pub fn count_junk(&mut self, worker: &str) {
        self.junk += 1;
        if self.junk < JUNK_LINES || self.junk.is_power_of_two() {
            let (name, count) = (name_of(worker), self.junk);
            (self.log)(&format!("dropped a message in the name of `{name}` that is not an answer, {count} so far\n"));
        }
    }

    fn known(&mut self, worker: &str) -> &mut Known {
        self.workers.entry(worker.to_owned()).or_default()
    }

    fn standing(&self, worker: &str) -> Standing {
        self.workers.get(worker).map_or(Standing::Unknown, |known| known.standing)
    }
}

fn name_of(sender: &str) -> &str {
    sender.split(' ').next().unwrap_or_default()
}
