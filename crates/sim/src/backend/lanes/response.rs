//! Contact forces: which voxels touch in a substep, and the forces between them (docs/physics.md 7).

use std::sync::Arc;

use nalgebra::Vector2;

use crate::backend::lanes::batch::{Batch, Floor};
use crate::backend::lanes::contact::{Hit, Quad};
use crate::backend::lanes::proximity::{Inside, LowPoint};
use crate::backend::lanes::real::Real;
use crate::backend::lanes::stiffness::Stiffness;
use crate::lattice::CORNERS;

impl<R: Real, K: Stiffness<R>> Batch<R, K> {
    /// Contact forces and the instability test, both from the positions at the start of the substep.
    // Engines of WebAssembly give functions of that size few registers.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    #[cfg_attr(target_family = "wasm", inline(never))]
    pub fn apply_contacts(&mut self) {
        self.loads.clear_contacts(&mut self.masses.now);
        let mut low = std::mem::take(&mut self.touching.low);
        let mut inside = std::mem::take(&mut self.touching.inside);
        // Only a flat floor is found by height.
        let surface = if matches!(self.floor, Floor::Flat(_)) { self.constants.cell } else { f64::NEG_INFINITY };
        if self.proximity.survey(&self.masses.now, surface, &mut low) {
            self.proximity.renew(&self.masses.now);
            if let Floor::Terrain(terrain) = &self.floor {
                let terrain = Arc::clone(terrain);
                self.renew_terrain(&terrain);
            }
        }
        self.proximity.insides(&self.masses.now, &mut inside);
        self.unstable |= self.proximity.unstable(&self.masses.now);
        if !low.is_empty() {
            self.collide_with_ground(&low);
        }
        self.collide_with_terrain();
        if !inside.is_empty() {
            self.collide_with_itself(&inside);
        }
        low.clear();
        inside.clear();
        self.touching.low = low;
        self.touching.inside = inside;
    }

    /// Without unstable robots: their env step is discarded, and their huge voxels would touch all of the ground.
    pub fn sound_lanes(&self, lanes: u32) -> impl Iterator<Item = usize> + use<R, K> {
        let sound = lanes & !self.unstable;
        (0..self.occupants.len()).filter(move |lane| sound >> lane & 1 == 1)
    }

    #[inline(never)]
    fn collide_with_ground(&mut self, low: &[LowPoint]) {
        for lane in self.sound_lanes(u32::MAX) {
            let mut voxels = std::mem::take(&mut self.touching.voxels);
            for point in low.iter().filter(|point| point.lanes >> lane & 1 == 1) {
                voxels.extend(self.occupants[lane].at_mass[point.mass].iter().map(|&(voxel, _)| voxel));
            }
            voxels.sort_unstable();
            voxels.dedup();
            for &voxel in &voxels {
                self.collide_voxel_with_ground(lane, voxel);
            }
            voxels.clear();
            self.touching.voxels = voxels;
        }
    }

    fn collide_voxel_with_ground(&mut self, lane: usize, voxel: usize) {
        let (quad, masses) = self.quad(lane, voxel);
        let cell = self.constants.cell;
        let [least, greatest] = quad.bounds;
        if !(least.y <= cell && greatest.y >= 0.0) {
            return;
        }
        let Floor::Flat(width) = self.floor else { return };
        let columns = width as f64;
        let from = ((least.x / cell).floor() - 1.0).clamp(0.0, columns) as usize;
        let to = ((greatest.x / cell).floor() + 2.0).clamp(0.0, columns) as usize;
        for column in from..to {
            let ground = self.ground(column, width);
            let [left, right] = [ground.corners[0].x, ground.corners[1].x];
            if !(left <= greatest.x && least.x <= right) {
                continue;
            }
            self.collide_with_fixed(lane, &quad, &masses, &ground);
        }
    }

    /// Two voxels of one object are evaluated twice in both orders, so their forces are doubled.
    #[inline(never)]
    fn collide_with_itself(&mut self, insides: &[Inside]) {
        for inside in insides {
            for lane in self.sound_lanes(inside.lanes) {
                self.collide_point_with_itself(lane, inside);
            }
        }
    }

    fn collide_point_with_itself(&mut self, lane: usize, inside: &Inside) {
        let own = self.proximity.tiles[inside.tile].in_lane[lane];
        let part = self.occupants[lane].surface[own].part;
        let (reference, masses) = self.quad(lane, own);
        let [least, greatest] = reference.bounds;
        for n in 0..self.occupants[lane].at_mass[inside.point].len() {
            let (voxel, corner) = self.occupants[lane].at_mass[inside.point][n];
            let (main, _) = self.quad(lane, voxel);
            let [from, to] = main.bounds;
            let overlap = from.x <= greatest.x && least.x <= to.x && from.y <= greatest.y && least.y <= to.y;
            if let Some(hit) = overlap.then(|| reference.hit_by(&main, corner, &self.constants)).flatten() {
                let ends = reference.ends(hit.side).map(|corner| masses[corner]);
                let times = if self.occupants[lane].surface[voxel].part == part { 2.0 } else { 1.0 };
                self.push(lane, &hit, Some(inside.point), Some(ends), times);
            }
        }
    }

    /// The forces of a contact, multiplied: on the point F - 140 (n·w) n and friction; on each end of the side half of
    /// F and of friction in the opposite direction, and its own damping. No force acts on the ground.
    pub fn push(&mut self, lane: usize, hit: &Hit, point: Option<usize>, ends: Option<[usize; 2]>, times: f64) {
        let constants = self.constants;
        let normal = hit.normal;
        let strength = constants.contact_stiffness * (constants.contact_depth + hit.distance);
        let force = strength * normal;
        let mut friction = Vector2::zeros();
        if let Some(point) = point {
            let speed = self.true_velocity(lane, point);
            let along = Vector2::new(-normal.y, normal.x);
            let range = constants.friction_range * strength;
            friction = -constants.friction * range * libm::tanh(along.dot(&speed) / range) * along;
            let damping = constants.point_damping * normal.dot(&speed) * normal;
            self.add_load(lane, point, (force - damping + friction) * times);
        }
        for end in ends.into_iter().flatten() {
            let damping = constants.edge_damping * normal.dot(&self.true_velocity(lane, end)) * normal;
            self.add_load(lane, end, (force / 2.0 + damping + friction / 2.0) * -times);
        }
    }

    /// Adds a force in newtons to a lane's mass for this substep.
    fn add_load(&mut self, lane: usize, mass: usize, force: Vector2<f64>) {
        let scale = self.constants.per_substep_squared();
        self.loads.add(lane, mass, [force[0] * scale, force[1] * scale]);
        self.masses.now[mass].force = self.loads.of(mass);
    }

    /// The velocity over the last substep, including corrections, in meters per second (docs/physics.md 5).
    fn true_velocity(&self, lane: usize, mass: usize) -> Vector2<f64> {
        let (now, before) = (&self.masses.now[mass].at, &self.masses.before[mass]);
        let speed = |axis: usize| (now[axis].lane(lane) - before[axis].lane(lane)) / self.constants.substep;
        Vector2::new(speed(0), speed(1))
    }

    pub fn quad(&self, lane: usize, voxel: usize) -> (Quad, [usize; CORNERS]) {
        let voxel = self.occupants[lane].surface[voxel];
        let masses = &self.masses.now;
        let place = |mass: usize| Vector2::new(masses[mass].at[0].lane(lane), masses[mass].at[1].lane(lane));
        let strays = voxel.strays.map(|sides| sides.map(|ends| ends.map(place)));
        (Quad::new(voxel.corners.map(place), voxel.sides).with_strays(strays), voxel.corners)
    }

    /// Ground voxel `column`, rounded as in docs/physics.md 2.
    fn ground(&self, column: usize, width: usize) -> Quad {
        let cell = self.constants.cell;
        let (left, right) = (column as f64 * cell, (column + 1) as f64 * cell);
        let corners = [[left, cell], [right, cell], [right, 0.0], [left, 0.0]].map(|[x, y]| Vector2::new(x, y));
        let bounds = [corners[3], corners[1]];
        Quad::within(bounds, corners, [true, column + 1 == width, true, column == 0])
    }
}
