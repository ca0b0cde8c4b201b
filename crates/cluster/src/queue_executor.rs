//! The queue as an executor: any thread can request tasks and wait for their results.

use std::sync::mpsc;
use std::thread::{self, JoinHandle};

use tokio::sync::mpsc::{UnboundedSender, unbounded_channel};

use crate::Log;
use crate::connection::NatsServer;
use crate::message::{MOST_BYTES, encode};
use crate::open_batches::BatchRequest;
use crate::queue::Queue;
use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_circuit::CancelFlag;
use nbc_sim::Simulator;
use nbc_swarm::{Executor, Task, TaskResult, perform};

const RESERVE: usize = 1024;

#[derive(Clone, Debug)]
pub struct QueueOptions {
    pub server: NatsServer,
    /// Whether no work of workers is done again here as a check.
    pub trust_workers: bool,
    pub cancel: CancelFlag,
    pub log: Log,
}

/// Workers at a server, which do tasks. After a cancellation or a failure, all work is stopped.
pub struct QueueExecutor {
    requests: UnboundedSender<BatchRequest>,
    thread: JoinHandle<Result<(), Diagnostic>>,
}

impl QueueExecutor {
    pub fn open(options: QueueOptions, note: impl Fn(String) + Send + 'static) -> Result<Self, Diagnostic> {
        let (requests, requested) = unbounded_channel();
        let (opened, opening) = mpsc::channel();
        // The queue belongs to the thread that opens it.
        let work = move || {
            let QueueOptions { server, trust_workers, cancel, log } = options;
            let mut queue = Queue::open(&server, trust_workers, log)?;
            let _ = opened.send(());
            queue.work(requested, &cancel, note)
        };
        let thread = thread::Builder::new().spawn(work).map_err(|error| wording::no_client(&error.to_string()))?;
        let executor = Self { requests, thread };
        match opening.recv() {
            Ok(()) => Ok(executor),
            Err(_) => Err(executor.end().expect_err("only a failure ends the thread so early")),
        }
    }

    pub fn end(self) -> Result<(), Diagnostic> {
        let Self { requests, thread } = self;
        drop(requests);
        thread.join().expect("the queue does not panic")
    }
}

impl Executor for QueueExecutor {
    fn perform(&self, run: usize, tasks: &[Task], observe: &dyn Fn()) -> Option<Vec<TaskResult>> {
        let (reply, results) = mpsc::channel();
        let (far, near): (Vec<usize>, Vec<usize>) = (0..tasks.len()).partition(|&place| fits(&tasks[place]));
        for places in batches(tasks, far) {
            let tasks = places.into_iter().map(|place| (place, tasks[place].clone())).collect();
            // After a failure nobody takes requests.
            let _ = self.requests.send(BatchRequest { run: run as u32, tasks, reply: reply.clone() });
        }
        drop(reply);
        let mut found: Vec<Option<TaskResult>> = vec![None; tasks.len()];
        for place in near {
            found[place] = perform(&Simulator::default(), &tasks[place..=place], observe).pop();
        }
        for (place, result) in results {
            found[place] = Some(result);
            observe();
        }
        found.into_iter().collect()
    }
}

/// All evaluations together, because a generation needs all of them, and each other task alone.
fn batches(tasks: &[Task], places: Vec<usize>) -> Vec<Vec<usize>> {
    let is_evaluation = |&place: &usize| matches!(tasks[place], Task::Evaluation(..));
    let (evaluations, others): (Vec<usize>, Vec<usize>) = places.into_iter().partition(is_evaluation);
    let together = Some(evaluations).filter(|places| !places.is_empty());
    together.into_iter().chain(others.into_iter().map(|place| vec![place])).collect()
}

fn fits(task: &Task) -> bool {
    let (bytes, answer) = match task {
        // The body of a candidate is small.
        Task::Evaluation(..) => return true,
        // A swarm without robots has no bits that could be asked for.
        Task::Swarm(swarm) if swarm.robots() == 0 => return false,
        Task::Swarm(swarm) => (encode(task).len(), (swarm.robots() + 3) * swarm.cycles()),
        _ => (encode(task).len(), 0),
    };
    bytes.max(answer) < MOST_BYTES - RESERVE
}
