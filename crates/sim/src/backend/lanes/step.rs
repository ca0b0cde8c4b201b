//! A substep, written once for one robot and for several in lanes (docs/physics.md 5 and 6).
//!
//! Each voxel's frame of four springs is computed together, after the rims. When the frames of a row are done, all
//! forces on its masses are known: the masses advance to the next Runge-Kutta stage at once, and their old positions
//! are no longer needed. Lengths are computed one frame ahead of the forces, so that the long chain of root and
//! quotient overlaps with other work.

use std::ops::Range;

use crate::backend::lanes::batch::{Batch, Row};
use crate::backend::lanes::lane_batch::LaneBatch;
use crate::backend::lanes::mass::{Mass, Vector, between, square};
use crate::backend::lanes::real::{Mask, Real};
use crate::backend::lanes::springs::{DIAGONAL, Frame, MAIN};
use crate::backend::lanes::stiffness::Stiffness;
use crate::constants::Constants;
use crate::meter::Part;

/// One env step: substeps with the targets as they are (docs/physics.md 4).
#[inline(always)]
pub fn env_step<R: Real, K: Stiffness<R>>(batch: &mut Batch<R, K>) {
    batch.lap(Part::Bookkeeping);
    for _ in 0..batch.constants.substeps {
        batch.apply_contacts();
        batch.lap(Part::Contact);
        batch.sweep::<1>();
        batch.sweep::<2>();
        batch.sweep::<3>();
        batch.sweep::<4>();
        batch.hold_fixed();
        batch.lap(Part::Springs);
        batch.limit_lengths();
        batch.hold_fixed();
        batch.limit_rigid();
        batch.lap(Part::Limits);
    }
}

/// The vector from the later to the earlier end, its length squared, and a first estimate of 1 / length.
#[derive(Clone, Copy)]
struct Measure<R> {
    r: Vector<R>,
    square: R,
    seed: R,
}

impl<R: Real, K: Stiffness<R>> Batch<R, K> {
    /// One Runge-Kutta stage: spring forces at the stage's positions, then each mass on to the next stage, row by row.
    // Engines of WebAssembly give functions of that size few registers.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    #[cfg_attr(target_family = "wasm", inline(never))]
    fn sweep<const STAGE: u8>(&mut self) {
        self.pull_rims::<STAGE>();
        let mut next = measure_frame::<R, STAGE>(&self.springs.frames[0], &self.masses.now);
        for row in 0..self.rows.len() {
            let Row { masses, frames } = self.rows[row].clone();
            self.pull_frames::<STAGE>(frames, &mut next);
            self.finish_stage::<STAGE>(masses);
        }
    }

    #[inline(always)]
    fn pull_rims<const STAGE: u8>(&mut self) {
        let law = Law::<R>::new(&self.constants);
        let (masses, aims) = (self.masses.now.as_mut_slice(), self.springs.aims.as_slice());
        let kept = self.springs.rim_stiffness.iter().zip(&mut self.springs.rim_frozen);
        for (rim, (stiffness, frozen)) in self.springs.rims.iter().zip(kept) {
            let measure = measure::<R, STAGE>(masses, rim.from, rim.to);
            let pull = law.pull::<STAGE>(measure, stiffness.value(), aims[rim.aim as usize], frozen);
            for axis in 0..2 {
                masses[rim.from as usize].force[axis] -= pull[axis];
                masses[rim.to as usize].force[axis] += pull[axis];
            }
        }
    }

    /// Adds the forces of some frames to their masses, the first of which are measured, and measures the one after.
    #[inline(always)]
    fn pull_frames<const STAGE: u8>(&mut self, frames: Range<usize>, next: &mut [Measure<R>; 4]) {
        let law = Law::<R>::new(&self.constants);
        let (masses, aims) = (self.masses.now.as_mut_slice(), self.springs.aims.as_slice());
        let (main, diagonal) = (aims[MAIN], aims[DIAGONAL]);
        let ahead = &self.springs.frames[frames.start + 1..frames.end + 1];
        let kept =
            self.springs.frame_stiffness[frames.clone()].iter().zip(&mut self.springs.frame_frozen[frames.clone()]);
        for ((frame, ahead), (stiffness, frozen)) in self.springs.frames[frames].iter().zip(ahead).zip(kept) {
            let now = *next;
            *next = measure_frame::<R, STAGE>(ahead, masses);
            let own = aims[frame.aim as usize];
            let top = law.pull::<STAGE>(now[0], stiffness[0].value(), own, &mut frozen[0]);
            let left = law.pull::<STAGE>(now[1], stiffness[1].value(), main, &mut frozen[1]);
            let falling = law.pull::<STAGE>(now[2], stiffness[2].value(), diagonal, &mut frozen[2]);
            let rising = law.pull::<STAGE>(now[3], stiffness[3].value(), diagonal, &mut frozen[3]);
            let corners = frame.indices();
            for axis in 0..2 {
                masses[corners[0]].force[axis] -= top[axis] + (left[axis] + falling[axis]);
                masses[corners[1]].force[axis] += top[axis] - rising[axis];
                masses[corners[2]].force[axis] += falling[axis];
                masses[corners[3]].force[axis] += left[axis] + rising[axis];
            }
        }
    }

    #[inline(always)]
    fn finish_stage<const STAGE: u8>(&mut self, masses: Range<usize>) {
        let drag = R::splat(self.constants.drag * self.constants.substep);
        let kept = self.loads.of_mass[masses.clone()].iter().zip(&mut self.masses.before[masses.clone()]);
        for (mass, (&load, before)) in self.masses.now[masses].iter_mut().zip(kept) {
            if mass.stage_position::<STAGE>()[1].below(R::splat(0.0)).any() {
                plane::<R, STAGE>(&self.constants, mass);
            }
            let pace = mass.stage_velocity::<STAGE>();
            let acceleration = [mass.force[0] - drag * pace[0], mass.force[1] - drag * pace[1]];
            mass.force = self.loads.values[load as usize];
            mass.advance::<STAGE>(acceleration, before);
        }
    }
}

#[derive(Clone, Copy)]
struct Law<R> {
    approach: R,
    rest: R,
}

impl<R: Real> Law<R> {
    #[inline(always)]
    fn new(constants: &Constants) -> Self {
        Self { approach: R::splat(constants.approach), rest: R::splat(1.0 - constants.approach) }
    }

    /// The force is r f with f = (d - l) k / d and the frozen rest length l (docs/physics.md 6). In the first stage d
    /// is also the length from which l = d + 0.006 (goal - d) is computed, so there f is k (0.006 - 0.006 goal / d),
    /// and k l is kept for the other stages.
    #[inline(always)]
    fn pull<const STAGE: u8>(self, measure: Measure<R>, stiffness: R, aim: R, frozen: &mut R) -> Vector<R> {
        let Measure { r, square, seed } = measure;
        let inverse = square.recip_sqrt_from(seed);
        let factor = if STAGE == 1 {
            *frozen = stiffness * (self.rest * (square * inverse) + aim);
            stiffness * (self.approach - aim * inverse)
        } else {
            stiffness - *frozen * inverse
        };
        [r[0] * factor, r[1] * factor]
    }
}

#[inline(always)]
fn measure_frame<R: Real, const STAGE: u8>(frame: &Frame, masses: &[Mass<R>]) -> [Measure<R>; 4] {
    let [a, b, c, d] = frame.indices();
    let (top_left, top_right) = (masses[a].stage_position::<STAGE>(), masses[b].stage_position::<STAGE>());
    let (bottom_right, bottom_left) = (masses[c].stage_position::<STAGE>(), masses[d].stage_position::<STAGE>());
    [
        Measure::between(top_left, top_right),
        Measure::between(top_left, bottom_left),
        Measure::between(top_left, bottom_right),
        Measure::between(top_right, bottom_left),
    ]
}

#[inline(always)]
fn measure<R: Real, const STAGE: u8>(masses: &[Mass<R>], from: u32, to: u32) -> Measure<R> {
    Measure::between(masses[from as usize].stage_position::<STAGE>(), masses[to as usize].stage_position::<STAGE>())
}

impl<R: Real> Measure<R> {
    #[inline(always)]
    fn between(here: Vector<R>, there: Vector<R>) -> Self {
        let r = between(here, there);
        let square = square(r);
        Self { r, square, seed: square.recip_sqrt_seed() }
    }
}

impl<R: Real> Mass<R> {
    #[inline(always)]
    fn stage_position<const STAGE: u8>(&self) -> Vector<R> {
        if STAGE == 1 { self.at } else { self.stage }
    }

    #[inline(always)]
    fn stage_velocity<const STAGE: u8>(&self) -> Vector<R> {
        if STAGE == 1 { self.velocity } else { self.stage_velocity }
    }

    /// With u the velocity, a_s the acceleration and u_s the velocity in stage s, all counted in substeps, the
    /// classical scheme is x_2 = x + u/2, x_3 = x + u_2/2, x_4 = x + u_3 and u_2 = u + a_1/2, u_3 = u + a_2/2,
    /// u_4 = u + a_3. It ends with x + (u + 2 u_2 + 2 u_3 + u_4)/6 and with
    /// u + (a_1 + 2 a_2 + 2 a_3 + a_4)/6 = (2 (u_2 + 2 u_3 + a_3) + a_4)/6.
    #[inline(always)]
    fn advance<const STAGE: u8>(&mut self, acceleration: Vector<R>, before: &mut Vector<R>) {
        let (half, two, sixth) = (R::splat(0.5), R::splat(2.0), R::splat(1.0 / 6.0));
        for axis in 0..2 {
            let a = acceleration[axis];
            let u = self.velocity[axis];
            let pace = self.stage_velocity[axis];
            let at = self.at[axis];
            match STAGE {
                1 => {
                    self.stage[axis] = at + half * u;
                    self.stage_velocity[axis] = u + half * a;
                }
                2 => {
                    self.stage[axis] = at + half * pace;
                    self.stage_velocity[axis] = u + half * a;
                    self.sum[axis] = pace + self.stage_velocity[axis];
                }
                3 => {
                    let last = u + a;
                    self.stage[axis] = at + pace;
                    self.stage_velocity[axis] = last;
                    before[axis] = at;
                    self.at[axis] = at + sixth * ((u + last) + two * self.sum[axis]);
                    self.sum[axis] = (self.sum[axis] + pace) + a;
                }
                _ => {
                    self.velocity[axis] = sixth * (two * self.sum[axis] + a);
                    self.stage[axis] = R::splat(0.0);
                }
            }
        }
    }
}

/// The plane y = 0 under the ground, for the lanes that are below it (docs/physics.md 6).
#[cold]
#[inline(never)]
fn plane<R: Real, const STAGE: u8>(constants: &Constants, mass: &mut Mass<R>) {
    let (at, pace) = (mass.stage_position::<STAGE>(), mass.stage_velocity::<STAGE>());
    for lane in 0..R::LANES {
        let depth = -at[1].lane(lane);
        if depth > 0.0 {
            let normal = constants.plane_stiffness * depth;
            let speed = pace[0].lane(lane) / constants.substep;
            let friction = constants.plane_friction * normal * libm::tanh(constants.plane_slope * normal * speed);
            let scale = constants.per_substep_squared();
            let [x, y] = mass.force.map(|axis| axis.lane(lane));
            mass.force[0].set_lane(lane, x - friction * scale);
            mass.force[1].set_lane(lane, y + normal * scale);
        }
    }
}
