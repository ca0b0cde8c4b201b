//! Progress and cancellation of long work.

use core::task::Poll;

use nbc_circuit::CancelFlag;
use nbc_swarm::{Assembly, KeptSwarm, LiveSwarm, RobotFault, SwarmTask};

/// Receives the progress of long work, and can stop it. Each door implements it. `()` ignores progress; a closure of
/// `(done, all)` receives it.
pub trait Observer {
    /// One of several tests and simulations begins, counted from 0; the progress that follows is its own.
    fn begin(&mut self, part: usize, parts: usize) {
        let _ = (part, parts);
    }

    /// `done` parts of `all` are done.
    fn progress(&mut self, done: u64, all: u64) {
        let _ = (done, all);
    }

    /// Whether the work should stop; called after each part.
    fn is_cancelled(&self) -> bool {
        false
    }

    /// The keeper of the swarms of tests, if there is one.
    fn keeper(&mut self) -> Option<&mut dyn SwarmKeeper> {
        None
    }
}

/// Simulates the cycles of a test's swarm. `()` does it at once.
pub trait CycleRunner {
    /// Begins the next cycle of a swarm that was made of an assembly for `cycles`, or goes on with the one that was
    /// begun; pending while others still simulate parts of it.
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

/// Keeps swarms in long tests, so that these can go on later.
pub trait SwarmKeeper {
    /// The swarm that was kept of a task, if any; all that is kept from here on is of this task.
    fn begin(&mut self, task: &SwarmTask) -> Option<KeptSwarm>;

    /// Whether it is time to keep the swarm; called after each cycle.
    fn is_due(&mut self) -> bool;

    /// Keeps the swarm of the task.
    fn keep(&mut self, kept: &KeptSwarm);

    /// The task is done.
    fn end(&mut self);
}

impl Observer for () {}

impl<F: FnMut(u64, u64)> Observer for F {
    fn progress(&mut self, done: u64, all: u64) {
        self(done, all);
    }
}

/// An observer that hands on the progress, and stops the work when the flag is raised.
pub struct Cancellable<F> {
    /// The request to stop.
    pub cancel: CancelFlag,
    /// Receives the progress.
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

/// Reports the progress of one of several cases of a test; `before` of `all` parts were done in earlier cases.
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
