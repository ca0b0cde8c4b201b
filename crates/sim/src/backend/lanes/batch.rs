//! The kernel's workspace: several robots in lanes, laid out for the pass of `step`.
//!
//! The robots may differ. The batch has the union of their points and of their springs, keyed by position in the box. A
//! spring that a lane does not have has stiffness zero, and a point that a lane does not have is far away and
//! weightless. Both add exact zeros, so a lane gives the same results as alone.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::backend::lanes::mass::{Mass, Vector};
use crate::backend::lanes::proximity::{Inside, LowPoint, Proximity, Tile};
use crate::backend::lanes::real::{Mask, Real};
use crate::backend::lanes::stiffness::Stiffness;
use crate::constants::Constants;
use crate::lattice::{CORNERS, DrivenEdge, Edge, Lattice, LatticePoint, Voxel};
use crate::meter::{Part, Stopwatch};
use crate::state::State;

/// Height in meters of the points that a lane does not have, at rest.
const AWAY: f64 = 1000.0;

/// The goals of springs that are not driven: of main edges, of diagonals.
pub const MAIN: usize = 0;
pub const DIAGONAL: usize = 1;

/// The four springs of a voxel in its frame: top, left, falling diagonal, rising diagonal.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Its masses: top left, top right, bottom right, bottom left.
    pub corners: [u32; CORNERS],
    /// The top spring's place in [`Batch::aims`].
    pub aim: u32,
}

impl Frame {
    /// The corners as places in a list of masses.
    #[inline(always)]
    pub fn indices(&self) -> [usize; CORNERS] {
        let [a, b, c, d] = self.corners;
        [a as usize, b as usize, c as usize, d as usize]
    }
}

/// A bottom or right side without a voxel beyond it, which would have it as its top or left side.
#[derive(Clone, Copy, Debug)]
pub struct Rim {
    /// The earlier mass.
    pub from: u32,
    /// The later mass.
    pub to: u32,
    /// Its place in [`Batch::aims`].
    pub aim: u32,
}

/// The springs' places in a frame: between which corners each runs, the earlier mass first.
pub const FRAME: [[usize; 2]; 4] = [[0, 1], [0, 3], [0, 2], [1, 3]];

/// Rigid voxels whose limits are processed together: at most one in each lane, the next in reading order.
#[derive(Clone, Debug)]
pub struct Round<R: Real> {
    /// Lanes that have one.
    pub lanes: R::Mask,
    /// The voxels' masses, top left, top right, bottom right, bottom left, and their lanes.
    pub voxels: Vec<([usize; CORNERS], R::Mask)>,
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
    /// Its driven springs.
    pub driven: Vec<Driven>,
}

/// A driven spring of one lane.
#[derive(Clone, Copy, Debug)]
pub struct Driven {
    /// Its place in [`Batch::aims`].
    pub aim: usize,
    /// Built length in meters.
    pub rest: f64,
    /// The material code of its first active owner.
    pub first: u8,
    /// The code of the second, if both are active.
    pub second: Option<u8>,
}

/// A surface voxel of one lane.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceVoxel {
    /// Its masses: top left, top right, bottom right, bottom left.
    pub corners: [usize; CORNERS],
    /// Which sides are surface.
    pub sides: [bool; CORNERS],
}

/// Robots in lanes, one robot each.
#[derive(Debug)]
pub struct Batch<R: Real, K: Stiffness<R>> {
    /// The physics' numbers.
    pub constants: Constants,
    /// Ground voxels.
    pub world_width: usize,
    /// Measures the time of each part, if requested.
    pub stopwatch: Option<Stopwatch>,
    /// The masses, in order of their places row by row.
    pub masses: Vec<Mass<R>>,
    /// The position of each mass one substep ago.
    pub before: Vec<Vector<R>>,
    /// The load of each mass in all four stages: an index of `loads`.
    pub load: Vec<u32>,
    /// Gravity in the lanes that have a mass, for each set of lanes that occurs; then, in this substep, gravity and
    /// contact of each mass in contact.
    pub loads: Vec<Vector<R>>,
    /// The number of `loads` that are only gravity.
    pub weights: usize,
    /// Masses in contact, with their load before.
    pub loaded: Vec<(usize, u32)>,
    /// The frames in reading order; then an idle one, because frames are measured one ahead.
    pub frames: Vec<Frame>,
    /// The stiffness of their springs.
    pub frame_stiffness: Vec<[K; 4]>,
    /// Their springs' stiffness times frozen rest length (docs/physics.md 5).
    pub frame_frozen: Vec<[R; 4]>,
    /// The rims, in order of their masses.
    pub rims: Vec<Rim>,
    /// Their stiffness.
    pub rim_stiffness: Vec<K>,
    /// Their stiffness times frozen rest length.
    pub rim_frozen: Vec<R>,
    /// Goal lengths times the approach factor (docs/physics.md 5): of springs that are not driven, and of each driven
    /// one.
    pub aims: Vec<R>,
    /// The rows of the lattice, upper first.
    pub rows: Vec<Row>,
    /// The rigid voxels of all lanes.
    pub rigid: Vec<Round<R>>,
    /// The robots.
    pub occupants: Vec<Occupant>,
    /// The pairs that are close to each other.
    pub proximity: Proximity<R>,
    /// Lanes that went unstable, as bits.
    pub unstable: u32,
    /// Surface voxels of each lane, zero in lanes that cannot be unstable.
    pub countable: Vec<u32>,
    /// Scratch: surface masses at or below the surface of the ground.
    pub low: Vec<LowPoint>,
    /// Scratch: masses inside voxels.
    pub inside: Vec<Inside>,
    /// Scratch: voxels of one lane.
    pub voxels: Vec<usize>,
    /// Position, position one substep ago and velocity of each mass at the end of the last env step that went well.
    saved: Vec<[Vector<R>; 3]>,
}

/// One row of the lattice.
#[derive(Clone, Debug)]
pub struct Row {
    pub masses: Range<usize>,
    /// The frames whose upper masses are in it.
    pub frames: Range<usize>,
}

/// A mass's place in the box: row, column, twin.
type Key = (usize, usize, bool);

/// The key of a voxel across lanes: row and column, masses.
type TileKey = ([usize; 2], [usize; CORNERS]);

/// The key of a rim: the earlier mass and the later.
type RimKey = (usize, usize);

/// The places that a lane's edges have found.
#[derive(Clone, Copy, Debug)]
enum Spring {
    Frame(TileKey, usize),
    Rim(RimKey),
}

fn key(point: LatticePoint) -> Key {
    (point.row, point.column, point.twin)
}

impl<R: Real, K: Stiffness<R>> Batch<R, K> {
    /// Lays out robots, one a lane, over the union of their boxes.
    ///
    /// # Panics
    /// When there are more robots than lanes, or none.
    pub fn new(robots: &[(&Lattice, &State)], world_width: usize, constants: &Constants) -> Self {
        assert!((1..=R::LANES).contains(&robots.len()), "a batch has a robot for each lane at most");
        let places: BTreeSet<Key> = robots.iter().flat_map(|(body, _)| body.points().iter().map(|&p| key(p))).collect();
        let places: Vec<Key> = places.into_iter().collect();
        let numbers: BTreeMap<Key, usize> = places.iter().enumerate().map(|(mass, &key)| (key, mass)).collect();
        let masses_of = |body: &Lattice| body.points().iter().map(|&p| numbers[&key(p)]).collect::<Vec<_>>();
        let maps: Vec<Vec<usize>> = robots.iter().map(|(body, _)| masses_of(body)).collect();
        let mut batch = Self {
            constants: *constants,
            world_width,
            stopwatch: None,
            masses: places.iter().map(|&place| far_away(place, constants)).collect(),
            before: vec![[R::splat(0.0); 2]; places.len()],
            load: vec![0; places.len()],
            loads: Vec::new(),
            weights: 0,
            loaded: Vec::new(),
            frames: Vec::new(),
            frame_stiffness: Vec::new(),
            frame_frozen: Vec::new(),
            rims: Vec::new(),
            rim_stiffness: Vec::new(),
            rim_frozen: Vec::new(),
            aims: Vec::new(),
            rows: Vec::new(),
            rigid: Vec::new(),
            occupants: Vec::new(),
            proximity: Proximity::default(),
            unstable: 0,
            countable: Vec::new(),
            low: Vec::new(),
            inside: Vec::new(),
            voxels: Vec::new(),
            saved: Vec::new(),
        };
        let driven = batch.add_springs(robots, &maps, &places);
        for (((body, state), masses), driven) in robots.iter().zip(maps).zip(driven) {
            batch.add_robot(Occupant::new(body, masses, places.len(), driven), state);
        }
        batch.add_tiles(robots);
        batch.assign_weights();
        batch.save();
        batch
    }

    /// Adds the time since the last part to `part`, if time is measured.
    #[inline(always)]
    pub fn lap(&mut self, part: Part) {
        if let Some(stopwatch) = &mut self.stopwatch {
            stopwatch.lap(part, self.occupants.len());
        }
    }

    /// Puts a robot into the next lane.
    fn add_robot(&mut self, occupant: Occupant, state: &State) {
        let lane = self.occupants.len();
        for (point, &mass) in occupant.masses.iter().enumerate() {
            for axis in 0..2 {
                self.masses[mass].at[axis].set_lane(lane, state.position[point][axis]);
                self.masses[mass].velocity[axis].set_lane(lane, state.velocity[point][axis]);
                self.before[mass][axis].set_lane(lane, state.previous[point][axis]);
            }
        }
        self.countable.push(if occupant.active { occupant.surface.len() as u32 } else { 0 });
        self.occupants.push(occupant);
    }

    /// Sets the weight of each mass in the lanes that have it.
    fn assign_weights(&mut self) {
        let mut lanes = vec![0u32; self.masses.len()];
        for (lane, occupant) in self.occupants.iter().enumerate() {
            for &mass in &occupant.masses {
                lanes[mass] |= 1 << lane;
            }
        }
        let gravity = R::splat(-self.constants.gravity * self.constants.per_substep_squared());
        let kinds: BTreeSet<u32> = lanes.iter().copied().collect();
        let kinds: Vec<u32> = kinds.into_iter().collect();
        let zero = R::splat(0.0);
        let weight = |&kind: &u32| [zero, R::select(R::Mask::from_bits(kind), gravity, zero)];
        self.loads = kinds.iter().map(weight).collect();
        self.weights = kinds.len();
        for (mass, lanes) in lanes.iter().enumerate() {
            let kind = kinds.binary_search(lanes).expect("each set of lanes is listed");
            self.load[mass] = kind as u32;
            self.masses[mass].force = self.loads[kind];
        }
    }

    /// Builds the union of the robots' springs. Returns each lane's driven springs.
    fn add_springs(&mut self, robots: &[(&Lattice, &State)], maps: &[Vec<usize>], places: &[Key]) -> Vec<Vec<Driven>> {
        let lanes: Vec<Vec<Spring>> =
            robots.iter().zip(maps).map(|((body, _), masses)| springs(body, masses)).collect();
        let mut frames: BTreeMap<TileKey, [K; 4]> = BTreeMap::new();
        let mut rims: BTreeMap<RimKey, K> = BTreeMap::new();
        for (lane, ((body, _), springs)) in robots.iter().zip(&lanes).enumerate() {
            for (edge, spring) in body.edges().iter().zip(springs) {
                let stiffness = match *spring {
                    Spring::Frame(key, place) => &mut frames.entry(key).or_insert([K::none(); 4])[place],
                    Spring::Rim(key) => rims.entry(key).or_insert(K::none()),
                };
                stiffness.set_lane(lane, edge.stiffness * self.constants.per_substep_squared());
            }
        }
        self.aims = [MAIN, DIAGONAL].map(|kind| R::splat(self.constants.approach * self.rest(kind))).to_vec();
        for (&(_, corners), &stiffness) in &frames {
            self.frames.push(Frame { corners: corners.map(|mass| mass as u32), aim: MAIN as u32 });
            self.frame_stiffness.push(stiffness);
        }
        self.frame_frozen = vec![[R::splat(0.0); 4]; frames.len()];
        for (&(from, to), &stiffness) in &rims {
            self.rims.push(Rim { from: from as u32, to: to as u32, aim: MAIN as u32 });
            self.rim_stiffness.push(stiffness);
        }
        self.rim_frozen = vec![R::splat(0.0); rims.len()];
        let frames: BTreeMap<TileKey, usize> = frames.into_keys().zip(0..).collect();
        let rims: BTreeMap<RimKey, usize> = rims.into_keys().zip(0..).collect();
        let mut driven: Vec<Vec<Driven>> = Vec::with_capacity(robots.len());
        for ((body, _), springs) in robots.iter().zip(&lanes) {
            let drive = |edge: &DrivenEdge| {
                let aim = match springs[edge.edge] {
                    Spring::Frame(key, _) => &mut self.frames[frames[&key]].aim,
                    Spring::Rim(key) => &mut self.rims[rims[&key]].aim,
                };
                if *aim as usize == MAIN {
                    *aim = self.aims.len() as u32;
                    self.aims.push(self.aims[MAIN]);
                }
                let rest = body.edges()[edge.edge].rest;
                Driven { aim: *aim as usize, rest, first: edge.first, second: edge.second }
            };
            driven.push(body.driven().iter().map(drive).collect());
        }
        self.index_rows(places);
        driven
    }

    /// Built length of a kind of spring in meters.
    pub fn rest(&self, kind: usize) -> f64 {
        let cell = self.constants.cell;
        if kind == MAIN { cell } else { (cell * cell + cell * cell).sqrt() }
    }

    /// Sets the masses and frames of each row.
    fn index_rows(&mut self, places: &[Key]) {
        let (mut mass, mut frame) = (0, 0);
        while mass < places.len() {
            let row = places[mass].0;
            let masses = mass..places.partition_point(|place| place.0 <= row);
            let frames = frame..self.frames.partition_point(|frame| (frame.corners[0] as usize) < masses.end);
            (mass, frame) = (masses.end, frames.end);
            self.rows.push(Row { masses, frames });
        }
        self.frames.push(self.frames[0]);
    }

    /// Takes a lane's state out.
    pub fn unload(&self, lane: usize, state: &mut State) {
        for (point, &mass) in self.occupants[lane].masses.iter().enumerate() {
            let (mass, before) = (&self.masses[mass], &self.before[mass]);
            state.position[point] = mass.at.map(|axis| axis.lane(lane));
            state.previous[point] = before.map(|axis| axis.lane(lane));
            state.velocity[point] = mass.velocity.map(|axis| axis.lane(lane));
        }
    }

    /// Reads a lane's state at the last call of [`Batch::save`].
    pub fn unload_saved(&self, lane: usize, state: &mut State) {
        for (point, &mass) in self.occupants[lane].masses.iter().enumerate() {
            let [at, before, velocity] = self.saved[mass].map(|vector| vector.map(|axis| axis.lane(lane)));
            (state.position[point], state.previous[point], state.velocity[point]) = (at, before, velocity);
        }
    }

    /// Saves all states, in case the next env step has to be undone.
    pub fn save(&mut self) {
        self.saved.clear();
        self.saved.extend(self.masses.iter().zip(&self.before).map(|(mass, &before)| [mass.at, before, mass.velocity]));
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

    /// Sets the targets of a lane's materials: `targets[code]` is a fraction of the rest width (docs/physics.md 4).
    pub fn set_targets(&mut self, lane: usize, targets: &[f64]) {
        for driven in &self.occupants[lane].driven {
            let first = targets[usize::from(driven.first)];
            let goal = match driven.second {
                Some(second) => (first + targets[usize::from(second)]) * (driven.rest / 2.0),
                None => first * driven.rest,
            };
            self.aims[driven.aim].set_lane(lane, self.constants.approach * goal);
        }
    }

    fn add_tiles(&mut self, robots: &[(&Lattice, &State)]) {
        let mut surface: BTreeMap<TileKey, u32> = BTreeMap::new();
        let mut rigid: Vec<BTreeMap<TileKey, u32>> = Vec::new();
        for (lane, (body, _)) in robots.iter().enumerate() {
            let key = |voxel: &Voxel| {
                let corners = voxel.corners.map(|point| self.occupants[lane].masses[point]);
                ([voxel.row, voxel.column], corners)
            };
            for voxel in body.voxels().iter().filter(|voxel| voxel.is_surface()) {
                *surface.entry(key(voxel)).or_default() |= 1 << lane;
            }
            let own: BTreeSet<TileKey> = body.voxels().iter().filter(|voxel| voxel.rigid).map(key).collect();
            rigid.resize(rigid.len().max(own.len()), BTreeMap::new());
            for (key, round) in own.into_iter().zip(&mut rigid) {
                *round.entry(key).or_default() |= 1 << lane;
            }
        }
        self.rigid = rigid.iter().map(Round::new).collect();
        let tiles = surface.into_iter().map(|((cell, corners), surface)| Tile { cell, corners, surface });
        self.proximity = Proximity::new(tiles.collect());
    }
}

impl<R: Real> Round<R> {
    fn new(voxels: &BTreeMap<TileKey, u32>) -> Self {
        let lanes = voxels.values().fold(0, |all, lanes| all | lanes);
        let voxel = |(&(_, corners), &lanes): (&TileKey, &u32)| (corners, R::Mask::from_bits(lanes));
        Self { lanes: R::Mask::from_bits(lanes), voxels: voxels.iter().map(voxel).collect() }
    }
}

/// The place of each edge of a robot: in the frame of the voxel that has it as top, left or diagonal, or among the
/// rims.
fn springs(body: &Lattice, masses: &[usize]) -> Vec<Spring> {
    let mut found: BTreeMap<RimKey, Spring> = BTreeMap::new();
    for voxel in body.voxels() {
        let corners = voxel.corners.map(|point| masses[point]);
        for (place, [a, b]) in FRAME.into_iter().enumerate() {
            let spring = Spring::Frame(([voxel.row, voxel.column], corners), place);
            found.insert((corners[a], corners[b]), spring);
        }
    }
    let spring = |edge: &Edge| {
        let (a, b) = (masses[edge.a], masses[edge.b]);
        let ends = (a.min(b), a.max(b));
        found.get(&ends).copied().unwrap_or(Spring::Rim(ends))
    };
    body.edges().iter().map(spring).collect()
}

impl Occupant {
    fn new(body: &Lattice, masses: Vec<usize>, count: usize, driven: Vec<Driven>) -> Self {
        let mut at_mass = vec![Vec::new(); count];
        let mut surface = Vec::new();
        for voxel in body.voxels().iter().filter(|voxel| voxel.is_surface()) {
            let corners = voxel.corners.map(|point| masses[point]);
            for (corner, &mass) in corners.iter().enumerate() {
                at_mass[mass].push((surface.len(), corner));
            }
            surface.push(SurfaceVoxel { corners, sides: voxel.surface });
        }
        Self { masses, surface, at_mass, active: body.is_active(), driven }
    }
}

/// The position of a mass that no robot has.
fn far_away<R: Real>((row, column, _): Key, constants: &Constants) -> Mass<R> {
    let zero = [R::splat(0.0); 2];
    let at = [R::splat(column as f64 * constants.cell), R::splat(AWAY - row as f64 * constants.cell)];
    Mass { at, velocity: zero, stage: zero, stage_velocity: zero, sum: zero, force: zero }
}
