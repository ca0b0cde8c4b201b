//! Length limits: after the integrator, edges that are too long or too short are moved back a part of the way (docs/physics.md 8).

use crate::sim::batch::Batch;
use crate::sim::real::{Mask, Real};

impl<R: Real> Batch<R> {
    /// First pass, all edges at once: an edge of length d beyond its bound moves its ends by 0.8 r excess / (2 d).
    ///
    /// Squares of lengths are compared, so that a root is needed only where a limit bites. A mass can be moved when its turn has come,
    /// because all its edges have then been measured.
    #[inline(always)]
    pub fn limit_lengths(&mut self) {
        let (longest, tightest) = (self.constants.longest, self.constants.tightest);
        let share = R::splat(self.constants.correction / 2.0);
        let zero = R::splat(0.0);
        for owner in 0..self.masses.len() {
            let here = self.masses[owner].at;
            let mut shift = self.masses[owner].shift;
            for spring in &self.springs[self.first[owner]..self.first[owner + 1]] {
                let other = &mut self.masses[spring.to as usize];
                let r = [here[0] - other.at[0], here[1] - other.at[1]];
                let square = r[0] * r[0] + r[1] * r[1];
                let (long, short) = (spring.rest * longest, spring.rest * tightest);
                let too_long = R::splat(long * long).below(square);
                let bites = too_long.or(square.below(R::splat(short * short))).and(zero.below(spring.stiffness));
                if bites.any() {
                    let inverse = square.recip_sqrt();
                    let excess = square * inverse - R::select(too_long, R::splat(long), R::splat(short));
                    let factor = R::select(bites, share * excess * inverse, zero);
                    for axis in 0..2 {
                        other.shift[axis] += r[axis] * factor;
                        shift[axis] -= r[axis] * factor;
                    }
                }
            }
            let mass = &mut self.masses[owner];
            for axis in 0..2 {
                mass.at[axis] += shift[axis];
                mass.shift[axis] = zero;
            }
        }
    }

    /// Second pass, the sides of rigid voxels one after another: an edge of length d beyond its bound moves its ends by
    /// 0.5 r excess / (2 d) before the next edge is looked at.
    #[inline(always)]
    pub fn limit_rigid(&mut self) {
        let (long, short) =
            (self.constants.cell * self.constants.rigid_longest, self.constants.cell * self.constants.rigid_tightest);
        let share = R::splat(self.constants.rigid_correction / 2.0);
        let zero = R::splat(0.0);
        for tile in &self.rigid {
            for side in 0..4 {
                let (a, b) = (tile.corners[side], tile.corners[(side + 1) % 4]);
                let (here, there) = (self.masses[a].at, self.masses[b].at);
                let r = [here[0] - there[0], here[1] - there[1]];
                let square = r[0] * r[0] + r[1] * r[1];
                let too_long = R::splat(long * long).at_most(square);
                let bites = too_long.or(square.at_most(R::splat(short * short))).and(tile.rigid);
                if bites.any() {
                    let inverse = square.recip_sqrt();
                    let excess = square * inverse - R::select(too_long, R::splat(long), R::splat(short));
                    let factor = R::select(bites, share * excess * inverse, zero);
                    for axis in 0..2 {
                        self.masses[a].at[axis] -= r[axis] * factor;
                        self.masses[b].at[axis] += r[axis] * factor;
                    }
                }
            }
        }
    }
}
