//! The kernel's workspace: several robots of one box side by side, laid out for the sweep of `step`.
//!
//! The robots may differ. The batch holds the union of their points and of their springs, keyed by places in the box; a spring that a
//! lane has not is one of stiffness zero, and a point that a lane has not lies far away, weightless. Both add exact zeros, so a lane
//! computes what it would compute alone.

use std::collections::{BTreeMap, BTreeSet};

use crate::sim::constants::Constants;
use crate::sim::lattice::{CORNERS, Lattice, LatticePoint};
use crate::sim::proximity::{Inside, Proximity};
use crate::sim::real::{Mask, Real};
use crate::sim::state::State;

/// Where a lane keeps the points it has not: so many metres up.
const AWAY: f64 = 1000.0;

/// A point's coordinates in every lane.
pub type Place<R> = [R; 2];

/// A point mass. Time is counted in substeps: velocities are metres a substep, forces metres a substep squared.
#[derive(Clone, Copy, Debug)]
pub struct Mass<R> {
    /// Position at the start of the substep.
    pub at: Place<R>,
    /// Position at the start of the substep before.
    pub before: Place<R>,
    /// Velocity of the integrator.
    pub velocity: Place<R>,
    /// Position in the current Runge-Kutta stage.
    pub stage: Place<R>,
    /// Velocity in the current Runge-Kutta stage.
    pub pace: Place<R>,
    /// Sum of stage velocities so far.
    pub sum: Place<R>,
    /// Force so far in the current stage.
    pub force: Place<R>,
    /// What acts in all four stages: gravity and contact.
    pub load: Place<R>,
    /// Correction by the length limits so far.
    pub shift: Place<R>,
}

/// A spring from the mass that owns it to a later one.
#[derive(Clone, Copy, Debug)]
pub struct Spring<R> {
    /// The other end.
    pub to: u32,
    /// Built length in metres.
    pub rest: f64,
    /// Stiffness; zero in lanes without this spring.
    pub stiffness: R,
    /// Stiffness times approach times goal length: the goal's part of the frozen rest length (docs/physics.md 5).
    pub goal: R,
    /// Stiffness times frozen rest length.
    pub frozen: R,
}

/// A voxel of any lane.
#[derive(Clone, Debug)]
pub struct Tile<R: Real> {
    /// Row and column.
    pub cell: [usize; 2],
    /// Its masses: top left, top right, bottom right, bottom left.
    pub corners: [usize; CORNERS],
    /// Lanes that have it on their surface, as bits.
    pub surface: u32,
    /// Lanes that have it of rigid material.
    pub rigid: R::Mask,
}

/// One lane's robot.
#[derive(Clone, Debug)]
pub struct Occupant {
    /// The mass of each of its points.
    pub masses: Vec<usize>,
    /// Its surface voxels in reading order, with corners as masses.
    pub surface: Vec<SurfaceVoxel>,
    /// Indexed by mass: its surface voxels at that mass, as (place in `surface`, corner).
    pub at_mass: Vec<Vec<(usize, usize)>>,
    /// Whether it can be unstable.
    pub active: bool,
    /// Its driven edges: the spring and the codes of one or two owners.
    pub driven: Vec<(usize, u8, Option<u8>)>,
}

/// A surface voxel of one lane.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceVoxel {
    /// Its masses: top left, top right, bottom right, bottom left.
    pub corners: [usize; CORNERS],
    /// Which sides are surface.
    pub sides: [bool; CORNERS],
}

/// Robots side by side, one a lane.
#[derive(Clone, Debug)]
pub struct Batch<R: Real> {
    /// The physics' numbers.
    pub constants: Constants,
    /// Ground voxels.
    pub world_width: usize,
    /// The masses, in order of their places row by row.
    pub masses: Vec<Mass<R>>,
    /// Gravity on each mass: zero in lanes that have it not.
    pub weight: Vec<R>,
    /// The springs, in order of their owners.
    pub springs: Vec<Spring<R>>,
    /// Where each mass's springs begin in `springs`; one more than there are masses.
    pub first: Vec<usize>,
    /// The tiles with rigid material in some lane.
    pub rigid: Vec<Tile<R>>,
    /// The robots.
    pub occupants: Vec<Occupant>,
    /// What is near what.
    pub proximity: Proximity<R>,
    /// Masses whose load is more than their weight.
    pub loaded: Vec<usize>,
    /// Lanes that went unstable, as bits.
    pub unstable: u32,
    /// Surface voxels of each lane, zero in lanes that cannot be unstable.
    pub countable: Vec<u32>,
    /// Scratch: masses that are not above the ground's face, with their lanes.
    pub low: Vec<(usize, u32)>,
    /// Scratch: masses inside voxels.
    pub inside: Vec<Inside>,
    /// Scratch: voxels of one lane.
    pub voxels: Vec<usize>,
    /// Positions at the end of the last env step that went well.
    saved: Vec<Place<R>>,
}

/// A mass's place in the box: row, column, twin.
type Key = (usize, usize, bool);

fn key(point: LatticePoint) -> Key {
    (point.row, point.column, point.twin)
}

impl<R: Real> Batch<R> {
    /// Lays out robots of one box, one a lane.
    ///
    /// # Panics
    /// When there are more robots than lanes, or none.
    pub fn new(robots: &[(&Lattice, &State)], world_width: usize, constants: &Constants) -> Self {
        assert!((1..=R::LANES).contains(&robots.len()), "a batch has a robot for each lane at most");
        let places: BTreeSet<Key> = robots.iter().flat_map(|(body, _)| body.points().iter().map(|&p| key(p))).collect();
        let numbers: BTreeMap<Key, usize> = places.iter().enumerate().map(|(mass, &key)| (key, mass)).collect();
        let masses_of = |body: &Lattice| body.points().iter().map(|&p| numbers[&key(p)]).collect::<Vec<_>>();
        let maps: Vec<Vec<usize>> = robots.iter().map(|(body, _)| masses_of(body)).collect();
        let (springs, first, numbers_of) = lay_springs::<R>(robots, &maps, places.len(), constants);
        let occupants = robots
            .iter()
            .zip(maps)
            .enumerate()
            .map(|(lane, ((body, _), masses))| Occupant::new(body, masses, places.len(), &numbers_of[lane]))
            .collect();
        let mut batch = Self {
            constants: *constants,
            world_width,
            masses: scatter(&places, constants),
            weight: vec![R::splat(0.0); places.len()],
            springs,
            first,
            rigid: Vec::new(),
            occupants,
            proximity: Proximity::default(),
            loaded: Vec::new(),
            unstable: 0,
            countable: Vec::new(),
            low: Vec::new(),
            inside: Vec::new(),
            voxels: Vec::new(),
            saved: Vec::new(),
        };
        batch.lay_tiles(robots);
        for (lane, (_, state)) in robots.iter().enumerate() {
            batch.load(lane, state);
        }
        let countable = |occupant: &Occupant| if occupant.active { occupant.surface.len() as u32 } else { 0 };
        batch.countable = batch.occupants.iter().map(countable).collect();
        batch.save();
        batch
    }

    /// Puts a robot's state into a lane.
    fn load(&mut self, lane: usize, state: &State) {
        let gravity = -self.constants.gravity * self.constants.per_substep_squared();
        for (point, &mass) in self.occupants[lane].masses.iter().enumerate() {
            self.weight[mass].set_lane(lane, gravity);
            let mass = &mut self.masses[mass];
            for axis in 0..2 {
                mass.at[axis].set_lane(lane, state.position[point][axis]);
                mass.before[axis].set_lane(lane, state.previous[point][axis]);
                mass.velocity[axis].set_lane(lane, state.velocity[point][axis]);
            }
            mass.load[1].set_lane(lane, gravity);
            mass.force[1].set_lane(lane, gravity);
        }
    }

    /// Takes a lane's state out.
    pub fn unload(&self, lane: usize, state: &mut State) {
        for (point, &mass) in self.occupants[lane].masses.iter().enumerate() {
            let mass = &self.masses[mass];
            state.position[point] = mass.at.map(|axis| axis.lane(lane));
            state.previous[point] = mass.before.map(|axis| axis.lane(lane));
            state.velocity[point] = mass.velocity.map(|axis| axis.lane(lane));
        }
    }

    /// Takes out where a lane's points were at the last call of [`Batch::save`].
    pub fn unload_saved(&self, lane: usize, state: &mut State) {
        for (point, &mass) in self.occupants[lane].masses.iter().enumerate() {
            state.position[point] = self.saved[mass].map(|axis| axis.lane(lane));
        }
    }

    /// Remembers where everything is, in case the next env step has to be abandoned.
    pub fn save(&mut self) {
        self.saved.clear();
        self.saved.extend(self.masses.iter().map(|mass| mass.at));
    }

    /// The center of mass of a lane's robot, in voxels: the plain mean over its points in order of creation.
    pub fn center(&self, lane: usize) -> [f64; 2] {
        let masses = &self.occupants[lane].masses;
        let mean = |axis: usize| {
            let sum: f64 = masses.iter().map(|&mass| self.masses[mass].at[axis].lane(lane)).sum();
            sum / masses.len() as f64 / self.constants.cell
        };
        [mean(0), mean(1)]
    }

    /// Sets what a lane's materials ask for: `targets[code]` as a share of the width at rest (docs/physics.md 4).
    pub fn set_targets(&mut self, lane: usize, targets: &[f64]) {
        for &(spring, first, second) in &self.occupants[lane].driven {
            let spring = &mut self.springs[spring];
            let first = targets[usize::from(first)];
            let goal = match second {
                Some(second) => (first + targets[usize::from(second)]) * (spring.rest / 2.0),
                None => first * spring.rest,
            };
            let pull = spring.stiffness.lane(lane) * self.constants.approach;
            spring.goal.set_lane(lane, pull * goal);
        }
    }

    fn lay_tiles(&mut self, robots: &[(&Lattice, &State)]) {
        let mut tiles: BTreeMap<([usize; 2], [usize; CORNERS]), (u32, u32)> = BTreeMap::new();
        for (lane, (body, _)) in robots.iter().enumerate() {
            for voxel in body.voxels() {
                let corners = voxel.corners.map(|point| self.occupants[lane].masses[point]);
                let (surface, rigid) = tiles.entry(([voxel.row, voxel.column], corners)).or_default();
                *surface |= u32::from(voxel.is_surface()) << lane;
                *rigid |= u32::from(voxel.rigid) << lane;
            }
        }
        let mut surface_tiles = Vec::new();
        for ((cell, corners), (surface, rigid)) in tiles {
            let tile = Tile { cell, corners, surface, rigid: R::Mask::from_bits(rigid) };
            if rigid != 0 {
                self.rigid.push(tile.clone());
            }
            if surface != 0 {
                surface_tiles.push(tile);
            }
        }
        self.proximity = Proximity::new(surface_tiles);
    }
}

impl Occupant {
    fn new(body: &Lattice, masses: Vec<usize>, count: usize, springs: &[usize]) -> Self {
        let mut at_mass = vec![Vec::new(); count];
        let mut surface = Vec::new();
        for voxel in body.voxels().iter().filter(|voxel| voxel.is_surface()) {
            let corners = voxel.corners.map(|point| masses[point]);
            for (corner, &mass) in corners.iter().enumerate() {
                at_mass[mass].push((surface.len(), corner));
            }
            surface.push(SurfaceVoxel { corners, sides: voxel.surface });
        }
        let driven = body.driven().iter().map(|edge| (springs[edge.edge], edge.first, edge.second)).collect();
        Self { masses, surface, at_mass, active: body.is_active(), driven }
    }
}

/// All masses at rest where no robot has them, pairwise apart.
fn scatter<R: Real>(places: &BTreeSet<Key>, constants: &Constants) -> Vec<Mass<R>> {
    let zero = [R::splat(0.0); 2];
    let away = |&(row, column, twin): &Key| {
        let x = (2 * column + usize::from(twin)) as f64 * constants.cell;
        let at = [R::splat(x), R::splat(AWAY - row as f64 * constants.cell)];
        Mass { at, before: at, velocity: zero, stage: at, pace: zero, sum: zero, force: zero, load: zero, shift: zero }
    };
    places.iter().map(away).collect()
}

/// The union of the robots' springs, where each mass's springs begin, and for each lane the spring of each of its edges.
fn lay_springs<R: Real>(
    robots: &[(&Lattice, &State)],
    maps: &[Vec<usize>],
    masses: usize,
    constants: &Constants,
) -> (Vec<Spring<R>>, Vec<usize>, Vec<Vec<usize>>) {
    let ends = |lane: usize, a: usize, b: usize| {
        let (a, b) = (maps[lane][a], maps[lane][b]);
        (a.min(b), a.max(b))
    };
    let mut union: BTreeMap<(usize, usize), Spring<R>> = BTreeMap::new();
    let zero = R::splat(0.0);
    for (lane, (body, _)) in robots.iter().enumerate() {
        for edge in body.edges() {
            let ends = ends(lane, edge.a, edge.b);
            let fresh = Spring { to: ends.1 as u32, rest: edge.rest, stiffness: zero, goal: zero, frozen: zero };
            let spring = union.entry(ends).or_insert(fresh);
            let stiffness = edge.stiffness * constants.per_substep_squared();
            spring.stiffness.set_lane(lane, stiffness);
            spring.goal.set_lane(lane, stiffness * constants.approach * edge.rest);
        }
    }
    let numbers: BTreeMap<(usize, usize), usize> = union.keys().enumerate().map(|(n, &ends)| (ends, n)).collect();
    let spring_of = |(lane, (body, _)): (usize, &(&Lattice, &State))| {
        body.edges().iter().map(|edge| numbers[&ends(lane, edge.a, edge.b)]).collect()
    };
    let springs_of = robots.iter().enumerate().map(spring_of).collect();
    let mut first = vec![0; masses + 1];
    for &(owner, _) in union.keys() {
        first[owner + 1] += 1;
    }
    for mass in 0..masses {
        first[mass + 1] += first[mass];
    }
    (union.into_values().collect(), first, springs_of)
}
