//! Where tasks are done: the seam between a search and the machines that work for it.

use std::collections::VecDeque;

use crate::cli::Failure;
use crate::cli::gpu::OpenDevice;
use nbc_swarm::{Task, TaskResult, perform};

/// The tasks of one generation of one run.
pub struct TaskBatch {
    /// The place of the run among all runs of the program.
    pub run: usize,
    /// The tasks, in order of their candidates.
    pub tasks: Vec<Task>,
}

/// A place where tasks are done. The results depend on the tasks alone.
pub trait TaskPlace {
    /// The number of runs that are worked on at once.
    fn most_runs(&self) -> usize;

    /// Takes the tasks of a generation. If they cannot be done, the next call of [`TaskPlace::next`] says so.
    fn submit(&mut self, batch: TaskBatch);

    /// The run of a generation that is complete, and its results in order of the tasks; `None` if there is none yet.
    /// Returns within a second, or when a generation is complete.
    ///
    /// # Errors
    /// When nothing more can come.
    fn next(&mut self) -> Result<Option<(usize, Vec<TaskResult>)>, Failure>;

    /// A note for the progress display in place of that of the run.
    fn note(&mut self) -> Option<String>;

    /// Cleans up.
    fn close(&mut self);
}

/// The threads of this program, or its device.
pub struct LocalPlace<'d> {
    device: &'d OpenDevice,
    waiting: VecDeque<TaskBatch>,
}

impl<'d> LocalPlace<'d> {
    pub fn new(device: &'d OpenDevice) -> Self {
        Self { device, waiting: VecDeque::new() }
    }
}

impl TaskPlace for LocalPlace<'_> {
    fn most_runs(&self) -> usize {
        1
    }

    fn submit(&mut self, batch: TaskBatch) {
        self.waiting.push_back(batch);
    }

    fn next(&mut self) -> Result<Option<(usize, Vec<TaskResult>)>, Failure> {
        let Some(TaskBatch { run, tasks }) = self.waiting.pop_front() else { return Ok(None) };
        let results = perform(&self.device.simulator(), &tasks);
        self.device.check()?;
        Ok(Some((run, results)))
    }

    fn note(&mut self) -> Option<String> {
        None
    }

    fn close(&mut self) {}
}
