//! The colors of a film: 255 of them, and for any color the nearest.

use std::collections::BTreeSet;

use crate::Color;
use crate::color::Scheme;
use crate::looks::{Look, Looks};

/// The index that is not a color: the pixel is the same as in the previous frame.
pub const UNCHANGED: u8 = 255;

pub struct Swatches {
    colors: Vec<Color>,
    /// Numbers of the nearest colors, by the five high bits of red, green and blue.
    nearest: Vec<u8>,
}

impl Swatches {
    pub fn new(looks: &Looks, scheme: Scheme, stimuli: usize) -> Self {
        let materials: Vec<Color> = (1..=8).map(|code| scheme.color(code)).collect();
        let own = [
            Color::WHITE,
            Color::BLACK,
            Color::GRAY,
            Color::PALE,
            Color::GROUND,
            Color::SKY,
            Color::stimulus(0),
            Color::stimulus(1),
            Color::FAULT,
        ];
        let further = Color::STIMULI.into_iter().take(stimuli).skip(2);
        let mut colors: Vec<Color> = own.into_iter().chain(further).chain(materials.iter().copied()).collect();
        let partners = [Color::SKY, Color::GROUND, Color::BLACK];
        // Pixels on edges are mixtures with the background.
        for color in materials {
            colors.extend(partners.iter().flat_map(|&other| [0.25, 0.5, 0.75].map(|share| color.mix(other, share))));
        }
        colors.extend((0..=15).map(|level| Color::new(level * 17, level * 17, level * 17)));
        let beyond: Vec<Look> = looks.all().map(|(_, look)| look).filter(|look| look.mark.is_some()).collect();
        // The fewer steps, the more room for the looks of materials beyond the paper's.
        let steps: &[u8] = if beyond.is_empty() { &[0, 63, 127, 191, 255] } else { &[0, 85, 170, 255] };
        let cube = steps
            .iter()
            .flat_map(|&r| steps.iter().flat_map(move |&g| steps.iter().map(move |&b| Color::new(r, g, b))));
        colors.extend(cube);
        for Look { color, mark } in beyond {
            colors.extend([color, color.mix(Color::BLACK, 0.5)]);
            colors.extend(mark.map(|mark| mark.ink));
        }
        let mut seen = BTreeSet::new();
        colors.retain(|&color| looks.all().all(|(_, look)| look.mark.is_none()) || seen.insert(color));
        colors.truncate(usize::from(UNCHANGED));
        let of_key = |key: usize| Color::new(wide(key >> 10), wide(key >> 5), wide(key));
        let mut nearest: Vec<u8> = (0..1 << 15).map(|key| nearest(&colors, of_key(key)) as u8).collect();
        // A color of the list maps to itself; otherwise the nearest, and of equally near ones the first.
        for (i, color) in colors.iter().enumerate().rev() {
            nearest[key(color.r, color.g, color.b)] = i as u8;
        }
        Self { colors, nearest }
    }

    pub fn index(&self, [r, g, b]: [u8; 3]) -> u8 {
        self.nearest[key(r, g, b)]
    }

    pub fn bytes(&self) -> Vec<u8> {
        let unseen = std::iter::repeat_n(Color::BLACK, 256 - self.colors.len());
        self.colors.iter().copied().chain(unseen).flat_map(|color| [color.r, color.g, color.b]).collect()
    }
}

fn key(r: u8, g: u8, b: u8) -> usize {
    usize::from(r >> 3) << 10 | usize::from(g >> 3) << 5 | usize::from(b >> 3)
}

fn wide(bits: usize) -> u8 {
    let five = (bits & 31) as u8;
    five << 3 | five >> 2
}

fn nearest(colors: &[Color], wanted: Color) -> usize {
    let apart = |a: u8, b: u8| (i32::from(a) - i32::from(b)).pow(2);
    let distance = |color: &Color| apart(color.r, wanted.r) + apart(color.g, wanted.g) + apart(color.b, wanted.b);
    (0..colors.len()).min_by_key(|&i| distance(&colors[i])).unwrap_or(0)
}
