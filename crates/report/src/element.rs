//! The elements of drawings. Lengths are pixels; y increases downwards.

use crate::Color;

pub type Point = (f64, f64);

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Paint {
    pub(super) fill: Option<Color>,
    pub(super) stroke: Option<(Color, f64)>,
    pub(super) dash: Option<f64>,
    pub(super) opacity: Option<f64>,
}

impl Paint {
    pub fn fill(color: Color) -> Self {
        Self { fill: Some(color), ..Self::default() }
    }

    pub fn stroke(color: Color, width: f64) -> Self {
        Self { stroke: Some((color, width)), ..Self::default() }
    }

    pub fn with_stroke(self, color: Color, width: f64) -> Self {
        Self { stroke: Some((color, width)), ..self }
    }

    pub fn dashed(self, length: f64) -> Self {
        Self { dash: Some(length), ..self }
    }

    pub fn with_opacity(self, opacity: f64) -> Self {
        Self { opacity: Some(opacity), ..self }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Anchor {
    #[default]
    Start,
    Middle,
    End,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Type {
    pub(super) size: f64,
    pub(super) color: Color,
    pub(super) anchor: Anchor,
    pub(super) bold: bool,
    pub(super) upwards: bool,
}

impl Type {
    pub fn new(size: f64) -> Self {
        Self { size, color: Color::BLACK, anchor: Anchor::Start, bold: false, upwards: false }
    }

    pub fn colored(self, color: Color) -> Self {
        Self { color, ..self }
    }

    pub fn anchored(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }
}

/// Later elements cover earlier ones.
#[derive(Clone, Debug)]
pub(super) enum Element {
    /// By its upper left corner, its width and its height.
    Rect(Point, f64, f64, Paint),
    Line(Point, Point, Paint),
    Polyline(Vec<Point>, Paint),
    Polygon(Vec<Point>, Paint),
    Circle(Point, f64, Paint),
    Text(Point, String, Type),
    Group(String, String, Vec<Element>),
    Placed(Point, f64, Vec<Element>),
}
