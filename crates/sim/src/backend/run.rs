//! One simulation: a robot, its clock, and the schedule ahead of it.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::backend::Snapshot;
use crate::constants::Constants;
use crate::grid::Grid;
use crate::lattice::Lattice;
use crate::signal::Signals;
use crate::state::State;
use nbc_base::model::{Body, Fault, FaultKind, Palette, Schedule, Setting, Spell};

#[derive(Clone, Debug)]
pub struct Run {
    pub lattice: Arc<Lattice>,
    /// The body's number: runs of one number share a body.
    pub body: usize,
    pub signals: Arc<Signals>,
    /// Its points. While the run is in a lane the batch has them, and these are outdated.
    pub state: State,
    /// Its center of mass at the end of the last whole env step, in voxels.
    pub center: [f64; 2],
    pub clock: u32,
    pub fault: Option<Fault>,
    /// Spells ahead, the next one last.
    spells: Vec<Spell>,
}

impl Run {
    pub fn assign(&mut self, schedule: &Schedule) {
        let spells = schedule.spells.iter().rev().filter(|spell| spell.steps > 0);
        self.spells.clear();
        self.spells.extend(spells.cloned());
    }

    pub fn is_done(&self) -> bool {
        self.fault.is_some() || self.spells.is_empty()
    }

    pub fn spell(&self) -> &Spell {
        self.spells.last().expect("a run that is not done has a spell")
    }

    pub fn finish_env_step(&mut self, center: [f64; 2], is_unstable: bool) {
        let fault = |kind| Some(Fault { env_step: self.clock + 1, kind });
        if is_unstable {
            self.fault = fault(FaultKind::Unstable);
        } else if !center.iter().all(|axis| axis.is_finite()) {
            self.fault = fault(FaultKind::NonFinite);
        } else {
            self.center = center;
            self.count_down();
        }
    }

    pub fn stop(&mut self) {
        if !self.is_done() {
            self.fault = Some(Fault { env_step: self.clock + 1, kind: FaultKind::Stopped });
        }
    }

    #[cfg(feature = "gpu")]
    pub fn remaining(&self) -> u32 {
        if self.fault.is_some() { 0 } else { self.spells.iter().map(|spell| spell.steps).sum() }
    }

    #[cfg(feature = "gpu")]
    pub fn spells_ahead(&self, env_steps: u32) -> Vec<Spell> {
        let mut left = env_steps;
        let cut = |spell: &Spell| {
            let steps = spell.steps.min(left);
            left -= steps;
            Spell { steps, ..spell.clone() }
        };
        self.spells.iter().rev().map(cut).take_while(|spell| spell.steps > 0).collect()
    }

    fn count_down(&mut self) {
        self.clock += 1;
        let spell = self.spells.last_mut().expect("a run that is not done has a spell");
        spell.steps -= 1;
        if spell.steps == 0 {
            self.spells.pop();
        }
    }

    pub fn restore(&mut self, snapshot: &Snapshot) {
        assert_eq!(snapshot.state.position.len(), self.lattice.points().len(), "a snapshot is of the same body");
        let Snapshot { state, center, clock, fault } = snapshot.clone();
        self.spells.clear();
        (self.state, self.center, self.clock, self.fault) = (state, center, clock, fault);
    }
}

/// Equal bodies share their lattice, equal palettes the signals of bodies that sense no image.
pub fn runs<'a>(constants: &Constants, setting: &Setting, bodies: impl IntoIterator<Item = &'a Body>) -> Vec<Run> {
    let mut palettes: BTreeMap<&Palette, Arc<Signals>> = BTreeMap::new();
    let mut starts: BTreeMap<&Body, Run> = BTreeMap::new();
    let run = |body: &'a Body| {
        let number = starts.len();
        let start = starts.entry(body).or_insert_with(|| {
            let signals =
                palettes.entry(body.palette()).or_insert_with(|| Arc::new(Signals::new(body.palette(), constants)));
            let signals = match Grid::seeing(body).next() {
                Some(_) => Arc::new(Signals::clone(signals).of(body, constants)),
                None => Arc::clone(signals),
            };
            let lattice = Arc::new(Lattice::new(body, constants));
            let state = State::start(&lattice, setting.start(body.width()), constants);
            let center = state.center(constants);
            Run { lattice, body: number, signals, state, center, clock: 0, fault: None, spells: Vec::new() }
        });
        start.clone()
    };
    bodies.into_iter().map(run).collect()
}
