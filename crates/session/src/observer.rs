//! Progress and cancellation of long work.

use core::task::Poll;

use nbc_circuit::CancelFlag;
use nbc_swarm::{Assembly, KeptSwarm, LiveSwarm, RobotFault, SwarmTask};

/// Receives the progress of long work, and can stop it. `()` ignores progress; a closure receives `(done, all)`.
pub trait Observer {
    /// Test or simulation `part` begins, counted from 0. The progress that follows is its own.
    fn begin(&mut self, part: usize, parts: usize) {
        let _ = (part, parts);
    }

    fn progress(&mut self, done: u64, all: u64) {
        let _ = (done, all);
    }

    fn is_cancelled(&self) -> bool {
        false
    }

    fn keeper(&mut self) -> Option<&mut dyn SwarmKeeper> {
        None
    }
}

/// Simulates the cycles of a test's swarm; `()` does so at once.
pub trait CycleRunner {
    /// Begins or continues a cycle of a swarm made for `cycles`; pending while others simulate parts of it.
    fn step(
        &mut self,
        swarm: &mut LiveSwarm,
        assembly: &Assembly,
        cycles: usize,
        inputs: &[bool],
    ) -> Poll<Result<(), RobotFault>>;
}

impl CycleRunner for () {
    fn step(&mut self, swarm: &mut LiveSwarm, _: &Assembly, _: usize, inputs: &[bool]) -> Poll<Result<(), RobotFault>> {
        Poll::Ready(swarm.step(inputs).map(drop))
    }
}

pub trait SwarmKeeper {
    /// The saved swarm of a task, if any. All that follows is of this task.
    fn begin(&mut self, task: &SwarmTask) -> Option<KeptSwarm>;

    fn is_due(&mut self) -> bool;

    fn keep(&mut self, kept: &KeptSwarm);

    fn end(&mut self);
}

impl Observer for () {}

impl<F: FnMut(u64, u64)> Observer for F {
    fn progress(&mut self, done: u64, all: u64) {
        self(done, all);
    }
}

pub struct Cancellable<F> {
    pub cancel: CancelFlag,
    pub progress: F,
}

impl<F: FnMut(u64, u64)> Observer for Cancellable<F> {
    fn progress(&mut self, done: u64, all: u64) {
        (self.progress)(done, all);
    }

    fn is_cancelled(&self) -> bool {
        self.cancel.is_raised()
    }
}

/// `before` of `all` parts were done in earlier cases.
pub(super) struct CaseObserver<'a> {
    pub(super) whole: &'a mut dyn Observer,
    pub(super) before: u64,
    pub(super) all: u64,
}

impl Observer for CaseObserver<'_> {
    fn progress(&mut self, done: u64, _: u64) {
        self.whole.progress(self.before + done, self.all);
    }

    fn is_cancelled(&self) -> bool {
        self.whole.is_cancelled()
    }

    fn keeper(&mut self) -> Option<&mut dyn SwarmKeeper> {
        self.whole.keeper()
    }
}
