//! `nbc watch`: checks and tests programs again whenever they are saved.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, SystemTime};

use clap::Args;

use crate::cli::check::describe;
use crate::cli::test::TestArguments;
use crate::cli::{Context, Failure, Interrupt, Status};
use nbc_base::diag::counted;
use nbc_session::{Checked, Session};

/// Polling works for every editor and file system.
const PAUSE: Duration = Duration::from_millis(100);

/// Check and test programs again whenever they are saved
#[derive(Args)]
#[command(after_help = "Examples:
  nbc watch adder.nb
  nbc watch adder.nb --logic

The files that a program uses and its folders of robots are watched too. Tests that still run when a file is saved \
are stopped. Ctrl-C ends.")]
pub struct WatchArguments {
    #[command(flatten)]
    test: TestArguments,
}

/// Time of change and length of each file or folder; `None` if it is missing.
#[derive(Debug, Default, PartialEq, Eq)]
struct Stamps(BTreeMap<String, Option<(SystemTime, u64)>>);

fn stamp(path: &str) -> Option<(SystemTime, u64)> {
    let about = fs::metadata(path).ok()?;
    Some((about.modified().ok()?, about.len()))
}

impl Stamps {
    /// Adds the stamps of paths that have none, and returns these paths.
    fn add(&mut self, paths: impl IntoIterator<Item = String>) -> Vec<String> {
        let new: Vec<_> = paths.into_iter().filter(|path| !self.0.contains_key(path)).collect();
        self.0.extend(new.iter().map(|path| (path.clone(), stamp(path))));
        new
    }

    /// The stamps that are different now.
    fn changes(&self) -> Self {
        let now = self.0.iter().map(|(path, known)| (path, known, stamp(path)));
        Self(now.filter(|(_, known, now)| *known != now).map(|(path, _, now)| (path.clone(), now)).collect())
    }

    /// Returns the paths that have changed, and stores their new stamps.
    fn renew(&mut self) -> Vec<String> {
        let changes = self.changes();
        let paths = changes.0.keys().cloned().collect();
        self.0.extend(changes.0);
        paths
    }
}

impl WatchArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let signal = Interrupt::watch()?;
        let device = self.test.device(context)?;
        let mut session =
            Session::new(signal.world()).with_simulator(device.simulator()).with_files(self.test.named_files());
        let (paths, mut stamps) = (self.test.paths()?, Stamps::default());
        while !signal.is_raised() {
            context.clear()?;
            let checked = check(&paths, &mut session, &mut stamps);
            if signal.is_raised() {
                break;
            }
            self.round(&session, &checked, (&stamps, &signal), context)?;
            device.check()?;
            context.flush()?;
            for path in wait(&mut stamps, &signal, context) {
                session.close(&path);
            }
        }
        Ok(Status::Done)
    }

    /// Tests if there are no errors, until a file changes or a signal arrives.
    fn round(
        &self,
        session: &Session,
        checked: &[Arc<Checked>],
        (stamps, signal): (&Stamps, &Interrupt),
        context: &mut Context,
    ) -> Result<(), Failure> {
        for file in checked {
            context.tell(&file.diagnostics, &file.sources);
            context.print(describe(file))?;
        }
        context.flush()?;
        let tested: Vec<_> = checked.iter().filter(|file| !file.program.tests.is_empty()).cloned().collect();
        if tested.is_empty() || checked.iter().any(|file| file.has_errors()) {
            return Ok(());
        }
        let stop = Interrupt::default();
        let done = Interrupt::default();
        let outcome = thread::scope(|scope| {
            scope.spawn(|| {
                while !done.is_raised() && !signal.is_raised() && stamps.changes().0.is_empty() {
                    thread::sleep(PAUSE);
                }
                stop.raise();
            });
            let outcome = self.test.test(session, &tested, &stop, context);
            done.raise();
            outcome
        });
        match outcome {
            Err(failure @ Failure::Input(_)) => _ = context.report(failure),
            outcome => _ = outcome?,
        }
        Ok(())
    }
}

/// Only a check finds the dependencies, and a path may change before it has its stamp, so what has a new stamp is read
/// again.
fn check(paths: &[&str], session: &mut Session, stamps: &mut Stamps) -> Vec<Arc<Checked>> {
    loop {
        let checked = paths.iter().map(|path| session.checked(path)).collect();
        let new = stamps.add(paths.iter().flat_map(|path| session.dependencies(path)));
        if new.is_empty() {
            return checked;
        }
        new.iter().for_each(|path| session.close(path));
    }
}

/// Waits for changes or a signal, and returns the paths that changed. A file may be written in parts, so the changes
/// end with a pause in which nothing changes.
fn wait(stamps: &mut Stamps, signal: &Interrupt, context: &Context) -> BTreeSet<String> {
    if !signal.is_raised() {
        context.log(&format!("watching {}; Ctrl-C ends\n", counted(stamps.0.len(), "path")));
    }
    let mut changed = BTreeSet::new();
    while !signal.is_raised() {
        let now = stamps.renew();
        if now.is_empty() && !changed.is_empty() {
            break;
        }
        changed.extend(now);
        thread::sleep(PAUSE);
    }
    changed
}
