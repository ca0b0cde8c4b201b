//! A compiled circuit's swarm, run through inputs in full physics.

use core::task::Poll;

use crate::compiled::Compiled;
use crate::observer::{CycleRunner, Observer};
use nbc_sim::Simulator;
use nbc_swarm::{Assembly, LiveSwarm, Room, SwarmTask, SwarmTrace};

pub(super) const LIVE_CYCLES: usize = 1000;

#[derive(Clone, Debug)]
pub struct SwarmRun {
    pub compiled: Compiled,
    pub trace: SwarmTrace,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Physics {
    pub simulator: Simulator,
    pub poses: Option<Room>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunEnd {
    Complete,
    Cancelled,
}

impl Physics {
    pub fn swarm(&self, compiled: &Compiled, cycles: usize) -> LiveSwarm {
        LiveSwarm::new(&self.simulator, &compiled.assembly, cycles, compiled.plan.window as usize, self.poses)
    }

    pub fn run(
        &self,
        compiled: &Compiled,
        inputs: Vec<Vec<bool>>,
        observer: &mut dyn Observer,
    ) -> (SwarmTrace, RunEnd) {
        DrivenSwarm::new(self.swarm(compiled, inputs.len()), inputs).run(&compiled.assembly, observer)
    }
}

pub(super) struct DrivenSwarm {
    swarm: LiveSwarm,
    inputs: Vec<Vec<bool>>,
    done: usize,
}

impl DrivenSwarm {
    pub(super) fn new(swarm: LiveSwarm, inputs: Vec<Vec<bool>>) -> Self {
        Self { swarm, inputs, done: 0 }
    }

    pub(super) fn resume(&mut self, compiled: &Compiled, observer: &mut dyn Observer) {
        let Some(keeper) = observer.keeper() else { return };
        let Compiled { assembly, plan, .. } = compiled;
        let kept = keeper.begin(&SwarmTask::of(assembly, self.inputs.clone(), plan.window as usize));
        if let Some(kept) = kept.filter(|kept| self.swarm.go_on(kept, assembly, &self.inputs)) {
            self.done = kept.cycles();
        }
    }

    /// Simulates the next cycle, or a part of it. The run also ends after a cycle whose trace `is_enough`.
    pub(super) fn advance(
        &mut self,
        assembly: &Assembly,
        is_enough: impl FnOnce(&SwarmTrace) -> bool,
        observer: &mut dyn Observer,
        runner: &mut dyn CycleRunner,
    ) -> Option<RunEnd> {
        let all = self.inputs.len();
        if let Some(inputs) = self.inputs.get(self.done) {
            let Poll::Ready(step) = runner.step(&mut self.swarm, assembly, all, inputs) else {
                return observer.is_cancelled().then_some(RunEnd::Cancelled);
            };
            let is_last = step.is_err() || is_enough(self.swarm.trace());
            self.done = if is_last { all } else { self.done + 1 };
            observer.progress(self.done as u64, all as u64);
        }
        let end = match self.done < all {
            true => observer.is_cancelled().then_some(RunEnd::Cancelled),
            false => Some(RunEnd::Complete),
        };
        if let Some(keeper) = observer.keeper() {
            match end {
                Some(RunEnd::Complete) => keeper.end(),
                None if !keeper.is_due() => {}
                _ => keeper.keep(&self.swarm.keep()),
            }
        }
        end
    }

    pub(super) fn run(mut self, assembly: &Assembly, observer: &mut dyn Observer) -> (SwarmTrace, RunEnd) {
        loop {
            if let Some(end) = self.advance(assembly, |_| false, observer, &mut ()) {
                return (self.into_trace(), end);
            }
        }
    }

    pub(super) fn trace(&self) -> &SwarmTrace {
        self.swarm.trace()
    }

    pub(super) fn into_trace(self) -> SwarmTrace {
        self.swarm.into_trace()
    }
}
