//! Runs in the lanes of one batch. The batch is kept between calls, because laying it out costs as much as some env
//! steps.

use crate::backend::lanes::batch::Ground;
use crate::backend::lanes::lane_batch::LaneBatch;
use crate::backend::lanes::world::World;
use crate::backend::run::Run;
use crate::meter::Part;
use crate::state::State;
use nbc_base::model::{Fault, FaultKind};

/// Runs that share a batch, at most as many as the kernel has lanes.
#[derive(Debug, Default)]
pub struct LaneGroup {
    /// The points of those in a lane are read with [`LaneGroup::state`].
    pub runs: Vec<Run>,
    lanes: Vec<usize>,
    batch: Option<Box<dyn LaneBatch>>,
    targets: Vec<f64>,
}

impl LaneGroup {
    pub fn new(runs: Vec<Run>) -> Self {
        Self { runs, ..Self::default() }
    }

    pub fn take(&mut self) -> Vec<Run> {
        self.unload();
        std::mem::take(&mut self.runs)
    }

    pub fn state(&self, run: usize) -> State {
        let mut state = self.runs[run].state.clone();
        if let (Some(batch), Some(lane)) = (&self.batch, self.lanes.iter().position(|&at| at == run)) {
            batch.unload(lane, &mut state);
        }
        state
    }

    pub fn finish(&mut self, world: &World) {
        while self.runs.iter().any(|run| !run.is_done()) {
            self.advance(world, |_, _| {});
        }
    }

    /// Advances until the first run ends. Calls `record` with each run after each of its env steps.
    pub fn advance(&mut self, world: &World, mut record: impl FnMut(usize, &Run)) {
        if world.is_stopped() {
            return self.stop();
        }
        self.load(world);
        let Some(batch) = &mut self.batch else { return };
        batch.resume();
        while !self.lanes.iter().any(|&run| self.runs[run].is_done()) {
            for (lane, &run) in self.lanes.iter().enumerate() {
                let run = &self.runs[run];
                self.targets.clear();
                self.targets.extend(run.signals.targets(run.clock, run.spell()));
                batch.set_targets(lane, &self.targets);
            }
            batch.env_step();
            for (lane, &place) in self.lanes.iter().enumerate() {
                let run = &mut self.runs[place];
                run.finish_env_step(batch.center(lane), batch.unstable() >> lane & 1 == 1);
                if run.fault.is_none() {
                    record(place, run);
                }
            }
            if self.lanes.iter().all(|&run| self.runs[run].fault.is_none()) {
                batch.save();
            }
            world.count(self.lanes.len());
            if world.is_stopped() {
                self.lanes.iter().for_each(|&run| self.runs[run].stop());
            }
        }
        batch.lap(Part::Bookkeeping);
        if self.lanes.iter().any(|&run| self.runs[run].fault.is_some()) {
            self.unload();
        }
    }

    fn stop(&mut self) {
        self.runs.iter_mut().for_each(Run::stop);
        self.unload();
    }

    fn load(&mut self, world: &World) {
        let is_loaded = self.batch.is_some() && self.lanes.iter().all(|&run| !self.runs[run].is_done());
        if is_loaded {
            return;
        }
        self.unload();
        self.lanes = (0..self.runs.len()).filter(|&run| !self.runs[run].is_done()).collect();
        let Some(&first) = self.lanes.first() else { return };
        let is_first = |&run: &usize| self.runs[run].body == self.runs[first].body;
        let robots: Vec<_> = self.lanes.iter().map(|&run| (&*self.runs[run].lattice, &self.runs[run].state)).collect();
        let ground = Ground { constants: &world.constants, floor: &world.floor, meter: world.meter.as_ref() };
        self.batch = Some(world.kernel.batch(&robots, self.lanes.iter().all(is_first), ground));
    }

    /// Moves the points out of the lanes; those of a run with a fault as they were after its last complete env step.
    pub fn unload(&mut self) {
        let Some(batch) = self.batch.take() else { return };
        for (lane, run) in self.lanes.drain(..).enumerate() {
            let run = &mut self.runs[run];
            match run.fault {
                None | Some(Fault { kind: FaultKind::Stopped, .. }) => batch.unload(lane, &mut run.state),
                Some(_) => batch.unload_saved(lane, &mut run.state),
            }
        }
    }
}
