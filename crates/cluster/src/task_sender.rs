//! Sends tasks to the queue. Keeps those that the server does not accept, to send them again.

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use async_nats::jetstream::{self, consumer};
use futures_util::TryStreamExt;
use tokio::task::JoinSet;

use crate::Log;
use crate::connection::{Connection, task_subject, task_subjects, words};
use crate::message::TaskKey;
use crate::task_message::TaskMessage;

const AGAIN: Duration = Duration::from_secs(1);
/// The time between two searches for tasks that the server has lost.
const LOOK: Duration = Duration::from_secs(5);

/// A queue that gives out no task for this time, although tasks wait and workers ask for them, is made again. It is
/// longer than the time after which a task is given to another worker.
const STUCK: Duration = Duration::from_secs(10);
/// The same if all tasks are given out: one that takes long may be at work.
const STUCK_IF_GIVEN_OUT: Duration = Duration::from_secs(60);

pub struct TaskSender {
    jetstream: jetstream::Context,
    handle: tokio::runtime::Handle,
    token: String,
    search: String,
    sending: JoinSet<(TaskKey, Result<(), String>)>,
    kept: BTreeSet<TaskKey>,
    failed: Instant,
    looked: Instant,
    trouble: Option<String>,
    /// The number of tasks that the queue has ever given out, and since when that is so although workers ask for tasks.
    given_out: (u64, Instant),
    log: Log,
}

impl TaskSender {
    pub fn new(connection: &Connection, token: String, search: &str, log: Log) -> Self {
        let (jetstream, handle) = (connection.jetstream.clone(), connection.runtime.handle().clone());
        Self {
            jetstream,
            handle,
            token,
            search: search.to_owned(),
            sending: JoinSet::new(),
            kept: BTreeSet::new(),
            failed: Instant::now(),
            looked: Instant::now(),
            trouble: None,
            given_out: (0, Instant::now()),
            log,
        }
    }

    pub fn send(&mut self, task: &TaskMessage) {
        let (jetstream, key, bytes) = (self.jetstream.clone(), task.key, task.encode());
        let subject = self.subject(key);
        let publish = async move {
            let acknowledgment = jetstream.publish(subject, bytes.into()).await.map_err(|error| error.to_string())?;
            acknowledgment.await.map(|_| ()).map_err(|error| error.to_string())
        };
        self.sending.spawn_on(async move { (key, publish.await) }, &self.handle);
    }

    pub async fn next(&mut self) -> Option<()> {
        let (key, sent) = self.sending.join_next().await?.expect("sending does not panic");
        match sent {
            Ok(()) => self.trouble = None,
            Err(reason) => {
                self.kept.insert(key);
                self.failed = Instant::now();
                self.complain(format!("the NATS server does not take tasks ({reason}); trying again\n"));
            }
        }
        Some(())
    }

    fn complain(&mut self, fault: String) {
        if self.trouble.as_ref() != Some(&fault) {
            (self.log)(&fault);
        }
        self.trouble = Some(fault);
    }

    pub async fn retry(&mut self) -> BTreeSet<TaskKey> {
        if self.kept.is_empty() || self.failed.elapsed() < AGAIN {
            return BTreeSet::new();
        }
        // The stream may be gone, for example with the disk of the server.
        let _ = Connection::queue(&self.jetstream, &self.token).await;
        std::mem::take(&mut self.kept)
    }

    pub async fn lost(&mut self, tasks: impl FnOnce() -> Vec<TaskKey>) -> Vec<TaskKey> {
        if self.looked.elapsed() < LOOK {
            return Vec::new();
        }
        self.looked = Instant::now();
        let mut tasks = tasks();
        if tasks.is_empty() || !self.sending.is_empty() {
            return Vec::new();
        }
        let there = match self.subjects(&tasks).await {
            Ok(there) => there,
            Err(reason) => {
                self.complain(format!("the queue of the NATS server does not answer ({reason}); trying again\n"));
                return Vec::new();
            }
        };
        self.trouble = None;
        tasks.retain(|&key| !self.kept.contains(&key) && !there.contains(&self.subject(key)));
        tasks
    }

    fn subject(&self, key: TaskKey) -> String {
        task_subject(&self.token, &self.search, key)
    }

    /// The subjects of this search's tasks on the server. A queue that would never give some of them out is made again.
    async fn subjects(&mut self, tasks: &[TaskKey]) -> Result<BTreeSet<String>, String> {
        // The queue may be gone, too. What it has to do is asked first: a task that is done later leaves the stream.
        let queue = Connection::queue(&self.jetstream, &self.token).await?;
        let stream = Connection::stream(&self.jetstream).await?;
        let found = stream.info_with_subjects(task_subjects(&self.token, &self.search)).await.map_err(words)?;
        let last = found.info.state.last_sequence;
        let pairs = found.try_collect::<Vec<_>>().await.map_err(words)?;
        let there: BTreeSet<String> = pairs.into_iter().map(|(subject, _)| subject).collect();
        let info = queue.cached_info();
        let is_idle = info.num_pending == 0 && info.num_ack_pending == 0;
        let has_ours = tasks.iter().any(|&key| there.contains(&self.subject(key)));
        let is_stuck = has_ours && self.is_stuck(info);
        // After a failure of its disk the server may number its messages from an earlier number on than the queue does,
        // which takes the new ones for done.
        let is_lost = info.delivered.stream_sequence > last || is_idle && has_ours;
        if is_lost || is_stuck {
            let waiting = info.num_pending + info.num_ack_pending as u64;
            (self.log)(&match is_lost {
                true => "the queue of the NATS server has lost its place; it is made again\n".to_owned(),
                false => format!(
                    "the queue of the NATS server gives out none of {waiting} tasks, though workers ask; it is made \
                     again\n"
                ),
            });
            self.given_out.1 = Instant::now();
            stream.delete_consumer(&info.name).await.map_err(words)?;
            Connection::queue(&self.jetstream, &self.token).await?;
        }
        Ok(there)
    }

    /// A server that was killed may not find the tasks that its notes name, and then gives out no other, either.
    fn is_stuck(&mut self, queue: &consumer::Info) -> bool {
        let given_out = queue.delivered.consumer_sequence;
        if given_out != self.given_out.0 || queue.num_waiting == 0 {
            self.given_out = (given_out, Instant::now());
        }
        let most = if queue.num_pending > 0 { STUCK } else { STUCK_IF_GIVEN_OUT };
        self.given_out.1.elapsed() >= most
    }

    /// Removes this search's tasks from the server. A server that cannot be reached drops them when they are too old.
    pub async fn clear(&self) {
        if let Ok(stream) = Connection::stream(&self.jetstream).await {
            let _ = stream.purge().filter(task_subjects(&self.token, &self.search)).await;
        }
    }
}
