//! What `nbc library add` has measured, in a file beside the robots until the command is done: after an interruption
//! the same command does not measure it again.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde::{Deserialize, Serialize};

use crate::cli::{Failure, Interrupt};
use nbc_session::store;
use nbc_swarm::{Executor, Task, TaskResult};

/// In the folder of the robots.
const FILE: &str = "measured.jsonl";

/// An executor that remembers the results of screenings and measurements, and stops between two tasks.
pub(super) struct Measured<'a> {
    executor: &'a dyn Executor,
    interrupt: &'a Interrupt,
    /// Whether all tasks are given to the executor at once, because workers or a device do many together.
    together: bool,
    path: PathBuf,
    is_new_folder: bool,
    state: Mutex<State>,
}

struct State {
    known: BTreeMap<String, TaskResult>,
    /// Why a result could not be written.
    fault: Option<Failure>,
}

#[derive(Serialize, Deserialize)]
struct Line {
    version: String,
    task: String,
    outcome: TaskResult,
}

impl<'a> Measured<'a> {
    /// Reads what an earlier command with the same version has measured.
    pub(super) fn open(folder: &Path, executor: &'a dyn Executor, together: bool, interrupt: &'a Interrupt) -> Self {
        let (path, is_new_folder) = (folder.join(FILE), !folder.exists());
        // A last line that is cut, and lines of other versions, are measured again.
        let text = fs::read_to_string(&path).unwrap_or_default();
        let lines = text.lines().filter_map(|line| serde_json::from_str::<Line>(line).ok());
        let lines = lines.filter(|line| line.version == nbc_base::VERSION);
        let known = lines.map(|line| (line.task, line.outcome)).collect();
        let state = Mutex::new(State { known, fault: None });
        Self { executor, interrupt, together, path, is_new_folder, state }
    }

    pub(super) fn len(&self) -> usize {
        self.lock().known.len()
    }

    /// Removes the file after a command that is done.
    pub(super) fn end(self, is_done: bool) -> Result<(), Failure> {
        if is_done {
            // A file that stays is read again. A folder with robots is not empty, and stays.
            let _ = fs::remove_file(&self.path);
            if let Some(folder) = self.path.parent().filter(|_| self.is_new_folder) {
                let _ = fs::remove_dir(folder);
            }
        }
        let state = self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        state.fault.map_or(Ok(()), Err)
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn keep(&self, task: String, result: &TaskResult) {
        let line = Line { version: nbc_base::VERSION.to_owned(), task, outcome: result.clone() };
        let text = serde_json::to_string(&line).expect("a result can be written as JSON") + "\n";
        let mut state = self.lock();
        let folder = self.path.parent().map_or(Ok(()), store::create_folder);
        let file = folder.and_then(|()| OpenOptions::new().create(true).append(true).open(&self.path));
        if let Err(error) = file.and_then(|mut file| file.write_all(text.as_bytes())) {
            state.fault.get_or_insert_with(|| Failure::unwritable(&self.path, &error));
        }
        state.known.insert(line.task, line.outcome);
    }
}

impl Executor for Measured<'_> {
    fn perform(&self, run: usize, tasks: &[Task], observe: &dyn Fn()) -> Option<Vec<TaskResult>> {
        let known = |task: &Task| key(task).and_then(|key| self.lock().known.get(&key).cloned());
        let mut results: Vec<Option<TaskResult>> = tasks.iter().map(known).collect();
        results.iter().flatten().for_each(|_| observe());
        let open: Vec<usize> = (0..tasks.len()).filter(|&place| results[place].is_none()).collect();
        for places in open.chunks(if self.together { tasks.len().max(1) } else { 1 }) {
            if self.interrupt.is_raised() {
                return None;
            }
            let asked: Vec<Task> = places.iter().map(|&place| tasks[place].clone()).collect();
            let made = self.executor.perform(run, &asked, observe)?;
            for (&place, result) in places.iter().zip(made) {
                if let Some(key) = key(&tasks[place]) {
                    self.keep(key, &result);
                }
                results[place] = Some(result);
            }
        }
        results.into_iter().collect()
    }
}

/// `None` for tasks that are not remembered.
fn key(task: &Task) -> Option<String> {
    let (what, body) = match task {
        Task::Screening { body, behavior, most } => (format!("screening {behavior} {most}"), body),
        Task::Measurement(body) => ("measurement".to_owned(), body),
        Task::Evaluation(..) | Task::Swarm(_) => return None,
    };
    let materials = serde_json::to_string(&body.own_materials()).expect("materials can be written as JSON");
    Some(format!("{what} {} {materials}", body.rows().join("|")))
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use nbc_base::model::{Body, Palette};
    use nbc_swarm::LocalExecutor;

    /// Raises the interrupt after `most` tasks.
    struct Counting<'a> {
        done: AtomicUsize,
        most: usize,
        interrupt: &'a Interrupt,
    }

    impl Executor for Counting<'_> {
        fn perform(&self, run: usize, tasks: &[Task], observe: &dyn Fn()) -> Option<Vec<TaskResult>> {
            if self.done.fetch_add(tasks.len(), Ordering::Relaxed) + tasks.len() >= self.most {
                self.interrupt.raise();
            }
            LocalExecutor::default().perform(run, tasks, observe)
        }
    }

    #[test]
    fn what_was_measured_before_an_interruption_is_not_measured_again() {
        let folder = tempfile::tempdir().unwrap();
        let bodies =
            [["34", "43"], ["33", "43"], ["34", "33"]].map(|rows| Body::parse(&rows, &Palette::paper()).unwrap());
        let screening =
            |body: &Body| Task::Screening { body: body.clone(), behavior: "RRRR".parse().unwrap(), most: 1 };
        let tasks: Vec<Task> = bodies.iter().map(screening).collect();
        let perform = |most: usize| {
            let interrupt = Interrupt::default();
            let counting = Counting { done: AtomicUsize::new(0), most, interrupt: &interrupt };
            let measured = Measured::open(folder.path(), &counting, false, &interrupt);
            let found = measured.perform(0, &tasks, &|| ());
            measured.end(found.is_some()).unwrap();
            (found, counting.done.into_inner())
        };
        assert_eq!(perform(2), (None, 2));
        let alone = LocalExecutor::default().perform(0, &tasks, &|| ());
        assert_eq!(perform(9), (alone, 1), "the third only, with the same bits");
        assert!(!folder.path().join(FILE).exists());
    }
}
