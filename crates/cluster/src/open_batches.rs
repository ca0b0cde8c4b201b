//! The batches that wait for results, and the channels of the threads that wait for them.

use std::collections::BTreeMap;
use std::sync::mpsc::Sender;
use std::time::{Duration, Instant};

use crate::message::TaskKey;
use crate::task_batch::TaskBatch;
use nbc_swarm::{Task, TaskResult};

/// The time for which a run without a batch is still in progress: it may be about to hand in the next.
const BETWEEN: Duration = Duration::from_secs(1);

pub struct BatchRequest {
    pub run: u32,
    pub tasks: Vec<(usize, Task)>,
    pub reply: Sender<(usize, TaskResult)>,
}

#[derive(Default)]
pub struct OpenBatches {
    open: BTreeMap<(u32, u32), Waiting>,
    runs: BTreeMap<u32, Run>,
}

struct Run {
    batches: u32,
    open: u32,
    seen: Instant,
}

struct Waiting {
    batch: TaskBatch,
    places: Vec<usize>,
    reply: Sender<(usize, TaskResult)>,
}

impl OpenBatches {
    pub fn add(&mut self, request: BatchRequest) -> Vec<TaskKey> {
        let BatchRequest { run, tasks, reply } = request;
        let entry = self.runs.entry(run).or_insert_with(|| Run { batches: 0, open: 0, seen: Instant::now() });
        let number = entry.batches;
        *entry = Run { batches: number + 1, open: entry.open + 1, seen: Instant::now() };
        let (places, tasks): (Vec<usize>, Vec<Task>) = tasks.into_iter().unzip();
        let batch = TaskBatch::new(run, number, tasks);
        let keys = batch.keys();
        self.open.insert((run, number), Waiting { batch, places, reply });
        keys
    }

    pub fn get(&mut self, key: TaskKey) -> Option<&mut TaskBatch> {
        self.open.get_mut(&(key.run, key.generation)).map(|waiting| &mut waiting.batch)
    }

    /// Passes on the results of its batch if all can be used. Returns the workers that are trusted for them.
    pub fn pass_on(&mut self, key: TaskKey, is_trusted: impl Fn(&str) -> bool) -> Vec<String> {
        let batch = (key.run, key.generation);
        let Some(Waiting { batch: waiting, places, reply }) = self.open.get(&batch) else { return Vec::new() };
        let Some((results, workers)) = waiting.results(is_trusted) else { return Vec::new() };
        let workers = workers.into_iter().map(str::to_owned).collect();
        // Whoever no longer waits needs no result.
        places.iter().zip(results).for_each(|(&place, result)| _ = reply.send((place, result)));
        self.open.remove(&batch);
        if let Some(run) = self.runs.get_mut(&key.run) {
            *run = Run { open: run.open - 1, seen: Instant::now(), ..*run };
        }
        workers
    }

    pub fn pass_on_all(&mut self, is_trusted: impl Fn(&str) -> bool) -> Vec<String> {
        let keys: Vec<TaskKey> =
            self.open.keys().map(|&(run, generation)| TaskKey { run, generation, index: 0 }).collect();
        keys.into_iter().flat_map(|key| self.pass_on(key, &is_trusted)).collect()
    }

    pub fn claims(&self, worker: &str, most: usize) -> Vec<(TaskKey, TaskResult)> {
        self.open.values().flat_map(|waiting| waiting.batch.claims(worker)).take(most).collect()
    }

    pub fn forget(&mut self, worker: &str) -> Vec<TaskKey> {
        self.open.values_mut().flat_map(|waiting| waiting.batch.forget(worker)).collect()
    }

    pub fn overdue(&self, age: Duration) -> Vec<TaskKey> {
        self.open.values().flat_map(|waiting| waiting.batch.overdue(age)).collect()
    }

    pub fn missing(&self) -> usize {
        self.open.values().map(|waiting| waiting.batch.missing()).sum()
    }

    pub fn runs(&self) -> usize {
        self.runs.values().filter(|run| run.open > 0 || run.seen.elapsed() < BETWEEN).count()
    }

    pub fn len(&self) -> usize {
        self.open.len()
    }

    pub fn is_empty(&self) -> bool {
        self.open.is_empty()
    }
}
