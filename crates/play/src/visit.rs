//! The state of one connected page: its texts, its swarm, its requests. Each page has a thread of its own.

use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use axum::extract::ws::Utf8Bytes;
use serde_json::Value;
use tokio::sync::mpsc;

use crate::class::Membership;
use crate::files::{PageFiles, example, examples, is_circuit, program_around};
use crate::history::MEMORY;
use crate::jobs::{Job, JobEnd, JobKind, Jobs};
use crate::message::finding::findings;
use crate::message::{ClassName, Greeting, LessonList, PlayLimits, RequestResult, SwarmAnswer, TakenFile};
use crate::outbox::Outbox;
use crate::refusal::Refused;
use crate::request::{Request, TakeKind, Verb};
use crate::runner::{self, SwarmOrder};
use crate::served::Served;
use crate::text_checker::TextChecker;
use crate::{bodies, evolving, lessons, programs, taking};
use nbc_base::budget::Limit;
use nbc_circuit::CancelFlag;
use nbc_session::store::GuardedWorld;
use nbc_session::{Checked, Choice, Compiled, Session};
use nbc_swarm::Room;

/// The time between two checks of the files that the page has read.
const LOOK: Duration = Duration::from_millis(500);

/// A page that is connected.
pub(super) struct Visit {
    served: Arc<Served>,
    checker: Arc<TextChecker>,
    /// The path of the last text that was to be checked, and the flag that ends its check.
    checking: Option<(String, CancelFlag)>,
    files: PageFiles,
    jobs: Jobs,
    runner: Sender<SwarmOrder>,
    outbox: Outbox,
    swarms: u32,
    looked: Instant,
    membership: Option<Membership>,
}

impl Visit {
    /// A page that has connected.
    pub(super) fn new(served: Arc<Served>, outbox: Outbox) -> Self {
        let world = served.world.clone();
        Self {
            checker: Arc::new(TextChecker::new(world.clone())),
            checking: None,
            files: PageFiles::new(world),
            jobs: Jobs::new(outbox.clone(), served.making.clone()),
            runner: runner::start(outbox.clone()),
            outbox,
            served,
            swarms: 0,
            looked: Instant::now(),
            membership: None,
        }
    }

    /// Answers requests until the page disconnects. An empty message stands for a pause without messages.
    pub(super) fn serve(mut self, mut requests: mpsc::Receiver<Utf8Bytes>) {
        while let Some(text) = requests.blocking_recv() {
            if !text.is_empty() {
                self.receive(&text);
            }
            if self.looked.elapsed() >= LOOK {
                self.look();
            }
        }
    }

    /// Answers a request, and waits until long ones are done, but not longer than the time.
    pub(super) fn receive_and_wait(&mut self, text: &str, time: Duration) {
        let end = Instant::now() + time;
        self.receive(text);
        while !self.jobs.are_done() && Instant::now() < end {
            thread::sleep(Duration::from_millis(1));
        }
    }

    fn receive(&mut self, text: &str) {
        match serde_json::from_str::<Request>(text) {
            Ok(Request { id, verb }) => self.request(id, verb),
            Err(error) => {
                let id = serde_json::from_str::<Value>(text).ok().and_then(|value| value.get("id")?.as_u64());
                self.outbox.answer(id.unwrap_or(0), Err(Refused::Message(error.to_string())));
            }
        }
    }

    /// Reports files that have changed.
    fn look(&mut self) {
        self.looked = Instant::now();
        for (path, event) in self.files.changes() {
            self.checker.close(path);
            self.outbox.event(event);
        }
        self.jobs.end_late();
    }

    fn request(&mut self, id: u64, verb: Verb) {
        let verb = match verb.change() {
            Ok(change) => return self.order(SwarmOrder::Change(id, change)),
            Err(verb) => verb,
        };
        let answer = match verb {
            Verb::Hello => Ok(RequestResult::Hello(self.hello())),
            Verb::Files => Ok(RequestResult::Files(self.files.list())),
            Verb::Read { path: Some(path), .. } if !is_circuit(&path) => self.files.read(path).map(RequestResult::Read),
            Verb::Read { path: None, example: name } => example(&name.unwrap_or_default()).map(RequestResult::Read),
            Verb::Save { path, text, stamp } => self
                .may_save(&path)
                .and_then(|()| self.files.save(path, &text, stamp.as_deref()))
                .map(RequestResult::Save),
            Verb::Program { path, text } => return self.check(id, path, text),
            Verb::Join { name, key } => self.join(&name, key).map(RequestResult::Join),
            Verb::Progress { place, finished } => {
                let done = self.membership.as_ref().ok_or(Refused::NoClass);
                return self.outbox.done(id, done.map(|membership| membership.progress(place, finished)));
            }
            Verb::Leave => {
                self.membership.take().into_iter().for_each(Membership::leave);
                return self.outbox.done(id, Ok(()));
            }
            Verb::Cancel { of } => {
                self.jobs.cancel(of);
                return self.outbox.done(id, Ok(()));
            }
            long => return self.start(id, long),
        };
        self.outbox.answer(id, answer);
    }

    /// Joins the class. A page that has joined it takes another name, and gives up the one before.
    fn join(&mut self, name: &str, key: Option<String>) -> Result<ClassName, Refused> {
        let class = self.served.class.as_ref().ok_or(Refused::NoClass)?;
        let key = key.or_else(|| self.membership.as_ref().map(|own| own.key().to_owned()));
        let joined = class.join(name, key.as_deref())?;
        let key = joined.key().to_owned();
        if let Some(before) = self.membership.replace(joined).filter(|before| before.key() != key) {
            before.leave();
        }
        Ok(ClassName { key })
    }

    /// Whether the page may save at a path: learners of a class only have files of their own.
    fn may_save(&self, path: &str) -> Result<(), Refused> {
        if self.served.class.is_none() {
            return Ok(());
        }
        let own = self.membership.as_ref().ok_or(Refused::NotJoined)?.own_path(path);
        if own == path { Ok(()) } else { Err(Refused::NotOwn { path: path.to_owned(), own }) }
    }

    /// Starts the check of a text. That of an older text at the same path ends.
    fn check(&mut self, id: u64, path: String, text: String) {
        let older = self.checking.take().filter(|(older, _)| *older == path);
        older.into_iter().for_each(|(_, stop)| stop.raise());
        self.checker.update(path.clone(), text);
        let (checker, of) = (self.checker.clone(), path.clone());
        let stop = self.jobs.start(id, JobKind::Check, move |job| {
            Ok(Some(RequestResult::Program(programs::program(&*checker.checked(&of, job)?))))
        });
        self.checking = stop.map(|stop| (path, stop));
    }

    /// Starts a long request.
    fn start(&mut self, id: u64, verb: Verb) {
        let work = match verb {
            Verb::Compile { path, circuit, swarm } => {
                let choice = Choice { circuit: Some(circuit), swarm };
                return self.run_swarm(id, path, RequestResult::Compile, move |session, checked, job| {
                    let (circuit, options) = programs::chosen(checked, &choice, job)?;
                    Ok((session.compile(checked, &circuit, &options)?, Vec::new()))
                });
            }
            Verb::Replay { path, test, swarm, world, row } => {
                return self.run_swarm(id, path, RequestResult::Replay, move |session, checked, job| {
                    programs::until_row(session, checked, (test, swarm.as_deref(), world.as_deref(), row), job)
                });
            }
            Verb::Read { path: Some(path), .. } => {
                let (checker, world) = (self.checker.clone(), self.served.world.clone());
                boxed(move |job| {
                    // Its text is not one of the page's, but it waits for its turn to be translated.
                    let mut apart = Session::new(GuardedWorld::until(world.clone(), job.stop.clone()));
                    let read = checker.with(job, |_| program_around(&world, &mut apart, &path))??;
                    Ok(Some(RequestResult::Read(read)))
                })
            }
            Verb::Test { path, test, level } => self.with_program(path, move |session, checked, job| {
                programs::run_test(session, checked, test, level.into(), job)
            }),
            Verb::Robots { path } => {
                let (checker, session) = (self.checker.clone(), self.fresh());
                boxed(move |job| {
                    let checked = path.map(|path| checker.checked(&path, job)).transpose()?;
                    bodies::robots(&session, checked.as_deref()).map(|cards| Some(RequestResult::Robots(cards)))
                })
            }
            Verb::Lessons => {
                let served = self.served.clone();
                boxed(move |_| {
                    let lessons::ReadLessons { lessons, found } = lessons::load(&served.lessons, Some(&served.world));
                    let findings = findings(&found.list, &found.sources);
                    Ok(Some(RequestResult::Lessons(LessonList { lessons, findings })))
                })
            }
            Verb::Probe { body, cycles, character } => {
                let served = self.served.clone();
                let is_whole = character.unwrap_or(true);
                boxed(move |job| served.probing.install(|| bodies::probe(&body, cycles, is_whole, job)))
            }
            Verb::Evolve(request) => {
                let served = self.served.clone();
                boxed(move |job| evolving::evolve(&request, &served.background, job))
            }
            Verb::Keep(request) => {
                let served = self.served.clone();
                let files = PageFiles::new(served.world.clone());
                let is_shared = served.class.is_some();
                boxed(move |job| served.background.install(|| bodies::keep(&request, &files, is_shared, job)))
            }
            Verb::Export { path, circuit, swarm } => {
                let (choice, served) = (Choice { circuit: Some(circuit), swarm }, self.served.clone());
                self.with_program(path, move |session, checked, job| {
                    let (name, bytes) = taking::exported(session, checked, &choice, job)?;
                    let url = served.takes.keep(&name, taking::HTML, bytes);
                    Ok(Some(RequestResult::Export(TakenFile { url, name })))
                })
            }
            Verb::Take { what, cycles } => self.take(what, cycles),
            other => unreachable!("{other:?} is answered at once"),
        };
        self.jobs.start(id, JobKind::Work, work);
    }

    fn hello(&self) -> Greeting {
        let name = self.served.world.root().file_name().unwrap_or_default().to_string_lossy();
        Greeting {
            version: nbc_base::VERSION,
            folder: name.into_owned(),
            root: self.served.root.clone(),
            file: self.served.file.clone(),
            files: self.files.list(),
            examples: examples(),
            limits: PlayLimits {
                robots: Limit::PageRobots.most() as usize,
                cycles: MEMORY,
                message: Limit::PageMessage.most() as usize,
            },
            class: self.served.class.is_some(),
            cycle_seconds: 0.25,
        }
    }

    /// Compiles on another thread, and gives the swarm to the runner, which answers.
    fn run_swarm(
        &mut self,
        id: u64,
        path: String,
        answer: fn(SwarmAnswer) -> RequestResult,
        compile: impl FnOnce(&Session, &Checked, &Job) -> Result<(Compiled, Vec<Vec<bool>>), Refused> + Send + 'static,
    ) {
        self.swarms += 1;
        let (number, runner) = (self.swarms, self.runner.clone());
        let work = self.with_program(path, move |session, checked, job| {
            let (compiled, inputs) = compile(session, checked, job)?;
            let loaded = programs::loaded(session, compiled, inputs, answer, (number, job))?;
            let _ = runner.send(SwarmOrder::Load(Box::new(loaded)));
            Ok(None)
        });
        self.jobs.start(id, JobKind::Work, work);
    }

    /// Work on a program without errors.
    fn with_program(
        &self,
        path: String,
        work: impl FnOnce(&Session, &Checked, &mut Job) -> JobEnd + Send + 'static,
    ) -> Work {
        let (checker, session) = (self.checker.clone(), self.fresh());
        boxed(move |job| work(&session, &*checker.open(&path, job)?, job))
    }

    /// A session for another thread.
    fn fresh(&self) -> Session {
        Session::new(self.served.world.clone()).with_poses(Room::LIVE)
    }

    fn take(&self, what: TakeKind, cycles: u32) -> Work {
        let (reply, excerpt) = channel();
        self.order(SwarmOrder::Excerpt(cycles.clamp(1, what.most()), reply));
        let (session, served) = (self.fresh(), self.served.clone());
        boxed(move |job| {
            let excerpt = excerpt.recv().ok().flatten().ok_or(Refused::NoSwarm)?;
            let bytes = taking::make(&session, &excerpt, what, job)?;
            let (ending, kind) = what.ending();
            let name = format!("{}.{ending}", excerpt.compiled.plan.circuit.circuit);
            Ok(Some(RequestResult::Take(TakenFile { url: served.takes.keep(&name, kind, bytes), name })))
        })
    }

    fn order(&self, order: SwarmOrder) {
        // The runner lives as long as this end.
        let _ = self.runner.send(order);
    }
}

/// The work of a long request.
type Work = Box<dyn FnOnce(&mut Job) -> JobEnd + Send>;

fn boxed(work: impl FnOnce(&mut Job) -> JobEnd + Send + 'static) -> Work {
    Box::new(work)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::sample::select;

    use serde_json::json;

    use super::*;
    use crate::outbox::outbox;
    use nbc_session::store::FolderWorld;

    const VERBS: [&str; 20] = [
        "hello", "files", "read", "save", "program", "inputs", "clock", "run", "pause", "step", "reset", "seek",
        "view", "cancel", "robots", "lessons", "join", "progress", "leave", "nonsense",
    ];
    const TEXTS: [&str; 6] = ["a.nb", "../a", "", "circuit f(a) -> (q) { q = a }", "é\u{0}", "01"];

    fn number() -> impl Strategy<Value = Value> {
        select(vec![json!(0), json!(1), json!(-1), json!(1.5), json!(1e300), json!(u64::MAX), json!("x"), Value::Null])
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn any_requests_are_answered_without_a_fault(
            sent in prop::collection::vec((select(VERBS.to_vec()), select(TEXTS.to_vec()), number(), number()), 0..12),
            broken in ".{0,30}",
        ) {
            let folder = tempfile::tempdir().unwrap();
            let world = FolderWorld::new(folder.path()).unwrap();
            let served = Arc::new(Served::new(world, String::new(), None, "secret".to_owned()));
            let (inbox, outgoing) = outbox();
            let mut visit = Visit::new(served, inbox);
            // Nobody reads the answers.
            drop(outgoing);
            visit.receive(&broken);
            for (verb, text, one, two) in sent {
                let request = json!({
                    "id": one, "do": verb, "path": text, "text": text, "example": text, "stamp": null, "bits": text,
                    "bit": two, "half": one, "speed": two, "cycles": one, "cycle": two, "robots": [one], "of": two,
                    "name": text, "place": null, "finished": one,
                });
                visit.receive(&request.to_string());
            }
        }
    }
}
