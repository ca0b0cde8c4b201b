//! The state that the threads of a worker share: its connection, its name, the number of tasks done.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use futures_util::StreamExt;
use tokio::time;

use crate::Log;
use crate::connection::{Connection, reply_subject, worker_note_subject};
use crate::delivery::{Delivery, DeliveryEnd};
use crate::message::{AnswerReply, WorkerNote, decode, encode};
use crate::physics::{PROGRAM, PhysicsId};
use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_circuit::CancelFlag;

pub const REPORT: Duration = Duration::from_secs(2);
/// The worker ends when so many of its answers were rejected.
const MOST_REJECTIONS: usize = 3;
/// Tasks of a search that did not receive an answer are dropped for this time.
const SHUNNED: Duration = Duration::from_secs(10);

pub struct WorkerState {
    pub name: String,
    pub connection: Connection,
    pub physics: PhysicsId,
    pub tally: Arc<Tally>,
    pub log: Log,
    cancel: CancelFlag,
    /// The number of answers that searches have rejected. Anybody who can use the server can say so once.
    rejections: AtomicUsize,
    silent: Mutex<BTreeMap<String, Instant>>,
}

#[derive(Default)]
pub struct Tally {
    pub evaluations: AtomicU64,
    pub redelivered: AtomicU64,
}

impl WorkerState {
    pub fn new(name: String, connection: Connection, physics: PhysicsId, cancel: CancelFlag, log: Log) -> Self {
        let (tally, rejections, silent) = (Arc::default(), AtomicUsize::new(0), Mutex::default());
        Self { name, connection, physics, tally, log, cancel, rejections, silent }
    }

    pub fn is_ending(&self) -> bool {
        self.cancel.is_raised() || self.rejections.load(Ordering::Relaxed) >= MOST_REJECTIONS
    }

    pub fn shuns(&self, search: &str) -> bool {
        let silent = self.silent.lock().unwrap_or_else(PoisonError::into_inner);
        silent.get(search).is_some_and(|since| since.elapsed() < SHUNNED)
    }

    pub fn count(&self, ended: Vec<DeliveryEnd>) -> Result<(), Diagnostic> {
        for one in ended {
            match one {
                DeliveryEnd::Received => _ = self.tally.evaluations.fetch_add(1, Ordering::Relaxed),
                DeliveryEnd::Unwanted { search } => {
                    let mut silent = self.silent.lock().unwrap_or_else(PoisonError::into_inner);
                    silent.retain(|_, since| since.elapsed() < SHUNNED);
                    silent.insert(search, Instant::now());
                }
                DeliveryEnd::Rejected(reply) => {
                    let reason = match reply {
                        AnswerReply::OtherPhysics => "its physics is different",
                        AnswerReply::Invalid => "its messages cannot be read",
                        AnswerReply::Wrong | AnswerReply::Received => "its results are wrong",
                    };
                    let (name, count) = (self.name.clone(), self.rejections.fetch_add(1, Ordering::Relaxed) + 1);
                    if count >= MOST_REJECTIONS {
                        return Err(wording::rejected(&name, reason));
                    }
                    let said = format!("an answer was rejected: {reason} ({count} of {MOST_REJECTIONS})");
                    (self.log)(&format!("worker `{name}`: {said}\n"));
                }
            }
        }
        Ok(())
    }

    pub fn delivery(&self) -> Delivery {
        Delivery::new(&self.connection, &self.name)
    }

    pub fn report(&self, threads: u32) {
        let (client, tally, name) = (self.connection.client.clone(), Arc::clone(&self.tally), self.name.clone());
        let physics = self.physics.to_string();
        self.connection.runtime.spawn(async move {
            let mut before = 0;
            loop {
                let evaluations = tally.evaluations.load(Ordering::Relaxed);
                let note = WorkerNote {
                    name: name.clone(),
                    version: PROGRAM.to_owned(),
                    physics: physics.clone(),
                    threads,
                    evaluations,
                    redelivered: tally.redelivered.load(Ordering::Relaxed),
                    evaluations_per_second: (evaluations - before) as f64 / REPORT.as_secs_f64(),
                };
                before = evaluations;
                let _ = client.publish(worker_note_subject(), encode(&note).into()).await;
                time::sleep(REPORT).await;
            }
        });
    }

    pub fn listen(&self) {
        let (client, name, log) = (self.connection.client.clone(), self.name.clone(), self.log);
        self.connection.runtime.spawn(async move {
            let Ok(mut replies) = client.subscribe(reply_subject(&name)).await else { return };
            let is_refusal = |bytes: &[u8]| decode(bytes) == Some(AnswerReply::OtherPhysics);
            while let Some(message) = replies.next().await {
                if is_refusal(&message.payload) {
                    log(&format!("worker `{name}`: a search refused this worker, because its physics is different\n"));
                    return;
                }
            }
        });
    }
}
