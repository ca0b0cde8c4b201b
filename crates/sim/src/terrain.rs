//! Terrain: objects of which every voxel is fixed (docs/physics.md 16).

use nalgebra::Vector2;

use crate::constants::Constants;
use crate::grid::Grid;
use crate::lattice::{CORNERS, corner};
use nbc_base::model::GroundProfile;

/// Voxels that never move. Each fills a cell of the world, numbered from the lower left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Terrain {
    /// Those at a surface, by object and then in reading order.
    pub voxels: Vec<TerrainVoxel>,
    columns: usize,
    /// For each cell row by row from below, the number of its voxel plus one, or zero.
    cells: Vec<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TerrainVoxel {
    /// Top left, top right, bottom right, bottom left, in meters.
    pub corners: [Vector2<f64>; CORNERS],
    /// Which sides are surface: top, right, bottom, left.
    pub surface: [bool; CORNERS],
}

impl Terrain {
    pub fn new<'a>(objects: impl IntoIterator<Item = (&'a Grid, [usize; 2])>, constants: &Constants) -> Self {
        let mut placed: Vec<([usize; 2], TerrainVoxel)> = Vec::new();
        let (mut columns, mut rows) = (0, 0);
        for (grid, [left, bottom]) in objects {
            (columns, rows) = (columns.max(left + grid.width()), rows.max(bottom + grid.height()));
            for row in 0..grid.height() {
                for column in 0..grid.width() {
                    let surface = [0, 1, 2, 3].map(|side| !grid.is_joined(row, column, side));
                    if grid.cell(row as isize, column as isize).is_some() && surface.contains(&true) {
                        let voxel =
                            TerrainVoxel { corners: corners(grid, [left, bottom], row, column, constants), surface };
                        placed.push(([left + column, bottom + grid.height() - 1 - row], voxel));
                    }
                }
            }
        }
        let mut cells = vec![0; columns * rows];
        for (n, ([column, row], _)) in placed.iter().enumerate() {
            cells[row * columns + column] = n as u32 + 1;
        }
        Self { voxels: placed.into_iter().map(|(_, voxel)| voxel).collect(), columns, cells }
    }

    pub fn ground(columns: usize, profile: &GroundProfile, constants: &Constants) -> Self {
        let rows = profile.highest(0..columns.min(GroundProfile::MOST_COLUMNS));
        let is_there = |row: usize, column: usize| profile.rows(column) >> (rows - 1 - row) & 1 == 1;
        let code = |at: usize| if is_there(at / columns, at % columns) { 5 } else { 0 };
        let codes: Vec<u8> = (0..rows * columns).map(code).collect();
        Self::new([(&Grid::structure(columns, rows, &codes), [0, 0])], constants)
    }

    /// Calls `found` with the number of each voxel in a cell that overlaps a box in meters, row by row from below.
    pub fn each_near(&self, least: [f64; 2], greatest: [f64; 2], cell: f64, mut found: impl FnMut(usize)) {
        if self.columns == 0 {
            return;
        }
        let rows = self.cells.len() / self.columns;
        let range = |axis: usize, count: usize| {
            let from = (least[axis] / cell).floor().clamp(0.0, count as f64) as usize;
            // A box that is not a number is near nothing.
            let to = ((greatest[axis] / cell).floor() + 1.0).clamp(0.0, count as f64) as usize;
            from..to
        };
        for row in range(1, rows) {
            for column in range(0, self.columns) {
                if let Some(voxel) = self.cells[row * self.columns + column].checked_sub(1) {
                    found(voxel as usize);
                }
            }
        }
    }
}

fn corners(
    grid: &Grid,
    [left, bottom]: [usize; 2],
    row: usize,
    column: usize,
    constants: &Constants,
) -> [Vector2<f64>; CORNERS] {
    let point = |i: usize, j: usize| {
        let [x, y] = corner([left as f64, bottom as f64], grid.height(), column + i, row + j, constants);
        Vector2::new(x, y)
    };
    [point(0, 0), point(1, 0), point(1, 1), point(0, 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voxels_are_found_by_their_cells() {
        let (low, high) = (Grid::structure(3, 1, &[5, 5, 5]), Grid::structure(2, 2, &[5, 0, 5, 5]));
        let terrain = Terrain::new([(&low, [0, 0]), (&high, [3, 1])], &Constants::default());
        let near = |least: [f64; 2], greatest: [f64; 2]| {
            let mut found = Vec::new();
            terrain.each_near(least, greatest, 0.1, |voxel| found.push(voxel));
            found
        };
        assert_eq!(near([0.05, 0.05], [0.15, 0.25]), [0, 1]);
        assert_eq!(near([-9.0, -9.0], [9.0, 9.0]), [0, 1, 2, 4, 5, 3]);
        assert_eq!(near([f64::NAN; 2], [f64::NAN; 2]), [0usize; 0]);
        let tower = terrain.voxels[3];
        assert_eq!((tower.surface, tower.corners[0].y), ([true, true, false, true], (0.1 + 2.0 * 0.1) - 0.0));
    }
}
