//! The colors of a picture as a palette. A drawing has few colors, but the edges of its shapes mix them into thousands
//! of shades. The rare ones are replaced by similar ones, which nobody sees, and files become half as large.

use std::cmp::Reverse;
use std::collections::BTreeMap;

const MOST: usize = 256;

pub(super) type Shade = [u8; 4];

pub(super) struct Shades {
    pub(super) palette: Vec<Shade>,
    pub(super) indexed: Vec<u8>,
}

impl Shades {
    pub(super) fn of(pixels: &[Shade]) -> Self {
        let mut counts: BTreeMap<Shade, usize> = BTreeMap::new();
        for run in pixels.chunk_by(|a, b| a == b) {
            *counts.entry(run[0]).or_default() += run.len();
        }
        let mut shades: Vec<Shade> = counts.keys().copied().collect();
        shades.sort_by_key(|shade| Reverse(counts[shade]));
        let palette = palette(&shades);
        let nearest = |shade: Shade| {
            let found = (0..palette.len()).min_by_key(|&place| difference(palette[place], shade));
            found.expect("a picture has pixels") as u8
        };
        let places: BTreeMap<Shade, u8> = shades.into_iter().map(|shade| (shade, nearest(shade))).collect();
        let runs = pixels.chunk_by(|a, b| a == b);
        let indexed = runs.flat_map(|run| std::iter::repeat_n(places[&run[0]], run.len())).collect();
        Self { palette, indexed }
    }
}

/// Colors, the most frequent first, as close together as fits into a palette.
fn palette(shades: &[Shade]) -> Vec<Shade> {
    let (mut low, mut high) = (1, u16::from(u8::MAX));
    let mut found = Vec::new();
    while low <= high {
        let middle = (low + high) / 2;
        match distinct(shades, middle) {
            Some(palette) => {
                found = palette;
                high = middle - 1;
            }
            None => low = middle + 1,
        }
    }
    found
}

fn distinct(shades: &[Shade], least: u16) -> Option<Vec<Shade>> {
    let mut palette: Vec<Shade> = Vec::new();
    for &shade in shades {
        if palette.iter().all(|&known| difference(known, shade) >= least) {
            if palette.len() == MOST {
                return None;
            }
            palette.push(shade);
        }
    }
    Some(palette)
}

fn difference(a: Shade, b: Shade) -> u16 {
    a.into_iter().zip(b).map(|(a, b)| u16::from(a.abs_diff(b))).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colors_are_exact() {
        let pixels: Vec<Shade> = (0..=255).map(|red| [red, 0, 0, 255]).collect();
        let Shades { palette, indexed } = Shades::of(&pixels);
        assert_eq!(indexed.into_iter().map(|place| palette[usize::from(place)]).collect::<Vec<_>>(), pixels);
    }

    #[test]
    fn rare_colors_give_way_to_similar_ones() {
        let rare = (0..1000u32).map(|number| [(number % 250) as u8, (number / 250) as u8 * 40, 9, 255]);
        let pixels: Vec<Shade> = rare.chain([[200, 100, 50, 255]; 1000]).collect();
        let Shades { palette, indexed } = Shades::of(&pixels);
        let shown = indexed.into_iter().map(|place| palette[usize::from(place)]);
        assert!(palette.len() <= MOST && palette.len() > MOST / 2, "{}", palette.len());
        assert_eq!(palette[0], [200, 100, 50, 255], "the most frequent color is exact");
        assert!(shown.zip(pixels).all(|(shown, pixel)| difference(shown, pixel) < 8));
    }
}
