//! Colors that people with any color vision can tell apart, and the color schemes of the paper's materials.

use std::fmt;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Color {
    pub r: u8,
    pub g: u8,
    pub b: u8,
}

impl Color {
    pub const WHITE: Self = Self::new(255, 255, 255);
    pub const BLACK: Self = Self::new(26, 26, 26);
    pub const GRAY: Self = Self::new(110, 110, 110);
    pub const PALE: Self = Self::new(222, 222, 222);

    pub const GROUND: Self = Self::new(120, 104, 88);
    pub const SKY: Self = Self::new(250, 250, 247);

    /// The series of Okabe and Ito: blue, vermilion, bluish green, reddish purple, orange, sky blue, yellow.
    pub const SERIES: [Self; 7] = [
        Self::new(0, 114, 178),
        Self::new(213, 94, 0),
        Self::new(0, 158, 115),
        Self::new(204, 121, 167),
        Self::new(230, 159, 0),
        Self::new(86, 180, 233),
        Self::new(240, 228, 66),
    ];
    pub const STIMULI: [Self; 4] = [Self::SERIES[0], Self::SERIES[4], Self::SERIES[3], Self::SERIES[5]];
    pub const OUTPUT: Self = Self::SERIES[2];
    pub const FAULT: Self = Self::SERIES[1];

    pub const fn new(r: u8, g: u8, b: u8) -> Self {
        Self { r, g, b }
    }

    pub fn series(i: usize) -> Self {
        Self::SERIES[i % Self::SERIES.len()]
    }

    pub fn stimulus(i: usize) -> Self {
        Self::STIMULI[i % Self::STIMULI.len()]
    }

    /// The color of an input of a swarm; never that of outputs or of faults.
    pub fn input(i: usize) -> Self {
        const INPUTS: [Color; 5] =
            [Color::SERIES[0], Color::SERIES[4], Color::SERIES[3], Color::SERIES[5], Color::SERIES[6]];
        INPUTS[i % INPUTS.len()]
    }

    /// 0 is this color, 1 the other.
    pub fn mix(self, other: Self, share: f64) -> Self {
        let part = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * share.clamp(0.0, 1.0)).round() as u8;
        Self::new(part(self.r, other.r), part(self.g, other.g), part(self.b, other.b))
    }
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.r, self.g, self.b)
    }
}

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
