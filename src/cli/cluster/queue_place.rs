//! The tasks of a program in a queue of a NATS server, done by workers.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;
use std::time::{Duration, Instant};

use async_nats::{Message, Subscriber};
use futures_util::StreamExt;
use tokio::runtime::EnterGuard;
use tokio::sync::Notify;
use tokio::time;

use crate::cli::Failure;
use crate::cli::cluster::answer_message::AnswerMessage;
use crate::cli::cluster::audit::{Audit, Auditor};
use crate::cli::cluster::connection::{Connection, NatsArguments, answer_subject, random_name, reply_subject};
use crate::cli::cluster::connection::{search_note_subject, worker_note_subject};
use crate::cli::cluster::generation::{Generation, Verdict};
use crate::cli::cluster::message::{AnswerReply, SearchNote, TaskKey, WorkerNote, encode};
use crate::cli::cluster::physics::{PROGRAM, PhysicsId};
use crate::cli::cluster::roster::Roster;
use crate::cli::cluster::task_message::{TOGETHER, TaskMessage};
use crate::cli::cluster::task_sender::TaskSender;
use crate::cli::place::{TaskBatch, TaskPlace};
use crate::cli::wording::ClusterError;
use nbc_sim::Simulator;
use nbc_swarm::{Task, TaskResult};

/// The most time that [`TaskPlace::next`] waits.
const TURN: Duration = Duration::from_millis(500);
/// The time between looks at the queue.
const LOOK: Duration = Duration::from_secs(5);
/// The time between reports.
const REPORT: Duration = Duration::from_secs(2);
/// The most runs at once: each keeps a file open.
const MOST_RUNS: usize = 500;

/// The queue.
pub struct QueuePlace {
    /// The random name of this search.
    search: String,
    physics: PhysicsId,
    answers: Subscriber,
    notes: Subscriber,
    open: BTreeMap<usize, Generation>,
    /// The number of generations that each run has submitted.
    submitted: BTreeMap<usize, u32>,
    complete: VecDeque<(usize, Vec<TaskResult>)>,
    sender: TaskSender,
    auditor: Auditor,
    roster: Roster,
    /// Workers whose answers are ignored.
    refused: BTreeSet<String>,
    /// Workers whose results were used without an evaluation here.
    used: BTreeSet<String>,
    /// Messages that were not answers.
    junk: u64,
    /// A worker whose results were used and that was wrong.
    unsound: Option<String>,
    looked: Instant,
    reported: Option<Instant>,
    wake: Arc<Notify>,
    log: fn(&str),
    // Dropped last, because the subscriptions need them.
    connection: Connection,
    _entered: EnterGuard<'static>,
}

impl QueuePlace {
    /// Connects and prepares the queue.
    ///
    /// # Errors
    /// When the server cannot be used.
    pub fn open(arguments: &NatsArguments, trusting: bool, log: fn(&str)) -> Result<Self, Failure> {
        let search = random_name();
        let connection = Connection::open(arguments, &format!("nbc evolve {search}"))?;
        let entered = connection.enter();
        let physics = PhysicsId::compute(&Simulator::default());
        connection.open_queue(&physics.token())?;
        let subscribing = async {
            let subscribe = async |subject: String| connection.client.subscribe(subject).await;
            let answers = subscribe(answer_subject(&search, "*")).await.map_err(|error| error.to_string())?;
            let notes = subscribe(worker_note_subject()).await.map_err(|error| error.to_string())?;
            connection.client.flush().await.map_err(|error| error.to_string())?;
            Ok::<_, String>((answers, notes))
        };
        let (answers, notes) =
            connection.runtime.block_on(subscribing).map_err(|reason| connection.no_queue(reason))?;
        Ok(Self {
            sender: TaskSender::new(&connection, physics.token(), &search, log),
            auditor: Auditor::new(connection.runtime.handle().clone(), trusting),
            search,
            physics,
            answers,
            notes,
            open: BTreeMap::new(),
            submitted: BTreeMap::new(),
            complete: VecDeque::new(),
            roster: Roster::default(),
            refused: BTreeSet::new(),
            used: BTreeSet::new(),
            junk: 0,
            unsound: None,
            looked: Instant::now(),
            reported: None,
            wake: Arc::default(),
            log,
            connection,
            _entered: entered,
        })
    }

    /// What makes [`TaskPlace::next`] return at once when it is notified.
    pub fn wake(&self) -> Arc<Notify> {
        Arc::clone(&self.wake)
    }

    /// Starts to send those of the tasks that have no result.
    fn send(&mut self, tasks: impl IntoIterator<Item = TaskKey>) {
        let together = self.together();
        for key in tasks {
            let generation = self.open.get(&(key.run as usize));
            if let Some(task) = generation.and_then(|generation| generation.missing_task(key)) {
                // Only evaluations gain by being done together.
                let together = if matches!(task, Task::Evaluation(..)) { together } else { 1 };
                self.sender.send(&TaskMessage { key, together, task: task.clone() });
            }
        }
    }

    /// As many tasks as a thread can take without leaving another one idle.
    fn together(&mut self) -> u8 {
        let fair = self.waiting() / self.roster.summary().threads.max(1);
        fair.clamp(1, TOGETHER.into()) as u8
    }

    /// The number of tasks without a result.
    fn waiting(&self) -> usize {
        self.open.values().map(Generation::missing).sum()
    }

    /// Takes messages until a generation is complete or the time is over.
    async fn receive(&mut self) {
        let end = time::Instant::now() + TURN;
        while self.complete.is_empty() && self.unsound.is_none() {
            tokio::select! {
                Some(message) = self.answers.next() => self.take_answer(message).await,
                Some(message) = self.notes.next() => self.take_note(&message).await,
                Some(audit) = self.auditor.next() => self.take_audit(&audit),
                Some(()) = self.sender.next() => {}
                () = self.wake.notified() => return,
                () = time::sleep_until(end) => return,
            }
        }
    }

    async fn take_answer(&mut self, message: Message) {
        let worker = sender(&message);
        let reply =
            if self.refused.contains(&worker) { AnswerReply::Wrong } else { self.judge(&worker, &message.payload) };
        if let Some(inbox) = message.reply {
            // A lost reply makes the worker send its answer again.
            let _ = self.connection.client.publish(inbox, encode(&reply).into()).await;
        }
    }

    fn judge(&mut self, worker: &str, payload: &[u8]) -> AnswerReply {
        let Ok(answer) = AnswerMessage::decode(payload) else {
            self.drop_junk(worker);
            return AnswerReply::Invalid;
        };
        let run = answer.key.run as usize;
        let Some(generation) = self.open.get_mut(&run) else { return AnswerReply::Received };
        match generation.take(worker, &answer) {
            Verdict::Late | Verdict::Again => {}
            Verdict::Taken => {
                self.roster.count();
                if self.auditor.wants(worker) {
                    self.audit(answer.key, vec![(worker.to_owned(), answer.result)]);
                }
                self.finish(run);
            }
            Verdict::Differs { worker: first, result } => {
                self.audit(answer.key, vec![(first, result), (worker.to_owned(), answer.result)]);
            }
            Verdict::Implausible | Verdict::Wrong => {
                self.reject(worker, "its result cannot be right");
                self.send([answer.key]);
                return AnswerReply::Wrong;
            }
        }
        AnswerReply::Received
    }

    /// Does a task here; its result is not used before.
    fn audit(&mut self, key: TaskKey, claims: Vec<(String, TaskResult)>) {
        let Some(generation) = self.open.get_mut(&(key.run as usize)) else { return };
        generation.doubt(key);
        if let Some(task) = generation.task(key) {
            self.auditor.start(key, task.clone(), claims);
        }
    }

    fn take_audit(&mut self, audit: &Audit) {
        if let Some(generation) = self.open.get_mut(&(audit.key.run as usize)) {
            generation.verify(audit.key, audit.correct.clone());
        }
        for worker in audit.wrong() {
            self.reject(worker, "its result differs from that of this machine");
        }
        // The worker may be trusted now.
        let runs: Vec<usize> = self.open.keys().copied().collect();
        runs.into_iter().for_each(|run| self.finish(run));
    }

    /// Passes on the results of a generation if all can be used.
    fn finish(&mut self, run: usize) {
        let Some(generation) = self.open.get(&run) else { return };
        if let Some((results, workers)) = generation.results(|worker| self.auditor.trusts(worker)) {
            self.used.extend(workers.into_iter().map(str::to_owned));
            self.complete.push_back((run, results));
            self.open.remove(&run);
        }
    }

    /// Refuses a worker that was wrong, and lets others do its work again.
    fn reject(&mut self, worker: &str, reason: &str) {
        self.refuse(worker, reason);
        if self.used.contains(worker) {
            self.unsound = Some(worker.to_owned());
        }
        let lost: Vec<TaskKey> = self.open.values_mut().flat_map(|generation| generation.forget(worker)).collect();
        self.send(lost);
    }

    fn refuse(&mut self, worker: &str, reason: &str) {
        if self.refused.insert(worker.to_owned()) {
            (self.log)(&format!("refused worker `{}`: {reason}\n", name_of(worker)));
        }
    }

    /// Drops a message that is not an answer. Anybody can send one in the name of a worker, so it is no fault of that
    /// worker. Many make few lines.
    fn drop_junk(&mut self, worker: &str) {
        self.junk += 1;
        if self.junk < 8 || self.junk.is_power_of_two() {
            let (name, count) = (name_of(worker), self.junk);
            (self.log)(&format!("dropped a message in the name of `{name}` that is not an answer, {count} so far\n"));
        }
    }

    async fn take_note(&mut self, message: &Message) {
        let Ok(note) = WorkerNote::decode(&message.payload) else { return };
        if note.physics == self.physics.0 && note.program == PROGRAM {
            self.roster.take(note);
            return;
        }
        let WorkerNote { name, program, physics, .. } = note;
        let own = self.physics.0;
        self.refuse(
            &name,
            &format!(
                "its physics is {physics:016x} (version {program}), expected {own:016x} \
                 (version {PROGRAM})"
            ),
        );
        let _ = self.connection.client.publish(reply_subject(&name), encode(&AnswerReply::OtherPhysics).into()).await;
    }

    /// Sends again what the server did not take and what it has lost.
    async fn look(&mut self) {
        let again = self.sender.retry().await;
        self.send(again);
        if self.looked.elapsed() >= LOOK {
            self.looked = Instant::now();
            let overdue = self.open.values().flat_map(|generation| generation.overdue(LOOK)).collect();
            let lost = self.sender.lost(overdue).await;
            self.send(lost);
        }
    }

    /// Tells those who watch how this search is doing.
    async fn report(&mut self) {
        if self.reported.is_some_and(|reported| reported.elapsed() < REPORT) {
            return;
        }
        self.reported = Some(Instant::now());
        let summary = self.roster.summary();
        let note = SearchNote {
            name: self.search.clone(),
            program: PROGRAM.to_owned(),
            physics: self.physics.0,
            runs: self.open.len() as u32,
            workers: summary.workers as u32,
            evaluations: summary.evaluations,
            per_kilosecond: (summary.rate * 1000.0) as u64,
            waiting: self.waiting() as u64,
            redelivered: summary.redelivered,
            refused: self.refused.len() as u32,
        };
        let _ = self.connection.client.publish(search_note_subject(), encode(&note).into()).await;
    }
}

/// Who sent an answer: the name in its subject, and the connection to which the reply goes. Whoever sends in the name
/// of another has another connection, and so is another worker.
fn sender(message: &Message) -> String {
    let name = message.subject.rsplit('.').next().unwrap_or_default();
    // The inbox of a connection, without the number of the request. No part of a subject has a space.
    let inbox: Vec<&str> = message.reply.as_deref().unwrap_or_default().split('.').take(2).collect();
    format!("{name} {}", inbox.join("."))
}

/// The name of the worker that sent an answer.
fn name_of(sender: &str) -> &str {
    sender.split(' ').next().unwrap_or_default()
}

impl TaskPlace for QueuePlace {
    fn most_runs(&self) -> usize {
        MOST_RUNS
    }

    fn submit(&mut self, batch: TaskBatch) {
        let (run, count) = (batch.run, batch.tasks.len());
        let number = self.submitted.entry(run).or_default();
        let generation = Generation::new(*number, batch);
        *number += 1;
        let keys: Vec<TaskKey> = (0..count).map(|index| generation.key(index)).collect();
        self.open.insert(run, generation);
        self.send(keys);
        self.finish(run);
    }

    fn next(&mut self) -> Result<Option<(usize, Vec<TaskResult>)>, Failure> {
        if self.complete.is_empty() {
            let handle = self.connection.runtime.handle().clone();
            handle.block_on(async {
                self.look().await;
                self.report().await;
                self.receive().await;
            });
        }
        match self.unsound.take() {
            Some(worker) => Err(ClusterError::Unsound { worker: name_of(&worker).to_owned() }.into()),
            None => Ok(self.complete.pop_front()),
        }
    }

    fn note(&mut self) -> Option<String> {
        let (waiting, refused) = (self.waiting(), self.refused.len());
        Some(format!("{}, {waiting} waiting, {refused} refused", self.roster.summary().describe()))
    }

    fn close(&mut self) {
        self.connection.runtime.block_on(self.sender.clear());
    }
}
