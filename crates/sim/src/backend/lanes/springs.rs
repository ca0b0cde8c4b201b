//! The springs of a batch: the union of its robots' springs, by voxel, and the lengths that they approach.

use std::collections::{BTreeMap, BTreeSet};

use crate::backend::lanes::real::Real;
use crate::backend::lanes::stiffness::Stiffness;
use crate::constants::Constants;
use crate::grid::DriveAxis;
use crate::lattice::{CORNERS, DrivenEdge, Edge, Lattice};

/// The goals of springs that are not driven: of main edges, of diagonals.
pub const MAIN: usize = 0;
pub const DIAGONAL: usize = 1;

/// The four springs of a voxel in its frame: top, left, falling diagonal, rising diagonal.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub corners: [u32; CORNERS],
    pub aim: u32,
}

impl Frame {
    #[inline(always)]
    pub fn indices(&self) -> [usize; CORNERS] {
        let [a, b, c, d] = self.corners;
        [a as usize, b as usize, c as usize, d as usize]
    }
}

/// A bottom or right side that is no other voxel's top or left side, or a driven left side.
#[derive(Clone, Copy, Debug)]
pub struct Rim {
    /// The end with the lower number: a mass.
    pub from: u32,
    pub to: u32,
    pub aim: u32,
}

/// The corners that each spring of a voxel connects, the earlier mass first. The OpenCL kernel uses this order.
pub const FRAME: [[usize; 2]; 4] = [[0, 1], [0, 3], [0, 2], [1, 3]];

#[derive(Clone, Copy, Debug)]
pub struct Driven {
    pub aim: usize,
    /// Built length in meters.
    pub rest: f64,
    /// The channel of its first active owner; the material code in a body.
    pub first: u16,
    pub second: Option<u16>,
}

#[derive(Debug)]
pub struct Springs<R: Real, K: Stiffness<R>> {
    /// The frames in reading order; then an idle one, because frames are measured one ahead.
    pub frames: Vec<Frame>,
    pub frame_stiffness: Vec<[K; 4]>,
    /// Their springs' stiffness times frozen rest length (docs/physics.md 5).
    pub frame_frozen: Vec<[R; 4]>,
    /// The rims, in order of their masses.
    pub rims: Vec<Rim>,
    pub rim_stiffness: Vec<K>,
    pub rim_frozen: Vec<R>,
    /// Goal lengths times the approach factor (docs/physics.md 5): of springs that are not driven, then of driven ones.
    pub aims: Vec<R>,
}

/// The key of a voxel across lanes: row and column, masses.
pub type TileKey = ([usize; 2], [usize; CORNERS]);

/// The key of a rim: the earlier mass and the later, and whether it is the earlier one of two with these ends.
type RimKey = (usize, usize, bool);

#[derive(Clone, Copy, Debug)]
enum Spring {
    Frame(TileKey, usize),
    Rim(RimKey),
}

impl<R: Real, K: Stiffness<R>> Springs<R, K> {
    /// `maps` has the masses of each robot's points.
    pub fn new(robots: &[&Lattice], maps: &[Vec<usize>], constants: &Constants) -> (Self, Vec<Vec<Driven>>) {
        let lanes: Vec<Vec<Spring>> = robots.iter().zip(maps).map(|(body, masses)| places(body, masses)).collect();
        let mut frames: BTreeMap<TileKey, [K; 4]> = BTreeMap::new();
        let mut rims: BTreeMap<RimKey, K> = BTreeMap::new();
        for (lane, (body, springs)) in robots.iter().zip(&lanes).enumerate() {
            for (edge, spring) in body.edges.iter().zip(springs) {
                let stiffness = match *spring {
                    Spring::Frame(key, place) => &mut frames.entry(key).or_insert([K::none(); 4])[place],
                    Spring::Rim(key) => rims.entry(key).or_insert(K::none()),
                };
                stiffness.set_lane(lane, edge.stiffness * constants.per_substep_squared());
            }
        }
        let frame = |&(_, corners): &TileKey| Frame { corners: corners.map(|mass| mass as u32), aim: MAIN as u32 };
        let rim = |&(from, to, _): &RimKey| Rim { from: from as u32, to: to as u32, aim: MAIN as u32 };
        let mut all = Self {
            frames: frames.keys().map(frame).collect(),
            frame_stiffness: frames.values().copied().collect(),
            frame_frozen: vec![[R::splat(0.0); 4]; frames.len()],
            rims: rims.keys().map(rim).collect(),
            rim_stiffness: rims.values().copied().collect(),
            rim_frozen: vec![R::splat(0.0); rims.len()],
            aims: [MAIN, DIAGONAL].map(|kind| R::splat(constants.approach * rest(kind, constants))).to_vec(),
        };
        let frames: BTreeMap<TileKey, usize> = frames.into_keys().zip(0..).collect();
        let rims: BTreeMap<RimKey, usize> = rims.into_keys().zip(0..).collect();
        let mut driven: Vec<Vec<Driven>> = Vec::with_capacity(robots.len());
        for (body, springs) in robots.iter().zip(&lanes) {
            let drive = |edge: &DrivenEdge| {
                let aim = match springs[edge.edge] {
                    Spring::Frame(key, _) => &mut all.frames[frames[&key]].aim,
                    Spring::Rim(key) => &mut all.rims[rims[&key]].aim,
                };
                if *aim as usize == MAIN {
                    *aim = all.aims.len() as u32;
                    all.aims.push(all.aims[MAIN]);
                }
                let rest = body.edges[edge.edge].rest;
                Driven { aim: *aim as usize, rest, first: edge.first, second: edge.second }
            };
            driven.push(body.driven.iter().map(drive).collect());
        }
        all.frames.push(all.frames[0]);
        (all, driven)
    }

    /// The target of a channel is a fraction of the rest width or height (docs/physics.md 4).
    pub fn set_targets(&mut self, lane: usize, driven: &[Driven], targets: &[f64], constants: &Constants) {
        for driven in driven {
            let first = targets[usize::from(driven.first)];
            let goal = match driven.second {
                Some(second) => (first + targets[usize::from(second)]) * (driven.rest / 2.0),
                None => first * driven.rest,
            };
            self.aims[driven.aim].set_lane(lane, constants.approach * goal);
        }
    }
}

/// Built length of a kind of spring in meters.
pub fn rest(kind: usize, constants: &Constants) -> f64 {
    let cell = constants.cell;
    if kind == MAIN { cell } else { (cell * cell + cell * cell).sqrt() }
}

fn places(body: &Lattice, masses: &[usize]) -> Vec<Spring> {
    let mut found: BTreeMap<(usize, usize), Spring> = BTreeMap::new();
    for voxel in body.voxels() {
        let corners = voxel.corners.map(|point| masses[point]);
        for (place, [a, b]) in FRAME.into_iter().enumerate() {
            let spring = Spring::Frame(([voxel.row, voxel.column], corners), place);
            found.insert((corners[a], corners[b]), spring);
        }
    }
    // Of the sides of a frame only the top has a goal of its own.
    let upright = |edge: &&DrivenEdge| edge.axis == DriveAxis::Vertical;
    let upright: BTreeSet<usize> = body.driven.iter().filter(upright).map(|edge| edge.edge).collect();
    let spring = |(n, edge): (usize, &Edge)| {
        let (a, b) = (masses[edge.a], masses[edge.b]);
        let ends = (a.min(b), a.max(b));
        let in_frame = found.get(&ends).filter(|_| !upright.contains(&n) && !edge.doubled);
        in_frame.copied().unwrap_or(Spring::Rim((ends.0, ends.1, edge.doubled)))
    };
    body.edges.iter().enumerate().map(spring).collect()
}
