//! What a body needs of images: a map of how much less far it walks when each pixel is covered.

use crate::Color;
use crate::color::Scheme;
use crate::element::{Paint, Point, Type};
use crate::image::{draw_pixels, ink};
use crate::looks::Looks;
use crate::sprite::{draw_body, draw_legend, legend_size};
use crate::svg::Svg;
use nbc_base::model::{Body, ImageSize};

const VOXEL: f64 = 24.0;
const GAP: f64 = 28.0;
const TOP: f64 = 78.0;

pub struct OcclusionMap<'a> {
    pub title: &'a str,
    pub body: &'a Body,
    pub size: ImageSize,
    /// How much less far the body walks when a pixel is covered, in voxels; none where no voxel senses it.
    pub losses: &'a [Option<f64>],
    pub sets: &'a [(String, Vec<f64>)],
}

pub fn draw_occlusion(map: &OcclusionMap<'_>, scheme: Scheme) -> Svg {
    let OcclusionMap { title, body, size, losses, sets } = *map;
    let looks = Looks::of([body], scheme);
    let picture = draw_body(body, &looks, VOXEL);
    let (wide, high) = (size.columns as f64 * VOXEL, size.rows as f64 * VOXEL);
    let legend = legend_size(&looks, body);
    let maps = 1 + sets.len();
    let legend_left = GAP + picture.width() + GAP + maps as f64 * (wide + GAP);
    let width = (legend_left + legend.0 + 10.0).max(28.0 + title.chars().count() as f64 * 9.5);
    let height = (TOP + picture.height().max(high) + 58.0).max(TOP + legend.1 + 20.0);
    let mut svg = Svg::new(width, height, title);
    svg.text((GAP, 30.0), title, Type::new(14.0).bold());
    let caption = |svg: &mut Svg, left: f64, text: &str| svg.text((left, TOP - 10.0), text, Type::new(12.0));
    caption(&mut svg, GAP, "body");
    svg.place((GAP - 1.0, TOP - 1.0), 1.0, &picture);
    let left = |number: usize| 2.0 * GAP + picture.width() + number as f64 * (wide + GAP);
    let most = losses.iter().flatten().map(|loss| loss.abs()).fold(0.0, f64::max);
    caption(&mut svg, left(0), "needed");
    svg.group("losses", "voxels less when a pixel is covered", |svg| {
        let color = |at: usize| losses[at].map_or(Color::PALE, |loss| loss_color(loss, most));
        draw_pixels(svg, (left(0), TOP), VOXEL, size, color);
    });
    for (number, (name, mean)) in sets.iter().enumerate() {
        let place = left(number + 1);
        caption(&mut svg, place, &format!("mean of {name}"));
        svg.group(&format!("mean-{name}"), name, |svg| {
            draw_pixels(svg, (place, TOP), VOXEL, size, |at| ink(mean[at]));
        });
    }
    draw_key(&mut svg, (left(0), TOP + high + 16.0), wide, most);
    draw_legend(&mut svg, (legend_left, TOP), body, &looks);
    svg
}

/// Orange where the body needs a pixel, blue where it does better without it.
fn loss_color(loss: f64, most: f64) -> Color {
    let share = if most > 0.0 { loss.abs() / most } else { 0.0 };
    let end = if loss >= 0.0 { Color::new(179, 62, 0) } else { Color::new(0, 84, 159) };
    Color::WHITE.mix(end, share)
}

fn draw_key(svg: &mut Svg, (left, top): Point, width: f64, most: f64) {
    const STEPS: usize = 21;
    for step in 0..STEPS {
        let share = 2.0 * step as f64 / (STEPS - 1) as f64 - 1.0;
        let wide = width / STEPS as f64;
        svg.rect((left + step as f64 * wide, top), wide, 9.0, Paint::fill(loss_color(share * most, most)));
    }
    svg.text((left, top + 24.0), &format!("-{most:.2} to {most:.2} voxels less"), Type::new(11.0));
}
