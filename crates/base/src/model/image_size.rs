//! The size of an image.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The numbers of rows and of columns of an image. As data it is a list of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(from = "[usize; 2]", into = "[usize; 2]")]
pub struct ImageSize {
    pub rows: usize,
    pub columns: usize,
}

impl ImageSize {
    pub const MAX_SIDE: usize = 256;

    pub fn new(rows: usize, columns: usize) -> Self {
        Self { rows, columns }
    }

    pub fn pixels(self) -> usize {
        self.rows * self.columns
    }

    pub fn is_valid(self) -> bool {
        [self.rows, self.columns].iter().all(|side| (1..=Self::MAX_SIDE).contains(side))
    }
}

impl fmt::Display for ImageSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} x {}", self.rows, self.columns)
    }
}

impl From<[usize; 2]> for ImageSize {
    fn from([rows, columns]: [usize; 2]) -> Self {
        Self { rows, columns }
    }
}

impl From<ImageSize> for [usize; 2] {
    fn from(size: ImageSize) -> Self {
        [size.rows, size.columns]
    }
}
