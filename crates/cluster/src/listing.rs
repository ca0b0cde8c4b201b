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
use nbc_base::diag::Diagnostic;
use nbc_circuit::CancelFlag;
use nbc_session::report::{Align, TextTable};

/// The time in which every worker and every search reports at least once.
const WATCH: Duration = Duration::from_secs(3);
const GLANCE: Duration = Duration::from_millis(100);

#[derive(Serialize)]
pub struct ClusterListing {
    searches: Vec<SearchNote>,
    workers: Vec<WorkerNote>,
}

/// It must stay on the thread that opened it.
pub struct ClusterWatch {
    searches: Subscriber,
    workers: Subscriber,
    // Dropped last, because the subscriptions need them.
    connection: Connection,
    _entered: EnterGuard<'static>,
}

impl ClusterWatch {
    pub fn open(server: &NatsServer, log: Log) -> Result<Self, Diagnostic> {
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
                if let Some(note) = SearchNote::decode(&message.payload) {
                    searches.insert(note.name.clone(), note);
                }
            }
            Some(message) = from_workers.next() => {
                if let Some(note) = WorkerNote::decode(&message.payload) {
                    workers.insert(note.name.clone(), note);
                }
            }
            () = time::sleep(GLANCE) => {}
        }
    }
    ClusterListing { searches: searches.into_values().collect(), workers: workers.into_values().collect() }
}

impl ClusterListing {
    pub fn describe(&self) -> String {
        let searches = if self.searches.is_empty() { "no searches\n".to_owned() } else { self.searches_table() };
        let workers = if self.workers.is_empty() { "no workers\n".to_owned() } else { self.workers_table() };
        format!("{searches}\n{workers}")
    }

    fn searches_table(&self) -> String {
        let counts = ["runs", "workers", "evaluations", "per second", "waiting", "redelivered", "refused"];
        let mut table = table(&["search", "physics"], &counts);
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
        let counts = ["threads", "evaluations", "per second", "redelivered"];
        let mut table = table(&["worker", "version", "physics"], &counts);
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

fn table<'a>(names: &[&'a str], counts: &[&'a str]) -> TextTable {
    let columns = names.iter().map(|name| (*name, Align::Left)).chain(counts.iter().map(|name| (*name, Align::Right)));
    TextTable::new(&columns.collect::<Vec<_>>())
}
