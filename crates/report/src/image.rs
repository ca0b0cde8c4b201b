//! Images as squares, from white for 0 to black for 1.

use crate::Color;
use crate::element::{Paint, Point};
use crate::svg::Svg;
use nbc_base::model::{Image, ImageSize};

pub fn ink(value: f64) -> Color {
    Color::WHITE.mix(Color::BLACK, value)
}

pub fn draw_image(svg: &mut Svg, corner: Point, side: f64, image: &Image) {
    draw_pixels(svg, corner, pixel_side(image, side), image.size(), |at| ink(image.pixels()[at]));
}

pub fn pixel_side(image: &Image, side: f64) -> f64 {
    let size = image.size();
    side / size.rows.max(size.columns) as f64
}

pub fn draw_pixels(
    svg: &mut Svg,
    (left, top): Point,
    side: f64,
    ImageSize { rows, columns }: ImageSize,
    color: impl Fn(usize) -> Color,
) {
    for at in 0..rows * columns {
        let corner = (left + (at % columns) as f64 * side, top + (at / columns) as f64 * side);
        svg.rect(corner, side, side, Paint::fill(color(at)).with_stroke(Color::PALE, 0.7));
    }
}
