//! Pairs that are close to each other: the broad phase of contact and of the instability test (docs/physics.md 7 and
//! 9).
//!
//! Bounding boxes and points are compared only now and then. Pairs farther apart than a margin are skipped until some
//! point has moved by half the margin since then; closer pairs are checked in every substep. So no contact is missed,
//! and the times at which the lists are rebuilt do not affect results.

use crate::sim::backend::lanes::contact::is_inside;
use crate::sim::backend::lanes::mass::{Mass, Vector};
use crate::sim::backend::lanes::real::{Mask, Real};
use crate::sim::lattice::CORNERS;

/// Boxes closer than this, in meters, are checked in every substep.
const MARGIN: f64 = 0.03;

/// Slack for rounding, in meters.
const SLACK: f64 = 1e-9;

/// A voxel of any lane.
#[derive(Clone, Debug)]
pub struct Tile {
    /// Row and column.
    pub cell: [usize; 2],
    /// Its masses: top left, top right, bottom right, bottom left.
    pub corners: [usize; CORNERS],
    /// Lanes that have it on their surface, as bits.
    pub surface: u32,
}

/// The lists of close pairs.
#[derive(Clone, Debug)]
pub struct Proximity<R: Real> {
    /// Surface voxels of all lanes, in reading order.
    tiles: Vec<Tile>,
    /// Their masses.
    pub points: Vec<usize>,
    /// The positions when the lists were built; infinitely far before the first time.
    reference: Vec<Vector<R>>,
    /// Points near a tile that is not theirs.
    near_points: Vec<NearPoint>,
    /// Pairs of tiles near each other but not neighbors.
    near_tiles: Vec<NearTiles>,
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
    lanes: u32,
}

/// The result of checking the points.
#[derive(Clone, Copy, Debug)]
pub struct Survey {
    /// Whether a point has moved so far that the lists have to be renewed.
    pub is_stale: bool,
    /// Lanes with a point at or below the given height, as bits.
    pub lowest: u32,
}

/// A point found inside a tile.
#[derive(Clone, Copy, Debug)]
pub struct Inside {
    /// The tile's masses.
    pub corners: [usize; CORNERS],
    /// The point's mass.
    pub point: usize,
    /// In which lanes, as bits.
    pub lanes: u32,
}

impl<R: Real> Default for Proximity<R> {
    fn default() -> Self {
        Self::new(Vec::new())
    }
}

impl<R: Real> Proximity<R> {
    /// The broad phase over these surface voxels.
    pub fn new(tiles: Vec<Tile>) -> Self {
        let mut points: Vec<usize> = tiles.iter().flat_map(|tile| tile.corners).collect();
        points.sort_unstable();
        points.dedup();
        let reference = vec![[R::splat(f64::INFINITY); 2]; points.len()];
        Self { tiles, points, reference, near_points: Vec::new(), near_tiles: Vec::new(), suspects: 0 }
    }

    /// Checks the points, and records the lanes in which each is at or below `height`.
    #[inline(always)]
    pub fn survey(&self, masses: &[Mass<R>], height: f64, low: &mut Vec<u32>) -> Survey {
        low.resize(self.points.len(), 0);
        let height = R::splat(height);
        let (mut moved, mut lowest) = (R::splat(0.0), 0);
        for ((&point, reference), low) in self.points.iter().zip(&self.reference).zip(low) {
            let at = masses[point].at;
            moved = (at[0] - reference[0]).abs().max(moved);
            moved = (at[1] - reference[1]).abs().max(moved);
            *low = at[1].at_most(height).bits();
            lowest |= *low;
        }
        Survey { is_stale: R::splat(MARGIN / 2.0 - SLACK).at_most(moved).any(), lowest }
    }

    /// Builds the lists from current positions. `surface[lane]` is the number of a lane's surface voxels, or zero if it
    /// cannot be unstable.
    #[inline(always)]
    pub fn renew(&mut self, masses: &[Mass<R>], surface: &[u32]) {
        self.reference.clear();
        self.reference.extend(self.points.iter().map(|&point| masses[point].at));
        self.near_points.clear();
        self.near_tiles.clear();
        let margin = R::splat(MARGIN);
        let boxes: Vec<[Vector<R>; 2]> = self.tiles.iter().map(|tile| bounds(masses, tile)).collect();
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
                if both != 0 && are_apart(tile, other) {
                    let lanes = gap(&boxes[n], &boxes[m]).at_most(margin).bits() & both;
                    if lanes != 0 {
                        self.near_tiles.push(NearTiles { tiles: [n, m], lanes });
                    }
                }
            }
        }
        let pairs = tally(self.near_tiles.iter().map(|near| near.lanes), surface.len());
        self.suspects = overfull(&pairs, surface);
    }

    /// Points inside tiles that are not theirs, by tile and then by point.
    #[inline(always)]
    pub fn insides(&self, masses: &[Mass<R>], found: &mut Vec<Inside>) {
        let slack = R::splat(SLACK);
        let mut last = usize::MAX;
        let mut reach = [[R::splat(0.0); 2]; 2];
        for near in &self.near_points {
            let tile = &self.tiles[near.tile];
            if near.tile != last {
                reach = bounds(masses, tile);
                last = near.tile;
            }
            let at = masses[near.point].at;
            if gap(&reach, &[at, at]).at_most(slack).bits() & near.lanes == 0 {
                continue;
            }
            let lanes = is_inside(at, tile.corners.map(|corner| masses[corner].at)).bits() & near.lanes;
            if lanes != 0 {
                found.push(Inside { corners: tile.corners, point: near.point, lanes });
            }
        }
    }

    /// The instability test of docs/physics.md 9 on current positions: lanes in which the ordered pairs of non-adjacent
    /// surface voxels with overlapping boxes outnumber the surface voxels.
    #[inline(always)]
    pub fn unstable(&self, masses: &[Mass<R>], surface: &[u32]) -> u32 {
        if self.suspects == 0 { 0 } else { self.count_overlaps(masses, surface) }
    }

    #[inline(always)]
    fn count_overlaps(&self, masses: &[Mass<R>], surface: &[u32]) -> u32 {
        let overlaps = self.near_tiles.iter().map(|near| {
            let [a, b] = near.tiles.map(|n| bounds(masses, &self.tiles[n]));
            overlap(&a, &b).bits() & near.lanes
        });
        overfull(&tally(overlaps, surface.len()), surface)
    }
}

/// Counts the set bits of each lane.
fn tally(bits: impl Iterator<Item = u32>, lanes: usize) -> Vec<u32> {
    let mut counts = vec![0; lanes];
    for bits in bits {
        for (lane, count) in counts.iter_mut().enumerate() {
            *count += bits >> lane & 1;
        }
    }
    counts
}

/// Lanes in which twice the number of pairs exceeds the number of surface voxels.
fn overfull(pairs: &[u32], surface: &[u32]) -> u32 {
    let lanes = pairs.iter().zip(surface).enumerate();
    lanes
        .filter(|(_, (pairs, surface))| **surface > 0 && 2 * **pairs > **surface)
        .fold(0, |bits, (lane, _)| bits | 1 << lane)
}

/// Whether two voxels' cells differ by more than one row or column.
fn are_apart(a: &Tile, b: &Tile) -> bool {
    a.cell[0].abs_diff(b.cell[0]) > 1 || a.cell[1].abs_diff(b.cell[1]) > 1
}

/// Smallest and largest coordinates of a tile.
#[inline(always)]
fn bounds<R: Real>(masses: &[Mass<R>], tile: &Tile) -> [Vector<R>; 2] {
    let [a, b, c, d] = [0, 1, 2, 3].map(|corner| masses[tile.corners[corner]].at);
    let least = |axis: usize| a[axis].min(b[axis]).min(c[axis].min(d[axis]));
    let greatest = |axis: usize| a[axis].max(b[axis]).max(c[axis].max(d[axis]));
    [[least(0), least(1)], [greatest(0), greatest(1)]]
}

/// The distance of two boxes along the axis where it is largest; negative if they overlap.
#[inline(always)]
fn gap<R: Real>(a: &[Vector<R>; 2], b: &[Vector<R>; 2]) -> R {
    let along = |axis: usize| (a[0][axis] - b[1][axis]).max(b[0][axis] - a[1][axis]);
    along(0).max(along(1))
}

/// Whether two boxes overlap or touch.
#[inline(always)]
fn overlap<R: Real>(a: &[Vector<R>; 2], b: &[Vector<R>; 2]) -> R::Mask {
    let along = |axis: usize| a[0][axis].at_most(b[1][axis]).and(b[0][axis].at_most(a[1][axis]));
    along(0).and(along(1))
}
