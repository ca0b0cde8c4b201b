//! A body's lattice at rest: its points, its edges with their springs, its surface (docs/physics.md 2 and 3).

use std::collections::{BTreeMap, BTreeSet};

use crate::constants::Constants;
use crate::grid::{DriveAxis, Grid, GridCell};
use nbc_base::model::Body;

/// Corners and sides of a voxel are numbered clockwise: corner 0 top left, 1 top right, 2 bottom right, 3 bottom left;
/// side 0 top, 1 right, 2 bottom, 3 left. So side `i` runs from corner `i` to corner `i + 1`.
pub const CORNERS: usize = 4;

/// The points, edges and voxels of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    width: usize,
    height: usize,
    points: Vec<LatticePoint>,
    edges: Vec<Edge>,
    voxels: Vec<Voxel>,
    driven: Vec<DrivenEdge>,
    fixed: Vec<usize>,
    parts: Vec<LatticePart>,
}

/// An object of its own in a lattice: some of its rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LatticePart {
    /// Its first row of voxels.
    pub top: usize,
    /// Whether any of its voxels is active: only such an object is a robot, and can be unstable (docs/physics.md 1).
    pub active: bool,
}

/// A point of the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LatticePoint {
    /// Columns from the left edge of the body's box.
    pub column: usize,
    /// Rows from the top edge of the body's box.
    pub row: usize,
    /// If two voxels touch only diagonally, each has its own point here: false for the upper, true for the lower
    /// voxel's.
    pub twin: bool,
}

/// An edge between two points, which is a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// One end: a point, by its number.
    pub a: usize,
    /// The other end: a point, by its number.
    pub b: usize,
    /// Built length in meters.
    pub rest: f64,
    /// Stiffness in newtons per meter (docs/physics.md 3).
    pub stiffness: f64,
}

/// A voxel that is not empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Voxel {
    /// The row in the box of the body, 0 on top.
    pub row: usize,
    /// The column in the box of the body, 0 on the left.
    pub column: usize,
    /// The code of its material in the palette of the body.
    pub code: u8,
    /// Whether its material is rigid.
    pub rigid: bool,
    /// The object that it belongs to: the place of a part.
    pub part: usize,
    /// Its points by number: top left, top right, bottom right, bottom left.
    pub corners: [usize; CORNERS],
    /// Whether each side is surface: top, right, bottom, left.
    pub surface: [bool; CORNERS],
}

impl Voxel {
    /// Whether any side is surface.
    pub fn is_surface(&self) -> bool {
        self.surface.contains(&true)
    }
}

/// An edge that one or two active voxels drive (docs/physics.md 4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrivenEdge {
    /// The edge, by its number.
    pub edge: usize,
    /// The channel of the first owner in reading order that drives it; the material code in a body.
    pub first: u16,
    /// The channel of the second, if both do.
    pub second: Option<u16>,
    /// The direction of the edge.
    pub axis: DriveAxis,
}

impl Lattice {
    /// The lattice of a body.
    pub fn new(body: &Body, constants: &Constants) -> Self {
        Self::of(&[&Grid::from(body)], constants)
    }

    /// The lattice of some objects, one below the other in a box, each a part of its own.
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

    /// The edges, ordered by the places of their ends, row by row.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The voxels in reading order.
    pub fn voxels(&self) -> &[Voxel] {
        &self.voxels
    }

    /// The edges that active voxels drive.
    pub fn driven(&self) -> &[DrivenEdge] {
        &self.driven
    }

    /// The points that never move, in order.
    pub fn fixed(&self) -> &[usize] {
        &self.fixed
    }

    /// The objects, from top to bottom; a body is one.
    pub fn parts(&self) -> &[LatticePart] {
        &self.parts
    }

    /// The object that a row of points belongs to.
    pub fn part_of(&self, row: usize) -> usize {
        part_at(&self.parts, row)
    }

    /// The start position of point `point`, in meters, for a body whose left side is `start` voxels from the start of
    /// the ground, rounded as in docs/physics.md 2.
    pub fn start(&self, point: usize, origin: [f64; 2], constants: &Constants) -> [f64; 2] {
        let LatticePoint { column, row, .. } = self.points[point];
        corner(origin, self.height, column, row, constants)
    }
}

/// The part that has a row.
fn part_at(parts: &[LatticePart], row: usize) -> usize {
    parts.partition_point(|part| part.top <= row) - 1
}

/// The start of a lattice point of an object, in meters: of its column and row in the object, whose lower left corner
/// is `origin` voxels from that of the world (docs/physics.md 2).
pub fn corner([left, bottom]: [f64; 2], height: usize, column: usize, row: usize, constants: &Constants) -> [f64; 2] {
    let cell = constants.cell;
    [left * cell + column as f64 * cell, (bottom * cell + height as f64 * cell) - row as f64 * cell]
}

/// Lattice place of a corner relative to its voxel: columns, rows.
const OFFSETS: [(usize, usize); CORNERS] = [(0, 0), (1, 0), (1, 1), (0, 1)];

/// Corners in order of creation: top left, top right, bottom left, bottom right.
const CREATION: [usize; CORNERS] = [0, 1, 3, 2];

/// The neighbour across each side: columns, rows.
const ACROSS: [(isize, isize); CORNERS] = [(0, -1), (1, 0), (0, 1), (-1, 0)];

/// A lattice under construction.
struct Builder<'a> {
    grid: &'a Grid,
    parts: Vec<LatticePart>,
    constants: &'a Constants,
}

/// An edge while its owners are being visited.
struct Draft {
    rest: f64,
    stiffness: f64,
    drivers: Vec<(u16, DriveAxis)>,
}

impl Builder<'_> {
    fn build(self) -> Lattice {
        let (points, voxels) = self.points_and_voxels();
        let drafts = self.drafts(&points, &voxels);
        let mut edges = Vec::with_capacity(drafts.len());
        let mut driven = Vec::new();
        for ((a, b), draft) in drafts {
            if let Some(&(first, axis)) = draft.drivers.first() {
                let second = draft.drivers.get(1).map(|&(channel, _)| channel);
                driven.push(DrivenEdge { edge: edges.len(), first, second, axis });
            }
            edges.push(Edge { a: a.1, b: b.1, rest: draft.rest, stiffness: draft.stiffness });
        }
        let holds = |voxel: &&Voxel| self.cell(voxel) == GridCell::Fixed;
        let fixed: BTreeSet<usize> = voxels.iter().filter(holds).flat_map(|voxel| voxel.corners).collect();
        let (width, height, fixed) = (self.grid.width(), self.grid.height(), fixed.into_iter().collect());
        Lattice { width, height, points, edges, voxels, driven, fixed, parts: self.parts }
    }

    fn cell(&self, voxel: &Voxel) -> GridCell {
        self.grid.cell(voxel.row as isize, voxel.column as isize).expect("a voxel is not empty")
    }

    fn occupied(&self, column: isize, row: isize) -> bool {
        self.grid.cell(row, column).is_some()
    }

    /// Whether the lattice point at (column, row) is two points: exactly two voxels around it, diagonal to each other.
    fn is_split(&self, column: usize, row: usize) -> bool {
        let (i, j) = (column as isize, row as isize);
        let falling = [(i - 1, j - 1), (i, j)].map(|(column, row)| self.occupied(column, row));
        let rising = [(i, j - 1), (i - 1, j)].map(|(column, row)| self.occupied(column, row));
        (falling == [true; 2] && rising == [false; 2]) || (falling == [false; 2] && rising == [true; 2])
    }

    fn points_and_voxels(&self) -> (Vec<LatticePoint>, Vec<Voxel>) {
        let mut points = Vec::new();
        let mut voxels = Vec::new();
        let mut numbers = BTreeMap::new();
        for row in 0..self.grid.height() {
            for column in 0..self.grid.width() {
                let Some(cell) = self.grid.cell(row as isize, column as isize) else { continue };
                let mut corners = [0; CORNERS];
                for corner in CREATION {
                    let (i, j) = (column + OFFSETS[corner].0, row + OFFSETS[corner].1);
                    let point = LatticePoint { column: i, row: j, twin: self.is_split(i, j) && j == row };
                    corners[corner] = *numbers.entry(point).or_insert_with(|| {
                        points.push(point);
                        points.len() - 1
                    });
                }
                let surface = ACROSS.map(|(i, j)| !self.occupied(column as isize + i, row as isize + j));
                let (code, rigid) = (self.grid.code(row, column), cell == GridCell::Rigid);
                let part = part_at(&self.parts, row);
                voxels.push(Voxel { row, column, code, rigid, part, corners, surface });
            }
        }
        (points, voxels)
    }

    /// The edges under the places and numbers of their ends. A later voxel in reading order overwrites the stiffness of
    /// a shared main edge unless it is rigid (docs/physics.md 3).
    fn drafts(&self, points: &[LatticePoint], voxels: &[Voxel]) -> BTreeMap<(End, End), Draft> {
        let mut drafts: BTreeMap<(End, End), Draft> = BTreeMap::new();
        let side = self.constants.cell;
        let diagonal = (side * side + side * side).sqrt();
        for voxel in voxels {
            let cell = self.cell(voxel);
            let (main, share) = self.stiffness(cell);
            let end = |corner: usize| {
                let point = points[voxel.corners[corner]];
                ((point.row, point.column, point.twin), voxel.corners[corner])
            };
            let key = |a: usize, b: usize| if end(a) < end(b) { (end(a), end(b)) } else { (end(b), end(a)) };
            for from in 0..CORNERS {
                let draft = drafts.entry(key(from, (from + 1) % CORNERS)).or_insert_with(|| Draft {
                    rest: side,
                    stiffness: self.constants.rigid_stiffness,
                    drivers: Vec::new(),
                });
                if !matches!(cell, GridCell::Rigid | GridCell::Fixed) {
                    draft.stiffness = main;
                }
                if let GridCell::Active { channel, axis } = cell
                    && (from % 2 == 0) == (axis == DriveAxis::Horizontal)
                {
                    draft.drivers.push((channel, axis));
                }
            }
            for (a, b) in [(1, 3), (0, 2)] {
                drafts.insert(key(a, b), Draft { rest: diagonal, stiffness: main * share, drivers: Vec::new() });
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

/// An edge's end: its place (row, column, twin) and its point's number.
type End = ((usize, usize, bool), usize);

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
        let found = (lattice.points().len(), lattice.edges().len(), sides);
        assert_eq!(found, (points, edges, surface), "{rows:?}");
    }

    #[test]
    fn counts() {
        check(&["3"], 4, 6, 4);
        check(&["34", "12"], 9, 20, 8);
        check(&["33333"; 5], 36, 110, 20);
        check(&["333", "303", "333"], 16, 40, 16);
    }

    #[test]
    fn voxels_that_meet_only_diagonally_have_points_of_their_own() {
        check(&["30", "03"], 8, 12, 8);
        check(&["30", "33"], 8, 16, 8);
        let twins = lattice(&["30", "03"]);
        let places: Vec<_> = twins.points().iter().filter(|p| (p.column, p.row) == (1, 1)).map(|p| p.twin).collect();
        assert_eq!(places, [false, true]);
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
            let shared = two.edges().iter().find(|e| ends.contains(&e.a) && ends.contains(&e.b)).unwrap();
            shared.stiffness
        };
        assert_eq!(stiffness(&["11"]), 3e8 / 3.5);
        assert_eq!(stiffness(&["12"]), 5e7);
        assert_eq!(stiffness(&["31"]), 6e7);
        assert_eq!(stiffness(&["32"]), 5e7);
        assert_eq!(stiffness(&["23"]), 6e7);
    }
}
