//! A small typed writer of SVG, used by all pictures. Lengths are pixels; y increases downwards.

use std::fmt::{self, Write};

use crate::report::Color;

/// A point in pixels.
pub type Point = (f64, f64);

/// How a shape is painted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Paint {
    fill: Option<Color>,
    stroke: Option<(Color, f64)>,
    dash: Option<f64>,
    opacity: Option<f64>,
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

impl fmt::Display for Paint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.fill {
            Some(color) => write!(f, " fill=\"{color}\"")?,
            None => f.write_str(" fill=\"none\"")?,
        }
        if let Some((color, width)) = self.stroke {
            write!(f, " stroke=\"{color}\" stroke-width=\"{}\" stroke-linejoin=\"round\"", Number(width))?;
        }
        if let Some(dash) = self.dash {
            write!(f, " stroke-dasharray=\"{0} {0}\"", Number(dash))?;
        }
        if let Some(opacity) = self.opacity {
            write!(f, " opacity=\"{}\"", Number(opacity))?;
        }
        Ok(())
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
    size: f64,
    color: Color,
    anchor: Anchor,
    bold: bool,
    upwards: bool,
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

    /// Standing so relative to its point.
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

/// A drawing under construction.
#[derive(Clone, Debug)]
pub struct Svg {
    width: f64,
    height: f64,
    title: String,
    body: String,
}

impl Svg {
    /// An empty drawing on white, with a title for screen readers.
    pub fn new(width: f64, height: f64, title: &str) -> Self {
        let mut svg = Self { width, height, title: title.to_owned(), body: String::new() };
        svg.rect((0.0, 0.0), width, height, Paint::fill(Color::WHITE));
        svg
    }

    /// An empty drawing on a transparent background, to be placed on other drawings.
    pub fn transparent(width: f64, height: f64, title: &str) -> Self {
        Self { width, height, title: title.to_owned(), body: String::new() }
    }

    /// The drawing's width in pixels.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// The drawing's height in pixels.
    pub fn height(&self) -> f64 {
        self.height
    }

    /// A rectangle by its upper left corner.
    pub fn rect(&mut self, (x, y): Point, width: f64, height: f64, paint: Paint) {
        let (x, y, width, height) = (Number(x), Number(y), Number(width), Number(height));
        self.push(format_args!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"{paint}/>"));
    }

    /// A straight line.
    pub fn line(&mut self, (x1, y1): Point, (x2, y2): Point, paint: Paint) {
        let (x1, y1, x2, y2) = (Number(x1), Number(y1), Number(x2), Number(y2));
        self.push(format_args!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"{paint}/>"));
    }

    /// A line through points.
    pub fn polyline(&mut self, points: &[Point], paint: Paint) {
        self.push(format_args!("<polyline points=\"{}\"{paint}/>", Points(points)));
    }

    /// A closed shape.
    pub fn polygon(&mut self, points: &[Point], paint: Paint) {
        self.push(format_args!("<polygon points=\"{}\"{paint}/>", Points(points)));
    }

    /// A disk or circle.
    pub fn circle(&mut self, (x, y): Point, radius: f64, paint: Paint) {
        let (x, y, radius) = (Number(x), Number(y), Number(radius));
        self.push(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{paint}/>"));
    }

    /// A line of text on its base line.
    pub fn text(&mut self, (x, y): Point, text: &str, set: Type) {
        let (x, y) = (Number(x), Number(y));
        let anchor = match set.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let bold = if set.bold { " font-weight=\"bold\"" } else { "" };
        let turn = if set.upwards { format!(" transform=\"rotate(-90 {x} {y})\"") } else { String::new() };
        let (size, color, text) = (Number(set.size), set.color, Escaped(text));
        self.push(format_args!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{color}\"{anchor}{bold}{turn}>{text}</text>"
        ));
    }

    /// A group of shapes with an identity and a title, for pages that let readers pick it.
    pub fn group(&mut self, id: &str, title: &str, draw: impl FnOnce(&mut Self)) {
        self.push(format_args!("<g id=\"{}\"><title>{}</title>", Escaped(id), Escaped(title)));
        draw(self);
        self.push(format_args!("</g>"));
    }

    /// Another drawing with its upper left corner at this point, scaled.
    pub fn place(&mut self, (x, y): Point, scale: f64, other: &Self) {
        let (x, y, scale) = (Number(x), Number(y), Number(scale));
        self.push(format_args!("<g transform=\"translate({x} {y}) scale({scale})\">"));
        self.body.push_str(&other.body);
        self.push(format_args!("</g>"));
    }

    /// The whole drawing as a file.
    pub fn finish(&self) -> String {
        let (width, height, title) = (Number(self.width), Number(self.height), Escaped(&self.title));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} \
             {height}\" \
             role=\"img\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n<title>{title}</title>\n{}</svg>\n",
            self.body
        )
    }

    fn push(&mut self, element: fmt::Arguments<'_>) {
        writeln!(self.body, "{element}").expect("text can be written to a string");
    }
}

/// The first characters of a text that has more than `most`.
pub fn shorten(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some(_) => text.chars().take(most - 1).chain(['…']).collect(),
        None => text.to_owned(),
    }
}

/// A length with at most two decimals, which is finer than any screen; a value that is not a number becomes 0.
struct Number(f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!("{:.2}", if self.0.is_finite() { self.0 } else { 0.0 });
        let short = text.trim_end_matches('0').trim_end_matches('.');
        f.write_str(if short == "-0" { "0" } else { short })
    }
}

struct Points<'a>(&'a [Point]);

impl fmt::Display for Points<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, &(x, y)) in self.0.iter().enumerate() {
            let gap = if i == 0 { "" } else { " " };
            write!(f, "{gap}{},{}", Number(x), Number(y))?;
        }
        Ok(())
    }
}

/// Text for an element or an attribute; invalid XML characters become question marks.
struct Escaped<'a>(&'a str);

impl fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for c in self.0.chars() {
            match c {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                '\u{fffe}' | '\u{ffff}' => f.write_char('?')?,
                c if c.is_control() => f.write_char('?')?,
                c => f.write_char(c)?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(draw: impl FnOnce(&mut Svg), expected: &str) {
        let mut svg = Svg::transparent(10.0, 10.0, "t");
        draw(&mut svg);
        assert_eq!(svg.body.trim_end(), expected);
    }

    #[test]
    fn shapes_are_written_with_short_numbers() {
        check(
            |svg| svg.line((0.0, -0.001), (1.0 / 3.0, 2.5), Paint::stroke(Color::BLACK, 1.0)),
            "<line x1=\"0\" y1=\"0\" x2=\"0.33\" y2=\"2.5\" fill=\"none\" stroke=\"#1a1a1a\" stroke-width=\"1\" \
             stroke-linejoin=\"round\"/>",
        );
        check(
            |svg| svg.polygon(&[(f64::NAN, 1.0), (f64::INFINITY, 100.0)], Paint::fill(Color::WHITE)),
            "<polygon points=\"0,1 0,100\" fill=\"#ffffff\"/>",
        );
    }

    #[test]
    fn text_is_escaped() {
        check(
            |svg| svg.text((1.0, 2.0), "<a & \"b\"\u{0}>", Type::new(9.0)),
            "<text x=\"1\" y=\"2\" font-size=\"9\" fill=\"#1a1a1a\">&lt;a &amp; &quot;b&quot;?&gt;</text>",
        );
    }
}
