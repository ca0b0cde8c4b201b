//! The workers at a server, and the searches that they work for.

use std::collections::BTreeMap;
use std::time::Duration;

use async_nats::Subscriber;
use futures_util::StreamExt;
use serde::Serialize;
use tokio::runtime::EnterGuard;
use tokio::time;

use crate::Log;
use crate::connection::{Connection, NatsServer, search_note_subject, worker_note_subject};
use crate::message::{SearchNote, WorkerNote};
use crate::wording::ClusterError;
use nbc_circuit::CancelFlag;
use nbc_session::report::{Align, TextTable};

/// The time in which every worker and every search reports at least once.
const WATCH: Duration = Duration::from_secs(3);
/// The time between two checks of the request to stop.
const GLANCE: Duration = Duration::from_millis(100);

/// The searches and workers that have reported.
#[derive(Serialize)]
pub struct ClusterListing {
    searches: Vec<ListedSearch>,
    workers: Vec<ListedWorker>,
}

#[derive(Serialize)]
struct ListedSearch {
    name: String,
    version: String,
    /// In hexadecimal.
    physics: String,
    runs: u32,
    workers: u32,
    evaluations: u64,
    evaluations_per_second: f64,
    waiting: u64,
    redelivered: u64,
    refused: u32,
}

#[derive(Serialize)]
struct ListedWorker {
    name: String,
    version: String,
    /// In hexadecimal.
    physics: String,
    threads: u32,
    evaluations: u64,
    evaluations_per_second: f64,
    redelivered: u64,
}

/// Receives the reports of searches and workers. It must stay on the thread that opened it.
pub struct ClusterWatch {
    searches: Subscriber,
    workers: Subscriber,
    // Dropped last, because the subscriptions need them.
    connection: Connection,
    _entered: EnterGuard<'static>,
}

impl ClusterWatch {
    pub fn open(server: &NatsServer, log: Log) -> Result<Self, ClusterError> {
        let connection = Connection::open(server, "nbc workers", log)?;
        let entered = connection.enter();
        let subscribing = async {
            let subscribe = async |subject: String| connection.client.subscribe(subject).await;
            let searches = subscribe(search_note_subject()).await.map_err(|error| error.to_string())?;
            let workers = subscribe(worker_note_subject()).await.map_err(|error| error.to_string())?;
            Ok((searches, workers))
        };
        let subscribed = connection.runtime.block_on(subscribing);
        let (searches, workers) = subscribed.map_err(|reason| connection.no_queue(reason))?;
        Ok(Self { searches, workers, connection, _entered: entered })
    }

    /// Lists those that report in the next seconds, or until it is cancelled.
    pub fn listen(&mut self, cancel: &CancelFlag) -> ClusterListing {
        self.connection.runtime.block_on(listen(&mut self.searches, &mut self.workers, cancel))
    }
}

async fn listen(from_searches: &mut Subscriber, from_workers: &mut Subscriber, cancel: &CancelFlag) -> ClusterListing {
    let (mut searches, mut workers) = (BTreeMap::new(), BTreeMap::new());
    let end = time::Instant::now() + WATCH;
    while time::Instant::now() < end && !cancel.is_raised() {
        tokio::select! {
            Some(message) = from_searches.next() => {
                if let Ok(note) = SearchNote::decode(&message.payload) {
                    searches.insert(note.name.clone(), note);
                }
            }
            Some(message) = from_workers.next() => {
                if let Ok(note) = WorkerNote::decode(&message.payload) {
                    workers.insert(note.name.clone(), note);
                }
            }
            () = time::sleep(GLANCE) => {}
        }
    }
    ClusterListing {
        searches: searches.into_values().map(ListedSearch::of).collect(),
        workers: workers.into_values().map(ListedWorker::of).collect(),
    }
}

impl ListedSearch {
    fn of(note: SearchNote) -> Self {
        Self {
            name: note.name,
            version: note.program,
            physics: format!("{:016x}", note.physics),
            runs: note.runs,
            workers: note.workers,
            evaluations: note.evaluations,
            evaluations_per_second: note.per_kilosecond as f64 / 1000.0,
            waiting: note.waiting,
            redelivered: note.redelivered,
            refused: note.refused,
        }
    }
}

impl ListedWorker {
    fn of(note: WorkerNote) -> Self {
        Self {
            name: note.name,
            version: note.program,
            physics: format!("{:016x}", note.physics),
            threads: note.threads,
            evaluations: note.evaluations,
            evaluations_per_second: note.per_kilosecond as f64 / 1000.0,
            redelivered: note.redelivered,
        }
    }
}

impl ClusterListing {
    pub fn describe(&self) -> String {
        let searches = if self.searches.is_empty() { "no searches\n".to_owned() } else { self.searches_table() };
        let workers = if self.workers.is_empty() { "no workers\n".to_owned() } else { self.workers_table() };
        format!("{searches}\n{workers}")
    }

    fn searches_table(&self) -> String {
        let right = Align::Right;
        let mut table = TextTable::new(&[
            ("search", Align::Left),
            ("physics", Align::Left),
            ("runs", right),
            ("workers", right),
            ("evaluations", right),
            ("per second", right),
            ("waiting", right),
            ("redelivered", right),
            ("refused", right),
        ]);
        for search in &self.searches {
            table.push(vec![
                search.name.clone(),
                search.physics.clone(),
                search.runs.to_string(),
                search.workers.to_string(),
                search.evaluations.to_string(),
                format!("{:.1}", search.evaluations_per_second),
                search.waiting.to_string(),
                search.redelivered.to_string(),
                search.refused.to_string(),
            ]);
        }
        table.to_string()
    }

    fn workers_table(&self) -> String {
        let right = Align::Right;
        let mut table = TextTable::new(&[
            ("worker", Align::Left),
            ("version", Align::Left),
            ("physics", Align::Left),
            ("threads", right),
            ("evaluations", right),
            ("per second", right),
            ("redelivered", right),
        ]);
        for worker in &self.workers {
            table.push(vec![
                worker.name.clone(),
                worker.version.clone(),
                worker.physics.clone(),
                worker.threads.to_string(),
                worker.evaluations.to_string(),
                format!("{:.1}", worker.evaluations_per_second),
                worker.redelivered.to_string(),
            ]);
        }
        table.to_string()
    }
}
