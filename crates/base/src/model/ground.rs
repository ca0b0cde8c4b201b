//! The ground that robots stand on, as cells of voxels.

use serde::{Deserialize, Serialize};

/// Which cells of the ground are voxels, column by column (docs/physics.md 15). The columns repeat. The default is one
/// row everywhere, as in the paper's world.
///
/// There are two kinds: heights, whose columns repeat from the left end of the ground to the right, and cells of a
/// file, which repeat around the place where robots start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "GroundShape", into = "GroundShape")]
pub struct GroundProfile {
    /// The rows of each column that are voxels; the bottom row is the lowest bit.
    columns: [u32; GroundProfile::MOST_COLUMNS],
    /// How many columns there are before they repeat; none if all are one voxel high.
    count: u8,
    is_of_file: bool,
}

/// A [`GroundProfile`] as it is written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum GroundShape {
    /// Heights above the lowest column; none if the ground is flat.
    Heights(Vec<u8>),
    /// The rows of a file, the top one first: `#` is a voxel, `.` is none.
    Cells(Vec<String>),
}

impl Default for GroundProfile {
    fn default() -> Self {
        Self { columns: [0; Self::MOST_COLUMNS], count: 0, is_of_file: false }
    }
}

impl GroundProfile {
    pub const MOST_COLUMNS: usize = 128;
    pub const MOST_ROWS: usize = 32;
    pub const MOST_HEIGHTS: usize = 32;
    /// The most voxels by which one height is above another.
    pub const MOST_HEIGHT: u8 = 10;
    /// The column of a file in the middle of the ground, so that robots of up to twelve columns start in the file.
    pub const HOME: usize = 6;

    /// The ground of these heights, of which there are at least one and at most [`Self::MOST_HEIGHTS`], each at most
    /// [`Self::MOST_HEIGHT`]; `None` for others. Only differences matter.
    pub fn new(heights: &[u8]) -> Option<Self> {
        let least = *heights.iter().min()?;
        let is_possible = heights.len() <= Self::MOST_HEIGHTS && heights.iter().all(|at| *at <= Self::MOST_HEIGHT);
        is_possible.then(|| Self::of(heights.iter().map(|at| (2 << (at - least)) - 1), false))
    }

    /// The ground of these columns of a file, each with a bit for every row that is a voxel, the bottom row first.
    /// There are at least one and at most [`Self::MOST_COLUMNS`], and at least one voxel; `None` for others.
    pub fn of_cells(columns: &[u32]) -> Option<Self> {
        let is_possible = columns.len() <= Self::MOST_COLUMNS && columns.iter().any(|rows| *rows != 0);
        is_possible.then(|| Self::of(columns.iter().copied(), true))
    }

    fn of(columns: impl ExactSizeIterator<Item = u32> + Clone, is_of_file: bool) -> Self {
        let mut profile = Self::default();
        if columns.clone().any(|rows| rows != 1) {
            profile.count = columns.len() as u8;
            profile.is_of_file = is_of_file;
            profile.columns.iter_mut().zip(columns).for_each(|(own, rows)| *own = rows);
        }
        profile
    }

    pub fn is_flat(&self) -> bool {
        self.count == 0
    }

    pub fn is_of_file(&self) -> bool {
        self.is_of_file
    }

    /// The rows of each column that are voxels, before the columns repeat; none if it is flat.
    pub fn columns(&self) -> &[u32] {
        &self.columns[..usize::from(self.count)]
    }

    /// The heights of the columns above the lowest; none if it is flat. Gaps below a voxel do not count.
    pub fn heights(&self) -> Vec<u8> {
        self.columns().iter().map(|rows| (top(*rows) as u8).saturating_sub(1)).collect()
    }

    /// The rows of a column that are voxels, counted from the left end of the ground.
    pub fn rows(&self, column: usize) -> u32 {
        if self.is_flat() { 1 } else { self.columns[column % usize::from(self.count)] }
    }

    /// The stretches of voxels without a gap in a column, from below.
    pub fn stretches(&self, column: usize) -> Vec<std::ops::Range<usize>> {
        let rows = u64::from(self.rows(column));
        let mut stretches = Vec::new();
        let mut from = 0;
        while rows >> from != 0 {
            from += (rows >> from).trailing_zeros() as usize;
            let to = from + (rows >> from).trailing_ones() as usize;
            stretches.push(from..to);
            from = to;
        }
        stretches
    }

    /// The rows up to the highest voxel of these columns; one if there are no columns.
    pub fn highest(&self, columns: std::ops::Range<usize>) -> usize {
        columns.map(|column| top(self.rows(column))).max().unwrap_or(1)
    }

    /// The same on ground of that many columns, as columns that repeat from its left end: column [`Self::HOME`] of a
    /// file is then in the middle.
    pub fn on(&self, width: usize) -> Self {
        let mut placed = *self;
        if self.is_of_file {
            let count = usize::from(self.count);
            placed.is_of_file = false;
            placed.columns[..count].rotate_right((width / 2 + count - Self::HOME % count) % count);
        }
        placed
    }
}

/// The rows up to the highest voxel of a column.
fn top(rows: u32) -> usize {
    (u32::BITS - rows.leading_zeros()) as usize
}

impl From<GroundProfile> for GroundShape {
    fn from(profile: GroundProfile) -> Self {
        if !profile.is_of_file {
            return Self::Heights(profile.heights());
        }
        let rows = (0..profile.highest(0..profile.columns().len())).rev();
        let cell = |rows: &u32, row| if rows >> row & 1 == 1 { '#' } else { '.' };
        Self::Cells(rows.map(|row| profile.columns().iter().map(|rows| cell(rows, row)).collect()).collect())
    }
}

impl TryFrom<GroundShape> for GroundProfile {
    type Error = &'static str;

    fn try_from(shape: GroundShape) -> Result<Self, Self::Error> {
        match shape {
            GroundShape::Heights(heights) if heights.is_empty() => Ok(Self::default()),
            GroundShape::Heights(heights) => {
                Self::new(&heights).ok_or("there are too many heights, or one is too large")
            }
            GroundShape::Cells(rows) => cells(&rows).ok_or("expected rows of `#` and `.` of one length, not too many"),
        }
    }
}

fn cells(rows: &[String]) -> Option<GroundProfile> {
    let width = rows.first()?.len();
    if rows.len() > GroundProfile::MOST_ROWS || width > GroundProfile::MOST_COLUMNS {
        return None;
    }
    let mut columns = vec![0; width];
    for row in rows {
        if row.len() != width || row.bytes().any(|cell| cell != b'#' && cell != b'.') {
            return None;
        }
        columns.iter_mut().zip(row.bytes()).for_each(|(rows, cell)| *rows = *rows << 1 | u32::from(cell == b'#'));
    }
    GroundProfile::of_cells(&columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ground_repeats_and_begins_at_its_lowest_place() {
        let ground = GroundProfile::new(&[3, 2, 5]).unwrap();
        assert_eq!((0..7).map(|column| ground.rows(column)).collect::<Vec<_>>(), [3, 1, 15, 3, 1, 15, 3]);
        assert_eq!((ground.highest(3..5), ground.highest(4..6), ground.highest(2..2)), (2, 4, 1));
        assert_eq!((ground.heights(), ground.on(500)), (vec![1, 0, 3], ground));
        assert!(GroundProfile::new(&[4, 4]).unwrap().is_flat() && !ground.is_flat());
        assert_eq!([GroundProfile::new(&[]), GroundProfile::new(&[11]), GroundProfile::new(&[0; 33])], [None; 3]);
    }

    #[test]
    fn a_file_is_around_the_middle_of_the_ground() {
        let columns: Vec<u32> = (0..9).map(|column| 1 + 2 * column).collect();
        let ground = GroundProfile::of_cells(&columns).unwrap();
        for width in [4, 500, 501, 512] {
            let placed = ground.on(width);
            let around = |column: usize| placed.rows(width / 2 + 9 + column - GroundProfile::HOME);
            assert_eq!((0..9).map(around).collect::<Vec<_>>(), columns, "{width}");
            assert_eq!(placed.on(width), placed);
        }
        assert!(
            GroundProfile::of_cells(&[1; 9]).unwrap().is_flat() && !GroundProfile::of_cells(&[3]).unwrap().is_flat()
        );
        assert_eq!([&[][..], &[0, 0], &[1; 129]].map(GroundProfile::of_cells), [None; 3]);
    }

    #[test]
    fn cells_are_written_as_rows() {
        let ground = GroundProfile::of_cells(&[0b001, 0b101, 0b000]).unwrap();
        let ends = |column| ground.stretches(column).iter().map(|rows| [rows.start, rows.end]).collect::<Vec<_>>();
        assert_eq!([0, 1, 2].map(ends), [vec![[0, 1]], vec![[0, 1], [2, 3]], vec![]]);
        assert_eq!(GroundProfile::of_cells(&[!0]).unwrap().stretches(0)[0].len(), 32);
        let text = serde_json::to_string(&ground).unwrap();
        assert_eq!(text, r###"[".#.","...","##."]"###);
        assert_eq!(serde_json::from_str::<GroundProfile>(&text).unwrap(), ground);
        for wrong in [r#"[""]"#, r###"["#","##"]"###, r#"["x"]"#, r#"["."]"#] {
            assert!(serde_json::from_str::<GroundProfile>(wrong).is_err(), "{wrong}");
        }
    }
}
