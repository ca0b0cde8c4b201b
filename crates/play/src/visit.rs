//! The state of one connected page: its texts, its swarm, its requests.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use core::time::Duration;

use serde_json::Value;

use crate::class::Membership;
use crate::evolving::SharedSearch;
use crate::history::MEMORY;
use crate::jobs::{Job, JobEnd, JobWork, Jobs, PortionEnd, once};
use crate::message::{ClassName, Greeting, LessonList, PlayLimits, RequestResult, SwarmAnswer, TakenFile};
use crate::outbox::{Line, Outbox};
use crate::page_files::{PageFiles, example, examples, is_circuit, program_around};
use crate::refusal::Refused;
use crate::request::{Request, TakeKind, Verb};
use crate::runner::{LoadingSwarm, Runner};
use crate::script::{GivenInputs, TestMoment};
use crate::shell::WorkKind;
use crate::site::PlaySite;
use crate::text_checker::TextChecker;
use crate::{bodies, lessons, programs, script, taking};
use nbc_base::budget::Limit;
use nbc_circuit::CancelFlag;
use nbc_session::{Checked, Choice, Compiled, Excerpt, Session};
use nbc_swarm::Room;

const LOOK: Duration = Duration::from_millis(500);

/// A page that is connected. It knows no clock: `now` is the time since any moment, the same for all visits of a site,
/// and never goes back.
pub struct Visit {
    site: Arc<PlaySite>,
    checker: Arc<TextChecker>,
    /// The path of the last text to check, and the flag that ends its check.
    checking: Option<(String, CancelFlag)>,
    files: PageFiles,
    jobs: Jobs,
    runner: Runner,
    outbox: Outbox,
    swarms: u32,
    loaded: (Sender<Box<LoadingSwarm>>, Receiver<Box<LoadingSwarm>>),
    now: Duration,
    looked: Duration,
    membership: Option<Membership>,
}

impl Visit {
    pub fn new(site: Arc<PlaySite>, line: Arc<dyn Line>, now: Duration) -> Self {
        let (folder, outbox) = (site.folder.clone(), Outbox::new(line));
        Self {
            checker: Arc::new(TextChecker::new(&*folder)),
            checking: None,
            files: PageFiles::new(folder),
            jobs: Jobs::new(outbox.clone(), site.making.clone()),
            runner: Runner::new(outbox.clone()),
            outbox,
            site,
            swarms: 0,
            loaded: channel(),
            now,
            looked: now,
            membership: None,
        }
    }

    pub fn is_idle(&self) -> bool {
        self.jobs.are_done()
    }

    /// The time until [`Visit::advance`] has something to do. A request, or a call of [`Line::wake`], may come before.
    pub fn due(&self, now: Duration) -> Duration {
        let look = (self.looked + LOOK).saturating_sub(now);
        self.runner.due(now).map_or(look, |swarm| swarm.min(look))
    }

    /// Does what is due, at most one cycle of the swarm.
    pub fn advance(&mut self, now: Duration) {
        self.now = now;
        while let Ok(loaded) = self.loaded.1.try_recv() {
            self.runner.show(*loaded);
        }
        self.runner.advance(now);
        if now.saturating_sub(self.looked) >= LOOK {
            self.look();
        }
    }

    /// Takes a request, which should be JSON, and answers it, now or when its work is done.
    pub fn receive(&mut self, text: &str, now: Duration) {
        self.now = now;
        match serde_json::from_str::<Request>(text) {
            Ok(Request { id, verb }) => self.request(id, verb),
            Err(error) => {
                let id = serde_json::from_str::<Value>(text).ok().and_then(|value| value.get("id")?.as_u64());
                self.outbox.answer(id.unwrap_or(0), Err(Refused::Message(error.to_string())));
            }
        }
    }

    fn look(&mut self) {
        self.looked = self.now;
        for (path, event) in self.files.changes() {
            self.checker.close(path);
            self.outbox.event(event);
        }
        self.jobs.end_late(self.now);
    }

    fn request(&mut self, id: u64, verb: Verb) {
        let verb = match verb.change() {
            Ok(change) => return self.runner.change(id, change, self.now),
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
            Verb::Settle { rows } => self.runner.settle(&rows).map(RequestResult::Settle),
            Verb::Join { name, key } => self.join(&name, key).map(RequestResult::Join),
            Verb::Progress { place, finished } => {
                let done = self.membership.as_ref().ok_or(Refused::NoClass);
                return self.outbox.done(id, done.map(|membership| membership.progress(place, finished, self.now)));
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

    /// Joins the class. A page that has joined takes another name, and gives up the one before.
    fn join(&mut self, name: &str, key: Option<String>) -> Result<ClassName, Refused> {
        let class = self.site.class.as_ref().ok_or(Refused::NoClass)?;
        let key = key.or_else(|| self.membership.as_ref().map(|own| own.key().to_owned()));
        let joined = class.join(name, key.as_deref(), self.now)?;
        let key = joined.key().to_owned();
        if let Some(before) = self.membership.replace(joined).filter(|before| before.key() != key) {
            before.leave();
        }
        Ok(ClassName { key })
    }

    /// Learners of a class may only save files of their own.
    fn may_save(&self, path: &str) -> Result<(), Refused> {
        if self.site.class.is_none() {
            return Ok(());
        }
        let own = self.membership.as_ref().ok_or(Refused::NotJoined)?.own_path(path);
        if own == path { Ok(()) } else { Err(Refused::NotOwn { path: path.to_owned(), own }) }
    }

    /// Starts the check of a text, and ends that of an older text at the same path.
    fn check(&mut self, id: u64, path: String, text: String) {
        let older = self.checking.take().filter(|(older, _)| *older == path);
        older.into_iter().for_each(|(_, stop)| stop.raise());
        self.checker.update(path.clone(), text);
        let (checker, of) = (self.checker.clone(), path.clone());
        let work = once(move |job| Ok(Some(RequestResult::Program(programs::program(&*checker.checked(&of, job)?)))));
        let stop = self.begin(id, WorkKind::Check, work);
        self.checking = stop.map(|stop| (path, stop));
    }

    fn begin(&self, id: u64, kind: WorkKind, work: JobWork) -> Option<CancelFlag> {
        self.jobs.start(&*self.site.shell, id, kind, work, self.now)
    }

    fn start(&mut self, id: u64, verb: Verb) {
        let mut kind = WorkKind::Program;
        let site = self.site.clone();
        let work = match verb {
            Verb::Compile { path, circuit, swarm } => {
                let choice = Choice { circuit: Some(circuit), swarm };
                self.swarm(path, None, RequestResult::Compile, move |checked, job| {
                    let (circuit, options) = programs::chosen(checked, &choice, job)?;
                    Ok((checked.compile(&circuit, &options)?, GivenInputs::default()))
                })
            }
            Verb::Replay { path, test, swarm, world, row } => {
                let (test, shown) = test.parts();
                self.swarm(path, shown, RequestResult::Replay, move |checked, job| {
                    let moment = TestMoment { test, swarm: swarm.as_deref(), world: world.as_deref(), row };
                    script::begin(checked, moment, job)
                })
            }
            Verb::Read { path: Some(path), .. } => {
                let checker = self.checker.clone();
                once(move |job| {
                    // Its text is not one of the page's, but its translation waits for its turn.
                    let stop = job.stop.clone();
                    let mut apart = Session::new(site.folder.guarded(Arc::new(move || stop.clone())));
                    let read = checker.with(job, |_| program_around(&*site.folder, &mut apart, &path))??;
                    Ok(Some(RequestResult::Read(read)))
                })
            }
            Verb::Test { path, test, level } => {
                let checker = self.checker.clone();
                let (test, shown) = test.parts();
                let open = move |job: &Job| checker.open_with(&path, shown.as_deref(), job);
                programs::testing(self.fresh(), open, (test, level), site.shell.clone())
            }
            Verb::Prove { path, claim } => {
                let checker = self.checker.clone();
                programs::proving(move |job: &Job| checker.open(&path, job), claim)
            }
            Verb::Robots { path } => {
                let (checker, session) = (self.checker.clone(), self.fresh());
                once(move |job| {
                    let checked = path.map(|path| checker.checked(&path, job)).transpose()?;
                    bodies::robots(&session, checked.as_deref()).map(|cards| Some(RequestResult::Robots(cards)))
                })
            }
            Verb::Lessons => once(move |_| {
                let read = lessons::load(site.shell.lessons(), Some(&site.folder.world()));
                let findings = read.found.findings();
                Ok(Some(RequestResult::Lessons(LessonList { lessons: read.lessons, findings })))
            }),
            Verb::Probe { body, cycles, character } => {
                kind = WorkKind::Probe;
                once(move |job| bodies::probe(&body, cycles, character.unwrap_or(true), job))
            }
            Verb::Evolve(request) => {
                kind = WorkKind::Search;
                let mut search = None;
                Box::new(move |job: &mut Job| match &mut search {
                    None => {
                        search = Some(SharedSearch::begin(&request, site.shell.clone())?);
                        Ok(PortionEnd::More)
                    }
                    Some(search) => search.advance(job),
                })
            }
            Verb::Keep(request) => {
                kind = WorkKind::Search;
                let (files, is_shared) = (PageFiles::new(site.folder.clone()), site.class.is_some());
                once(move |job| bodies::keep(&request, &files, is_shared, job))
            }
            Verb::Export { path, circuit, swarm, live } => {
                let choice = Choice { circuit: Some(circuit), swarm };
                self.with_program(path, move |_, checked, job| {
                    let (name, bytes) = match live {
                        true => taking::live(&site, checked, &choice, job)?,
                        false => taking::recorded(&site, checked, &choice, job)?,
                    };
                    let url = site.shell.keep(&name, taking::HTML, bytes);
                    Ok(Some(RequestResult::Export(TakenFile { url, name })))
                })
            }
            Verb::Take { what, cycles } => {
                let (session, excerpt) = (self.fresh(), self.runner.excerpt(cycles.clamp(1, what.most())));
                once(move |job| taken(&site, &session, &excerpt?, what, job))
            }
            other => unreachable!("{other:?} is answered at once"),
        };
        self.begin(id, kind, work);
    }

    fn hello(&self) -> Greeting {
        Greeting {
            version: nbc_base::VERSION,
            folder: self.site.folder.name(),
            root: self.site.folder.uri(),
            file: self.site.file.clone(),
            files: self.files.list(),
            examples: examples(),
            limits: PlayLimits {
                robots: Limit::PageRobots.most() as usize,
                cycles: MEMORY,
                message: Limit::PageMessage.most() as usize,
            },
            live_pages: self.site.live_pages,
            public_page: self.site.public_page.clone(),
            class: self.site.class.is_some(),
            cycle_seconds: 0.25,
        }
    }

    /// Compiles a circuit of a program, perhaps with one test more, and runs its swarm through cycles of its script.
    /// Showing the swarm is the answer.
    fn swarm(
        &mut self,
        path: String,
        more: Option<String>,
        answer: fn(SwarmAnswer) -> RequestResult,
        compile: impl FnOnce(&Checked, &Job) -> Result<(Compiled, GivenInputs), Refused> + Send + 'static,
    ) -> JobWork {
        self.swarms += 1;
        let (number, loaded) = (self.swarms, self.loaded.0.clone());
        let (checker, session, shell) = (self.checker.clone(), self.fresh(), self.site.shell.clone());
        let (mut compile, mut loading) = (Some(compile), None);
        Box::new(move |job| {
            let Some(swarm) = &mut loading else {
                let compile = compile.take().expect("it is compiled once");
                let checked = checker.open_with(&path, more.as_deref(), job)?;
                let (compiled, script) = compile(&checked, job)?;
                loading = Some(programs::loading(
                    (&session, &checked),
                    compiled,
                    script,
                    answer,
                    (number, job, shell.clone()),
                )?);
                return Ok(PortionEnd::More);
            };
            let step = swarm.advance(job)?;
            if let PortionEnd::Done(_) = step {
                // A page that is gone sees no swarm.
                loading.take().into_iter().for_each(|swarm| _ = loaded.send(Box::new(swarm)));
                job.outbox.line().wake();
            }
            Ok(step)
        })
    }

    fn with_program(
        &self,
        path: String,
        work: impl FnOnce(&Session, &Checked, &mut Job) -> JobEnd + Send + 'static,
    ) -> JobWork {
        let (checker, session) = (self.checker.clone(), self.fresh());
        once(move |job| work(&session, &*checker.open(&path, job)?, job))
    }

    /// A session apart from that of the page's texts.
    fn fresh(&self) -> Session {
        Session::new(self.site.folder.world()).with_poses(Room::LIVE)
    }
}

fn taken(site: &PlaySite, session: &Session, excerpt: &Excerpt, what: TakeKind, job: &mut Job) -> JobEnd {
    let bytes = taking::make(session, excerpt, what, job)?;
    let (ending, media_type) = what.ending();
    let name = format!("{}.{ending}", excerpt.compiled.plan.circuit.circuit);
    Ok(Some(RequestResult::Take(TakenFile { url: site.shell.keep(&name, media_type, bytes), name })))
}

#[cfg(test)]
mod tests;
