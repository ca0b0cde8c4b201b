//! The point masses of a batch.

use crate::backend::lanes::real::Real;
use crate::state::State;

pub type Vector<R> = [R; 2];

/// A point mass. Time is counted in substeps: velocities are meters per substep, forces meters per substep squared.
#[derive(Clone, Copy, Debug)]
pub struct Mass<R> {
    pub at: Vector<R>,
    pub velocity: Vector<R>,
    /// Position in the current Runge-Kutta stage; after the last, the sum of the corrections by the length limits.
    pub stage: Vector<R>,
    pub stage_velocity: Vector<R>,
    pub sum: Vector<R>,
    pub force: Vector<R>,
}

#[inline(always)]
pub fn between<R: Real>(here: Vector<R>, there: Vector<R>) -> Vector<R> {
    [here[0] - there[0], here[1] - there[1]]
}

#[inline(always)]
pub fn square<R: Real>(r: Vector<R>) -> R {
    r[0] * r[0] + r[1] * r[1]
}

/// The masses of a batch at three times: now, one substep ago, and when they were saved.
#[derive(Debug)]
pub struct Masses<R> {
    pub now: Vec<Mass<R>>,
    pub before: Vec<Vector<R>>,
    /// Position, position one substep ago and velocity of each mass at the end of the last env step that went well.
    saved: Vec<[Vector<R>; 3]>,
}

impl<R: Real> Masses<R> {
    pub fn new(positions: impl Iterator<Item = [f64; 2]>) -> Self {
        let zero = [R::splat(0.0); 2];
        let mass = |at: [f64; 2]| Mass {
            at: at.map(R::splat),
            velocity: zero,
            stage: zero,
            stage_velocity: zero,
            sum: zero,
            force: zero,
        };
        let now: Vec<Mass<R>> = positions.map(mass).collect();
        Self { before: vec![zero; now.len()], now, saved: Vec::new() }
    }

    /// Puts a robot's points into a lane; `places` has the mass of each point.
    pub fn load(&mut self, lane: usize, places: &[usize], state: &State) {
        for (point, &mass) in places.iter().enumerate() {
            for axis in 0..2 {
                self.now[mass].at[axis].set_lane(lane, state.position[point][axis]);
                self.now[mass].velocity[axis].set_lane(lane, state.velocity[point][axis]);
                self.before[mass][axis].set_lane(lane, state.previous[point][axis]);
            }
        }
    }

    pub fn unload(&self, lane: usize, places: &[usize], state: &mut State) {
        for (point, &mass) in places.iter().enumerate() {
            let (mass, before) = (&self.now[mass], &self.before[mass]);
            state.position[point] = mass.at.map(|axis| axis.lane(lane));
            state.previous[point] = before.map(|axis| axis.lane(lane));
            state.velocity[point] = mass.velocity.map(|axis| axis.lane(lane));
        }
    }

    pub fn unload_saved(&self, lane: usize, places: &[usize], state: &mut State) {
        for (point, &mass) in places.iter().enumerate() {
            let [at, before, velocity] = self.saved[mass].map(|vector| vector.map(|axis| axis.lane(lane)));
            (state.position[point], state.previous[point], state.velocity[point]) = (at, before, velocity);
        }
    }

    pub fn save(&mut self) {
        self.saved.clear();
        self.saved.extend(self.now.iter().zip(&self.before).map(|(mass, &before)| [mass.at, before, mass.velocity]));
    }
}
