//! Sends tasks to the queue. Keeps those that the server does not accept, to send them again.

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use async_nats::jetstream;
use futures_util::TryStreamExt;
use tokio::task::JoinSet;

use crate::Log;
use crate::connection::{Connection, task_subject, task_subjects, words};
use crate::message::TaskKey;
use crate::task_message::TaskMessage;

/// The time before another attempt.
const AGAIN: Duration = Duration::from_secs(1);
/// The time between two searches for tasks that the server has lost.
const LOOK: Duration = Duration::from_secs(5);

/// The tasks that are being sent, and those that must be sent again.
pub struct TaskSender {
    jetstream: jetstream::Context,
    handle: tokio::runtime::Handle,
    /// The part of the subject that names the physics, and the name of the search.
    token: String,
    search: String,
    sending: JoinSet<(TaskKey, Result<(), String>)>,
    kept: BTreeSet<TaskKey>,
    failed: Instant,
    looked: Instant,
    /// The last fault, so that it is logged once.
    trouble: Option<String>,
    log: Log,
}

impl TaskSender {
    /// A sender without tasks.
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
            log,
        }
    }

    /// Starts to send a task.
    pub fn send(&mut self, task: &TaskMessage) {
        let (jetstream, key, bytes) = (self.jetstream.clone(), task.key, task.encode());
        let subject = self.subject(key);
        let publish = async move {
            let acknowledgment = jetstream.publish(subject, bytes.into()).await.map_err(|error| error.to_string())?;
            acknowledgment.await.map(|_| ()).map_err(|error| error.to_string())
        };
        self.sending.spawn_on(async move { (key, publish.await) }, &self.handle);
    }

    /// Waits until a task is sent or not; `None` if there is none on its way.
    pub async fn next(&mut self) -> Option<()> {
        let (key, sent) = self.sending.join_next().await?.expect("sending does not panic");
        match sent {
            Ok(()) => self.trouble = None,
            Err(reason) => {
                self.kept.insert(key);
                self.failed = Instant::now();
                if self.trouble.as_ref() != Some(&reason) {
                    (self.log)(&format!("the NATS server does not take tasks ({reason}); trying again\n"));
                }
                self.trouble = Some(reason);
            }
        }
        Some(())
    }

    /// The tasks that must be sent again now.
    pub async fn retry(&mut self) -> BTreeSet<TaskKey> {
        if self.kept.is_empty() || self.failed.elapsed() < AGAIN {
            return BTreeSet::new();
        }
        // The stream may be gone, for example with the disk of the server.
        let _ = Connection::queue(&self.jetstream, &self.token).await;
        std::mem::take(&mut self.kept)
    }

    /// Those of some tasks that the server no longer has, if it is time to look.
    pub async fn lost(&mut self, tasks: impl FnOnce() -> Vec<TaskKey>) -> Vec<TaskKey> {
        if self.looked.elapsed() < LOOK {
            return Vec::new();
        }
        self.looked = Instant::now();
        let mut tasks = tasks();
        if tasks.is_empty() || !self.sending.is_empty() {
            return Vec::new();
        }
        let Ok(there) = self.subjects(&tasks).await else { return Vec::new() };
        tasks.retain(|&key| !self.kept.contains(&key) && !there.contains(&self.subject(key)));
        tasks
    }

    fn subject(&self, key: TaskKey) -> String {
        task_subject(&self.token, &self.search, key)
    }

    /// The subjects of this search's tasks that the server has. A queue that would never give some of these tasks to a
    /// worker is made again.
    async fn subjects(&self, tasks: &[TaskKey]) -> Result<BTreeSet<String>, String> {
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
        // After a failure of its disk the server may number its messages from an earlier number on than the queue does,
        // which takes the new ones for done.
        if info.delivered.stream_sequence > last || is_idle && has_ours {
            (self.log)("the queue of the NATS server has lost its place; it is made again\n");
            stream.delete_consumer(&info.name).await.map_err(words)?;
            Connection::queue(&self.jetstream, &self.token).await?;
        }
        Ok(there)
    }

    /// Removes this search's tasks from the server. A server that cannot be reached drops them when they are too old.
    pub async fn clear(&self) {
        if let Ok(stream) = Connection::stream(&self.jetstream).await {
            let _ = stream.purge().filter(task_subjects(&self.token, &self.search)).await;
        }
    }
}
