//! Text as outlines of the built-in fonts, whatever fonts the machine has.

use tiny_skia::{Path, PathBuilder, Transform};
use ttf_parser::{Face, OutlineBuilder};

const PLAIN: &[u8] = include_bytes!("../assets/DejaVuSans-subset.ttf");
const BOLD: &[u8] = include_bytes!("../assets/DejaVuSans-Bold-subset.ttf");

/// A line of text as a shape, with its start at the origin of the base line and y downwards.
pub(super) struct Outline {
    pub path: Option<Path>,
    pub width: f32,
}

impl Outline {
    pub(super) fn of(text: &str, size: f64, bold: bool) -> Self {
        let face = Face::parse(if bold { BOLD } else { PLAIN }, 0).expect("the built-in fonts are fonts");
        let mut pen = Pen { path: PathBuilder::new(), x: 0.0 };
        let dots = if face.glyph_index('\u{2026}').is_some() { "\u{2026}" } else { "..." };
        for c in text.replace('\u{2026}', dots).chars() {
            let glyph = face.glyph_index(c).or_else(|| face.glyph_index('?')).unwrap_or_default();
            face.outline_glyph(glyph, &mut pen);
            pen.x += f32::from(face.glyph_hor_advance(glyph).unwrap_or(0));
        }
        let scale = size as f32 / f32::from(face.units_per_em());
        let path = pen.path.finish().and_then(|path| path.transform(Transform::from_scale(scale, -scale)));
        Self { path, width: pen.x * scale }
    }
}

struct Pen {
    path: PathBuilder,
    x: f32,
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.x + x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.x + x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.path.quad_to(self.x + x1, y1, self.x + x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.path.cubic_to(self.x + x1, y1, self.x + x2, y2, self.x + x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_follow_each_other() {
        let width = |text: &str| Outline::of(text, 10.0, false).width;
        assert!((width("robots") - width("rob") - width("ots")).abs() < 1e-3);
        assert!(Outline::of("robots", 10.0, true).width > width("robots"));
        assert!((width("m") / Outline::of("m", 20.0, false).width - 0.5).abs() < 1e-6);
    }

    #[test]
    fn letters_stand_on_the_base_line() {
        let bounds = Outline::of("H", 10.0, false).path.unwrap().bounds();
        assert!(bounds.bottom().abs() < 1e-3 && (-8.0..-6.0).contains(&bounds.top()), "{bounds:?}");
    }

    #[test]
    fn an_ellipsis_is_no_question_mark() {
        for bold in [false, true] {
            let shape = |text| Outline::of(text, 10.0, bold).path.unwrap().bounds();
            assert!(shape("\u{2026}").height() < shape("?").height() / 2.0);
        }
    }

    #[test]
    fn only_ink_has_a_path() {
        assert!(Outline::of(" ", 10.0, false).path.is_none() && Outline::of(" ", 10.0, false).width > 2.0);
        for text in ["★", "−", "\u{10ffff}"] {
            assert!(Outline::of(text, 10.0, false).path.is_some(), "{text}");
        }
    }
}
