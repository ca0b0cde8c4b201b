//! Bodies as pictures: voxels in the colors of their materials.

use std::sync::Arc;

use crate::Color;
use crate::element::{Paint, Point, Type};
use crate::looks::{Look, Looks, draw_mark, draw_swatch};
use crate::scheme::Scheme;
use crate::svg::Svg;
use nbc_base::model::{Body, Palette, Robot};

pub const LETTER: f64 = 6.2;

/// A body at one moment: the corners of its voxels in voxels, y upwards, and their material codes.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    /// Each voxel's corners, in order around it from the top left, and its code.
    pub voxels: Vec<([Point; 4], u8)>,
    pub palette: Arc<Palette>,
}

impl Pose {
    /// A body at rest, its box's lower left corner at the origin.
    pub fn at_rest(body: &Body) -> Self {
        let voxel = |row: usize, column: usize| {
            let (left, top) = (column as f64, (body.height() - row) as f64);
            [(left, top), (left + 1.0, top), (left + 1.0, top - 1.0), (left, top - 1.0)]
        };
        let places = (0..body.height()).flat_map(|row| (0..body.width()).map(move |column| (row, column)));
        let filled = places.filter(|&(row, column)| body.code(row, column) > 0);
        let voxels = filled.map(|(row, column)| (voxel(row, column), body.code(row, column))).collect();
        Self { voxels, palette: Arc::clone(body.palette()) }
    }

    /// `to_pixel` maps a point of the world to the picture.
    pub fn draw(&self, svg: &mut Svg, looks: &Looks, opacity: f64, to_pixel: impl Fn(Point) -> Point) {
        let faded = |paint: Paint| if opacity < 1.0 { paint.with_opacity(opacity) } else { paint };
        for (corners, code) in &self.voxels {
            let Look { color, mark } = looks.look(&self.palette, *code);
            let corners = corners.map(&to_pixel);
            svg.polygon(&corners, faded(Paint::fill(color).with_stroke(color.mix(Color::BLACK, 0.35), 0.7)));
            if let Some(mark) = mark {
                draw_mark(&mark, &corners, |polygon, ink| svg.polygon(polygon, faded(Paint::fill(ink))));
            }
        }
    }
}

/// Only the body, with `voxel` pixels for each voxel's side, on a transparent background.
pub fn draw_body(body: &Body, looks: &Looks, voxel: f64) -> Svg {
    let (width, height) = (body.width() as f64 * voxel, body.height() as f64 * voxel);
    let mut svg = Svg::transparent(width + 2.0, height + 2.0, "a robot's body");
    let to_pixel = |(x, y): Point| (1.0 + x * voxel, 1.0 + height - y * voxel);
    Pose::at_rest(body).draw(&mut svg, looks, 1.0, to_pixel);
    svg
}

pub fn draw_sprite(robot: &Robot, scheme: Scheme) -> Svg {
    let title = format!("{}: {}, {}", robot.name, robot.function(), robot.behavior);
    draw_portrait(&title, &robot.body, scheme)
}

/// A body with a title and the names of its materials.
pub fn draw_portrait(title: &str, body: &Body, scheme: Scheme) -> Svg {
    let voxel = 24.0;
    let looks = Looks::of([body], scheme);
    let picture = draw_body(body, &looks, voxel);
    let legend_left = 20.0 + picture.width() + 24.0;
    let (wide, high) = legend_size(&looks, body);
    let height = (56.0 + picture.height() + 16.0).max(60.0 + high);
    let width = (legend_left + wide).max(28.0 + title.chars().count() as f64 * 9.5);
    let mut svg = Svg::new(width, height, title);
    svg.text((20.0, 30.0), title, Type::new(14.0).bold());
    svg.place((20.0, 48.0), 1.0, &picture);
    draw_legend(&mut svg, (legend_left, 49.0), body, &looks);
    svg
}

pub fn legend_size(looks: &Looks, body: &Body) -> Point {
    let entries = looks.legend([body]);
    let longest = entries.iter().map(|(_, text)| text.chars().count()).max().unwrap_or(0);
    ((longest as f64 * LETTER + 28.0).max(130.0), entries.len() as f64 * 20.0)
}

pub fn draw_legend(svg: &mut Svg, (left, top): Point, body: &Body, looks: &Looks) {
    for (i, (look, text)) in looks.legend([body]).iter().enumerate() {
        let top = top + i as f64 * 20.0;
        draw_swatch(svg, (left, top), 13.0, look);
        svg.text((left + 20.0, top + 11.0), text, Type::new(11.0));
    }
}
