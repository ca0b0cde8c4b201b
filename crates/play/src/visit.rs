//! The state of one connected page: its texts, its swarm, its requests.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use core::time::Duration;

use serde_json::Value;

use crate::class::Membership;
use crate::evolving::SharedSearch;
use crate::history::MEMORY;
use crate::jobs::{Job, JobEnd, JobWork, Jobs, PortionEnd, once};
use crate::message::finding::findings;
use crate::message::{ClassName, Greeting, LessonList, PlayLimits, RequestResult, SwarmAnswer, TakenFile};
use crate::outbox::{Line, Outbox};
use crate::page_files::{PageFiles, example, examples, is_circuit, program_around};
use crate::refusal::Refused;
use crate::request::{ChosenTest, Request, TakeKind, Verb};
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

/// The time between two checks of the files that the page has read.
const LOOK: Duration = Duration::from_millis(500);

/// A page that is connected. It knows no clock: `now` is always the time since any moment, the same for all visits of
/// a site, and never goes back.
pub struct Visit {
    site: Arc<PlaySite>,
    checker: Arc<TextChecker>,
    /// The path of the last text that was to be checked, and the flag that ends its check.
    checking: Option<(String, CancelFlag)>,
    files: PageFiles,
    jobs: Jobs,
    runner: Runner,
    outbox: Outbox,
    swarms: u32,
    /// Swarms that work has made, to be shown.
    loaded: (Sender<Box<LoadingSwarm>>, Receiver<Box<LoadingSwarm>>),
    now: Duration,
    /// When the files were checked.
    looked: Duration,
    membership: Option<Membership>,
}

impl Visit {
    /// A page that has connected.
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

    /// Whether no long request runs.
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

    /// Reports files that have changed.
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

    /// Joins the class. A page that has joined it takes another name, and gives up the one before.
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

    /// Whether the page may save at a path: learners of a class only have files of their own.
    fn may_save(&self, path: &str) -> Result<(), Refused> {
        if self.site.class.is_none() {
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
        let work = once(move |job| Ok(Some(RequestResult::Program(programs::program(&*checker.checked(&of, job)?)))));
        let stop = self.begin(id, WorkKind::Check, work);
        self.checking = stop.map(|stop| (path, stop));
    }

    fn begin(&self, id: u64, kind: WorkKind, work: JobWork) -> Option<CancelFlag> {
        self.jobs.start(&*self.site.shell, id, kind, work, self.now)
    }

    /// Starts a long request.
    fn start(&mut self, id: u64, verb: Verb) {
        let mut kind = WorkKind::Program;
        let site = self.site.clone();
        let work = match verb {
            Verb::Compile { path, circuit, swarm } => {
                let choice = Choice { circuit: Some(circuit), swarm };
                self.swarm(path, None, RequestResult::Compile, move |session, checked, job| {
                    let (circuit, options) = programs::chosen(checked, &choice, job)?;
                    Ok((session.compile(checked, &circuit, &options)?, GivenInputs::default()))
                })
            }
            Verb::Replay { path, test, swarm, world, row } => {
                let (test, shown) = match test {
                    ChosenTest::Declared(test) => (Some(test), None),
                    ChosenTest::Shown(text) => (None, Some(text)),
                };
                self.swarm(path, shown, RequestResult::Replay, move |session, checked, job| {
                    let moment = TestMoment { test, swarm: swarm.as_deref(), world: world.as_deref(), row };
                    script::begin(session, checked, moment, job)
                })
            }
            Verb::Read { path: Some(path), .. } => {
                let checker = self.checker.clone();
                once(move |job| {
                    // Its text is not one of the page's, but it waits for its turn to be translated.
                    let stop = job.stop.clone();
                    let mut apart = Session::new(site.folder.guarded(Arc::new(move || stop.clone())));
                    let read = checker.with(job, |_| program_around(&*site.folder, &mut apart, &path))??;
                    Ok(Some(RequestResult::Read(read)))
                })
            }
            Verb::Test { path, test, level } => {
                let checker = self.checker.clone();
                let open = move |job: &Job| checker.open(&path, job);
                programs::testing(self.fresh(), open, (test, level.into()), site.shell.clone())
            }
            Verb::Prove { path, claim } => {
                let checker = self.checker.clone();
                programs::proving(self.fresh(), move |job: &Job| checker.open(&path, job), claim)
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
                let findings = findings(&read.found.list, &read.found.sources);
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
                self.with_program(path, move |session, checked, job| {
                    let (name, bytes) = match live {
                        true => taking::live(&site, checked, &choice, job)?,
                        false => taking::exported(session, checked, &choice, job)?,
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

    /// Compiles a circuit of a program, perhaps with one test more, runs its swarm through cycles of its script, and
    /// hands it over to be shown, which is the answer.
    fn swarm(
        &mut self,
        path: String,
        more: Option<String>,
        answer: fn(SwarmAnswer) -> RequestResult,
        compile: impl FnOnce(&Session, &Checked, &Job) -> Result<(Compiled, GivenInputs), Refused> + Send + 'static,
    ) -> JobWork {
        self.swarms += 1;
        let (number, loaded) = (self.swarms, self.loaded.0.clone());
        let (checker, session, shell) = (self.checker.clone(), self.fresh(), self.site.shell.clone());
        let (mut compile, mut loading) = (Some(compile), None);
        Box::new(move |job| {
            let Some(swarm) = &mut loading else {
                let compile = compile.take().expect("it is compiled once");
                let checked = match &more {
                    None => checker.open(&path, job)?,
                    Some(test) => checker.open_with(&path, test, job)?,
                };
                let (compiled, script) = compile(&session, &checked, job)?;
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

    /// Work on a program without errors.
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

/// Makes a file of the last cycles of a swarm.
fn taken(site: &PlaySite, session: &Session, excerpt: &Excerpt, what: TakeKind, job: &mut Job) -> JobEnd {
    let bytes = taking::make(session, excerpt, what, job)?;
    let (ending, media_type) = what.ending();
    let name = format!("{}.{ending}", excerpt.compiled.plan.circuit.circuit);
    Ok(Some(RequestResult::Take(TakenFile { url: site.shell.keep(&name, media_type, bytes), name })))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::sample::select;

    use serde_json::json;

    use super::*;
    use crate::local::{LocalLine, LocalShell, MemoryFolder, PageMessage};

    const VERBS: [&str; 20] = [
        "hello", "files", "read", "save", "program", "inputs", "clock", "run", "pause", "step", "reset", "seek",
        "view", "cancel", "robots", "lessons", "join", "progress", "leave", "nonsense",
    ];
    const TEXTS: [&str; 6] = ["a.nb", "../a", "", "circuit f(a) -> (q) { q = a }", "é\u{0}", "01"];

    /// A page with everything around it.
    struct Tab {
        folder: MemoryFolder,
        shell: Arc<LocalShell>,
        line: Arc<LocalLine>,
        visit: Visit,
        now: Duration,
    }

    impl Tab {
        fn new() -> Self {
            let (folder, shell, line) = (MemoryFolder::default(), Arc::<LocalShell>::default(), Arc::default());
            let making = nbc_session::CompileOptions::default();
            let site = Arc::new(PlaySite {
                folder: Arc::new(folder.clone()),
                file: None,
                making,
                live_pages: true,
                public_page: None,
                class: None,
                shell: shell.clone(),
            });
            let visit = Visit::new(site, Arc::<LocalLine>::clone(&line), Duration::ZERO);
            Self { folder, shell, line, visit, now: Duration::ZERO }
        }

        /// Sends a request. Returns the texts that come until its work is done.
        fn ask(&mut self, request: &Value) -> Vec<Value> {
            self.visit.receive(&request.to_string(), self.now);
            while self.shell.has_work() {
                self.shell.advance();
            }
            self.visit.advance(self.now);
            self.texts()
        }

        /// The texts that wait. Frames are left out.
        fn texts(&self) -> Vec<Value> {
            let next = || self.line.next(true);
            let texts = std::iter::from_fn(next).filter_map(|message| match message {
                PageMessage::Text(text) => Some(serde_json::from_str(&text).unwrap()),
                PageMessage::Frame(_) => None,
            });
            texts.collect()
        }

        /// Lets some time pass, in steps of a few milliseconds; the number of frames that came.
        fn pass(&mut self, time: Duration) -> usize {
            let end = self.now + time;
            let mut frames = 0;
            while self.now < end {
                self.now += self.visit.due(self.now).clamp(Duration::from_millis(1), end - self.now);
                self.visit.advance(self.now);
                frames += usize::from(matches!(self.line.next(true), Some(PageMessage::Frame(_))));
            }
            frames
        }
    }

    const LATCH: &str = "circuit latch(d, e) -> (q) { q = if e then d else q }";

    #[test]
    fn a_swarm_walks_as_fast_as_its_page_says_by_the_clock_that_it_is_given() {
        let mut tab = Tab::new();
        let program = json!({ "id": 1, "do": "program", "path": "latch.nb", "text": LATCH });
        let checked = tab.ask(&program);
        assert_eq!(checked[0]["ok"]["errors"], 0, "{checked:?}");
        let compile = json!({ "id": 2, "do": "compile", "path": "latch.nb", "circuit": "latch", "swarm": null });
        assert_eq!(tab.ask(&compile).last().unwrap()["to"], "compile");
        assert_eq!(tab.ask(&json!({ "id": 3, "do": "inputs", "bits": "11" })), [json!({ "id": 3, "ok": {} })]);
        tab.ask(&json!({ "id": 4, "do": "run", "speed": 4.0 }));
        let frames = tab.pass(Duration::from_secs(2));
        assert!((7..=10).contains(&frames), "{frames} frames");
        // The log knows each cycle that was done, and no other.
        let refused = tab.ask(&json!({ "id": 5, "do": "seek", "cycle": 100 }));
        assert_eq!(refused[0]["error"]["message"], "the log goes from cycle 0 to 9");
        assert_eq!(tab.ask(&json!({ "id": 6, "do": "seek", "cycle": 3 })), [json!({ "id": 6, "ok": {} })]);
        assert_eq!(tab.pass(Duration::from_secs(1)), 1, "a swarm that is shown at a cycle has paused");
    }

    const TWO: &str = "file program = \"two.csv\"
        circuit two(char[2], clk) -> (at, q) {
            at = register(not at, clk)
            q  = char[0] and char[1]
        }
        environment desk(at) -> (char[2], screen: text) {
            net words[2][8] init program
            word   = words[at]
            char   = word[1..0]
            screen = {1, word}
        }
        test two \"reads\" with desk {
            clk | q
            ^   | -
            ^   | -
            ^   | -
        }";

    #[test]
    fn a_test_gives_the_inputs_of_its_swarm_until_somebody_sets_them() {
        let mut tab = Tab::new();
        tab.folder.insert("two.csv", "72, 107\n");
        tab.ask(&json!({ "id": 1, "do": "program", "path": "two.nb", "text": TWO }));
        let replay = json!({ "id": 2, "do": "replay", "path": "two.nb", "test": 0, "swarm": null, "row": 0 });
        let answer = tab.ask(&replay).pop().unwrap();
        let script = &answer["ok"]["swarm"]["script"];
        let (desk, all) = (&script["environment"], script["cycles"].as_u64().unwrap());
        let written: Vec<&str> =
            desk["screen"].as_array().unwrap().iter().map(|piece| piece[1].as_str().unwrap()).collect();
        assert_eq!((desk["name"].as_str(), written.concat()), (Some("desk"), "HkH".to_owned()), "{answer}");
        let memory = &desk["memories"][0];
        assert_eq!(memory["words"], json!(["48", "6b"]));
        let reads = memory["reads"][0].as_array().unwrap();
        assert_eq!(reads.iter().map(|read| read[1].as_u64().unwrap()).collect::<Vec<_>>(), [0, 1, 0, 1]);
        // The second word is read, and given, from the edge on.
        let edge = reads[1][0].as_u64().unwrap();
        assert!(0 < edge && edge + 1 < all, "{reads:?}");
        tab.ask(&json!({ "id": 3, "do": "step", "cycles": all - 1 }));
        tab.pass(Duration::from_secs(1));
        let given = tab.visit.runner.excerpt(all as u32).unwrap().inputs;
        let at = |cycle: u64| given[cycle as usize].clone();
        assert_eq!((at(0), at(edge - 1)), (vec![false; 3], vec![false; 3]));
        assert_eq!(at(edge), [false, false, true], "its inputs stay the same until the next row");
        let second = reads[2][0].as_u64().unwrap();
        assert_eq!((at(second - 1), at(second)), (vec![true, true, false], vec![true; 3]));
        tab.ask(&json!({ "id": 4, "do": "inputs", "bits": "010" }));
        tab.ask(&json!({ "id": 5, "do": "step", "cycles": 1 }));
        tab.pass(Duration::from_millis(100));
        assert_eq!(tab.visit.runner.excerpt(1).unwrap().inputs, [[false, true, false]]);
    }

    #[test]
    fn a_file_that_is_taken_is_kept_at_the_address_of_the_answer() {
        let mut tab = Tab::new();
        tab.ask(&json!({ "id": 1, "do": "program", "path": "latch.nb", "text": LATCH }));
        tab.ask(&json!({ "id": 2, "do": "compile", "path": "latch.nb", "circuit": "latch", "swarm": null }));
        tab.ask(&json!({ "id": 3, "do": "step", "cycles": 1 }));
        let taken = tab.ask(&json!({ "id": 4, "do": "take", "what": "csv", "cycles": 1 }));
        let file = tab.shell.take_kept().unwrap();
        assert_eq!(taken.last().unwrap()["ok"], json!({ "url": file.address, "name": "latch.csv" }));
        assert!(file.media_type.starts_with("text/csv") && !file.bytes.is_empty());
        assert_eq!(tab.shell.take_kept(), None);
    }

    #[test]
    fn work_is_done_in_portions_between_which_it_can_be_cancelled() {
        let mut tab = Tab::new();
        let evolve = json!({ "id": 7, "do": "evolve", "body": null, "box": [3, 3], "generations": 1000, "seed": 1 });
        tab.visit.receive(&evolve.to_string(), tab.now);
        (0..4).for_each(|_| tab.shell.advance());
        let seen = tab.texts();
        assert_eq!(seen.iter().filter(|text| text["event"] == "archive").count(), 3, "{seen:?}");
        assert!(!tab.visit.is_idle());
        let cancelled = tab.ask(&json!({ "id": 8, "do": "cancel", "of": 7 }));
        assert_eq!(cancelled[0], json!({ "id": 8, "ok": {} }));
        assert_eq!(cancelled[1]["error"]["code"], "cancelled");
        assert!(tab.visit.is_idle());
    }

    #[test]
    fn a_test_shows_its_progress_and_can_be_cancelled_in_one_thread() {
        for (level, rows) in [("physics", 60), ("logic", 6000)] {
            let mut tab = Tab::new();
            let rows = "    0 | 1\n    1 | 0\n".repeat(rows / 2);
            let text = format!("circuit f(a) -> (q) {{ q = not a }}\ntest f {{\n    a | q\n{rows}}}");
            tab.ask(&json!({ "id": 1, "do": "program", "path": "a.nb", "text": text }));
            let test = json!({ "id": 2, "do": "test", "path": "a.nb", "test": 0, "level": level });
            tab.visit.receive(&test.to_string(), tab.now);
            (0..12).for_each(|_| tab.shell.advance());
            let seen = tab.texts();
            assert!(seen.len() > 1 && seen.iter().all(|text| text["progress"].is_array()), "{seen:?}");
            let cancelled = tab.ask(&json!({ "id": 3, "do": "cancel", "of": 2 }));
            assert_eq!(cancelled.last().unwrap()["error"]["code"], "cancelled", "{cancelled:?}");
            let answer = tab.ask(&test);
            let results = &answer.last().unwrap()["ok"]["results"];
            assert_eq!(results[0]["passed"], true, "{answer:?}");
        }
    }

    const LIGHTS: &str = "circuit lights(car, clk) -> (main, side) {
            turn = register(turn xor car, clk)
            main = not turn
            side = turn
        }
        prove lights {
            never main and side
            always car and before(main or side) => side
        }";

    #[test]
    fn what_refutes_a_property_is_watched_like_a_test() {
        let mut tab = Tab::new();
        let program = tab.ask(&json!({ "id": 1, "do": "program", "path": "lights.nb", "text": LIGHTS }));
        let claims = &program[0]["ok"]["claims"];
        assert_eq!(claims[0]["properties"][0], json!({ "property": "never main and side", "line": 7 }), "{program:?}");
        let answer = tab.ask(&json!({ "id": 2, "do": "prove", "path": "lights.nb", "claim": 0 })).pop().unwrap();
        let found = &answer["ok"]["properties"];
        let proved = json!({ "verdict": "proved", "how": "by induction over 1 step", "test": null });
        assert_eq!((&found[0], &found[1]["verdict"]), (&proved, &"refuted".into()), "{answer}");
        let replay = json!({ "id": 3, "do": "replay", "path": "lights.nb", "test": found[1]["test"], "swarm": null,
            "row": 3 });
        let shown = tab.ask(&replay).pop().unwrap();
        let script = &shown["ok"]["swarm"]["script"];
        assert_eq!(script["title"], "always car and before(main or side) => side", "{shown}");
        // The program itself is as it was.
        let other = json!({ "id": 4, "do": "replay", "path": "lights.nb", "test": 0, "swarm": null, "row": 0 });
        assert_eq!(tab.ask(&other)[0]["error"]["message"], "the program has no such test or row");
        let other = tab.ask(&json!({ "id": 5, "do": "prove", "path": "lights.nb", "claim": 1 }));
        assert_eq!(other[0]["error"]["message"], "the program claims nothing of that number");
        let broken = json!({ "id": 6, "do": "replay", "path": "lights.nb", "test": "test lights {", "swarm": null,
            "row": 0 });
        assert!(tab.ask(&broken)[0]["error"]["message"].is_string());
    }

    #[test]
    fn work_that_takes_too_long_is_stopped() {
        let mut tab = Tab::new();
        let evolve = json!({ "id": 7, "do": "evolve", "body": null, "box": [2, 2], "generations": 1000, "seed": 1 });
        tab.visit.receive(&evolve.to_string(), tab.now);
        tab.now = Duration::from_secs(Limit::PageSeconds.most() + 1);
        tab.visit.advance(tab.now);
        let ended = tab.ask(&json!({ "id": 8, "do": "pause" }));
        assert_eq!(ended.last().unwrap()["error"]["code"], "timed-out", "{ended:?}");
    }

    #[test]
    fn what_changes_in_the_folder_is_told_and_counts() {
        let mut tab = Tab::new();
        tab.folder.insert("a.nb", LATCH);
        let read = tab.ask(&json!({ "id": 1, "do": "read", "path": "a.nb" }));
        assert_eq!(read[0]["ok"]["text"], LATCH);
        tab.folder.insert("a.nb", "");
        tab.now += LOOK;
        tab.visit.advance(tab.now);
        let changed = tab.texts().remove(0);
        assert_eq!(changed["event"], "changed");
        let (old, new) = (&read[0]["ok"]["stamp"], &changed["stamp"]);
        let saved = tab.ask(&json!({ "id": 2, "do": "save", "path": "a.nb", "text": LATCH, "stamp": old }));
        assert_eq!(saved[0]["error"]["code"], "changed");
        let saved = tab.ask(&json!({ "id": 3, "do": "save", "path": "a.nb", "text": LATCH, "stamp": new }));
        assert_eq!(saved[0]["to"], "save");
        // The draft of a page knows its file again after a reload.
        assert_eq!(saved[0]["ok"]["stamp"], *old);
        assert_eq!(tab.folder.take_written(), Some(("a.nb".to_owned(), LATCH.to_owned())));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn any_requests_are_answered_without_a_fault(
            sent in prop::collection::vec((select(VERBS.to_vec()), select(TEXTS.to_vec()), number(), number()), 0..12),
            broken in ".{0,30}",
        ) {
            let mut tab = Tab::new();
            tab.visit.receive(&broken, tab.now);
            for (verb, text, one, two) in sent {
                let request = json!({
                    "id": one, "do": verb, "path": text, "text": text, "example": text, "stamp": null, "bits": text,
                    "bit": two, "half": one, "speed": two, "cycles": one, "cycle": two, "robots": [one], "of": two,
                    "name": text, "place": null, "finished": one,
                });
                for answer in tab.ask(&request) {
                    prop_assert!(answer["error"]["message"] != json!("the program failed; its log says where"));
                }
            }
        }
    }

    fn number() -> impl Strategy<Value = Value> {
        select(vec![json!(0), json!(1), json!(-1), json!(1.5), json!(1e300), json!(u64::MAX), json!("x"), Value::Null])
    }
}
