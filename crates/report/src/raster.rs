//! Drawings as pixels, with a built-in font: the same drawing gives the same bytes on any machine.

use tiny_skia::{FillRule, LineJoin, Path, PathBuilder, Pixmap, Rect, Stroke, StrokeDash, Transform};

use crate::element::{Anchor, Element, Paint, Point, Type};
use crate::font::Outline;
use crate::shades::Shades;
use crate::{Color, Svg};

const MAX_SIDE: f64 = 16_000.0;
/// The most pixels of a picture; four bytes each are in memory at once.
const MAX_PIXELS: f64 = 16e6;

/// `scale` pixels for each of the drawing's own; fewer for a drawing that would be too large.
pub fn rasterize(svg: &Svg, scale: f64) -> Pixmap {
    let scale =
        scale.min(MAX_SIDE / svg.width().max(svg.height())).min((MAX_PIXELS / (svg.width() * svg.height())).sqrt());
    let side = |length: f64| ((length * scale).ceil() as u32).max(1);
    let mut pixmap = Pixmap::new(side(svg.width()), side(svg.height())).expect("a picture has pixels");
    draw(&mut pixmap, svg.elements(), Transform::from_scale(scale as f32, scale as f32));
    pixmap
}

fn draw(pixmap: &mut Pixmap, elements: &[Element], transform: Transform) {
    for element in elements {
        match element {
            Element::Rect(corner, width, height, paint) => {
                ink(pixmap, rect(*corner, *width, *height), paint, transform)
            }
            Element::Line(from, to, paint) => ink(pixmap, line(&[*from, *to], false), paint, transform),
            Element::Polyline(points, paint) => ink(pixmap, line(points, false), paint, transform),
            Element::Polygon(points, paint) => ink(pixmap, line(points, true), paint, transform),
            Element::Circle(middle, radius, paint) => ink(pixmap, circle(*middle, *radius), paint, transform),
            Element::Text(at, text, set) => write(pixmap, *at, text, set, transform),
            Element::Group(_, _, elements) => draw(pixmap, elements, transform),
            Element::Placed(at, scale, elements) => {
                let (x, y, scale) = (pixel(at.0), pixel(at.1), pixel(*scale));
                draw(pixmap, elements, transform.pre_translate(x, y).pre_scale(scale, scale));
            }
        }
    }
}

fn pixel(length: f64) -> f32 {
    if length.is_finite() { length as f32 } else { 0.0 }
}

fn rect((x, y): Point, width: f64, height: f64) -> Option<Path> {
    Rect::from_xywh(pixel(x), pixel(y), pixel(width), pixel(height)).map(PathBuilder::from_rect)
}

fn circle((x, y): Point, radius: f64) -> Option<Path> {
    PathBuilder::from_circle(pixel(x), pixel(y), pixel(radius))
}

pub(super) fn line(points: &[Point], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (i, &(x, y)) in points.iter().enumerate() {
        if i == 0 { path.move_to(pixel(x), pixel(y)) } else { path.line_to(pixel(x), pixel(y)) }
    }
    if closed {
        path.close();
    }
    path.finish()
}

pub(super) fn ink(pixmap: &mut Pixmap, path: Option<Path>, paint: &Paint, transform: Transform) {
    let Some(path) = path else { return };
    let opacity = paint.opacity.unwrap_or(1.0);
    if let Some(color) = paint.fill {
        pixmap.fill_path(&path, &solid(color, opacity), FillRule::Winding, transform, None);
    }
    if let Some((color, width)) = paint.stroke {
        let dash = paint.dash.and_then(|length| StrokeDash::new(vec![pixel(length); 2], 0.0));
        let stroke = Stroke { width: pixel(width), line_join: LineJoin::Round, dash, ..Stroke::default() };
        pixmap.stroke_path(&path, &solid(color, opacity), &stroke, transform, None);
    }
}

fn write(pixmap: &mut Pixmap, (x, y): Point, text: &str, set: &Type, transform: Transform) {
    let outline = Outline::of(text, set.size, set.bold);
    let start = match set.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => -outline.width / 2.0,
        Anchor::End => -outline.width,
    };
    let placed = transform.pre_translate(pixel(x), pixel(y));
    let turned = if set.upwards { placed.pre_rotate(-90.0) } else { placed };
    ink(pixmap, outline.path, &Paint::fill(set.color), turned.pre_translate(start, 0.0));
}

pub(super) fn solid(color: Color, opacity: f64) -> tiny_skia::Paint<'static> {
    let mut paint = tiny_skia::Paint { anti_alias: true, ..tiny_skia::Paint::default() };
    paint.set_color_rgba8(color.r, color.g, color.b, (opacity.clamp(0.0, 1.0) * 255.0).round() as u8);
    paint
}

pub fn png(svg: &Svg) -> Vec<u8> {
    let pixmap = rasterize(svg, 2.0);
    let (width, height) = (pixmap.width(), pixmap.height());
    let pixels = pixmap.take_demultiplied();
    let (pixels, _) = pixels.as_chunks();
    encode(&Shades::of(pixels), width, height).expect("pixels in memory can be encoded")
}

fn encode(shades: &Shades, width: u32, height: u32) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_palette(shades.palette.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect::<Vec<u8>>());
    if shades.palette.iter().any(|shade| shade[3] < 255) {
        encoder.set_trns(shades.palette.iter().map(|shade| shade[3]).collect::<Vec<u8>>());
    }
    encoder.set_compression(png::Compression::High);
    // Neighbors in a palette are not similar.
    encoder.set_filter(png::Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&shades.indexed)?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ink(text: &str) -> usize {
        let mut svg = Svg::new(200.0, 20.0, "t");
        svg.text((2.0, 15.0), text, Type::new(12.0));
        rasterize(&svg, 1.0).pixels().iter().filter(|pixel| pixel.red() < 128).count()
    }

    #[test]
    fn text_is_drawn_with_the_programs_font() {
        assert_eq!(ink(""), 0);
        assert!(ink("cycles, voxels, ★ −1") > 100);
    }

    #[test]
    fn colors_are_exact() {
        let mut svg = Svg::new(10.0, 10.0, "t");
        svg.rect((0.0, 0.0), 5.0, 10.0, Paint::fill(Color::FAULT));
        let pixmap = rasterize(&svg, 1.0);
        let at = |x, y| pixmap.pixel(x, y).map(|pixel| (pixel.red(), pixel.green(), pixel.blue()));
        assert_eq!(at(2, 5), Some((213, 94, 0)));
        assert_eq!(at(8, 5), Some((255, 255, 255)));
    }

    #[test]
    fn a_huge_drawing_is_scaled_down() {
        let pixmap = rasterize(&Svg::new(20_000.0, 10.0, "t"), 2.0);
        assert_eq!(pixmap.width(), 16_000);
    }
}
