//! Long requests: each is work that the shell does in portions. It reports its progress, and can be cancelled.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use core::time::Duration;

use crate::lock::lock;
use crate::message::RequestResult;
use crate::outbox::Outbox;
use crate::refusal::Refused;
use crate::shell::{Portion, Shell, WorkKind};
use nbc_base::budget::Limit;
use nbc_base::model::Instance;
use nbc_circuit::{CancelFlag, Effort};
use nbc_session::{Checked, CompileOptions, Observer};
use nbc_sim::{Monitor, Simulator};

/// Circuits with more gates are mapped with little effort.
const MANY_GATES: usize = 500;
const TIME: Duration = Duration::from_secs(Limit::PageSeconds.most());

pub(super) struct Jobs {
    running: Arc<Mutex<BTreeMap<u64, Running>>>,
    making: CompileOptions,
    outbox: Outbox,
}

struct Running {
    kind: WorkKind,
    stop: CancelFlag,
    monitor: Arc<Monitor>,
    end: Duration,
    is_late: Arc<AtomicBool>,
}

impl Running {
    fn stop(&self) {
        self.stop.raise();
        self.monitor.stop();
    }
}

pub(super) struct Job {
    pub(super) id: u64,
    pub(super) outbox: Outbox,
    pub(super) stop: CancelFlag,
    making: CompileOptions,
    monitor: Arc<Monitor>,
    is_late: Arc<AtomicBool>,
    pub(super) percent: u64,
}

pub(super) enum PortionEnd {
    More,
    Waits,
    /// There is no answer if somebody else will give it.
    Done(Option<RequestResult>),
}

pub(super) type JobEnd = Result<Option<RequestResult>, Refused>;

pub(super) type JobWork = Box<dyn FnMut(&mut Job) -> Result<PortionEnd, Refused> + Send>;

pub(super) fn once(work: impl FnOnce(&mut Job) -> JobEnd + Send + 'static) -> JobWork {
    let mut work = Some(work);
    Box::new(move |job| {
        let work = work.take().expect("work that is done is not called again");
        work(job).map(PortionEnd::Done)
    })
}

impl Jobs {
    pub(super) fn new(outbox: Outbox, making: CompileOptions) -> Self {
        Self { running: Arc::default(), making, outbox }
    }

    pub(super) fn start(
        &self,
        shell: &dyn Shell,
        id: u64,
        kind: WorkKind,
        mut work: JobWork,
        now: Duration,
    ) -> Option<CancelFlag> {
        let (stop, monitor) = (CancelFlag::default(), Arc::new(Monitor::default()));
        let is_late: Arc<AtomicBool> = Arc::default();
        {
            let mut running = lock(&self.running);
            let is_check = |kind: WorkKind| kind == WorkKind::Check;
            // Checks have room of their own.
            let same = running.values().filter(|one| is_check(one.kind) == is_check(kind)).count() as u64;
            // Two requests of one number could not be told apart when one is cancelled or ends.
            let is_in_use = running.contains_key(&id);
            if is_in_use || Limit::PageJobs.permit(same + 1).is_err() {
                let busy = Refused::Busy { most: same as usize };
                self.outbox.answer(id, Err(if is_in_use { Refused::NumberInUse { id } } else { busy }));
                return None;
            }
            let (stop, monitor, is_late) = (stop.clone(), monitor.clone(), is_late.clone());
            running.insert(id, Running { kind, stop, monitor, end: now + TIME, is_late });
        }
        let (running, outbox) = (self.running.clone(), self.outbox.clone());
        let mut job = Job { id, outbox, stop: stop.clone(), making: self.making.clone(), monitor, is_late, percent: 0 };
        let portion = move || {
            let ended = catch_unwind(AssertUnwindSafe(|| work(&mut job)));
            let ended = ended.unwrap_or(Err(Refused::Internal));
            match ended {
                Ok(PortionEnd::More) => return Portion::More,
                Ok(PortionEnd::Waits) => return Portion::Waits,
                _ => {}
            }
            lock(&running).remove(&id);
            match ended {
                Ok(PortionEnd::Done(answer)) => answer.into_iter().for_each(|answer| job.outbox.answer(id, Ok(answer))),
                Ok(PortionEnd::More | PortionEnd::Waits) => {}
                Err(refused) => job.outbox.answer(id, Err(job.reason(refused))),
            }
            Portion::Done
        };
        shell.start(kind, Box::new(portion));
        Some(stop)
    }

    pub(super) fn cancel(&self, id: u64) {
        lock(&self.running).get(&id).into_iter().for_each(Running::stop);
    }

    pub(super) fn are_done(&self) -> bool {
        lock(&self.running).is_empty()
    }

    pub(super) fn end_late(&self, now: Duration) {
        for late in lock(&self.running).values().filter(|one| one.end < now) {
            late.is_late.store(true, Ordering::Relaxed);
            late.stop();
        }
    }
}

impl Drop for Jobs {
    fn drop(&mut self) {
        lock(&self.running).values().for_each(Running::stop);
    }
}

impl Job {
    pub(super) fn simulator(&self) -> Simulator {
        Simulator::monitored(self.monitor.clone())
    }

    /// Maps a large circuit with little effort: seconds instead of minutes, for a few more robots.
    pub(super) fn options_for(&self, checked: &Checked, circuit: &Instance) -> CompileOptions {
        let effort = if checked.gates(circuit) > MANY_GATES { Effort::Fast } else { self.making.effort };
        CompileOptions { effort, ..self.options() }
    }

    pub(super) fn options(&self) -> CompileOptions {
        CompileOptions { cancel: self.stop.clone(), ..self.making.clone() }
    }

    pub(super) fn check(&self) -> Result<(), Refused> {
        if self.stop.is_raised() { Err(self.reason(Refused::Cancelled)) } else { Ok(()) }
    }

    fn reason(&self, refused: Refused) -> Refused {
        match refused {
            Refused::Cancelled if self.is_late.load(Ordering::Relaxed) => Refused::TimedOut { seconds: TIME.as_secs() },
            other => other,
        }
    }
}

impl Observer for Job {
    fn progress(&mut self, done: u64, all: u64) {
        let percent = done * 100 / all.max(1);
        if percent > self.percent {
            self.percent = percent;
            self.outbox.progress(self.id, [done, all]);
        }
    }

    fn is_cancelled(&self) -> bool {
        self.stop.is_raised()
    }
}
