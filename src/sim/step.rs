//! One substep, written once for one robot and for many side by side (docs/physics.md 5 and 6).
//!
//! Springs and integration share one sweep over the masses for each Runge-Kutta stage. Springs belong to the earlier of their two masses,
//! so when a mass's turn has come all force on it is known after its own springs, it can go on to the next stage at once, and nobody
//! asks for its old place any more.

use crate::sim::batch::{Batch, Mass, Place, Spring};
use crate::sim::real::{Mask, Real};

/// One env step: substeps with the targets as they are (docs/physics.md 4).
#[inline(always)]
pub fn env_step<R: Real>(batch: &mut Batch<R>) {
    for _ in 0..batch.constants.substeps {
        substep(batch);
    }
}

/// One substep, in the order of docs/physics.md 5.
#[inline(always)]
fn substep<R: Real>(batch: &mut Batch<R>) {
    batch.meet();
    sweep::<R, 1>(batch);
    sweep::<R, 2>(batch);
    sweep::<R, 3>(batch);
    sweep::<R, 4>(batch);
    batch.limit_lengths();
    batch.limit_rigid();
}

/// One stage: spring forces at the stage's positions, then each mass on to the next stage.
#[inline(always)]
fn sweep<R: Real, const STAGE: u8>(batch: &mut Batch<R>) {
    let approach = R::splat(batch.constants.approach);
    let rest = R::splat(1.0 - batch.constants.approach);
    let drag = R::splat(batch.constants.drag * batch.constants.substep);
    let masses = &mut batch.masses[..];
    let mut springs = &mut batch.springs[..];
    for owner in 0..masses.len() {
        let (own, later) = springs.split_at_mut(batch.first[owner + 1] - batch.first[owner]);
        springs = later;
        let here = place::<R, STAGE>(&masses[owner]);
        let mut force = masses[owner].force;
        for spring in own {
            let other = &mut masses[spring.to as usize];
            let there = place::<R, STAGE>(other);
            let pull = pull::<R, STAGE>(spring, here, there, approach, rest);
            for axis in 0..2 {
                force[axis] -= pull[axis];
                other.force[axis] += pull[axis];
            }
        }
        let mass = &mut masses[owner];
        for axis in 0..2 {
            force[axis] -= drag * pace::<R, STAGE>(mass)[axis];
        }
        if place::<R, STAGE>(mass)[1].below(R::splat(0.0)).any() {
            let (at, pace) = (place::<R, STAGE>(mass), pace::<R, STAGE>(mass));
            plane(&batch.constants, at, pace, &mut force);
        }
        advance::<R, STAGE>(mass, force);
    }
}

#[inline(always)]
fn place<R: Real, const STAGE: u8>(mass: &Mass<R>) -> Place<R> {
    if STAGE == 1 { mass.at } else { mass.stage }
}

#[inline(always)]
fn pace<R: Real, const STAGE: u8>(mass: &Mass<R>) -> Place<R> {
    if STAGE == 1 { mass.velocity } else { mass.pace }
}

/// The force of a spring on its far end, r (d - l) k / d (docs/physics.md 6).
///
/// In the first stage d is also the length from which the frozen rest length l = d + 0.006 (goal - d) comes, so there the force is
/// r (0.006 k - 0.006 k goal / d), and k l is kept for the other stages, where it is r (k - k l / d).
#[inline(always)]
fn pull<R: Real, const STAGE: u8>(
    spring: &mut Spring<R>,
    here: Place<R>,
    there: Place<R>,
    approach: R,
    rest: R,
) -> Place<R> {
    let r = [here[0] - there[0], here[1] - there[1]];
    let square = r[0] * r[0] + r[1] * r[1];
    let inverse = square.recip_sqrt();
    let factor = if STAGE == 1 {
        spring.frozen = spring.stiffness * rest * (square * inverse) + spring.goal;
        spring.stiffness * approach - spring.goal * inverse
    } else {
        spring.stiffness - spring.frozen * inverse
    };
    [r[0] * factor, r[1] * factor]
}

/// Takes a mass to the next stage, its acceleration in this one being known.
///
/// With u the velocity, a_s the acceleration and u_s the velocity in stage s, all counted in substeps, the classical scheme is
/// x_2 = x + u/2, x_3 = x + u_2/2, x_4 = x + u_3 and u_2 = u + a_1/2, u_3 = u + a_2/2, u_4 = u + a_3, and ends with
/// x + (u + 2 u_2 + 2 u_3 + u_4)/6 and u + (a_1 + 2 a_2 + 2 a_3 + a_4)/6 = (2 (u_2 + 2 u_3 + a_3) + a_4)/6.
#[inline(always)]
fn advance<R: Real, const STAGE: u8>(mass: &mut Mass<R>, acceleration: Place<R>) {
    let (half, two, sixth) = (R::splat(0.5), R::splat(2.0), R::splat(1.0 / 6.0));
    mass.force = mass.load;
    for axis in 0..2 {
        let a = acceleration[axis];
        let u = mass.velocity[axis];
        match STAGE {
            1 => {
                mass.stage[axis] = mass.at[axis] + half * u;
                mass.pace[axis] = u + half * a;
            }
            2 => {
                let second = mass.pace[axis];
                mass.stage[axis] = mass.at[axis] + half * second;
                mass.pace[axis] = u + half * a;
                mass.sum[axis] = second + mass.pace[axis];
            }
            3 => {
                let third = mass.pace[axis];
                let start = mass.at[axis];
                let fourth = u + a;
                mass.stage[axis] = start + third;
                mass.pace[axis] = fourth;
                mass.before[axis] = start;
                mass.at[axis] = start + sixth * ((u + fourth) + two * mass.sum[axis]);
                mass.sum[axis] = mass.sum[axis] + third + a;
            }
            _ => mass.velocity[axis] = sixth * (two * mass.sum[axis] + a),
        }
    }
}

/// The plane y = 0 under the ground, for the lanes that are below it (docs/physics.md 6).
#[cold]
#[inline(never)]
fn plane<R: Real>(constants: &crate::sim::constants::Constants, at: Place<R>, pace: Place<R>, force: &mut Place<R>) {
    for lane in 0..R::LANES {
        let depth = -at[1].lane(lane);
        if depth > 0.0 {
            let normal = constants.plane_stiffness * depth;
            let speed = pace[0].lane(lane) / constants.substep;
            let friction = constants.plane_friction * normal * libm::tanh(constants.plane_slope * normal * speed);
            let scale = constants.per_substep_squared();
            force[0].set_lane(lane, force[0].lane(lane) - friction * scale);
            force[1].set_lane(lane, force[1].lane(lane) + normal * scale);
        }
    }
}
