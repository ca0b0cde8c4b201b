//! Bodies: rectangles of voxels.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{BodyError, Material, Palette};

/// Actuators that an evolved body must have (docs/physics.md 11).
pub const LEAST_ACTUATORS: usize = 3;

/// A body: `height` rows of `width` material codes, row 0 on top, and the palette that defines the codes; code 0 is
/// empty (docs/physics.md 1).
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Body {
    width: usize,
    height: usize,
    codes: Vec<u8>,
    // Compared last, because bodies in one batch usually share it.
    palette: Arc<Palette>,
}

#[derive(Serialize, Deserialize)]
struct Written(Vec<String>, Arc<Palette>);

impl From<Body> for Written {
    fn from(body: Body) -> Self {
        Self(body.rows(), body.palette)
    }
}

impl TryFrom<Written> for Body {
    type Error = BodyError;

    fn try_from(Written(rows, palette): Written) -> Result<Self, BodyError> {
        Self::parse(&rows, &palette)
    }
}

impl Body {
    pub const MAX_SIDE: usize = 100;

    pub fn new(width: usize, height: usize, codes: Vec<u8>, palette: Arc<Palette>) -> Self {
        assert_eq!(codes.len(), width * height, "a body has a code for each place");
        let known = |&code: &u8| usize::from(code) <= palette.materials().len();
        assert!(codes.iter().all(known), "a body's codes are of its palette");
        Self { width, height, codes, palette }
    }

    pub fn from_codes(width: usize, height: usize, codes: &[u8], palette: &Arc<Palette>) -> Result<Self, BodyError> {
        if width > Self::MAX_SIDE || height > Self::MAX_SIDE {
            return Err(BodyError::TooLarge { width, height, most: Self::MAX_SIDE });
        }
        let highest = palette.materials().len() as u8;
        if let Some(place) = codes.iter().position(|&code| code > highest) {
            let (row, column) = (place / width + 1, place % width + 1);
            return Err(BodyError::CodeRange { row, column, code: codes[place], highest });
        }
        if codes.iter().all(|&code| code == 0) {
            return Err(BodyError::Empty);
        }
        Ok(Self::new(width, height, codes.to_vec(), Arc::clone(palette)))
    }

    /// A square body of the paper's eight materials in turn, for measurements of speed.
    pub fn patchwork(side: usize, shift: usize) -> Self {
        const TURN: [u8; 9] = [3, 4, 2, 7, 6, 1, 5, 8, 3];
        let codes = (0..side * side).map(|i| TURN[(i + i / side + shift) % TURN.len()]).collect();
        Self::new(side, side, codes, Palette::paper())
    }

    /// Reads rows of codes of a palette, top row first: a digit or lower-case letter for each voxel.
    pub fn parse<S: AsRef<str>>(rows: &[S], palette: &Arc<Palette>) -> Result<Self, BodyError> {
        let materials = palette.materials().len();
        let expected = rows.first().map_or(0, |row| row.as_ref().chars().count());
        if expected == 0 {
            return Err(BodyError::Empty);
        }
        if expected > Self::MAX_SIDE || rows.len() > Self::MAX_SIDE {
            return Err(BodyError::TooLarge { width: expected, height: rows.len(), most: Self::MAX_SIDE });
        }
        let mut codes = Vec::with_capacity(expected * rows.len());
        for (r, row) in rows.iter().enumerate() {
            let found = row.as_ref().chars().count();
            if found != expected {
                return Err(BodyError::Ragged { row: r + 1, found, expected });
            }
            for (c, digit) in row.as_ref().chars().enumerate() {
                codes.push(parse_code(digit, materials).ok_or(BodyError::UnknownCode {
                    row: r + 1,
                    column: c + 1,
                    digit,
                    highest: code_digit(materials as u8),
                })?);
            }
        }
        if codes.iter().all(|&code| code == 0) {
            return Err(BodyError::Empty);
        }
        Ok(Self { width: expected, height: rows.len(), codes, palette: Arc::clone(palette) })
    }

    pub fn width(&self) -> usize {
        self.width
    }

    pub fn height(&self) -> usize {
        self.height
    }

    pub fn code(&self, row: usize, column: usize) -> u8 {
        assert!(column < self.width, "column inside the body");
        self.codes[row * self.width + column]
    }

    pub fn codes(&self) -> &[u8] {
        &self.codes
    }

    /// Its materials, unless they are the paper's.
    pub fn own_materials(&self) -> Option<Arc<Palette>> {
        Some(self.palette()).filter(|palette| !palette.is_paper()).cloned()
    }

    pub fn palette(&self) -> &Arc<Palette> {
        &self.palette
    }

    /// The materials that occur in the body, each with its code, in order of the codes.
    pub fn materials(&self) -> impl Iterator<Item = (u8, &Material)> {
        (1..).zip(self.palette.materials()).filter(|(code, _)| self.codes.contains(code))
    }

    pub fn rows(&self) -> Vec<String> {
        self.codes.chunks(self.width).map(|row| row.iter().map(|&code| code_digit(code)).collect()).collect()
    }

    pub fn mirrored(&self) -> Self {
        let codes = self.codes.chunks(self.width).flat_map(|row| row.iter().rev().copied()).collect();
        Self { codes, ..self.clone() }
    }

    pub fn recoded(&self, to: impl Fn(u8) -> u8) -> Self {
        let codes = self.codes.iter().map(|&code| to(code)).collect();
        Self::new(self.width, self.height, codes, Arc::clone(&self.palette))
    }

    /// Whether the body has a voxel and all its voxels are connected through their sides.
    pub fn is_connected(&self) -> bool {
        let Some(first) = self.codes.iter().position(|&code| code > 0) else { return false };
        let mut reached = vec![false; self.codes.len()];
        let mut open = vec![first];
        reached[first] = true;
        while let Some(at) = open.pop() {
            let (row, column) = (at / self.width, at % self.width);
            let beside = [
                (row > 0).then(|| at - self.width),
                (row + 1 < self.height).then(|| at + self.width),
                (column > 0).then(|| at - 1),
                (column + 1 < self.width).then(|| at + 1),
            ];
            for next in beside.into_iter().flatten() {
                if self.codes[next] > 0 && !reached[next] {
                    reached[next] = true;
                    open.push(next);
                }
            }
        }
        self.codes.iter().zip(&reached).all(|(&code, &reached)| code == 0 || reached)
    }
}

fn code_digit(code: u8) -> char {
    char::from_digit(u32::from(code), 36).expect("codes stay below 36")
}

fn parse_code(digit: char, materials: usize) -> Option<u8> {
    let code = digit.to_digit(36).filter(|_| !digit.is_ascii_uppercase())?;
    (code as usize <= materials).then_some(code as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(rows: &[&str], expected: Result<&[&str], &str>) {
        let found = Body::parse(rows, &Palette::paper()).map(|body| body.rows()).map_err(|error| error.to_string());
        assert_eq!(found, expected.map(|rows| rows.iter().map(|row| row.to_string()).collect()).map_err(str::to_owned));
    }

    #[test]
    fn rows_round_trip() {
        check(&["00345", "33333"], Ok(&["00345", "33333"]));
    }

    #[test]
    fn invalid_rows_are_reported() {
        check(&[], Err("the body has no voxels"));
        check(&["000", "000"], Err("the body has no voxels"));
        check(&["33", "3"], Err("row 2 has 1 voxel, expected 2 as in row 1"));
        check(&["39"], Err("row 1, column 2: `9` is not a material code; expected 0 to 8"));
    }

    #[test]
    fn invalid_codes_are_reported() {
        let check = |width: usize, height: usize, codes: &[u8], expected: &str| {
            let found = Body::from_codes(width, height, codes, &Palette::paper()).map_err(|error| error.to_string());
            assert_eq!(found, Err(expected.to_owned()));
        };
        check(2, 1, &[0, 0], "the body has no voxels");
        check(0, 0, &[], "the body has no voxels");
        check(2, 2, &[3, 3, 3, 200], "row 2, column 2: 200 is not a material code; expected 0 to 8");
        check(101, 1, &[3; 101], "the body is 101 x 1, expected at most 100 x 100");
        let codes = Body::parse(&["012", "345"], &Palette::paper()).unwrap();
        assert_eq!(Body::from_codes(3, 2, &[0, 1, 2, 3, 4, 5], &Palette::paper()), Ok(codes));
    }

    #[test]
    fn diagonal_voxels_are_not_connected() {
        assert!(!Body::parse(&["30", "03"], &Palette::paper()).unwrap().is_connected());
        assert!(Body::parse(&["30", "33"], &Palette::paper()).unwrap().is_connected());
    }

    #[test]
    fn a_mirror_image_of_a_mirror_image_is_the_body() {
        let body = Body::parse(&["012", "345"], &Palette::paper()).unwrap();
        assert_eq!(body.mirrored().rows(), ["210", "543"]);
        assert_eq!(body.mirrored().mirrored(), body);
    }
}
