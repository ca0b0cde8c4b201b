//! The queue as a laboratory: any thread can hand in tasks and wait for their results.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender, TryRecvError};
use std::thread::{self, JoinHandle};

use tokio::sync::Notify;

use crate::cli::cluster::message::MOST_BYTES;
use crate::cli::cluster::queue_place::QueuePlace;
use crate::cli::cluster::task_message::task_bytes;
use crate::cli::distant::DistantLaboratory;
use crate::cli::place::{TaskBatch, TaskPlace};
use crate::cli::wording::ClusterError;
use crate::cli::{Failure, Interrupt};
use nbc_sim::Simulator;
use nbc_swarm::{Laboratory, Task, TaskResult};

/// Bytes of a message besides its task or result, at most.
const RESERVE: usize = 1024;

/// The queue, on a thread of its own.
pub struct QueueLaboratory {
    orders: Sender<Order>,
    wake: Arc<Notify>,
    desk: JoinHandle<Result<(), Failure>>,
}

/// A task, its place among those that were handed in with it, and where its result goes.
struct Order {
    task: Task,
    place: usize,
    reply: Sender<(usize, TaskResult)>,
}

/// The thread that passes tasks to the queue and results back.
struct Desk<S> {
    queue: QueuePlace,
    orders: Receiver<Order>,
    /// The place of each open task, and where its result goes.
    open: BTreeMap<usize, (usize, Sender<(usize, TaskResult)>)>,
    /// The number of the next task.
    next: usize,
    interrupt: Interrupt,
    show: S,
}

impl QueueLaboratory {
    /// Opens the queue; a signal ends it, and notes on its progress go to `show`.
    ///
    /// # Errors
    /// When the queue cannot be opened.
    pub fn open(
        queue: impl FnOnce() -> Result<QueuePlace, Failure> + Send + 'static,
        interrupt: Interrupt,
        show: impl Fn(String) + Send + 'static,
    ) -> Result<Self, Failure> {
        let (orders, ordered) = mpsc::channel();
        let (opened, opening) = mpsc::channel();
        // The queue belongs to the thread that opens it.
        let work = move || {
            let queue = queue()?;
            let _ = opened.send(queue.wake());
            Desk { queue, orders: ordered, open: BTreeMap::new(), next: 0, interrupt, show }.work()
        };
        let desk =
            thread::Builder::new().spawn(work).map_err(|error| ClusterError::Start { reason: error.to_string() })?;
        match opening.recv() {
            Ok(wake) => Ok(Self { orders, wake, desk }),
            Err(_) => Err(end(desk).expect_err("only a failure ends the thread so early")),
        }
    }
}

impl Laboratory for QueueLaboratory {
    fn perform(&self, tasks: &[Task], observe: &dyn Fn()) -> Vec<TaskResult> {
        let (reply, results) = mpsc::channel();
        let mut found: Vec<Option<TaskResult>> = vec![None; tasks.len()];
        let (near, far): (Vec<usize>, Vec<usize>) = (0..tasks.len()).partition(|&place| !fits(&tasks[place]));
        for place in far {
            // After a failure nobody takes orders.
            let _ = self.orders.send(Order { task: tasks[place].clone(), place, reply: reply.clone() });
        }
        drop(reply);
        self.wake.notify_one();
        for place in near {
            found[place] = Simulator::default().perform(&tasks[place..=place], observe).pop();
        }
        for (place, result) in results {
            found[place] = Some(result);
            observe();
        }
        found.into_iter().zip(tasks).map(|(result, task)| result.unwrap_or_else(|| task.stopped())).collect()
    }
}

impl DistantLaboratory for QueueLaboratory {
    fn end(self: Box<Self>) -> Result<(), Failure> {
        let Self { orders, wake, desk } = *self;
        drop(orders);
        wake.notify_one();
        end(desk)
    }
}

impl<S: Fn(String)> Desk<S> {
    /// Works until nobody can order any more, or a signal arrives.
    fn work(&mut self) -> Result<(), Failure> {
        while self.take_orders() && !self.interrupt.is_raised() {
            let Some((number, results)) = self.queue.next()? else {
                self.queue.note().into_iter().for_each(&self.show);
                continue;
            };
            if let Some((place, reply)) = self.open.remove(&number) {
                // Who no longer waits needs no result.
                results.into_iter().for_each(|result| _ = reply.send((place, result)));
            }
        }
        self.queue.close();
        Ok(())
    }

    /// Passes new tasks to the queue. Returns whether there is work, or can be.
    fn take_orders(&mut self) -> bool {
        loop {
            match self.orders.try_recv() {
                Ok(Order { task, place, reply }) => {
                    self.open.insert(self.next, (place, reply));
                    self.queue.submit(TaskBatch { run: self.next, tasks: vec![task] });
                    self.next += 1;
                }
                Err(TryRecvError::Empty) => return true,
                Err(TryRecvError::Disconnected) => return !self.open.is_empty(),
            }
        }
    }
}

/// Waits for the thread.
fn end(desk: JoinHandle<Result<(), Failure>>) -> Result<(), Failure> {
    desk.join().expect("the queue does not panic")
}

/// Whether the messages of a task are not too long. Others are done here.
fn fits(task: &Task) -> bool {
    let (bytes, answer) = match task {
        // A swarm without robots has no bits that could be asked for.
        Task::Swarm(swarm) if swarm.robots() == 0 => return false,
        Task::Swarm(swarm) => (task_bytes(task), swarm.robots() * swarm.cycles() / 8),
        _ => (task_bytes(task), 0),
    };
    bytes.max(answer) < MOST_BYTES - RESERVE
}
