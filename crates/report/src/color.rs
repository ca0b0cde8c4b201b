//! Colors that people with any color vision can tell apart.

use std::fmt;

/// A color of the sRGB space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Color {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
}

impl Color {
    /// Paper.
    pub const WHITE: Self = Self::new(255, 255, 255);
    /// Ink.
    pub const BLACK: Self = Self::new(26, 26, 26);
    /// Axes and small print.
    pub const GRAY: Self = Self::new(110, 110, 110);
    /// Grids.
    pub const PALE: Self = Self::new(222, 222, 222);

    /// The ground that robots walk on.
    pub const GROUND: Self = Self::new(120, 104, 88);
    /// The background of robots.
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
    /// The colors of stimuli in all pictures, stimulus 1 first; they start again at their end.
    pub const STIMULI: [Self; 4] = [Self::SERIES[0], Self::SERIES[4], Self::SERIES[3], Self::SERIES[5]];
    /// Outputs, in all pictures.
    pub const OUTPUT: Self = Self::SERIES[2];
    /// Faults, in all pictures.
    pub const FAULT: Self = Self::SERIES[1];

    /// The color of these three parts.
    pub const fn new(r: u8, g: u8, b: u8) -> Self {
        Self { r, g, b }
    }

    /// The `i`-th color of the series, which starts again at its end.
    pub fn series(i: usize) -> Self {
        Self::SERIES[i % Self::SERIES.len()]
    }

    /// The color of stimulus `i`, counted from 0.
    pub fn stimulus(i: usize) -> Self {
        Self::STIMULI[i % Self::STIMULI.len()]
    }

    /// The color of an input of a swarm, counted from 0; it is never that of outputs or of faults.
    pub fn input(i: usize) -> Self {
        const INPUTS: [Color; 5] =
            [Color::SERIES[0], Color::SERIES[4], Color::SERIES[3], Color::SERIES[5], Color::SERIES[6]];
        INPUTS[i % INPUTS.len()]
    }

    /// A mixture with another color: 0 is this one, 1 the other.
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
