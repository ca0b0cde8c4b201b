//! Simulations under one pattern, made together.

use nbc_base::model::{Body, Fault, Pattern, Setting, Spell};
use nbc_sim::{Simulator, Snapshot};

/// The most robots at once, so that many bodies need no more memory.
const MOST_AT_ONCE: usize = 4096;

pub(super) struct Leg<'a> {
    pub body: &'a Body,
    pub from: Option<&'a Snapshot>,
    pub spell: Spell,
}

impl<'a> Leg<'a> {
    pub fn fixed(body: &'a Body, pattern: Pattern, env_steps: u32) -> Self {
        Self { body, from: None, spell: Spell::of(pattern, env_steps) }
    }
}

pub(super) struct LegEnd {
    /// Where the body was before it, in voxels.
    pub start: f64,
    pub end: f64,
    pub fault: Option<Fault>,
    pub state: Snapshot,
}

impl LegEnd {
    pub fn moved(&self) -> Result<f64, Fault> {
        self.fault.map_or_else(|| Ok(self.end - self.start), Err)
    }
}

pub(super) fn advance(simulator: &Simulator, setting: &Setting, legs: &[Leg]) -> Vec<LegEnd> {
    let mut ends = Vec::with_capacity(legs.len());
    for legs in legs.chunks(MOST_AT_ONCE) {
        let bodies: Vec<Body> = legs.iter().map(|leg| leg.body.clone()).collect();
        let mut flock = simulator.flock(setting, &bodies);
        for (place, leg) in legs.iter().enumerate() {
            if let Some(from) = leg.from {
                flock.restore(place, from);
            }
        }
        let starts: Vec<f64> = (0..legs.len()).map(|place| flock.center(place)[0]).collect();
        flock.advance_under(&legs.iter().map(|leg| leg.spell.clone()).collect::<Vec<_>>());
        ends.extend((0..).zip(starts).map(|(place, start)| LegEnd {
            start,
            end: flock.center(place)[0],
            fault: flock.fault(place),
            state: flock.snapshot(place),
        }));
    }
    ends
}
