//! Sends the tasks of a program to a queue of a NATS server, and receives the results of workers.

use std::time::Duration;

use async_nats::{Message, Subscriber};
use futures_util::StreamExt;
use tokio::runtime::EnterGuard;
use tokio::sync::mpsc::UnboundedReceiver;
use tokio::time;

use crate::Log;
use crate::answer_message::AnswerMessage;
use crate::checker::{Check, Checker};
use crate::connection::{Connection, NatsServer, answer_subject, random_name, worker_note_subject};
use crate::message::{AnswerReply, TaskKey, encode};
use crate::open_batches::{BatchRequest, OpenBatches};
use crate::physics::PhysicsId;
use crate::reports::{Reporter, Reports};
use crate::task_batch::Verdict;
use crate::task_message::{TOGETHER, TaskMessage};
use crate::task_sender::TaskSender;
use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_circuit::CancelFlag;
use nbc_sim::Simulator;
use nbc_swarm::{Task, TaskResult};

const TURN: Duration = Duration::from_millis(500);
/// The age of a batch at which the server is asked whether it still has the tasks.
const OVERDUE: Duration = Duration::from_secs(5);

/// It must stay on the thread that opened it.
pub struct Queue {
    answers: Subscriber,
    batches: OpenBatches,
    sender: TaskSender,
    checker: Checker,
    reports: Reports,
    // Dropped last, because the others need them.
    connection: Connection,
    _entered: EnterGuard<'static>,
}

impl Queue {
    pub fn open(server: &NatsServer, is_trusting: bool, log: Log) -> Result<Self, Diagnostic> {
        let search = random_name();
        let connection = Connection::open(server, &format!("nbc evolve {search}"), log)?;
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
            answers,
            batches: OpenBatches::default(),
            sender: TaskSender::new(&connection, physics.token(), &search, log),
            checker: Checker::new(connection.runtime.handle().clone(), is_trusting, log),
            reports: Reports::new(connection.client.clone(), search, physics, notes),
            connection,
            _entered: entered,
        })
    }

    /// Works until all senders of requests are dropped or `cancel` is raised.
    pub fn work(
        &mut self,
        mut requests: UnboundedReceiver<BatchRequest>,
        cancel: &CancelFlag,
        note: impl Fn(String),
    ) -> Result<(), Diagnostic> {
        let handle = self.connection.runtime.handle().clone();
        handle.block_on(async {
            while !cancel.is_raised() && self.checker.unsound().is_none() && self.is_wanted(&requests) {
                self.look().await;
                let (runs, waiting) = (self.batches.runs(), self.batches.missing());
                self.reports.tell(runs, waiting, self.checker.refused()).await;
                self.receive(&mut requests).await;
                note(self.describe());
            }
            self.sender.clear().await;
        });
        match self.checker.unsound() {
            Some(worker) => Err(wording::unsound(worker)),
            None => Ok(()),
        }
    }

    fn is_wanted(&self, requests: &UnboundedReceiver<BatchRequest>) -> bool {
        !self.batches.is_empty() || !requests.is_closed() || !requests.is_empty()
    }

    fn describe(&mut self) -> String {
        let (waiting, refused) = (self.batches.missing(), self.checker.refused());
        format!("{}, {waiting} waiting, {refused} refused", self.reports.workers.summary().describe())
    }

    async fn receive(&mut self, requests: &mut UnboundedReceiver<BatchRequest>) {
        let end = time::Instant::now() + TURN;
        let mut open = self.batches.len();
        while self.batches.len() >= open && self.checker.unsound().is_none() {
            open = self.batches.len();
            tokio::select! {
                request = requests.recv(), if !requests.is_closed() || !requests.is_empty() => match request {
                    Some(request) => self.take_request(request),
                    None => return,
                },
                Some(message) = self.answers.next() => self.take_answer(message).await,
                Some(message) = self.reports.notes.next() => self.take_note(&message).await,
                Some(check) = self.checker.next() => self.take_check(&check),
                Some(()) = self.sender.next() => {}
                () = time::sleep_until(end) => return,
            }
        }
    }

    fn take_request(&mut self, request: BatchRequest) {
        let keys = self.batches.add(request);
        self.send(keys);
    }

    fn send(&mut self, tasks: impl IntoIterator<Item = TaskKey>) {
        let together = self.together();
        for key in tasks {
            if let Some(task) = self.batches.get(key).and_then(|batch| batch.missing_task(key)) {
                // Only evaluations gain by being done together.
                let together = if matches!(task, Task::Evaluation(..)) { together } else { 1 };
                self.sender.send(&TaskMessage { key, together, task: task.clone() });
            }
        }
    }

    /// The number of tasks that a thread should take together, so that no other thread is left without any.
    fn together(&mut self) -> u8 {
        let fair = self.batches.missing() / self.reports.workers.summary().threads.max(1);
        fair.clamp(1, TOGETHER.into()) as u8
    }

    async fn take_answer(&mut self, message: Message) {
        let worker = sender(&message);
        let reply =
            if self.checker.is_refused(&worker) { AnswerReply::Wrong } else { self.judge(&worker, &message.payload) };
        if let Some(inbox) = message.reply {
            // A lost reply makes the worker send its answer again.
            let _ = self.connection.client.publish(inbox, encode(&reply).into()).await;
        }
    }

    fn judge(&mut self, worker: &str, payload: &[u8]) -> AnswerReply {
        let Some(answer) = AnswerMessage::decode(payload) else {
            self.checker.count_junk(worker);
            return AnswerReply::Invalid;
        };
        let key = answer.key;
        let Some(batch) = self.batches.get(key) else { return AnswerReply::Received };
        match batch.take(worker, &answer) {
            Verdict::Late | Verdict::Again => {}
            Verdict::Taken => {
                self.reports.workers.count();
                if self.checker.wants(worker) {
                    self.check(key, vec![(worker.to_owned(), answer.result)]);
                }
                let workers = self.batches.pass_on(key, |worker| self.checker.trusts(worker));
                self.checker.set_used(workers);
            }
            Verdict::Differs { worker: first, result } => {
                self.check(key, vec![(first, *result), (worker.to_owned(), answer.result)]);
            }
            Verdict::Implausible | Verdict::Wrong => {
                self.reject(worker, key, "its result cannot be right");
                self.send([key]);
                return AnswerReply::Wrong;
            }
        }
        AnswerReply::Received
    }

    /// Does a task here. The results of workers for it are not used before this is done.
    fn check(&mut self, key: TaskKey, claims: Vec<(String, TaskResult)>) {
        let Some(batch) = self.batches.get(key) else { return };
        batch.doubt(key);
        if let Some(task) = batch.task(key) {
            self.checker.start(key, task.clone(), claims);
        }
    }

    fn take_check(&mut self, check: &Check) {
        if let Some(batch) = self.batches.get(check.key) {
            batch.verify(check.key, check.correct.clone());
        }
        for worker in check.wrong() {
            self.reject(worker, check.key, "its result differs from that of this machine");
        }
        let workers = self.batches.pass_on_all(|worker| self.checker.trusts(worker));
        self.checker.set_used(workers);
    }

    fn reject(&mut self, worker: &str, key: TaskKey, reason: &str) {
        // Others of its results tell whether somebody else used its name.
        for (key, claim) in self.batches.claims(worker, self.checker.count_wrong(worker, key, reason)) {
            self.check(key, vec![(worker.to_owned(), claim)]);
        }
        let lost = self.batches.forget(worker);
        self.send(lost);
    }

    async fn take_note(&mut self, message: &Message) {
        match self.reports.take(message).await {
            // Only workers with the physics of this search get its tasks, and what they answer is checked.
            Some(Reporter::Unfit { name, .. }) if self.checker.has_answered(&name) => self.checker.count_junk(&name),
            Some(Reporter::Unfit { name, reason }) => self.checker.refuse(&name, &reason),
            Some(Reporter::Fit { name }) => self.checker.readmit(&name),
            Some(Reporter::Two { name }) => self.checker.count_junk(&name),
            None => {}
        }
    }

    /// Sends the tasks again that the server did not accept or has lost.
    async fn look(&mut self) {
        let again = self.sender.retry().await;
        self.send(again);
        let lost = self.sender.lost(|| self.batches.overdue(OVERDUE)).await;
        self.send(lost);
    }
}

/// The name in the subject of an answer, and the connection for the reply, which no other sender has.
fn sender(message: &Message) -> String {
    let name = message.subject.rsplit('.').next().unwrap_or_default();
    // The inbox of a connection, without the number of the request. No part of a subject has a space.
    let inbox: Vec<&str> = message.reply.as_deref().unwrap_or_default().split('.').take(2).collect();
    format!("{name} {}", inbox.join("."))
}
