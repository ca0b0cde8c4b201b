//! Drawings as pixels, with a built-in font: the same drawing gives the same bytes on any machine.

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::Database;
use resvg::usvg::{Options, Tree};

use crate::report::Svg;

/// The most pixels along one side of a picture.
const MAX_SIDE: f64 = 16_000.0;
/// The most pixels of a picture; four bytes each are in memory at once.
const MAX_PIXELS: f64 = 16e6;

/// The drawing as pixels, `scale` of them for each of its own; less for a drawing that would be too large.
pub fn rasterize(svg: &Svg, scale: f64) -> Pixmap {
    let options = Options { fontdb: Arc::new(fonts()), font_family: "DejaVu Sans".to_owned(), ..Options::default() };
    let tree = Tree::from_str(&svg.finish(), &options).expect("drawings are well-formed SVG");
    let scale =
        scale.min(MAX_SIDE / svg.width().max(svg.height())).min((MAX_PIXELS / (svg.width() * svg.height())).sqrt());
    let side = |length: f64| ((length * scale).ceil() as u32).max(1);
    let mut pixmap = Pixmap::new(side(svg.width()), side(svg.height())).expect("a picture has pixels");
    resvg::render(&tree, Transform::from_scale(scale as f32, scale as f32), &mut pixmap.as_mut());
    pixmap
}

/// The program's own fonts, whatever the machine has.
fn fonts() -> Database {
    let mut fonts = Database::new();
    fonts.load_font_data(include_bytes!("../../assets/DejaVuSans-subset.ttf").to_vec());
    fonts.load_font_data(include_bytes!("../../assets/DejaVuSans-Bold-subset.ttf").to_vec());
    fonts
}

/// The drawing as a PNG file of twice its size, for sharp print.
pub fn png(svg: &Svg) -> Vec<u8> {
    rasterize(svg, 2.0).encode_png().expect("pixels in memory can be encoded")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Color, Paint, Type};

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
