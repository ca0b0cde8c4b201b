//! Length limits: after the integrator, edges that are too long or too short are partly corrected (docs/physics.md 8).

use crate::backend::lanes::batch::{Batch, Round, Row, VoxelSides};
use crate::backend::lanes::mass::{Mass, Vector, between, square};
use crate::backend::lanes::real::{Mask, Real};
use crate::backend::lanes::springs::{DIAGONAL, FRAME, MAIN, rest};
use crate::backend::lanes::stiffness::Stiffness;
use crate::constants::Constants;
use crate::lattice::CORNERS;

impl<R: Real, K: Stiffness<R>> Batch<R, K> {
    /// First pass, all edges at once: an edge of length d beyond its bound moves its ends by 0.8 r excess / (2 d). A
    /// row's masses move when the springs of the row are done, because then all edges at them have been measured.
    // Engines of WebAssembly give functions of that size few registers.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    #[cfg_attr(target_family = "wasm", inline(never))]
    pub fn limit_lengths(&mut self) {
        let main = Bounds::<R>::new(rest(MAIN, &self.constants), &self.constants);
        let diagonal = Bounds::<R>::new(rest(DIAGONAL, &self.constants), &self.constants);
        let (all, share) = (self.masses.now.as_mut_slice(), self.constants.correction);
        let springs = &self.springs;
        for (rim, stiffness) in springs.rims.iter().zip(&springs.rim_stiffness) {
            let ends = [rim.from as usize, rim.to as usize];
            let r = between(all[ends[0]].at, all[ends[1]].at);
            let bites = stiffness.mask(main.broken(square(r)));
            if bites.any() {
                pull_back(all, ends, &main, bites, share);
            }
        }
        for row in 0..self.rows.len() {
            let Row { masses, frames } = self.rows[row].clone();
            for (n, stiffness) in frames.clone().zip(&springs.frame_stiffness[frames]) {
                let corners = springs.frames[n].indices();
                let [a, b, c, d] = corners;
                let (top_left, top_right) = (all[a].at, all[b].at);
                let (bottom_right, bottom_left) = (all[c].at, all[d].at);
                let bites = [
                    stiffness[0].mask(main.broken(square(between(top_left, top_right)))),
                    stiffness[1].mask(main.broken(square(between(top_left, bottom_left)))),
                    stiffness[2].mask(diagonal.broken(square(between(top_left, bottom_right)))),
                    stiffness[3].mask(diagonal.broken(square(between(top_right, bottom_left)))),
                ];
                if bites[0].or(bites[1]).or(bites[2].or(bites[3])).any() {
                    for spring in 0..4 {
                        let ends = [corners[FRAME[spring][0]], corners[FRAME[spring][1]]];
                        let bounds = if spring < 2 { &main } else { &diagonal };
                        if bites[spring].any() {
                            pull_back(all, ends, bounds, bites[spring], share);
                        }
                    }
                }
            }
            for mass in &mut all[masses] {
                for axis in 0..2 {
                    mass.at[axis] += mass.stage[axis];
                }
            }
        }
    }

    /// Second pass, the sides of rigid voxels one after another: an edge of length d beyond its bound moves its ends by
    /// 0.5 r excess / (2 d) before the next edge is processed.
    // Engines of WebAssembly give functions of that size few registers.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    #[cfg_attr(target_family = "wasm", inline(never))]
    pub fn limit_rigid(&mut self) {
        let bounds = Rigid::<R>::new(&self.constants);
        for Round { lanes, voxels, strays } in &self.rigid {
            if let Some(strays) = strays {
                bounds.limit_strays(&mut self.masses.now, strays, *lanes);
                continue;
            }
            let mut at = gather(&self.masses.now, voxels);
            let mut moved = false;
            moved |= bounds.pull_back::<0, 1>(&mut at, *lanes);
            moved |= bounds.pull_back::<1, 2>(&mut at, *lanes);
            moved |= bounds.pull_back::<2, 3>(&mut at, *lanes);
            moved |= bounds.pull_back::<3, 0>(&mut at, *lanes);
            if moved {
                scatter(&mut self.masses.now, voxels, &at);
            }
        }
    }
}

#[inline(always)]
fn gather<R: Real>(masses: &[Mass<R>], voxels: &[([usize; CORNERS], R::Mask)]) -> [Vector<R>; CORNERS] {
    let mut at = [[R::splat(0.0); 2]; CORNERS];
    for &(corners, lanes) in voxels {
        for corner in 0..CORNERS {
            let place = masses[corners[corner]].at;
            for axis in 0..2 {
                at[corner][axis] = R::select(lanes, place[axis], at[corner][axis]);
            }
        }
    }
    at
}

#[inline(always)]
fn scatter<R: Real>(masses: &mut [Mass<R>], voxels: &[([usize; CORNERS], R::Mask)], at: &[Vector<R>; CORNERS]) {
    for &(corners, lanes) in voxels {
        for corner in 0..CORNERS {
            let place = &mut masses[corners[corner]].at;
            for axis in 0..2 {
                place[axis] = R::select(lanes, at[corner][axis], place[axis]);
            }
        }
    }
}

#[derive(Clone, Copy)]
struct Rigid<R> {
    bounds: Bounds<R>,
    share: f64,
}

impl<R: Real> Rigid<R> {
    #[inline(always)]
    fn new(constants: &Constants) -> Self {
        let (most, least) = (constants.cell * constants.rigid_longest, constants.cell * constants.rigid_tightest);
        Self { bounds: Bounds::between(least, most), share: constants.rigid_correction }
    }

    #[inline(never)]
    fn limit_strays(self, masses: &mut [Mass<R>], voxels: &[(VoxelSides, R::Mask)], lanes: R::Mask) {
        for side in 0..CORNERS {
            let mut at = [[R::splat(0.0); 2]; CORNERS];
            for &(sides, lanes) in voxels {
                for (end, at) in sides[side].into_iter().zip(&mut at) {
                    let place = masses[end].at;
                    *at = [R::select(lanes, place[0], at[0]), R::select(lanes, place[1], at[1])];
                }
            }
            if !self.pull_back::<0, 1>(&mut at, lanes) {
                continue;
            }
            for &(sides, lanes) in voxels {
                for (end, at) in sides[side].into_iter().zip(at) {
                    let place = &mut masses[end].at;
                    *place = [R::select(lanes, at[0], place[0]), R::select(lanes, at[1], place[1])];
                }
            }
        }
    }

    #[inline(always)]
    fn pull_back<const FROM: usize, const TO: usize>(self, at: &mut [Vector<R>; CORNERS], lanes: R::Mask) -> bool {
        let r = between(at[FROM], at[TO]);
        let square = square(r);
        let too_long = self.bounds.most_squared.at_most(square);
        let bites = too_long.or(square.at_most(self.bounds.least_squared)).and(lanes);
        if bites.any() {
            let bound = R::select(too_long, self.bounds.most, self.bounds.least);
            let factor = correction(square, bound, self.share, bites);
            for axis in 0..2 {
                at[FROM][axis] -= r[axis] * factor;
                at[TO][axis] += r[axis] * factor;
            }
        }
        bites.any()
    }
}

#[derive(Clone, Copy)]
struct Bounds<R> {
    most: R,
    least: R,
    most_squared: R,
    least_squared: R,
}

impl<R: Real> Bounds<R> {
    #[inline(always)]
    fn new(rest: f64, constants: &Constants) -> Self {
        Self::between(rest * constants.tightest, rest * constants.longest)
    }

    #[inline(always)]
    fn between(least: f64, most: f64) -> Self {
        let (most_squared, least_squared) = (R::splat(most * most), R::splat(least * least));
        Self { most: R::splat(most), least: R::splat(least), most_squared, least_squared }
    }

    #[inline(always)]
    fn broken(&self, square: R) -> R::Mask {
        self.most_squared.below(square).or(square.below(self.least_squared))
    }
}

#[inline(always)]
fn pull_back<R: Real>(masses: &mut [Mass<R>], ends: [usize; 2], bounds: &Bounds<R>, bites: R::Mask, share: f64) {
    let r = between(masses[ends[0]].at, masses[ends[1]].at);
    let square = square(r);
    let bound = R::select(bounds.most_squared.below(square), bounds.most, bounds.least);
    let factor = correction(square, bound, share, bites);
    for axis in 0..2 {
        masses[ends[0]].stage[axis] -= r[axis] * factor;
        masses[ends[1]].stage[axis] += r[axis] * factor;
    }
}

/// The factor by which an edge's vector moves its ends if a limit is exceeded: share (d - bound) / (2 d), from d².
#[inline(always)]
fn correction<R: Real>(square: R, bound: R, share: f64, bites: R::Mask) -> R {
    let inverse = square.recip_sqrt();
    let excess = square * inverse - bound;
    R::select(bites, R::splat(share / 2.0) * excess * inverse, R::splat(0.0))
}
