//! The kernel's workspace: several robots in lanes, laid out for the pass of `step`.
//!
//! The robots may differ. The batch has the union of their points and of their springs, keyed by position in the box. A
//! spring that a lane does not have has stiffness zero, and a point that a lane does not have is far away and
//! weightless. Both add exact zeros, so a lane gives the same results as alone.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

use crate::backend::lanes::loads::Loads;
use crate::backend::lanes::mass::Masses;
use crate::backend::lanes::proximity::{Inside, LowPoint, NearTerrain, Proximity, Tile};
use crate::backend::lanes::real::{Mask, Real};
use crate::backend::lanes::springs::{Driven, Frame, Springs, TileKey};
use crate::backend::lanes::stiffness::Stiffness;
use crate::constants::Constants;
use crate::lattice::{CORNERS, Lattice, LatticePoint, Voxel};
use crate::meter::{Meter, Stopwatch};
use crate::state::State;
use crate::terrain::Terrain;

/// Height in meters of the points that a lane does not have, at rest.
const AWAY: f64 = 1000.0;

/// Rigid voxels whose limits are processed together: at most one in each lane, the next in reading order.
#[derive(Clone, Debug)]
pub struct Round<R: Real> {
    pub lanes: R::Mask,
    /// The voxels' masses, top left, top right, bottom right, bottom left, and their lanes.
    pub voxels: Vec<([usize; CORNERS], R::Mask)>,
    pub strays: Option<Vec<(VoxelSides, R::Mask)>>,
}

/// The masses at the ends of the sides of a voxel: top, right, bottom, left.
pub type VoxelSides = [[usize; 2]; CORNERS];

#[derive(Clone, Debug)]
pub struct Occupant {
    pub masses: Vec<usize>,
    /// Its surface voxels in reading order, with corners as masses.
    pub surface: Vec<SurfaceVoxel>,
    /// Indexed by mass: its surface voxels at that mass, as (place in `surface`, corner).
    pub at_mass: Vec<Vec<(usize, usize)>>,
    /// The number of surface voxels of each of its parts, or zero for a part that cannot be unstable.
    pub countable: Vec<u32>,
    pub driven: Vec<Driven>,
}

#[derive(Clone, Copy, Debug)]
pub struct SurfaceVoxel {
    pub corners: [usize; CORNERS],
    pub sides: [bool; CORNERS],
    pub strays: Option<[[usize; 2]; 2]>,
    pub part: usize,
}

#[derive(Debug)]
pub struct Batch<R: Real, K: Stiffness<R>> {
    pub step: fn(&mut Self),
    pub constants: Constants,
    pub floor: Floor,
    pub stopwatch: Option<Stopwatch>,
    pub masses: Masses<R>,
    pub loads: Loads<R>,
    pub springs: Springs<R, K>,
    /// The rows of the lattice, upper first.
    pub rows: Vec<Row>,
    pub rigid: Vec<Round<R>>,
    pub fixed: Vec<(usize, R::Mask)>,
    pub occupants: Vec<Occupant>,
    pub proximity: Proximity<R>,
    /// Lanes that went unstable, as bits.
    pub unstable: u32,
    pub touching: Touching,
}

#[derive(Clone, Copy)]
pub struct Ground<'a> {
    pub constants: &'a Constants,
    pub floor: &'a Floor,
    pub meter: Option<&'a Arc<Meter>>,
}

#[derive(Clone, Debug)]
pub enum Floor {
    Flat(usize),
    Terrain(Arc<Terrain>),
}

/// Kept between substeps for its memory only.
#[derive(Debug, Default)]
pub struct Touching {
    pub low: Vec<LowPoint>,
    /// Surface voxels close to voxels of the terrain, by tile and then by voxel of the terrain.
    pub near: Vec<NearTerrain>,
    pub inside: Vec<Inside>,
    pub voxels: Vec<usize>,
}

#[derive(Clone, Debug)]
pub struct Row {
    pub masses: Range<usize>,
    pub frames: Range<usize>,
}

/// A mass's place in the box: row, column, copy.
type Key = (usize, usize, u8);

fn key(point: LatticePoint) -> Key {
    (point.row, point.column, point.copy)
}

impl<R: Real, K: Stiffness<R>> Batch<R, K> {
    pub fn new(robots: &[(&Lattice, &State)], ground: Ground<'_>, step: fn(&mut Self)) -> Self {
        let Ground { constants, floor, meter } = ground;
        let stopwatch = meter.map(Stopwatch::new);
        assert!((1..=R::LANES).contains(&robots.len()), "a batch has a robot for each lane at most");
        let (bodies, states): (Vec<&Lattice>, Vec<&State>) = robots.iter().copied().unzip();
        let places: BTreeSet<Key> = bodies.iter().flat_map(|body| body.points().iter().map(|&p| key(p))).collect();
        let places: Vec<Key> = places.into_iter().collect();
        let numbers: BTreeMap<Key, usize> = places.iter().enumerate().map(|(mass, &key)| (key, mass)).collect();
        let masses_of = |body: &&Lattice| body.points().iter().map(|&p| numbers[&key(p)]).collect::<Vec<_>>();
        let maps: Vec<Vec<usize>> = bodies.iter().map(masses_of).collect();
        let far_away = |&(row, column, _): &Key| [column as f64 * constants.cell, AWAY - row as f64 * constants.cell];
        let mut masses = Masses::new(places.iter().map(far_away));
        let mut lanes = vec![0u32; places.len()];
        for (lane, (map, state)) in maps.iter().zip(states).enumerate() {
            masses.load(lane, map, state);
            map.iter().for_each(|&mass| lanes[mass] |= 1 << lane);
        }
        masses.save();
        let loads = Loads::new(&lanes, constants.gravity * constants.per_substep_squared());
        masses.now.iter_mut().enumerate().for_each(|(n, mass)| mass.force = loads.of(n));
        let (springs, driven) = Springs::new(&bodies, &maps, constants);
        let robots = bodies.iter().zip(maps).zip(driven);
        let occupants: Vec<Occupant> =
            robots.map(|((body, masses), driven)| Occupant::new(body, masses, places.len(), driven)).collect();
        let fixed = fixed(&bodies, &occupants);
        let countable = occupants.iter().map(|occupant| occupant.countable.clone()).collect();
        Self {
            step,
            constants: *constants,
            floor: floor.clone(),
            stopwatch,
            masses,
            loads,
            rows: rows(&places, &springs.frames[..springs.frame_stiffness.len()]),
            springs,
            rigid: rigid(&bodies, &occupants),
            fixed,
            proximity: Proximity::new(tiles(&bodies, &occupants), countable),
            occupants,
            unstable: 0,
            touching: Touching::default(),
        }
    }

    /// Puts the masses that never move back to where they were at the start of the substep.
    #[inline(always)]
    pub fn hold_fixed(&mut self) {
        for &(mass, lanes) in &self.fixed {
            let (before, mass) = (&self.masses.before[mass], &mut self.masses.now[mass]);
            for axis in 0..2 {
                mass.at[axis] = R::select(lanes, before[axis], mass.at[axis]);
                mass.velocity[axis] = R::select(lanes, R::splat(0.0), mass.velocity[axis]);
            }
        }
    }
}

fn rows(places: &[Key], frames: &[Frame]) -> Vec<Row> {
    let (mut mass, mut frame) = (0, 0);
    let mut rows = Vec::new();
    while mass < places.len() {
        let row = places[mass].0;
        let masses = mass..places.partition_point(|place| place.0 <= row);
        let frames = frame..frames.partition_point(|frame| (frame.corners[0] as usize) < masses.end);
        (mass, frame) = (masses.end, frames.end);
        rows.push(Row { masses, frames });
    }
    rows
}

fn tile_key(voxel: &Voxel, occupant: &Occupant) -> TileKey {
    ([voxel.row, voxel.column], voxel.corners.map(|point| occupant.masses[point]))
}

fn tiles(bodies: &[&Lattice], occupants: &[Occupant]) -> Vec<Tile> {
    let mut tiles: BTreeMap<TileKey, Tile> = BTreeMap::new();
    for (lane, (body, occupant)) in bodies.iter().zip(occupants).enumerate() {
        let surface = body.voxels().iter().filter(|voxel| voxel.is_surface());
        for (n, voxel) in surface.enumerate() {
            let (cell, corners) = tile_key(voxel, occupant);
            let new = || Tile { cell, corners, part: voxel.part, surface: 0, in_lane: vec![0; bodies.len()] };
            let tile = tiles.entry((cell, corners)).or_insert_with(new);
            tile.surface |= 1 << lane;
            tile.in_lane[lane] = n;
        }
    }
    tiles.into_values().collect()
}

fn fixed<M: Mask>(bodies: &[&Lattice], occupants: &[Occupant]) -> Vec<(usize, M)> {
    let mut fixed: BTreeMap<usize, u32> = BTreeMap::new();
    for (lane, (body, occupant)) in bodies.iter().zip(occupants).enumerate() {
        for &point in &body.fixed {
            *fixed.entry(occupant.masses[point]).or_default() |= 1 << lane;
        }
    }
    fixed.into_iter().map(|(mass, lanes)| (mass, M::from_bits(lanes))).collect()
}

/// The key of a rigid voxel, and the ends of its top and its left side if these are not between its corners.
type RigidKey = (TileKey, Option<[[usize; 2]; 2]>);

fn rigid<R: Real>(bodies: &[&Lattice], occupants: &[Occupant]) -> Vec<Round<R>> {
    let mut rounds: Vec<BTreeMap<RigidKey, u32>> = Vec::new();
    for (lane, (body, occupant)) in bodies.iter().zip(occupants).enumerate() {
        let rigid = body.voxels().iter().filter(|voxel| voxel.rigid);
        let key = |voxel: &Voxel| (tile_key(voxel, occupant), strays(voxel, &occupant.masses));
        let own: BTreeSet<RigidKey> = rigid.map(key).collect();
        rounds.resize(rounds.len().max(own.len()), BTreeMap::new());
        for (key, round) in own.into_iter().zip(&mut rounds) {
            *round.entry(key).or_default() |= 1 << lane;
        }
    }
    rounds.iter().map(Round::new).collect()
}

impl<R: Real> Round<R> {
    fn new(voxels: &BTreeMap<RigidKey, u32>) -> Self {
        let lanes = voxels.values().fold(0, |all, lanes| all | lanes);
        let voxel = |(&((_, corners), _), &lanes): (&RigidKey, &u32)| (corners, R::Mask::from_bits(lanes));
        let sides = |(&((_, [a, b, c, d]), strays), &lanes): (&RigidKey, &u32)| {
            let [top, left] = strays.unwrap_or([[a, b], [a, d]]);
            ([top, [b, c], [d, c], left], R::Mask::from_bits(lanes))
        };
        let has_strays = voxels.keys().any(|(_, strays)| strays.is_some());
        Self {
            lanes: R::Mask::from_bits(lanes),
            voxels: voxels.iter().map(voxel).collect(),
            strays: has_strays.then(|| voxels.iter().map(sides).collect()),
        }
    }
}

fn strays(voxel: &Voxel, masses: &[usize]) -> Option<[[usize; 2]; 2]> {
    voxel.strays.map(|sides| sides.map(|ends| ends.map(|point| masses[point])))
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
            let strays = strays(voxel, &masses);
            surface.push(SurfaceVoxel { corners, sides: voxel.surface, strays, part: voxel.part });
        }
        let count = |part: usize| surface.iter().filter(|voxel| voxel.part == part).count() as u32;
        let parts = body.parts.iter().enumerate();
        let countable = parts.map(|(n, part)| if part.active { count(n) } else { 0 }).collect();
        Self { masses, surface, at_mass, countable, driven }
    }
}
