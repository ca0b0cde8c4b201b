//! A body's lattice at rest: its points, its edges with their springs, its surface (docs/physics.md 2 and 3).

use std::collections::BTreeSet;

use crate::constants::Constants;
use crate::grid::{DriveAxis, Grid, GridCell};
use nbc_base::model::Body;

/// Corners and sides of a voxel are numbered clockwise: corner 0 top left, 1 top right, 2 bottom right, 3 bottom left;
/// side 0 top, 1 right, 2 bottom, 3 left. So side `i` runs from corner `i` to corner `i + 1`.
pub const CORNERS: usize = 4;

#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    width: usize,
    height: usize,
    points: Vec<LatticePoint>,
    /// Ordered by the places of their ends, row by row.
    pub(crate) edges: Vec<Edge>,
    voxels: Vec<Voxel>,
    pub(crate) driven: Vec<DrivenEdge>,
    pub(crate) fixed: Vec<usize>,
    /// The objects, from top to bottom; a body is one.
    pub(crate) parts: Vec<LatticePart>,
}

/// An object of its own in a lattice: some of its rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LatticePart {
    pub top: usize,
    /// Whether any of its voxels is active: only such an object is a robot, and can be unstable (docs/physics.md 1).
    pub active: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LatticePoint {
    pub column: usize,
    pub row: usize,
    /// Voxels that touch only diagonally or are left apart have points of their own, numbered in order of creation.
    pub copy: u8,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    pub a: usize,
    pub b: usize,
    /// Built length in meters.
    pub rest: f64,
    /// Stiffness in newtons per meter (docs/physics.md 3).
    pub stiffness: f64,
    /// The earlier of two edges with the same ends: neighbors that are left apart may share both points of their sides.
    pub doubled: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Voxel {
    pub row: usize,
    pub column: usize,
    pub code: u8,
    pub rigid: bool,
    pub part: usize,
    /// Its points by number: top left, top right, bottom right, bottom left.
    pub corners: [usize; CORNERS],
    /// Whether each side is surface: top, right, bottom, left.
    pub surface: [bool; CORNERS],
    /// Ends of its top and left edge if not between its corners (docs/physics.md 16): left before right, upper first.
    pub strays: Option<[[usize; 2]; 2]>,
}

impl Voxel {
    pub fn is_surface(&self) -> bool {
        self.surface.contains(&true)
    }
}

/// An edge that one or two active voxels drive (docs/physics.md 4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrivenEdge {
    pub edge: usize,
    /// The channel of the first owner in reading order that drives it; the material code in a body.
    pub first: u16,
    pub second: Option<u16>,
    pub axis: DriveAxis,
}

impl Lattice {
    pub fn new(body: &Body, constants: &Constants) -> Self {
        Self::of(&[&Grid::from(body)], constants)
    }

    pub fn of(objects: &[&Grid], constants: &Constants) -> Self {
        let (grid, tops) = Grid::stack(objects);
        let part = |(grid, &top): (&&Grid, &usize)| LatticePart { top, active: grid.is_active() };
        let parts = objects.iter().zip(&tops).map(part).collect();
        Builder { grid: &grid, parts, constants }.build()
    }

    /// Columns and rows of the body's box.
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// The points in order of creation (docs/physics.md 2).
    pub fn points(&self) -> &[LatticePoint] {
        &self.points
    }

    /// The voxels in reading order.
    pub fn voxels(&self) -> &[Voxel] {
        &self.voxels
    }

    pub fn part_of(&self, row: usize) -> usize {
        part_at(&self.parts, row)
    }

    /// In meters, for a body whose lower left corner is at `origin`, in voxels, rounded as in docs/physics.md 2.
    pub fn start(&self, point: usize, origin: [f64; 2], constants: &Constants) -> [f64; 2] {
        let LatticePoint { column, row, .. } = self.points[point];
        corner(origin, self.height, column, row, constants)
    }
}

fn part_at(parts: &[LatticePart], row: usize) -> usize {
    parts.partition_point(|part| part.top <= row) - 1
}

/// In meters, in an object whose lower left corner is given in voxels of the world (docs/physics.md 2).
pub fn corner([left, bottom]: [f64; 2], height: usize, column: usize, row: usize, constants: &Constants) -> [f64; 2] {
    let cell = constants.cell;
    [left * cell + column as f64 * cell, (bottom * cell + height as f64 * cell) - row as f64 * cell]
}

/// Lattice place of a corner relative to its voxel: columns, rows.
const OFFSETS: [(usize, usize); CORNERS] = [(0, 0), (1, 0), (1, 1), (0, 1)];

/// Corners in order of creation: top left, top right, bottom left, bottom right.
const CREATION: [usize; CORNERS] = [0, 1, 3, 2];

struct Builder<'a> {
    grid: &'a Grid,
    parts: Vec<LatticePart>,
    constants: &'a Constants,
}

struct Draft {
    ends: (End, End),
    rest: f64,
    stiffness: f64,
    drivers: Vec<(u16, DriveAxis)>,
}

/// The sides at each corner: that above or below, then that to the left or right.
const SIDES: [[usize; 2]; CORNERS] = [[0, 3], [0, 1], [2, 1], [2, 3]];

/// Each corner as seen from the neighbor across these sides, and from the diagonal one.
const SEEN: [[usize; 3]; CORNERS] = [[3, 1, 2], [2, 0, 3], [1, 3, 0], [0, 2, 1]];

/// The two corners of each side, left before right and upper before lower.
const ALONG: [[usize; 2]; CORNERS] = [[0, 1], [1, 2], [3, 2], [0, 3]];

impl Builder<'_> {
    fn build(self) -> Lattice {
        let (points, mut voxels) = self.points_and_voxels();
        let mut drafts = self.drafts(&points, &mut voxels);
        // Of those with the same ends the earlier one stays first.
        drafts.sort_by_key(|draft| draft.ends);
        let mut edges: Vec<Edge> = Vec::with_capacity(drafts.len());
        let mut driven = Vec::new();
        for (n, draft) in drafts.iter().enumerate() {
            if let Some(&(first, axis)) = draft.drivers.first() {
                let second = draft.drivers.get(1).map(|&(channel, _)| channel);
                driven.push(DrivenEdge { edge: n, first, second, axis });
            }
            let doubled = drafts.get(n + 1).is_some_and(|next| next.ends == draft.ends);
            let (a, b) = (draft.ends.0.1, draft.ends.1.1);
            edges.push(Edge { a, b, rest: draft.rest, stiffness: draft.stiffness, doubled });
        }
        let holds = |voxel: &&Voxel| self.cell(voxel) == GridCell::Fixed;
        let fixed: BTreeSet<usize> = voxels.iter().filter(holds).flat_map(|voxel| voxel.corners).collect();
        let (width, height, fixed) = (self.grid.width(), self.grid.height(), fixed.into_iter().collect());
        Lattice { width, height, points, edges, voxels, driven, fixed, parts: self.parts }
    }

    fn cell(&self, voxel: &Voxel) -> GridCell {
        self.grid.cell(voxel.row as isize, voxel.column as isize).expect("a voxel is not empty")
    }

    /// Voxels share points as in Evolution Gym: a corner is that of the voxel across a side, if both are joined and
    /// that one was visited, or that of a diagonal voxel to which one of them is joined. The last of several counts.
    fn points_and_voxels(&self) -> (Vec<LatticePoint>, Vec<Voxel>) {
        let (mut points, mut voxels): (Vec<LatticePoint>, Vec<Voxel>) = (Vec::new(), Vec::new());
        // The corners of the voxels in the row above and in this row.
        let mut visited: [Vec<Option<[usize; CORNERS]>>; 2] = [const { Vec::new() }; 2];
        let mut copies: Vec<u8> = vec![0; (self.grid.width() + 1) * (self.grid.height() + 1)];
        for row in 0..self.grid.height() {
            visited.swap(0, 1);
            visited[1] = vec![None; self.grid.width() + 1];
            visited[0].resize(self.grid.width() + 1, None);
            for column in 0..self.grid.width() {
                let Some(cell) = self.grid.cell(row as isize, column as isize) else { continue };
                let mut corners = [usize::MAX; CORNERS];
                for corner in CREATION {
                    let (i, j) = (column + OFFSETS[corner].0, row + OFFSETS[corner].1);
                    let shared = self.neighbors_at(row, column, corner).into_iter().flatten();
                    let mut found = shared.filter_map(|(row_of, column_of, corner)| {
                        let line = (row_of + 1).checked_sub(row).filter(|&line| line < 2)?;
                        Some(visited[line][column_of]?[corner])
                    });
                    corners[corner] = found.next_back().unwrap_or_else(|| {
                        let copy = &mut copies[j * (self.grid.width() + 1) + i];
                        points.push(LatticePoint { column: i, row: j, copy: *copy });
                        *copy += 1;
                        points.len() - 1
                    });
                }
                visited[1][column] = Some(corners);
                let surface = [0, 1, 2, 3].map(|side| !self.grid.is_joined(row, column, side));
                let (code, rigid) = (self.grid.code(row, column), cell == GridCell::Rigid);
                let part = part_at(&self.parts, row);
                voxels.push(Voxel { row, column, code, rigid, part, corners, surface, strays: None });
            }
        }
        (points, voxels)
    }

    /// As row, column and corner: that above or below, that to the left or right, and the diagonal one.
    fn neighbors_at(&self, row: usize, column: usize, corner: usize) -> [Option<(usize, usize, usize)>; 3] {
        let [upright, level] = SIDES[corner];
        let step = |row: usize, column: usize, side: usize| match side {
            0 => (row.wrapping_sub(1), column),
            1 => (row, column + 1),
            2 => (row + 1, column),
            _ => (row, column.wrapping_sub(1)),
        };
        let via = |first: usize, second: usize| {
            let (to_row, to_column) = step(row, column, first);
            let joined = self.grid.is_joined(row, column, first);
            joined && self.grid.is_joined(to_row, to_column, second)
        };
        let at = |(row, column): (usize, usize), place: usize| (row, column, SEEN[corner][place]);
        let beside = |side: usize, place: usize| {
            self.grid.is_joined(row, column, side).then(|| at(step(row, column, side), place))
        };
        let (to_row, to_column) = step(row, column, upright);
        let is_reached = via(upright, level) || via(level, upright);
        let diagonal = is_reached.then(|| at(step(to_row, to_column, level), 2));
        [beside(upright, 0), beside(level, 1), diagonal]
    }

    /// In order of creation. A later voxel overwrites a shared edge's stiffness unless it is rigid (docs/physics.md 3).
    fn drafts(&self, points: &[LatticePoint], voxels: &mut [Voxel]) -> Vec<Draft> {
        let mut drafts: Vec<Draft> = Vec::new();
        let side = self.constants.cell;
        let diagonal = (side * side + side * side).sqrt();
        let ends_of = |a: usize, b: usize| {
            let end = |point: usize| ((points[point].row, points[point].column, points[point].copy), point);
            if end(a) < end(b) { (end(a), end(b)) } else { (end(b), end(a)) }
        };
        // The bottom edges of the voxels above, and the right edge of the voxel before.
        let mut bottoms: Vec<usize> = vec![0; self.grid.width()];
        let mut right = 0;
        for voxel in voxels.iter_mut() {
            let own = |drafts: &mut Vec<Draft>, [a, b]: [usize; 2]| {
                let ends = ends_of(voxel.corners[a], voxel.corners[b]);
                let stiffness = self.constants.rigid_stiffness;
                drafts.push(Draft { ends, rest: side, stiffness, drivers: Vec::new() });
                drafts.len() - 1
            };
            let top = if voxel.surface[0] { own(&mut drafts, ALONG[0]) } else { bottoms[voxel.column] };
            bottoms[voxel.column] = own(&mut drafts, ALONG[2]);
            let left = if voxel.surface[3] { own(&mut drafts, ALONG[3]) } else { right };
            right = own(&mut drafts, ALONG[1]);
            let found = [top, left].map(|edge| [drafts[edge].ends.0.1, drafts[edge].ends.1.1]);
            let expected = [ALONG[0], ALONG[3]].map(|ends| ends.map(|corner| voxel.corners[corner]));
            voxel.strays = (found != expected).then_some(found);
            let cell = self.cell(voxel);
            let (main, _) = self.stiffness(cell);
            for (edge, is_level) in [(top, true), (right, false), (bottoms[voxel.column], true), (left, false)] {
                if !matches!(cell, GridCell::Rigid | GridCell::Fixed) {
                    drafts[edge].stiffness = main;
                }
                if let GridCell::Active { channel, axis } = cell
                    && is_level == (axis == DriveAxis::Horizontal)
                {
                    drafts[edge].drivers.push((channel, axis));
                }
            }
        }
        for voxel in voxels.iter() {
            let (main, share) = self.stiffness(self.cell(voxel));
            for (a, b) in [(1, 3), (0, 2)] {
                let ends = ends_of(voxel.corners[a], voxel.corners[b]);
                drafts.push(Draft { ends, rest: diagonal, stiffness: main * share, drivers: Vec::new() });
            }
        }
        drafts
    }

    /// Stiffness of a voxel's main edges, and the fraction of it for its diagonals.
    fn stiffness(&self, cell: GridCell) -> (f64, f64) {
        let constants = self.constants;
        match cell {
            GridCell::Soft => (constants.soft_stiffness, constants.soft_diagonal),
            GridCell::Active { .. } => (constants.active_stiffness, constants.active_diagonal),
            GridCell::Rigid | GridCell::Fixed => (constants.rigid_stiffness, constants.rigid_diagonal),
        }
    }
}

/// An edge's end: its place (row, column, copy) and its point's number.
type End = ((usize, usize, u8), usize);

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::Palette;

    fn lattice(rows: &[&str]) -> Lattice {
        Lattice::new(&Body::parse(rows, &Palette::paper()).unwrap(), &Constants::default())
    }

    fn check(rows: &[&str], points: usize, edges: usize, surface: usize) {
        let lattice = lattice(rows);
        let sides = lattice.voxels().iter().flat_map(|voxel| voxel.surface).filter(|&is_surface| is_surface).count();
        let found = (lattice.points().len(), lattice.edges.len(), sides);
        assert_eq!(found, (points, edges, surface), "{rows:?}");
    }

    #[test]
    fn voxels_share_points_and_edges_with_neighbors() {
        check(&["3"], 4, 6, 4);
        check(&["34", "12"], 9, 20, 8);
        check(&["33333"; 5], 36, 110, 20);
        check(&["333", "303", "333"], 16, 40, 16);
        // Voxels that meet only diagonally have points of their own.
        check(&["30", "03"], 8, 12, 8);
        check(&["30", "33"], 8, 16, 8);
        let twins = lattice(&["30", "03"]);
        let places: Vec<_> = twins.points().iter().filter(|p| (p.column, p.row) == (1, 1)).map(|p| p.copy).collect();
        assert_eq!(places, [0, 1]);
    }

    #[test]
    fn neighbors_that_are_left_apart_have_sides_of_their_own() {
        let without = |width: usize, height: usize, apart: [usize; 2]| {
            let grid = Grid::structure(width, height, &vec![3; width * height]).with_apart([apart]);
            Lattice::of(&[&grid], &Constants::default())
        };
        let counts = |lattice: &Lattice| {
            let doubled = lattice.edges.iter().filter(|edge| edge.doubled).count();
            let strays = lattice.voxels().iter().filter(|voxel| voxel.strays.is_some()).count();
            (lattice.points().len(), lattice.edges.len(), doubled, strays)
        };
        // A slit from below, from the left and from the right ends at a point of all four.
        for apart in [[2, 3], [0, 2], [1, 3]] {
            assert_eq!(counts(&without(2, 2, apart)), (10, 21, 0, 0), "{apart:?}");
        }
        // A slit from above ends at two points, as in Evolution Gym, each of which belongs to a voxel above and to the
        // voxel below the other.
        let slit = without(2, 2, [0, 1]);
        assert_eq!(counts(&slit), (11, 21, 0, 2));
        let [a, b, c, d] = [0, 1, 2, 3].map(|voxel| slit.voxels()[voxel]);
        assert_eq!((a.corners, b.corners), ([0, 1, 3, 2], [4, 5, 7, 6]));
        assert_eq!((c.corners, d.corners), ([2, 6, 9, 8], [3, 7, 10, 9]));
        assert_eq!((c.strays, d.strays), (Some([[2, 3], [2, 8]]), Some([[6, 7], [6, 9]])));
        // So does the lower end of a slit inside a body. The two sides of a level one have the same points.
        assert_eq!(counts(&without(2, 3, [2, 3])), (13, 30, 0, 2));
        assert_eq!(counts(&without(3, 2, [1, 4])), (12, 30, 1, 0));
    }

    #[test]
    fn points_are_numbered_as_voxels_create_them() {
        let two = lattice(&["34", "12"]);
        let places: Vec<_> = two.points().iter().map(|p| (p.column, p.row)).collect();
        assert_eq!(places, [(0, 0), (1, 0), (0, 1), (1, 1), (2, 0), (2, 1), (0, 2), (1, 2), (2, 2)]);
    }

    #[test]
    fn shared_edges_take_the_later_compliant_owner() {
        let stiffness = |rows: &[&str]| {
            let two = lattice(rows);
            let voxel = two.voxels()[1];
            let ends = [voxel.corners[0], voxel.corners[3]];
            let shared = two.edges.iter().find(|e| ends.contains(&e.a) && ends.contains(&e.b)).unwrap();
            shared.stiffness
        };
        assert_eq!(stiffness(&["11"]), 3e8 / 3.5);
        assert_eq!(stiffness(&["12"]), 5e7);
        assert_eq!(stiffness(&["31"]), 6e7);
        assert_eq!(stiffness(&["32"]), 5e7);
        assert_eq!(stiffness(&["23"]), 6e7);
    }
}
