//! The elements of drawings. Lengths are pixels; y increases downwards.

use crate::Color;

/// A point in pixels.
pub type Point = (f64, f64);

/// How a shape is painted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Paint {
    pub(super) fill: Option<Color>,
    pub(super) stroke: Option<(Color, f64)>,
    pub(super) dash: Option<f64>,
    pub(super) opacity: Option<f64>,
}

impl Paint {
    /// Filled.
    pub fn fill(color: Color) -> Self {
        Self { fill: Some(color), ..Self::default() }
    }

    /// Outlined with a line of that width.
    pub fn stroke(color: Color, width: f64) -> Self {
        Self { stroke: Some((color, width)), ..Self::default() }
    }

    /// Outlined too.
    pub fn with_stroke(self, color: Color, width: f64) -> Self {
        Self { stroke: Some((color, width)), ..self }
    }

    /// With the line in dashes of that length.
    pub fn dashed(self, length: f64) -> Self {
        Self { dash: Some(length), ..self }
    }

    /// See-through: 0 is invisible, 1 opaque.
    pub fn with_opacity(self, opacity: f64) -> Self {
        Self { opacity: Some(opacity), ..self }
    }
}

/// The position of a text relative to its point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Anchor {
    /// The text starts there.
    #[default]
    Start,
    /// The middle of the text is there.
    Middle,
    /// The text ends there.
    End,
}

/// How a text is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Type {
    pub(super) size: f64,
    pub(super) color: Color,
    pub(super) anchor: Anchor,
    pub(super) bold: bool,
    pub(super) upwards: bool,
}

impl Type {
    /// Plain black type of that size.
    pub fn new(size: f64) -> Self {
        Self { size, color: Color::BLACK, anchor: Anchor::Start, bold: false, upwards: false }
    }

    /// In that color.
    pub fn colored(self, color: Color) -> Self {
        Self { color, ..self }
    }

    /// With this position relative to its point.
    pub fn anchored(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// Bold.
    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// Reading upwards.
    pub fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }
}

/// A part of a drawing. What comes later covers what comes before.
#[derive(Clone, Debug)]
pub(super) enum Element {
    /// By its upper left corner, its width and its height.
    Rect(Point, f64, f64, Paint),
    Line(Point, Point, Paint),
    /// A line through points.
    Polyline(Vec<Point>, Paint),
    /// A closed line through points.
    Polygon(Vec<Point>, Paint),
    /// By its middle and its radius.
    Circle(Point, f64, Paint),
    /// A line of text on its base line.
    Text(Point, String, Type),
    /// Elements with an identity and a title.
    Group(String, String, Vec<Element>),
    /// Elements with their origin at a point, scaled.
    Placed(Point, f64, Vec<Element>),
}
