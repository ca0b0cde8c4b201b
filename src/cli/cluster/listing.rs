//! `nbc workers`: the workers at a server, and the searches that they work for.

use std::collections::BTreeMap;
use std::time::Duration;

use async_nats::Subscriber;
use clap::Args;
use futures_util::StreamExt;
use serde::Serialize;
use tokio::time;

use crate::cli::cluster::connection::{Connection, NatsArguments, search_note_subject, worker_note_subject};
use crate::cli::cluster::message::{SearchNote, WorkerNote};
use crate::cli::{Context, Failure, Interrupt, OutputFormat, Status};
use nbc_session::report::{Align, Schema, TextTable};

/// The time in which every worker and every search reports at least once.
const WATCH: Duration = Duration::from_secs(3);
/// The time between looks for a signal.
const GLANCE: Duration = Duration::from_millis(100);

/// List the workers at a NATS server, and the searches that they work for
#[derive(Args)]
#[command(after_help = "\
Examples:
  nbc workers --nats nats://localhost:4222
  nbc workers --nats nats://localhost:4222 --watch --format json   a line of JSON every three seconds")]
pub struct WorkersArguments {
    #[command(flatten)]
    server: NatsArguments,
    /// List them again every three seconds, until Ctrl-C
    #[arg(long)]
    watch: bool,
}

/// The output for programs.
#[derive(Serialize)]
struct WorkersResult {
    searches: Vec<ListedSearch>,
    workers: Vec<ListedWorker>,
}

/// A search.
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

/// A worker.
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

/// What searches and workers say.
struct Watch {
    searches: Subscriber,
    workers: Subscriber,
}

impl WorkersArguments {
    /// Listens for a few seconds and lists who reported.
    ///
    /// # Errors
    /// When the server cannot be used.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let interrupt = Interrupt::watch()?;
        let connection = Connection::open(&self.server, "nbc workers")?;
        let _entered = connection.enter();
        let watch = connection.runtime.block_on(Watch::open(&connection)).map_err(|reason| connection.no_queue(reason));
        let mut watch = watch?;
        loop {
            let found = connection.runtime.block_on(watch.listen(&interrupt));
            if self.watch && interrupt.is_raised() {
                return Ok(Status::Done);
            }
            match context.format {
                OutputFormat::Json => context.print_json(Schema::Workers, &found)?,
                OutputFormat::Text => context.print(found.describe())?,
            }
            context.flush()?;
            if !self.watch {
                return Ok(Status::Done);
            }
        }
    }
}

impl Watch {
    async fn open(connection: &Connection) -> Result<Self, String> {
        let subscribe = async |subject: String| connection.client.subscribe(subject).await;
        let searches = subscribe(search_note_subject()).await.map_err(|error| error.to_string())?;
        let workers = subscribe(worker_note_subject()).await.map_err(|error| error.to_string())?;
        Ok(Self { searches, workers })
    }

    /// Listens for some seconds, or until a signal arrives.
    async fn listen(&mut self, interrupt: &Interrupt) -> WorkersResult {
        let (mut searches, mut workers) = (BTreeMap::new(), BTreeMap::new());
        let end = time::Instant::now() + WATCH;
        while time::Instant::now() < end && !interrupt.is_raised() {
            tokio::select! {
                Some(message) = self.searches.next() => {
                    if let Ok(note) = SearchNote::decode(&message.payload) {
                        searches.insert(note.name.clone(), note);
                    }
                }
                Some(message) = self.workers.next() => {
                    if let Ok(note) = WorkerNote::decode(&message.payload) {
                        workers.insert(note.name.clone(), note);
                    }
                }
                () = time::sleep(GLANCE) => {}
            }
        }
        WorkersResult {
            searches: searches.into_values().map(ListedSearch::of).collect(),
            workers: workers.into_values().map(ListedWorker::of).collect(),
        }
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

impl WorkersResult {
    fn describe(&self) -> String {
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
