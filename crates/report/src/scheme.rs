//! Color schemes of the paper's materials.

use crate::Color;

/// The colors of materials.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scheme {
    /// The paper's (paper, Methods): black, gray, orange, teal, red, blue, green, magenta.
    #[default]
    Paper,
    /// Colors that people with any color vision can tell apart.
    Safe,
}

const PAPER: [Color; 8] = [
    Color::new(38, 38, 38),
    Color::new(190, 190, 190),
    Color::new(255, 152, 41),
    Color::new(41, 176, 176),
    Color::new(214, 48, 49),
    Color::new(52, 94, 214),
    Color::new(62, 168, 70),
    Color::new(205, 66, 190),
];

const SAFE: [Color; 8] = [
    Color::new(0, 0, 0),
    Color::new(215, 215, 215),
    Color::new(230, 159, 0),
    Color::new(86, 180, 233),
    Color::new(213, 94, 0),
    Color::new(0, 114, 178),
    Color::new(0, 158, 115),
    Color::new(204, 121, 167),
];

impl Scheme {
    pub fn color(self, code: u8) -> Color {
        let colors = match self {
            Self::Paper => &PAPER,
            Self::Safe => &SAFE,
        };
        colors[usize::from(code) - 1]
    }
}
