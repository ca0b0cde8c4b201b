//! The appearance of materials in pictures: a color for each, and a mark for materials beyond the paper's eight, so
//! that they can be distinguished without color.

use std::sync::Arc;

use crate::Color;
use crate::color::Scheme;
use crate::element::{Paint, Point};
use crate::svg::Svg;
use nbc_base::model::{Body, Drive, Material, MaterialKind, Palette, Response};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    pub color: Color,
    pub mark: Option<Mark>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    pub ink: Color,
    /// Polygons in the unit square of a voxel: x to the right, y down.
    pub polygons: &'static [&'static [Point]],
}

/// Equal materials look alike in all bodies of the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Looks {
    palettes: Vec<Arc<Palette>>,
    materials: Vec<(Material, Look)>,
}

const HUES: [Color; 12] = [
    Color::new(148, 103, 189),
    Color::new(140, 86, 75),
    Color::new(227, 119, 194),
    Color::new(188, 189, 34),
    Color::new(23, 190, 207),
    Color::new(31, 119, 180),
    Color::new(255, 127, 14),
    Color::new(44, 160, 44),
    Color::new(214, 39, 40),
    Color::new(102, 102, 204),
    Color::new(176, 122, 60),
    Color::new(90, 140, 110),
];

const SHAPES: [&[&[Point]]; 12] = [
    &[&[(0.34, 0.34), (0.66, 0.34), (0.66, 0.66), (0.34, 0.66)]],
    &[&[(0.15, 0.4), (0.85, 0.4), (0.85, 0.6), (0.15, 0.6)]],
    &[&[(0.4, 0.15), (0.6, 0.15), (0.6, 0.85), (0.4, 0.85)]],
    &[&[(0.15, 0.15), (0.35, 0.15), (0.85, 0.65), (0.85, 0.85), (0.65, 0.85), (0.15, 0.35)]],
    &[&[(0.85, 0.15), (0.65, 0.15), (0.15, 0.65), (0.15, 0.85), (0.35, 0.85), (0.85, 0.35)]],
    &[
        &[(0.15, 0.42), (0.85, 0.42), (0.85, 0.58), (0.15, 0.58)],
        &[(0.42, 0.15), (0.58, 0.15), (0.58, 0.85), (0.42, 0.85)],
    ],
    &[&[(0.12, 0.2), (0.2, 0.12), (0.88, 0.8), (0.8, 0.88)], &[(0.88, 0.2), (0.8, 0.12), (0.12, 0.8), (0.2, 0.88)]],
    &[
        &[(0.15, 0.22), (0.85, 0.22), (0.85, 0.38), (0.15, 0.38)],
        &[(0.15, 0.62), (0.85, 0.62), (0.85, 0.78), (0.15, 0.78)],
    ],
    &[
        &[(0.22, 0.15), (0.38, 0.15), (0.38, 0.85), (0.22, 0.85)],
        &[(0.62, 0.15), (0.78, 0.15), (0.78, 0.85), (0.62, 0.85)],
    ],
    &[&[(0.5, 0.2), (0.82, 0.78), (0.18, 0.78)]],
    &[&[(0.5, 0.8), (0.82, 0.22), (0.18, 0.22)]],
    &[
        &[(0.14, 0.14), (0.36, 0.14), (0.36, 0.36), (0.14, 0.36)],
        &[(0.64, 0.14), (0.86, 0.14), (0.86, 0.36), (0.64, 0.36)],
        &[(0.14, 0.64), (0.36, 0.64), (0.36, 0.86), (0.14, 0.86)],
        &[(0.64, 0.64), (0.86, 0.64), (0.86, 0.86), (0.64, 0.86)],
    ],
];

impl Look {
    /// The `i`-th material that is not the paper's. The series is longer than a palette, and then starts again.
    fn beyond(i: usize) -> Self {
        let hue = HUES[i % HUES.len()];
        let (color, ink) = match i / SHAPES.len() % 3 {
            0 => (hue.mix(Color::WHITE, 0.55), Color::BLACK),
            1 => (hue, Color::WHITE),
            _ => (hue.mix(Color::BLACK, 0.65), Color::WHITE.mix(hue, 0.2)),
        };
        Self { color, mark: Some(Mark { ink, polygons: SHAPES[i % SHAPES.len()] }) }
    }
}

impl Looks {
    pub fn of<'a>(bodies: impl IntoIterator<Item = &'a Body>, scheme: Scheme) -> Self {
        Self::of_palettes(bodies.into_iter().map(Body::palette), scheme)
    }

    pub fn of_palettes<'a>(palettes: impl IntoIterator<Item = &'a Arc<Palette>>, scheme: Scheme) -> Self {
        let mut looks = Self { palettes: Vec::new(), materials: Vec::new() };
        for palette in palettes {
            if looks.palettes.contains(palette) {
                continue;
            }
            looks.palettes.push(Arc::clone(palette));
            for material in palette.materials() {
                if looks.materials.iter().all(|(known, _)| known != material) {
                    let own = looks.materials.iter().filter(|(_, look)| look.mark.is_some()).count();
                    let paper = |code| Look { color: scheme.color(code), mark: None };
                    let look = material.paper_code().map_or_else(|| Look::beyond(own), paper);
                    looks.materials.push((material.clone(), look));
                }
            }
        }
        looks
    }

    /// Panics when the code is empty, or the palette is not one of the picture's.
    pub fn look(&self, palette: &Palette, code: u8) -> Look {
        self.materials[self.index(palette, code)].1
    }

    pub fn index(&self, palette: &Palette, code: u8) -> usize {
        let material = palette.material(code).expect("voxels are not empty");
        self.materials.iter().position(|(known, _)| known == material).expect("the picture knows its palettes")
    }

    pub fn all(&self) -> impl Iterator<Item = (&Material, Look)> {
        self.materials.iter().map(|(material, look)| (material, *look))
    }

    pub fn legend<'a>(&self, bodies: impl IntoIterator<Item = &'a Body>) -> Vec<(Look, String)> {
        let mut entries: Vec<(usize, String)> = Vec::new();
        for body in bodies {
            for (code, material) in body.materials() {
                let index = self.index(body.palette(), code);
                // If palettes differ, a code may have two meanings.
                let number = if self.palettes.len() == 1 { format!("{} ", code_digit(code)) } else { String::new() };
                let entry = (index, format!("{number}{}", describe_material(material)));
                if !entries.contains(&entry) {
                    entries.push(entry);
                }
            }
        }
        entries.sort();
        entries.into_iter().map(|(index, text)| (self.materials[index].1, text)).collect()
    }
}

fn code_digit(code: u8) -> char {
    char::from_digit(code.into(), 36).unwrap_or('?')
}

pub fn describe_material(material: &Material) -> String {
    let name = &material.name;
    if material.paper_code().is_some() {
        return name.clone();
    }
    match material.kind {
        MaterialKind::Rigid => format!("{name}: rigid"),
        MaterialKind::Soft => format!("{name}: soft"),
        MaterialKind::Actuator(Drive { period, phase, low, high }) => {
            format!("{name}: {low}..{high} in {period} steps, {phase}°")
        }
        MaterialKind::Sensor(Response { image: Some(size), absent, present, .. }) => {
            format!("{name}: image of {size}, {absent} to {present}")
        }
        MaterialKind::Sensor(Response { stimulus, absent, present, .. }) => {
            format!("{name}: stimulus {}, {absent} to {present}", stimulus + 1)
        }
    }
}

pub fn material_words(body: &Body) -> Vec<String> {
    body.materials().map(|(code, material)| format!("{} {}", code_digit(code), describe_material(material))).collect()
}

/// Draws a mark on a voxel with these corners, from the top left; `pen` draws a polygon.
pub fn draw_mark(mark: &Mark, corners: &[Point; 4], mut pen: impl FnMut(&[Point], Color)) {
    let [a, b, c, d] = *corners;
    let across = |from: f64, to: f64, share: f64| from + (to - from) * share;
    let place = |&(x, y): &Point| {
        let (top, bottom) = ((across(a.0, b.0, x), across(a.1, b.1, x)), (across(d.0, c.0, x), across(d.1, c.1, x)));
        (across(top.0, bottom.0, y), across(top.1, bottom.1, y))
    };
    for polygon in mark.polygons {
        let placed: Vec<Point> = polygon.iter().map(place).collect();
        pen(&placed, mark.ink);
    }
}

pub fn draw_swatch(svg: &mut Svg, (left, top): Point, side: f64, look: &Look) {
    svg.rect((left, top), side, side, Paint::fill(look.color));
    if let Some(mark) = &look.mark {
        let (right, bottom) = (left + side, top + side);
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
        draw_mark(mark, &corners, |polygon, ink| svg.polygon(polygon, Paint::fill(ink)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirty_five_more_materials_are_distinct_without_color() {
        let lightness = |color: Color| (u32::from(color.r) * 3 + u32::from(color.g) * 6 + u32::from(color.b)) / 10;
        let looks: Vec<Look> = (0..36).map(Look::beyond).collect();
        for (i, look) in looks.iter().enumerate() {
            let mark = look.mark.unwrap();
            assert!(lightness(look.color).abs_diff(lightness(mark.ink)) > 50, "mark {i} stands out");
            for (k, other) in looks[..i].iter().enumerate() {
                let same_shape = mark.polygons == other.mark.unwrap().polygons;
                let apart = lightness(look.color).abs_diff(lightness(other.color));
                assert!(!same_shape || apart > 30, "looks {k} and {i} differ by {apart} in lightness alone");
            }
        }
    }
}
