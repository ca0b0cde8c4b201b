//! Drawings, and how they are written as SVG. Lengths are pixels; y increases downwards.

use std::fmt::{self, Display};

use crate::Color;
use crate::element::{Anchor, Element, Paint, Point, Type};

impl Display for Paint {
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

/// A drawing under construction.
#[derive(Clone, Debug)]
pub struct Svg {
    width: f64,
    height: f64,
    title: String,
    elements: Vec<Element>,
}

impl Svg {
    pub fn new(width: f64, height: f64, title: &str) -> Self {
        let mut svg = Self { width, height, title: title.to_owned(), elements: Vec::new() };
        svg.rect((0.0, 0.0), width, height, Paint::fill(Color::WHITE));
        svg
    }

    pub(super) fn titled(width: f64, height: f64, title: &str) -> Self {
        let mut svg = Self::new(width, height, title);
        svg.text((14.0, 28.0), title, Type::new(16.0).bold());
        svg
    }

    pub fn transparent(width: f64, height: f64, title: &str) -> Self {
        Self { width, height, title: title.to_owned(), elements: Vec::new() }
    }

    /// In pixels.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// In pixels.
    pub fn height(&self) -> f64 {
        self.height
    }

    pub fn rect(&mut self, corner: Point, width: f64, height: f64, paint: Paint) {
        self.elements.push(Element::Rect(corner, width, height, paint));
    }

    pub fn line(&mut self, from: Point, to: Point, paint: Paint) {
        self.elements.push(Element::Line(from, to, paint));
    }

    pub fn polyline(&mut self, points: &[Point], paint: Paint) {
        self.elements.push(Element::Polyline(points.to_vec(), paint));
    }

    pub fn polygon(&mut self, points: &[Point], paint: Paint) {
        self.elements.push(Element::Polygon(points.to_vec(), paint));
    }

    pub fn circle(&mut self, middle: Point, radius: f64, paint: Paint) {
        self.elements.push(Element::Circle(middle, radius, paint));
    }

    pub(super) fn cross(&mut self, (x, y): Point, paint: Paint) {
        self.line((x - 5.0, y - 5.0), (x + 5.0, y + 5.0), paint);
        self.line((x - 5.0, y + 5.0), (x + 5.0, y - 5.0), paint);
    }

    pub fn text(&mut self, at: Point, text: &str, set: Type) {
        self.elements.push(Element::Text(at, text.to_owned(), set));
    }

    pub fn group(&mut self, id: &str, title: &str, draw: impl FnOnce(&mut Self)) {
        let outer = std::mem::take(&mut self.elements);
        draw(self);
        let inner = std::mem::replace(&mut self.elements, outer);
        self.elements.push(Element::Group(id.to_owned(), title.to_owned(), inner));
    }

    pub fn place(&mut self, corner: Point, scale: f64, other: &Self) {
        self.elements.push(Element::Placed(corner, scale, other.elements.clone()));
    }

    /// The same drawing with nothing in the groups whose identity begins with `prefix`.
    pub fn emptied(&self, prefix: &str) -> Self {
        Self { elements: emptied(&self.elements, prefix), ..self.clone() }
    }

    #[cfg(feature = "pictures")]
    pub(super) fn elements(&self) -> &[Element] {
        &self.elements
    }

    pub fn finish(&self) -> String {
        let (width, height, title) = (Number(self.width), Number(self.height), Escaped(&self.title));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} \
             {height}\" \
             role=\"img\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n<title>{title}</title>\n{}</svg>\n",
            Lines(&self.elements)
        )
    }
}

fn emptied(elements: &[Element], prefix: &str) -> Vec<Element> {
    let element = |element: &Element| match element {
        Element::Group(id, title, _) if id.starts_with(prefix) => Element::Group(id.clone(), title.clone(), Vec::new()),
        Element::Group(id, title, inner) => Element::Group(id.clone(), title.clone(), emptied(inner, prefix)),
        Element::Placed(at, scale, inner) => Element::Placed(*at, *scale, emptied(inner, prefix)),
        other => other.clone(),
    };
    elements.iter().map(element).collect()
}

struct Lines<'a>(&'a [Element]);

impl Display for Lines<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|element| writeln!(f, "{element}"))
    }
}

impl Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rect(corner, width, height, paint) => {
                let (x, y, width, height) = (Number(corner.0), Number(corner.1), Number(*width), Number(*height));
                write!(f, "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"{paint}/>")
            }
            Self::Line(from, to, paint) => {
                let (x1, y1, x2, y2) = (Number(from.0), Number(from.1), Number(to.0), Number(to.1));
                write!(f, "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"{paint}/>")
            }
            Self::Polyline(points, paint) => write!(f, "<polyline points=\"{}\"{paint}/>", Points(points)),
            Self::Polygon(points, paint) => write!(f, "<polygon points=\"{}\"{paint}/>", Points(points)),
            Self::Circle(middle, radius, paint) => {
                let (x, y, radius) = (Number(middle.0), Number(middle.1), Number(*radius));
                write!(f, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{paint}/>")
            }
            Self::Text(at, text, set) => write_text(f, *at, text, set),
            Self::Group(id, title, elements) => {
                write!(f, "<g id=\"{}\"><title>{}</title>\n{}</g>", Escaped(id), Escaped(title), Lines(elements))
            }
            Self::Placed(at, scale, elements) => {
                let (x, y, scale) = (Number(at.0), Number(at.1), Number(*scale));
                write!(f, "<g transform=\"translate({x} {y}) scale({scale})\">\n{}</g>", Lines(elements))
            }
        }
    }
}

fn write_text(f: &mut fmt::Formatter<'_>, (x, y): Point, text: &str, set: &Type) -> fmt::Result {
    let (x, y, size, color) = (Number(x), Number(y), Number(set.size), set.color);
    write!(f, "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{color}\"")?;
    match set.anchor {
        Anchor::Start => {}
        Anchor::Middle => f.write_str(" text-anchor=\"middle\"")?,
        Anchor::End => f.write_str(" text-anchor=\"end\"")?,
    }
    if set.bold {
        f.write_str(" font-weight=\"bold\"")?;
    }
    if set.upwards {
        write!(f, " transform=\"rotate(-90 {x} {y})\"")?;
    }
    write!(f, ">{}</text>", Escaped(text))
}

pub fn shorten(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some(_) => text.chars().take(most - 1).chain(['…']).collect(),
        None => text.to_owned(),
    }
}

/// The last characters of a text that has more than `most`: paths differ at their ends.
pub fn shorten_start(text: &str, most: usize) -> String {
    match text.chars().count().checked_sub(most) {
        Some(over @ 1..) => ['…'].into_iter().chain(text.chars().skip(over + 1)).collect(),
        _ => text.to_owned(),
    }
}

/// A length with at most two decimals, which is finer than any screen; a value that is not a number becomes 0.
struct Number(f64);

impl Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!("{:.2}", if self.0.is_finite() { self.0 } else { 0.0 });
        let short = text.trim_end_matches('0').trim_end_matches('.');
        f.write_str(if short == "-0" { "0" } else { short })
    }
}

struct Points<'a>(&'a [Point]);

impl Display for Points<'_> {
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

impl Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for c in self.0.chars() {
            match c {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                '\u{fffe}' | '\u{ffff}' => f.write_str("?")?,
                c if c.is_control() => f.write_str("?")?,
                c => write!(f, "{c}")?,
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
        assert_eq!(Lines(&svg.elements).to_string().trim_end(), expected);
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
    fn long_texts_are_cut_at_one_end() {
        assert_eq!((shorten("carry", 5), shorten("carries", 5)), ("carry".to_owned(), "carr…".to_owned()));
        assert_eq!(
            (shorten_start("sum[3]", 6), shorten_start("sum[13]", 6)),
            ("sum[3]".to_owned(), "…m[13]".to_owned())
        );
    }

    #[test]
    fn groups_can_be_emptied() {
        let mut svg = Svg::transparent(10.0, 10.0, "t");
        svg.group("cell-0", "", |svg| svg.group("body-1", "", |svg| svg.circle((1.0, 1.0), 1.0, Paint::default())));
        assert!(svg.finish().contains("<circle") && svg.finish().contains("body-1"));
        let emptied = svg.emptied("body-").finish();
        assert!(!emptied.contains("<circle") && emptied.contains("body-1"));
    }

    #[test]
    fn text_is_escaped() {
        check(
            |svg| svg.text((1.0, 2.0), "<a & \"b\"\u{0}>", Type::new(9.0)),
            "<text x=\"1\" y=\"2\" font-size=\"9\" fill=\"#1a1a1a\">&lt;a &amp; &quot;b&quot;?&gt;</text>",
        );
    }
}
