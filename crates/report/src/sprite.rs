//! Bodies as pictures: voxels in the colors of their materials, alone or side by side with one legend.

use std::sync::Arc;

use crate::Color;
use crate::color::Scheme;
use crate::element::{Anchor, Paint, Point, Type};
use crate::looks::{Look, Looks, draw_mark, draw_swatch};
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

const SIDE: f64 = 84.0;
const PITCH: (f64, f64) = (124.0, 138.0);
const COLUMNS: usize = 8;
const TOP: f64 = 44.0;
const ENTRY: (f64, f64) = (106.0, 124.0);

#[derive(Clone, Debug)]
pub struct Portrait {
    pub title: String,
    pub subtitle: String,
    pub body: Body,
}

pub fn draw_portraits(title: &str, portraits: &[Portrait], scheme: Scheme) -> Svg {
    let columns = COLUMNS.min(portraits.len().max(1));
    let bodies = || portraits.iter().map(|portrait| &portrait.body);
    let looks = Looks::of(bodies(), scheme);
    let legend = looks.legend(bodies());
    let longest = legend.iter().map(|(_, text)| text.chars().count()).max().unwrap_or(0);
    let entry = (columns as f64 * PITCH.0 / legend.len().max(1) as f64).clamp(ENTRY.0, ENTRY.1);
    let entry = entry.max(longest as f64 * LETTER + 26.0);
    let per_line = ((columns as f64 * PITCH.0 / entry) as usize).max(2);
    let legend_height = legend.len().div_ceil(per_line) as f64 * 20.0;
    let width = (columns as f64 * PITCH.0).max(per_line as f64 * entry).max(title.chars().count() as f64 * 10.0) + 28.0;
    let rows = portraits.len().div_ceil(columns) as f64;
    let mut svg = Svg::titled(width, TOP + rows * PITCH.1 + legend_height + 22.0, title);
    let sides = portraits.iter().map(|portrait| portrait.body.width().max(portrait.body.height()));
    let voxel = SIDE / sides.max().unwrap_or(1) as f64;
    for (i, portrait) in portraits.iter().enumerate() {
        let left = 14.0 + (i % columns) as f64 * PITCH.0;
        let top = TOP + (i / columns) as f64 * PITCH.1;
        svg.group(&format!("robot-{i}"), &portrait.title, |svg| draw_one(svg, portrait, &looks, voxel, (left, top)));
    }
    for (i, (look, text)) in legend.iter().enumerate() {
        let left = 14.0 + (i % per_line) as f64 * entry;
        let top = TOP + rows * PITCH.1 + 6.0 + (i / per_line) as f64 * 20.0;
        draw_swatch(&mut svg, (left, top), 12.0, look);
        svg.text((left + 18.0, top + 10.5), text, Type::new(11.0));
    }
    svg
}

fn draw_one(svg: &mut Svg, portrait: &Portrait, looks: &Looks, voxel: f64, (left, top): (f64, f64)) {
    let middle = left + PITCH.0 / 2.0;
    let picture = draw_body(&portrait.body, looks, voxel);
    svg.text((middle, top + 14.0), &portrait.title, Type::new(12.0).bold().anchored(Anchor::Middle));
    let place = (middle - picture.width() / 2.0, top + 22.0 + SIDE + 2.0 - picture.height());
    svg.place(place, 1.0, &picture);
    let small = Type::new(10.0).colored(Color::GRAY).anchored(Anchor::Middle);
    svg.text((middle, top + SIDE + 38.0), &portrait.subtitle, small);
}
