//! Pairs that are close to each other: the broad phase of contact and of the instability test (docs/physics.md 7 and
//! 9).
//!
//! Bounding boxes and points are compared only now and then. Pairs farther apart than a margin are skipped until some
//! point has moved by half the margin since then; closer pairs are checked in every substep. So no contact is missed,
//! and the times at which the lists are rebuilt do not affect results.

use crate::backend::lanes::contact::is_inside;
use crate::backend::lanes::mass::{Mass, Vector};
use crate::backend::lanes::real::{Mask, Real};
use crate::lattice::CORNERS;

/// Boxes closer than this, in meters, are checked in every substep.
pub const MARGIN: f64 = 0.03;

/// Slack for rounding, in meters.
pub const SLACK: f64 = 1e-9;

#[derive(Clone, Debug)]
pub struct Tile {
    /// Row and column in the box.
    pub cell: [usize; 2],
    pub corners: [usize; CORNERS],
    pub part: usize,
    /// Lanes that have it on their surface, as bits.
    pub surface: u32,
    /// Its place among the surface voxels of each of these lanes.
    pub in_lane: Vec<usize>,
}

#[derive(Clone, Debug)]
pub struct Proximity<R: Real> {
    pub tiles: Vec<Tile>,
    points: Vec<usize>,
    /// The positions when the lists were built; infinitely far before the first time.
    reference: Vec<Vector<R>>,
    near_points: Vec<NearPoint>,
    near_tiles: Vec<NearTiles>,
    /// For each lane the number of surface voxels of each part, or zero for a part that cannot be unstable.
    countable: Vec<Vec<u32>>,
    /// Lanes with so many close pairs that they might be unstable, as bits.
    suspects: u32,
}

#[derive(Clone, Copy, Debug)]
struct NearPoint {
    tile: usize,
    point: usize,
    lanes: u32,
}

#[derive(Clone, Copy, Debug)]
struct NearTiles {
    tiles: [usize; 2],
    part: usize,
    lanes: u32,
}

#[derive(Clone, Copy, Debug)]
pub struct LowPoint {
    pub mass: usize,
    pub lanes: u32,
}

#[derive(Clone, Copy, Debug)]
pub struct NearTerrain {
    pub tile: usize,
    pub voxel: usize,
    pub lanes: u32,
}

#[derive(Clone, Copy, Debug)]
pub struct Inside {
    pub tile: usize,
    pub point: usize,
    pub lanes: u32,
}

impl<R: Real> Proximity<R> {
    pub fn new(tiles: Vec<Tile>, countable: Vec<Vec<u32>>) -> Self {
        let mut points: Vec<usize> = tiles.iter().flat_map(|tile| tile.corners).collect();
        points.sort_unstable();
        points.dedup();
        let reference = vec![[R::splat(f64::INFINITY); 2]; points.len()];
        Self { tiles, points, reference, near_points: Vec::new(), near_tiles: Vec::new(), countable, suspects: 0 }
    }

    /// Returns whether a point has moved so far that the other lists have to be renewed.
    #[inline(always)]
    pub fn survey(&self, masses: &[Mass<R>], height: f64, low: &mut Vec<LowPoint>) -> bool {
        let height = R::splat(height);
        let mut moved = R::splat(0.0);
        for (&point, reference) in self.points.iter().zip(&self.reference) {
            let at = masses[point].at;
            moved = (at[0] - reference[0]).abs().max(moved);
            moved = (at[1] - reference[1]).abs().max(moved);
            let lanes = at[1].at_most(height).bits();
            if lanes != 0 {
                low.push(LowPoint { mass: point, lanes });
            }
        }
        R::splat(MARGIN / 2.0 - SLACK).at_most(moved).any()
    }

    #[inline(always)]
    pub fn renew(&mut self, masses: &[Mass<R>]) {
        self.reference.clear();
        self.reference.extend(self.points.iter().map(|&point| masses[point].at));
        self.near_points.clear();
        self.near_tiles.clear();
        let margin = R::splat(MARGIN);
        let mut boxes: Vec<[Vector<R>; 2]> = Vec::with_capacity(self.tiles.len());
        for tile in &self.tiles {
            boxes.push(bounds(masses, tile));
        }
        for (n, tile) in self.tiles.iter().enumerate() {
            for &point in &self.points {
                let at = masses[point].at;
                let lanes = gap(&boxes[n], &[at, at]).at_most(margin).bits() & tile.surface;
                if lanes != 0 && !tile.corners.contains(&point) {
                    self.near_points.push(NearPoint { tile: n, point, lanes });
                }
            }
            for (m, other) in self.tiles.iter().enumerate().skip(n + 1) {
                let both = tile.surface & other.surface;
                if both != 0 && self.can_count(tile, other) {
                    let lanes = gap(&boxes[n], &boxes[m]).at_most(margin).bits() & both;
                    if lanes != 0 {
                        self.near_tiles.push(NearTiles { tiles: [n, m], part: tile.part, lanes });
                    }
                }
            }
        }
        self.suspects = 0;
        // Pairs are sorted by their tiles, so those of a part are together.
        for of_part in self.near_tiles.chunk_by(|one, other| one.part == other.part) {
            let mut pairs = Tally::default();
            for near in of_part {
                pairs.add(near.lanes);
            }
            self.suspects |= pairs.overfull(&self.countable, of_part[0].part);
        }
    }

    fn can_count(&self, tile: &Tile, other: &Tile) -> bool {
        let is_active = |countable: &Vec<u32>| countable.get(tile.part).is_some_and(|&count| count > 0);
        tile.part == other.part && are_apart(tile, other) && self.countable.iter().any(is_active)
    }

    /// Points inside tiles that are not theirs, by tile and then by point.
    #[inline(always)]
    pub fn insides(&self, masses: &[Mass<R>], found: &mut Vec<Inside>) {
        let slack = R::splat(SLACK);
        let mut last = None;
        let mut reach = [[R::splat(0.0); 2]; 2];
        for near in &self.near_points {
            let tile = &self.tiles[near.tile];
            if last != Some(near.tile) {
                reach = bounds(masses, tile);
                last = Some(near.tile);
            }
            let at = masses[near.point].at;
            if gap(&reach, &[at, at]).at_most(slack).bits() & near.lanes == 0 {
                continue;
            }
            let lanes = is_inside(at, corners(masses, tile)).bits() & near.lanes;
            if lanes != 0 {
                found.push(Inside { tile: near.tile, point: near.point, lanes });
            }
        }
    }

    /// The instability test of docs/physics.md 9 on current positions: lanes in which the ordered pairs of non-adjacent
    /// surface voxels with overlapping boxes outnumber the surface voxels.
    #[inline(always)]
    pub fn unstable(&self, masses: &[Mass<R>]) -> u32 {
        if self.suspects == 0 { 0 } else { self.count_overlaps(masses) }
    }

    #[inline(always)]
    fn count_overlaps(&self, masses: &[Mass<R>]) -> u32 {
        let mut found = 0;
        for of_part in self.near_tiles.chunk_by(|one, other| one.part == other.part) {
            let mut pairs = Tally::default();
            let mut last = None;
            let mut first = [[R::splat(0.0); 2]; 2];
            for near in of_part {
                if near.lanes & self.suspects == 0 {
                    continue;
                }
                let [a, b] = near.tiles;
                if last != Some(a) {
                    first = bounds(masses, &self.tiles[a]);
                    last = Some(a);
                }
                pairs.add(overlap(&first, &bounds(masses, &self.tiles[b])).bits() & near.lanes & self.suspects);
            }
            found |= pairs.overfull(&self.countable, of_part[0].part);
        }
        found
    }
}

#[derive(Default)]
struct Tally([u32; u32::BITS as usize]);

impl Tally {
    #[inline(always)]
    fn add(&mut self, mut lanes: u32) {
        while lanes != 0 {
            self.0[lanes.trailing_zeros() as usize] += 1;
            lanes &= lanes - 1;
        }
    }

    fn overfull(&self, surface: &[Vec<u32>], part: usize) -> u32 {
        let lanes = self.0.iter().zip(surface).enumerate();
        let is_overfull = |pairs: u32, surface: u32| surface > 0 && 2 * pairs > surface;
        lanes
            .filter(|(_, (pairs, surface))| is_overfull(**pairs, surface.get(part).copied().unwrap_or(0)))
            .fold(0, |bits, (lane, _)| bits | 1 << lane)
    }
}

fn are_apart(a: &Tile, b: &Tile) -> bool {
    a.cell[0].abs_diff(b.cell[0]) > 1 || a.cell[1].abs_diff(b.cell[1]) > 1
}

// The functions below use no closures and iterators on vectors: these would be compiled without the vector instructions
// of the kernel, and called with every vector in memory.

#[inline(always)]
fn corners<R: Real>(masses: &[Mass<R>], tile: &Tile) -> [Vector<R>; CORNERS] {
    let [a, b, c, d] = tile.corners;
    [masses[a].at, masses[b].at, masses[c].at, masses[d].at]
}

#[inline(always)]
pub fn bounds<R: Real>(masses: &[Mass<R>], tile: &Tile) -> [Vector<R>; 2] {
    let [a, b, c, d] = corners(masses, tile);
    [
        [a[0].min(b[0]).min(c[0].min(d[0])), a[1].min(b[1]).min(c[1].min(d[1]))],
        [a[0].max(b[0]).max(c[0].max(d[0])), a[1].max(b[1]).max(c[1].max(d[1]))],
    ]
}

/// The distance of two boxes along the axis where it is largest; negative if they overlap.
#[inline(always)]
fn gap<R: Real>(a: &[Vector<R>; 2], b: &[Vector<R>; 2]) -> R {
    let x = (a[0][0] - b[1][0]).max(b[0][0] - a[1][0]);
    let y = (a[0][1] - b[1][1]).max(b[0][1] - a[1][1]);
    x.max(y)
}

#[inline(always)]
fn overlap<R: Real>(a: &[Vector<R>; 2], b: &[Vector<R>; 2]) -> R::Mask {
    let x = a[0][0].at_most(b[1][0]).and(b[0][0].at_most(a[1][0]));
    let y = a[0][1].at_most(b[1][1]).and(b[0][1].at_most(a[1][1]));
    x.and(y)
}
