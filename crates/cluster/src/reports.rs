//! The reports that a search receives from workers and sends to `nbc workers`.

use std::time::{Duration, Instant};

use async_nats::{Client, Message, Subscriber};

use crate::connection::{reply_subject, search_note_subject};
use crate::message::{AnswerReply, SearchNote, WorkerNote, encode};
use crate::physics::{PROGRAM, PhysicsId};
use crate::worker_statistics::WorkerStatistics;

const REPORT: Duration = Duration::from_secs(2);

pub struct Reports {
    client: Client,
    search: String,
    physics: PhysicsId,
    pub notes: Subscriber,
    pub workers: WorkerStatistics,
    reported: Option<Instant>,
}

pub enum Reporter {
    Fit {
        name: String,
    },
    Unfit {
        name: String,
        reason: String,
    },
    /// Somebody with other physics in the name of a worker that reports, too.
    Two {
        name: String,
    },
}

impl Reports {
    pub fn new(client: Client, search: String, physics: PhysicsId, notes: Subscriber) -> Self {
        Self { client, search, physics, notes, workers: WorkerStatistics::default(), reported: None }
    }

    /// Takes the report of a worker. If the worker has other physics, replies so.
    pub async fn take(&mut self, message: &Message) -> Option<Reporter> {
        let note = WorkerNote::decode(&message.payload)?;
        if note.physics == self.physics.to_string() && note.version == PROGRAM {
            let name = note.name.clone();
            self.workers.take(note);
            return Some(Reporter::Fit { name });
        }
        if self.workers.has(&note.name) {
            return Some(Reporter::Two { name: note.name });
        }
        let WorkerNote { name, version, physics, .. } = note;
        let reply = encode(&AnswerReply::OtherPhysics);
        // The worker is refused in any case.
        let _ = self.client.publish(reply_subject(&name), reply.into()).await;
        let own = self.physics;
        let reason = format!("its physics is {physics} (version {version}), expected {own} (version {PROGRAM})");
        Some(Reporter::Unfit { name, reason })
    }

    pub async fn tell(&mut self, runs: usize, waiting: usize, refused: usize) {
        if self.reported.is_some_and(|reported| reported.elapsed() < REPORT) {
            return;
        }
        self.reported = Some(Instant::now());
        let summary = self.workers.summary();
        let note = SearchNote {
            name: self.search.clone(),
            version: PROGRAM.to_owned(),
            physics: self.physics.to_string(),
            runs: runs as u32,
            workers: summary.workers as u32,
            evaluations: summary.evaluations,
            evaluations_per_second: (summary.rate * 1000.0).floor() / 1000.0,
            waiting: waiting as u64,
            redelivered: summary.redelivered,
            refused: refused as u32,
        };
        // The next report follows soon.
        let _ = self.client.publish(search_note_subject(), encode(&note).into()).await;
    }
}
