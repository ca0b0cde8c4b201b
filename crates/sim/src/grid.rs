//! Voxels as the physics sees them: what robots, packages and terrain are made of (docs/physics.md 1 and 16).

use std::collections::BTreeSet;

use nbc_base::model::{Body, MaterialKind, Response};

/// `channel` is the place of a target width or height; the points of a fixed voxel never move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum GridCell {
    Rigid,
    Soft,
    Active { channel: u16, axis: DriveAxis },
    Fixed,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DriveAxis {
    /// The top and the bottom side are driven.
    Horizontal,
    /// The left and the right side are driven.
    Vertical,
}

/// A rectangle of voxels, row 0 on top.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Grid {
    width: usize,
    height: usize,
    cells: Vec<Option<GridCell>>,
    codes: Vec<u8>,
    channels: usize,
    /// Neighbors that are not joined: their places in reading order, the smaller first.
    apart: BTreeSet<[usize; 2]>,
}

/// The neighbor across each side: columns, rows. Sides are numbered clockwise from the top.
const ACROSS: [[isize; 2]; 4] = [[0, -1], [1, 0], [0, 1], [-1, 0]];

impl Grid {
    /// Evolution Gym's codes, row by row from the top: 0 empty, 1 rigid, 2 soft, 3 horizontal actuator, 4 vertical
    /// actuator, 5 fixed. The actuators' channels are their places in reading order. All neighbors are joined.
    /// Panics when the number of codes is not `width * height`, or a code is above 5.
    pub fn structure(width: usize, height: usize, codes: &[u8]) -> Self {
        assert_eq!(codes.len(), width * height, "a grid has a code for each place");
        let mut channels = 0;
        let mut active = |axis| {
            channels += 1;
            GridCell::Active { channel: channels as u16 - 1, axis }
        };
        let cell = |code: &u8| match code {
            0 => None,
            1 => Some(GridCell::Rigid),
            2 => Some(GridCell::Soft),
            3 => Some(active(DriveAxis::Horizontal)),
            4 => Some(active(DriveAxis::Vertical)),
            5 => Some(GridCell::Fixed),
            _ => panic!("codes are 0 to 5"),
        };
        let cells = codes.iter().map(cell).collect();
        Self { width, height, cells, codes: codes.to_vec(), channels, apart: BTreeSet::new() }
    }

    pub fn with_apart(mut self, pairs: impl IntoIterator<Item = [usize; 2]>) -> Self {
        self.apart.extend(pairs.into_iter().map(|[a, b]| [a.min(b), a.max(b)]));
        self
    }

    pub fn width(&self) -> usize {
        self.width
    }

    pub fn height(&self) -> usize {
        self.height
    }

    pub fn channels(&self) -> usize {
        self.channels
    }

    pub fn cell(&self, row: isize, column: isize) -> Option<GridCell> {
        let is_inside = (0..self.height as isize).contains(&row) && (0..self.width as isize).contains(&column);
        if is_inside { self.cells[row as usize * self.width + column as usize] } else { None }
    }

    /// Whether a voxel is joined to a neighbor across a side: 0 the top, 1 the right, 2 the bottom, 3 the left.
    pub fn is_joined(&self, row: usize, column: usize, side: usize) -> bool {
        let [across, down] = ACROSS[side];
        let (to_row, to_column) = (row as isize + down, column as isize + across);
        if self.cell(row as isize, column as isize).is_none() || self.cell(to_row, to_column).is_none() {
            return false;
        }
        let ends = [row * self.width + column, to_row as usize * self.width + to_column as usize];
        !self.apart.contains(&[ends[0].min(ends[1]), ends[0].max(ends[1])])
    }

    pub fn code(&self, row: usize, column: usize) -> u8 {
        self.codes[row * self.width + column]
    }

    pub fn is_active(&self) -> bool {
        self.cells.iter().any(|cell| matches!(cell, Some(GridCell::Active { .. })))
    }

    pub fn is_fixed(&self) -> bool {
        self.cells.iter().flatten().all(|cell| *cell == GridCell::Fixed)
    }

    /// One below the other, an empty row between, and the first row of each. Channels follow those of the grid above.
    pub fn stack(grids: &[&Grid]) -> (Self, Vec<usize>) {
        let width = grids.iter().map(|grid| grid.width).max().unwrap_or(0);
        let (cells, codes, apart) = (Vec::new(), Vec::new(), BTreeSet::new());
        let mut stack = Self { width, height: 0, cells, codes, channels: 0, apart };
        let mut tops = Vec::with_capacity(grids.len());
        for grid in grids {
            if stack.height > 0 {
                stack.height += 1;
            }
            tops.push(stack.height);
            let place = |at: usize| (stack.height + at / grid.width) * width + at % grid.width;
            let apart: Vec<[usize; 2]> = grid.apart.iter().map(|pair| pair.map(place)).collect();
            stack.apart.extend(apart);
            stack.height += grid.height;
            stack.cells.resize(tops[tops.len() - 1] * width, None);
            stack.codes.resize(stack.cells.len(), 0);
            let later = |cell| match cell {
                GridCell::Active { channel, axis } => {
                    GridCell::Active { channel: channel + stack.channels as u16, axis }
                }
                other => other,
            };
            for (cells, codes) in grid.cells.chunks(grid.width).zip(grid.codes.chunks(grid.width)) {
                stack.cells.extend(cells.iter().map(|cell| cell.map(later)));
                stack.codes.extend(codes);
                let end = stack.cells.len().next_multiple_of(width.max(1));
                stack.cells.resize(end, None);
                stack.codes.resize(end, 0);
            }
            stack.channels += grid.channels;
        }
        (stack, tops)
    }
}

impl Grid {
    /// Row, column and response, in reading order. The channels follow those of the materials.
    pub(crate) fn seeing(body: &Body) -> impl Iterator<Item = ([usize; 2], Response)> + '_ {
        body.codes().iter().enumerate().filter_map(|(at, &code)| match body.palette().kind(code) {
            Some(MaterialKind::Sensor(response)) if response.image.is_some() => {
                Some(([at / body.width(), at % body.width()], response))
            }
            _ => None,
        })
    }
}

impl From<&Body> for Grid {
    /// The channel of an active voxel is its material's code; a voxel that senses an image has one of its own.
    fn from(body: &Body) -> Self {
        let mut channels = body.palette().materials().len() as u16 + 1;
        let mut own = || {
            channels += 1;
            channels - 1
        };
        let cell = |&code: &u8| match body.palette().kind(code) {
            None => None,
            Some(MaterialKind::Rigid) => Some(GridCell::Rigid),
            Some(MaterialKind::Soft) => Some(GridCell::Soft),
            Some(MaterialKind::Sensor(Response { image: Some(_), .. })) => {
                Some(GridCell::Active { channel: own(), axis: DriveAxis::Horizontal })
            }
            Some(MaterialKind::Actuator(_) | MaterialKind::Sensor(_)) => {
                Some(GridCell::Active { channel: u16::from(code), axis: DriveAxis::Horizontal })
            }
        };
        let cells = body.codes().iter().map(cell).collect();
        Self {
            width: body.width(),
            height: body.height(),
            cells,
            codes: body.codes().to_vec(),
            channels: usize::from(channels),
            apart: BTreeSet::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_are_stacked_with_an_empty_row_between() {
        let (one, two) = (Grid::structure(1, 2, &[3, 1]), Grid::structure(2, 1, &[4, 5]));
        let (stack, tops) = Grid::stack(&[&one, &two]);
        assert_eq!((stack.width(), stack.height(), stack.channels(), tops), (2, 4, 2, vec![0, 3]));
        let codes: Vec<u8> = (0..8).map(|at| stack.code(at / 2, at % 2)).collect();
        assert_eq!(codes, [3, 0, 1, 0, 0, 0, 4, 5]);
        assert_eq!(stack.cell(3, 0), Some(GridCell::Active { channel: 1, axis: DriveAxis::Vertical }));
        assert_eq!((stack.cell(2, 0), stack.cell(-1, 0), stack.cell(0, 2)), (None, None, None));
    }

    #[test]
    fn neighbors_that_are_left_apart_stay_so_in_a_stack() {
        let slit = Grid::structure(2, 2, &[3; 4]).with_apart([[1, 0]]);
        let joined =
            |grid: &Grid, row: usize, column: usize| [0, 1, 2, 3].map(|side| grid.is_joined(row, column, side));
        assert_eq!(joined(&slit, 0, 0), [false, false, true, false]);
        assert_eq!(joined(&slit, 1, 0), [true, true, false, false]);
        let (stack, tops) = Grid::stack(&[&Grid::structure(3, 1, &[5; 3]), &slit]);
        assert_eq!(tops, [0, 2]);
        assert_eq!(joined(&stack, 2, 0), [false, false, true, false]);
        assert_eq!(
            (joined(&stack, 2, 1), joined(&stack, 0, 1)),
            ([false, false, true, false], [false, true, false, true])
        );
    }
}
