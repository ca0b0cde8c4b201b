//! The point masses of a batch.

use crate::backend::lanes::real::Real;

/// A vector of the plane in every lane: x and y.
pub type Vector<R> = [R; 2];

/// A point mass. Time is counted in substeps: velocities are meters per substep, forces meters per substep squared.
#[derive(Clone, Copy, Debug)]
pub struct Mass<R> {
    /// Position at the start of the substep.
    pub at: Vector<R>,
    /// Velocity of the integrator.
    pub velocity: Vector<R>,
    /// Position in the current Runge-Kutta stage; after the last, the sum of the corrections by the length limits.
    pub stage: Vector<R>,
    /// Velocity in the current Runge-Kutta stage.
    pub stage_velocity: Vector<R>,
    /// Sum of stage velocities so far.
    pub sum: Vector<R>,
    /// Force so far in the current stage.
    pub force: Vector<R>,
}

/// The vector from `there` to `here`.
#[inline(always)]
pub fn between<R: Real>(here: Vector<R>, there: Vector<R>) -> Vector<R> {
    [here[0] - there[0], here[1] - there[1]]
}

/// The square of a vector's length.
#[inline(always)]
pub fn square<R: Real>(r: Vector<R>) -> R {
    r[0] * r[0] + r[1] * r[1]
}
