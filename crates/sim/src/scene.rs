//! Scenes: robots, objects and terrain in one world, as in Evolution Gym (docs/physics.md 16).

use std::ops::Range;
use std::sync::Arc;

use crate::constants::Constants;
use crate::grid::Grid;
use crate::lattice::{CORNERS, Lattice, corner};
use crate::state::State;
use crate::terrain::Terrain;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneObject {
    pub grid: Grid,
    /// The column and the row of its lower left corner, in voxels from the lower left corner of the world.
    pub at: [usize; 2],
}

/// Objects that may touch each other. Those of fixed voxels only are terrain, the others move.
#[derive(Clone, Debug)]
pub struct Scene {
    pub(crate) lattice: Arc<Lattice>,
    pub(crate) terrain: Arc<Terrain>,
    pub(crate) start: State,
    objects: Vec<Placed>,
}

#[derive(Clone, Debug)]
enum Placed {
    Moving { points: Range<usize>, channels: Range<usize> },
    Still(Still),
}

#[derive(Clone, Debug)]
struct Still {
    /// In meters, in order of creation.
    points: Vec<[f64; 2]>,
    /// The same in voxels, from left to right.
    by_column: Vec<[f64; 2]>,
    voxels: Vec<[usize; CORNERS]>,
}

/// Evolution Gym's constants: π, the cosine that it uses instead of values above 1, and the product of two distances
/// from the center of mass, in square meters, below which it uses that cosine, too.
#[allow(clippy::approx_constant, reason = "Evolution Gym's number")]
const PI: f64 = 3.1415926;
const ALMOST: f64 = 0.99999;
const NEAR: f64 = 1e-7;

/// Sums are rounded as Evolution Gym's, because a cosine of exactly 1 is taken as it is.
fn arms(points: &[[f64; 2]]) -> Vec<([f64; 2], f64)> {
    let mean = |axis: usize| {
        let values: Vec<f64> = points.iter().map(|at| at[axis]).collect();
        let (first, rest) = values.split_first().expect("an object has points");
        let fours = rest.chunks_exact(4);
        let single: &[f64] = fours.remainder();
        let sum = fours.fold(*first, |sum, of| sum + ((of[0] + of[1]) + (of[2] + of[3])));
        single.iter().fold(sum, |sum, value| sum + value) / values.len() as f64
    };
    let center = [mean(0), mean(1)];
    let arm = |at: &[f64; 2]| {
        let [x, y] = [at[0] - center[0], at[1] - center[1]];
        let length = (x * x + y * y).sqrt();
        (if length > 0.0 { [x / length, y / length] } else { [x, y] }, length)
    };
    points.iter().map(arm).collect()
}

impl Scene {
    /// In sums, objects without actuators come before robots, each kind in order. Panics when no object moves.
    pub fn new(objects: &[SceneObject], constants: &Constants) -> Self {
        let (still, mut moving): (Vec<usize>, Vec<usize>) =
            (0..objects.len()).partition(|&n| objects[n].grid.is_fixed());
        assert!(!moving.is_empty(), "a scene has something that moves");
        // Robots last, so that scenes with different robots agree in the places of all else.
        moving.sort_by_key(|&n| objects[n].grid.is_active());
        let grids: Vec<&Grid> = moving.iter().map(|&n| &objects[n].grid).collect();
        let lattice = Lattice::of(&grids, constants);
        let place = |point: usize| {
            let at = lattice.points()[point];
            let part = lattice.part_of(at.row);
            let object = &objects[moving[part]];
            let origin = object.at.map(|axis| axis as f64);
            corner(origin, object.grid.height(), at.column, at.row - lattice.parts[part].top, constants)
        };
        let position: Vec<[f64; 2]> = (0..lattice.points().len()).map(place).collect();
        let start = State { previous: position.clone(), velocity: vec![[0.0; 2]; position.len()], position };
        let (mut point, mut channel) = (0, 0);
        let mut placed: Vec<Option<Placed>> = vec![None; objects.len()];
        for (part, &n) in moving.iter().enumerate() {
            let of_part = |at: &usize| lattice.part_of(lattice.points()[*at].row) == part;
            let points = point..point + (point..lattice.points().len()).take_while(of_part).count();
            let channels = channel..channel + objects[n].grid.channels();
            (point, channel) = (points.end, channels.end);
            placed[n] = Some(Placed::Moving { points, channels });
        }
        for &n in &still {
            let SceneObject { grid, at } = &objects[n];
            let own = Lattice::of(&[grid], constants);
            let origin = at.map(|axis| axis as f64);
            let points = own.points().iter().map(|p| corner(origin, grid.height(), p.column, p.row, constants));
            let points: Vec<[f64; 2]> = points.collect();
            let mut by_column: Vec<[f64; 2]> = points.iter().map(|at| at.map(|axis| axis / constants.cell)).collect();
            by_column.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let voxels = own.voxels().iter().map(|voxel| voxel.corners).collect();
            placed[n] = Some(Placed::Still(Still { points, by_column, voxels }));
        }
        let terrain = Terrain::new(still.iter().map(|&n| (&objects[n].grid, objects[n].at)), constants);
        let objects = placed.into_iter().map(|place| place.expect("each object moves or is still")).collect();
        Self { lattice: Arc::new(lattice), terrain: Arc::new(terrain), start, objects }
    }

    pub fn objects(&self) -> usize {
        self.objects.len()
    }

    /// The places in the targets of a scene that belong to an object's actuators, in reading order.
    pub fn channels(&self, object: usize) -> Range<usize> {
        match &self.objects[object] {
            Placed::Moving { channels, .. } => channels.clone(),
            Placed::Still(_) => 0..0,
        }
    }

    pub fn targets(&self) -> usize {
        (0..self.objects()).map(|object| self.channels(object).end).max().unwrap_or(0)
    }

    /// In voxels, in order of creation (docs/physics.md 2).
    pub fn positions(&self, object: usize, state: &State, constants: &Constants) -> Vec<[f64; 2]> {
        let meters = match &self.objects[object] {
            Placed::Moving { points, .. } => &state.position[points.clone()],
            Placed::Still(still) => &still.points,
        };
        meters.iter().map(|at| at.map(|axis| axis / constants.cell)).collect()
    }

    /// The velocities of an object's points, in voxels per second, as the integrator has them (docs/physics.md 5).
    pub fn velocities(&self, object: usize, state: &State, constants: &Constants) -> Vec<[f64; 2]> {
        match &self.objects[object] {
            Placed::Moving { points, .. } => {
                let speed = |axis: f64| axis / constants.substep / constants.cell;
                state.velocity[points.clone()].iter().map(|velocity| velocity.map(speed)).collect()
            }
            Placed::Still(still) => vec![[0.0; 2]; still.points.len()],
        }
    }

    /// The points of an object that never moves, in voxels, from left to right.
    pub(crate) fn still_by_column(&self, object: usize) -> Option<&[[f64; 2]]> {
        match &self.objects[object] {
            Placed::Moving { .. } => None,
            Placed::Still(still) => Some(&still.by_column),
        }
    }

    /// Evolution Gym's estimate since the start, in radians from 0 to 2π, counterclockwise (docs/physics.md 16).
    pub fn turn(&self, object: usize, state: &State) -> f64 {
        let Placed::Moving { points, .. } = &self.objects[object] else { return 0.0 };
        let [now, start] = [state, &self.start].map(|state| arms(&state.position[points.clone()]));
        let (mut angles, mut weights, mut cross) = (0.0, 0.0, 0.0);
        for (&(to_now, length), &(to_start, weight)) in now.iter().zip(&start) {
            let cosine = to_now[0] * to_start[0] + to_now[1] * to_start[1];
            let is_near = length * weight < NEAR;
            let cosine = if is_near || cosine > 1.0 { ALMOST } else { cosine.max(-ALMOST) };
            angles += libm::acos(cosine) * weight;
            weights += weight;
            cross += to_now[0] * to_start[1] - to_now[1] * to_start[0];
        }
        let angle = angles / weights;
        if cross > 0.0 { 2.0 * PI - angle } else { angle }
    }

    /// Places in the object's positions: top left, top right, bottom right, bottom left.
    pub fn voxels(&self, object: usize) -> Vec<[usize; CORNERS]> {
        match &self.objects[object] {
            Placed::Moving { points, .. } => {
                let own = self.lattice.voxels().iter().filter(|voxel| points.contains(&voxel.corners[0]));
                own.map(|voxel| voxel.corners.map(|point| point - points.start)).collect()
            }
            Placed::Still(still) => still.voxels.clone(),
        }
    }

    /// The parts that must agree in scenes whose robots share the lanes of a kernel: their first rows.
    pub(crate) fn tops(&self) -> Vec<usize> {
        self.lattice.parts.iter().map(|part| part.top).collect()
    }
}
