//! A body laid out for the kernel: its springs in frames and rims, and for each mass the order in which forces act on
//! it. The order is that of `lanes/springs.rs`.

use std::collections::{BTreeMap, BTreeSet};

use crate::backend::lanes::FRAME;
use crate::constants::Constants;
use crate::lattice::{CORNERS, Lattice, Voxel};

const NONE: u16 = 0xffff;

/// The goals of springs that are not driven: of main edges, of diagonals. Driven springs follow.
const MAIN: u16 = 0;
const DIAGONAL: u16 = 1;
const DRIVEN: u16 = 2;

/// The corner by which the voxels above left, above right, below left and below right of a mass touch it.
const TOUCHING: [usize; CORNERS] = [2, 3, 1, 0];

#[derive(Clone, Debug)]
pub struct BodyPlan {
    pub masses: Vec<usize>,
    /// All lists of the kernel's `Robot`, one after another.
    pub words: Vec<u16>,
    /// The stiffness of each spring, in kilograms per substep squared.
    pub stiffness: Vec<f64>,
    frames: usize,
    driven: usize,
    tiles: usize,
    points: usize,
    levels: usize,
    countable: usize,
}

/// The springs of a body: four for each voxel, then the rims.
struct SpringTable {
    /// Ends as masses, the earlier first.
    ends: Vec<[usize; 2]>,
    of_edge: Vec<usize>,
}

impl BodyPlan {
    pub fn new(body: &Lattice, constants: &Constants) -> Self {
        let masses = masses(body);
        let springs = SpringTable::new(body, &masses);
        let frames = body.voxels().len();
        let surface: Vec<&Voxel> = body.voxels().iter().filter(|voxel| voxel.is_surface()).collect();
        let skin: BTreeSet<usize> = surface.iter().flat_map(|voxel| voxel.corners).map(|point| masses[point]).collect();
        let levels = rigid_levels(body, &masses);
        let mut stiffness = vec![0.0; springs.ends.len()];
        for (edge, &spring) in body.edges.iter().zip(&springs.of_edge) {
            stiffness[spring] = edge.stiffness * constants.per_substep_squared();
        }
        let lists = [
            springs.ends.iter().flatten().map(|&mass| mass as u16).collect(),
            aims(body, &springs, frames),
            gather(body, &masses, &springs, frames),
            around(&surface, &masses),
            masses.iter().map(|&mass| mass as u16).collect(),
            body.driven.iter().flat_map(|edge| [edge.first, edge.second.unwrap_or(NONE)]).collect(),
            surface.iter().flat_map(|voxel| tile(voxel, &masses)).collect(),
            skin.iter().map(|&mass| mass as u16).collect(),
            ends_of(&levels),
            levels.iter().flatten().flatten().map(|&mass| mass as u16).collect::<Vec<u16>>(),
        ];
        Self {
            words: lists.concat(),
            stiffness,
            frames,
            driven: body.driven.len(),
            tiles: surface.len(),
            points: skin.len(),
            levels: levels.len(),
            countable: if body.parts.iter().any(|part| part.active) { surface.len() } else { 0 },
            masses,
        }
    }

    pub fn springs(&self) -> usize {
        self.stiffness.len()
    }

    pub fn tiles(&self) -> usize {
        self.tiles
    }

    pub fn header(&self, words: usize, stiffness: usize) -> [u32; 10] {
        let rims = self.springs() - 4 * self.frames;
        let Self { frames, driven, tiles, points, levels, countable, .. } = *self;
        [words, stiffness, self.masses.len(), frames, rims, driven, tiles, points, levels, countable]
            .map(|count| count as u32)
    }
}

/// The mass of each point: masses are numbered by their places, row by row.
fn masses(body: &Lattice) -> Vec<usize> {
    let place = |point: usize| {
        let point = body.points()[point];
        (point.row, point.column, point.copy)
    };
    let mut order: Vec<usize> = (0..body.points().len()).collect();
    order.sort_by_key(|&point| place(point));
    let mut masses = vec![0; order.len()];
    for (mass, &point) in order.iter().enumerate() {
        masses[point] = mass;
    }
    masses
}

impl SpringTable {
    fn new(body: &Lattice, masses: &[usize]) -> Self {
        let mut found: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        let mut ends = Vec::new();
        for voxel in body.voxels() {
            let corners = voxel.corners.map(|point| masses[point]);
            for [a, b] in FRAME {
                found.insert([corners[a], corners[b]], ends.len());
                ends.push([corners[a], corners[b]]);
            }
        }
        let of_edge = body.edges.iter().map(|edge| {
            let (a, b) = (masses[edge.a], masses[edge.b]);
            [a.min(b), a.max(b)]
        });
        let of_edge: Vec<[usize; 2]> = of_edge.collect();
        let rims: BTreeSet<[usize; 2]> = of_edge.iter().copied().filter(|edge| !found.contains_key(edge)).collect();
        for rim in rims {
            found.insert(rim, ends.len());
            ends.push(rim);
        }
        Self { of_edge: of_edge.iter().map(|edge| found[edge]).collect(), ends }
    }
}

fn aims(body: &Lattice, springs: &SpringTable, frames: usize) -> Vec<u16> {
    let kind = |spring: usize| if spring < 4 * frames && spring % 4 >= 2 { DIAGONAL } else { MAIN };
    let mut aims: Vec<u16> = (0..springs.ends.len()).map(kind).collect();
    for (driven, edge) in (DRIVEN..).zip(&body.driven) {
        aims[springs.of_edge[edge.edge]] = driven;
    }
    aims
}

/// For each mass the rims that end in it, those that begin in it, and the first spring of each frame around it.
fn gather(body: &Lattice, masses: &[usize], springs: &SpringTable, frames: usize) -> Vec<u16> {
    let mut gather = vec![[NONE; 8]; masses.len()];
    for (rim, [from, to]) in springs.ends.iter().enumerate().skip(4 * frames) {
        let put = |places: &mut [u16]| {
            let free = places.iter_mut().find(|place| **place == NONE);
            *free.expect("at most two rims begin and two end in a mass") = rim as u16;
        };
        put(&mut gather[*to][..2]);
        put(&mut gather[*from][2..4]);
    }
    for (frame, voxel) in body.voxels().iter().enumerate() {
        for (place, corner) in (4..).zip(TOUCHING) {
            gather[masses[voxel.corners[corner]]][place] = 4 * frame as u16;
        }
    }
    gather.concat()
}

fn around(surface: &[&Voxel], masses: &[usize]) -> Vec<u16> {
    let mut around = vec![[NONE; 4]; masses.len()];
    for (tile, voxel) in surface.iter().enumerate() {
        for (place, corner) in TOUCHING.into_iter().enumerate() {
            around[masses[voxel.corners[corner]]][place] = tile as u16;
        }
    }
    around.concat()
}

fn tile(voxel: &Voxel, masses: &[usize]) -> [u16; 7] {
    let [a, b, c, d] = voxel.corners.map(|point| masses[point] as u16);
    let sides = (0..CORNERS).filter(|&side| voxel.surface[side]).fold(0, |bits, side| bits | 1 << side);
    [a, b, c, d, sides, voxel.row as u16, voxel.column as u16]
}

/// Rigid voxels by level: one more than that of the last earlier voxel that shares a mass. A level is done at once.
fn rigid_levels(body: &Lattice, masses: &[usize]) -> Vec<Vec<[usize; CORNERS]>> {
    let mut levels: Vec<Vec<[usize; CORNERS]>> = Vec::new();
    let mut next = vec![0; masses.len()];
    for voxel in body.voxels().iter().filter(|voxel| voxel.rigid) {
        let corners = voxel.corners.map(|point| masses[point]);
        let level = corners.iter().map(|&mass| next[mass]).max().unwrap_or(0);
        levels.resize(levels.len().max(level + 1), Vec::new());
        levels[level].push(corners);
        for mass in corners {
            next[mass] = level + 1;
        }
    }
    levels
}

fn ends_of(levels: &[Vec<[usize; CORNERS]>]) -> Vec<u16> {
    let mut end = 0;
    let ends = levels.iter().map(|level| {
        end += level.len();
        end as u16
    });
    ends.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::{Body, Palette};

    fn plan(rows: &[&str]) -> BodyPlan {
        let constants = Constants::default();
        let body = Body::parse(rows, &Palette::paper()).unwrap();
        BodyPlan::new(&Lattice::new(&body, &constants), &constants)
    }

    #[test]
    fn every_spring_acts_on_both_its_ends_once() {
        for rows in [&["3"][..], &["34", "12"], &["30", "03"], &["303", "333", "303"]] {
            let plan = plan(rows);
            assert!(plan.stiffness.iter().all(|&stiffness| stiffness > 0.0), "{rows:?}");
            let springs = plan.springs();
            let gather = &plan.words[3 * springs..][..8 * plan.masses.len()];
            // A mass above left of which a voxel is has one of its springs, above right two, and so on.
            let weights = [1, 1, 1, 1, 1, 2, 2, 3];
            let ends: usize = gather
                .chunks(8)
                .flat_map(|mass| mass.iter().zip(weights))
                .filter(|(spring, _)| **spring != NONE)
                .map(|(_, weight)| weight)
                .sum();
            assert_eq!(ends, 2 * springs, "{rows:?}");
        }
    }

    #[test]
    fn rigid_voxels_of_a_level_have_no_mass_in_common() {
        let body = Body::parse(&["111", "131", "110"], &Palette::paper()).unwrap();
        let lattice = Lattice::new(&body, &Constants::default());
        let levels = rigid_levels(&lattice, &masses(&lattice));
        assert_eq!(levels.iter().map(Vec::len).sum::<usize>(), 7);
        for level in &levels {
            let all: Vec<usize> = level.iter().flatten().copied().collect();
            assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len());
        }
    }
}
