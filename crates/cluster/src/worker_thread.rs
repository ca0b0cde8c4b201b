//! One thread of a worker: takes tasks, does them together, and delivers the results.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use async_nats::jetstream::consumer::PullConsumer;
use async_nats::jetstream::consumer::pull::Batch;
use async_nats::jetstream::message::Acker;
use async_nats::jetstream::{AckKind, Message};
use futures_util::StreamExt;
use tokio::time;

use crate::answer_message::AnswerMessage;
use crate::connection::{Connection, PATIENCE, SILENCE, search_of, words};
use crate::delivery::Delivery;
use crate::task_message::{TOGETHER, TaskMessage};
use crate::worker_state::WorkerState;
use nbc_base::diag::Diagnostic;
use nbc_sim::Simulator;
use nbc_swarm::{Task, perform};

const REQUEST: Duration = Duration::from_secs(5);
const GLANCE: Duration = Duration::from_millis(100);
const AGAIN: Duration = Duration::from_secs(1);
const FAREWELL: Duration = Duration::from_secs(10);

pub struct WorkerThread<'a> {
    worker: &'a WorkerState,
    queue: PullConsumer,
    delivery: Delivery,
    together: usize,
    trouble: Option<String>,
}

struct OpenTask {
    message: TaskMessage,
    search: String,
    acker: Arc<Acker>,
}

impl<'a> WorkerThread<'a> {
    pub fn new(worker: &'a WorkerState, queue: PullConsumer) -> Self {
        Self { worker, queue, delivery: worker.delivery(), together: 1, trouble: None }
    }

    pub fn work(&mut self) -> Result<(), Diagnostic> {
        let handle = self.worker.connection.runtime.handle().clone();
        while !self.worker.is_ending() {
            match handle.block_on(self.fetch()) {
                Ok(tasks) => {
                    self.trouble = None;
                    self.perform(tasks);
                }
                Err(reason) => handle.block_on(self.recover(reason)),
            }
            let ended = self.delivery.finished();
            self.worker.count(ended)?;
        }
        let ended = handle.block_on(self.delivery.finish(FAREWELL));
        self.worker.count(ended)
    }

    async fn recover(&mut self, reason: String) {
        if self.trouble.as_ref() != Some(&reason) {
            (self.worker.log)(&format!("worker `{}`: {reason}; trying again\n", self.worker.name));
        }
        self.trouble = Some(reason);
        time::sleep(AGAIN).await;
        if let Ok(queue) = Connection::queue(&self.worker.connection.jetstream, &self.worker.physics.token()).await {
            self.queue = queue;
        }
    }

    async fn fetch(&mut self) -> Result<Vec<OpenTask>, String> {
        let mut taken = Vec::new();
        // The connection says that the server does not answer; the client tries again.
        while !self.worker.connection.is_open() && !self.worker.is_ending() {
            time::sleep(GLANCE).await;
        }
        let most = self.together;
        let waiting = self.queue.fetch().max_messages(most).messages().await.map_err(words)?;
        self.take(waiting, &mut taken).await?;
        if taken.is_empty() {
            let one = self.queue.batch().max_messages(1).expires(REQUEST).messages().await.map_err(words)?;
            self.take(one, &mut taken).await?;
            if !taken.is_empty() && self.together > 1 {
                let most = self.together - 1;
                let others = self.queue.fetch().max_messages(most).messages().await.map_err(words)?;
                self.take(others, &mut taken).await?;
            }
        }
        Ok(taken)
    }

    async fn take(&mut self, mut batch: Batch, taken: &mut Vec<OpenTask>) -> Result<(), String> {
        // A server that dies does not end the request.
        let end = time::Instant::now() + REQUEST + PATIENCE;
        while self.worker.connection.is_open() && !(self.worker.is_ending() && taken.is_empty()) {
            match time::timeout(GLANCE, batch.next()).await {
                Ok(Some(message)) => self.accept(message.map_err(words)?, taken).await,
                Ok(None) => break,
                Err(_) if time::Instant::now() < end => {}
                Err(_) if taken.is_empty() => return Err("the queue of the NATS server does not answer".to_owned()),
                Err(_) => break,
            }
        }
        Ok(())
    }

    async fn accept(&mut self, message: Message, taken: &mut Vec<OpenTask>) {
        let again = message.info().is_ok_and(|info| info.delivered > 1);
        self.worker.tally.redelivered.fetch_add(u64::from(again), Ordering::Relaxed);
        let (message, acker) = message.split();
        let search = search_of(&message.subject).filter(|search| !self.worker.shuns(search));
        match (TaskMessage::decode(&message.payload), search) {
            (Some(task), Some(search)) => {
                self.together = task.together.clamp(1, TOGETHER).into();
                taken.push(OpenTask { message: task, search: search.to_owned(), acker: Arc::new(acker) });
            }
            // Nobody can do this task, or nobody wants it.
            _ => _ = acker.ack_with(AckKind::Term).await,
        }
    }

    fn perform(&mut self, taken: Vec<OpenTask>) {
        let ackers: Vec<Arc<Acker>> = taken.iter().map(|taken| Arc::clone(&taken.acker)).collect();
        let holding = self.worker.connection.runtime.spawn(hold(ackers));
        let tasks: Vec<Task> = taken.iter().map(|taken| taken.message.task.clone()).collect();
        let results = perform(&Simulator::default(), &tasks, &|| ());
        for (taken, result) in taken.into_iter().zip(results) {
            if let Some(bytes) = (AnswerMessage { key: taken.message.key, result }).encode() {
                self.delivery.start(taken.search, bytes, taken.acker);
            }
        }
        holding.abort();
    }
}

async fn hold(ackers: Vec<Arc<Acker>>) {
    loop {
        time::sleep(SILENCE / 3).await;
        for acker in &ackers {
            let _ = acker.ack_with(AckKind::Progress).await;
        }
    }
}
