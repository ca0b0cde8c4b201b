//! The batches that wait for results, and who waits for them.

use std::collections::BTreeMap;
use std::sync::mpsc::Sender;
use std::time::Duration;

use crate::message::TaskKey;
use crate::task_batch::TaskBatch;
use nbc_swarm::{Task, TaskResult};

/// Tasks that are handed in together. Their results are passed on when all can be used.
pub struct BatchRequest {
    /// The number of the series that they belong to.
    pub run: u32,
    /// Each task, with its place in the list of whoever waits.
    pub tasks: Vec<(usize, Task)>,
    /// Takes the results with those places.
    pub reply: Sender<(usize, TaskResult)>,
}

/// The batches that wait for results.
#[derive(Default)]
pub struct OpenBatches {
    /// By their run and their number in it.
    open: BTreeMap<(u32, u32), Waiting>,
    /// The number of batches that each run has handed in.
    handed_in: BTreeMap<u32, u32>,
}

/// A batch, and who waits for it.
struct Waiting {
    batch: TaskBatch,
    places: Vec<usize>,
    reply: Sender<(usize, TaskResult)>,
}

impl OpenBatches {
    /// Adds a batch and returns the keys of its tasks.
    pub fn add(&mut self, request: BatchRequest) -> Vec<TaskKey> {
        let BatchRequest { run, tasks, reply } = request;
        let number = self.handed_in.entry(run).or_default();
        let (places, tasks): (Vec<usize>, Vec<Task>) = tasks.into_iter().unzip();
        let batch = TaskBatch::new(run, *number, tasks);
        let keys = batch.keys();
        self.open.insert((run, *number), Waiting { batch, places, reply });
        *number += 1;
        keys
    }

    /// The batch that a key belongs to.
    pub fn get(&mut self, key: TaskKey) -> Option<&mut TaskBatch> {
        self.open.get_mut(&(key.run, key.generation)).map(|waiting| &mut waiting.batch)
    }

    /// Passes on the results of the batch that a key belongs to, if all can be used. Returns the workers that are
    /// trusted for them.
    pub fn pass_on(&mut self, key: TaskKey, is_trusted: impl Fn(&str) -> bool) -> Vec<String> {
        let batch = (key.run, key.generation);
        let Some(Waiting { batch: waiting, places, reply }) = self.open.get(&batch) else { return Vec::new() };
        let Some((results, workers)) = waiting.results(is_trusted) else { return Vec::new() };
        let workers = workers.into_iter().map(str::to_owned).collect();
        // Whoever no longer waits needs no result.
        places.iter().zip(results).for_each(|(&place, result)| _ = reply.send((place, result)));
        self.open.remove(&batch);
        workers
    }

    /// The same for all batches.
    pub fn pass_on_all(&mut self, is_trusted: impl Fn(&str) -> bool) -> Vec<String> {
        let keys: Vec<TaskKey> =
            self.open.keys().map(|&(run, generation)| TaskKey { run, generation, index: 0 }).collect();
        keys.into_iter().flat_map(|key| self.pass_on(key, &is_trusted)).collect()
    }

    /// Forgets the results of a worker that nobody has verified, and returns their tasks.
    pub fn forget(&mut self, worker: &str) -> Vec<TaskKey> {
        self.open.values_mut().flat_map(|waiting| waiting.batch.forget(worker)).collect()
    }

    /// The tasks without a result of batches that were handed in so long ago.
    pub fn overdue(&self, age: Duration) -> Vec<TaskKey> {
        self.open.values().flat_map(|waiting| waiting.batch.overdue(age)).collect()
    }

    /// The number of tasks without a result.
    pub fn missing(&self) -> usize {
        self.open.values().map(|waiting| waiting.batch.missing()).sum()
    }

    /// The number of batches.
    pub fn len(&self) -> usize {
        self.open.len()
    }

    /// Whether nobody waits.
    pub fn is_empty(&self) -> bool {
        self.open.is_empty()
    }
}
