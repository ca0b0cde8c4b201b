//! Robots side by side: each body with its names, and one common legend.

use crate::Color;
use crate::element::{Anchor, Type};
use crate::looks::{Looks, draw_swatch};
use crate::scheme::Scheme;
use crate::sprite::{LETTER, draw_body};
use crate::svg::Svg;
use nbc_base::model::Body;

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
    // All stand on one line.
    let place = (middle - picture.width() / 2.0, top + 22.0 + SIDE + 2.0 - picture.height());
    svg.place(place, 1.0, &picture);
    let small = Type::new(10.0).colored(Color::GRAY).anchored(Anchor::Middle);
    svg.text((middle, top + SIDE + 38.0), &portrait.subtitle, small);
}
