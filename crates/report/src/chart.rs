//! Charts: scales, axes, grids, lines and steps, drawn onto an [`Svg`].

use crate::Color;
use crate::element::{Anchor, Paint, Point, Type};
use crate::svg::Svg;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Scale {
    /// Takes `low` to the pixel `from` and `high` to `to`; an empty or senseless range becomes one of length 1.
    pub fn new((low, high): (f64, f64), (from, to): (f64, f64)) -> Self {
        let sound = low.is_finite() && high.is_finite() && high - low > f64::EPSILON * high.abs().max(low.abs());
        let (low, high) = if sound { (low, high) } else { (finite(low) - 0.5, finite(low) + 0.5) };
        Self { low, high, from, to }
    }

    pub fn at(&self, value: f64) -> f64 {
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Round values inside the range, about `count` of them, one, two or five times a power of ten apart.
    pub fn ticks(&self, count: usize) -> Vec<f64> {
        let step = round_step((self.high - self.low) / count.max(1) as f64);
        let (first, last) = ((self.low / step - 1e-9).ceil() as i64, (self.high / step + 1e-9).floor() as i64);
        (first..=last).map(|k| k as f64 * step).collect()
    }
}

fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

fn round_step(step: f64) -> f64 {
    let power = libm::pow(10.0, libm::floor(libm::log10(step)));
    [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|k| k * power)
        .find(|&round| round >= step * (1.0 - 1e-9))
        .unwrap_or(10.0 * power)
}

pub fn tick_label(value: f64, ticks: &[f64]) -> String {
    let step = ticks.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    let decimals = if step.is_finite() { (-libm::floor(libm::log10(step) + 1e-9)).max(0.0) as usize } else { 0 };
    let text = format!("{value:.decimals$}");
    let text =
        if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') { text.replace('-', "") } else { text };
    with_minus(&text)
}

pub fn with_minus(number: &str) -> String {
    number.replace('-', "\u{2212}")
}

pub fn range_of(values: impl IntoIterator<Item = f64>, margin: f64) -> (f64, f64) {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (0.0, 1.0);
    }
    let spare = (high - low) * margin;
    (low - spare, high + spare)
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Panel {
    pub x: Scale,
    pub y: Scale,
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Panel {
    pub fn new((left, top): Point, width: f64, height: f64, x: (f64, f64), y: (f64, f64)) -> Self {
        let (right, bottom) = (left + width, top + height);
        Self { x: Scale::new(x, (left, right)), y: Scale::new(y, (bottom, top)), left, top, right, bottom }
    }

    pub fn downwards(self) -> Self {
        let y = Scale { from: self.top, to: self.bottom, ..self.y };
        Self { y, ..self }
    }

    pub fn at(&self, (x, y): Point) -> Point {
        (self.x.at(x), self.y.at(y))
    }

    pub fn frame(&self, svg: &mut Svg) {
        let (width, height) = (self.right - self.left, self.bottom - self.top);
        svg.rect((self.left, self.top), width, height, Paint::stroke(Color::GRAY, 1.0));
    }

    pub fn x_axis(&self, svg: &mut Svg, count: usize) {
        let ticks = self.x.ticks(count);
        for &tick in &ticks {
            let x = self.x.at(tick);
            svg.line((x, self.top), (x, self.bottom), Paint::stroke(Color::PALE, 0.6));
            svg.line((x, self.bottom), (x, self.bottom + 4.0), Paint::stroke(Color::GRAY, 1.0));
            let set = Type::new(10.0).colored(Color::GRAY).anchored(Anchor::Middle);
            svg.text((x, self.bottom + 15.0), &tick_label(tick, &ticks), set);
        }
    }

    pub fn y_axis(&self, svg: &mut Svg, count: usize, label: &str) {
        let ticks = self.y.ticks(count);
        let mut widest = 0;
        for &tick in &ticks {
            let value = tick_label(tick, &ticks);
            widest = widest.max(value.chars().count());
            let y = self.y.at(tick);
            svg.line((self.left, y), (self.right, y), Paint::stroke(Color::PALE, 0.6));
            svg.line((self.left - 4.0, y), (self.left, y), Paint::stroke(Color::GRAY, 1.0));
            let set = Type::new(10.0).colored(Color::GRAY).anchored(Anchor::End);
            svg.text((self.left - 7.0, y + 3.5), &value, set);
        }
        // A digit of DejaVu Sans in this size is 6.4 pixels wide. Three leave room for the title at its usual place.
        let beside = f64::max(34.0, 13.0 + 6.4 * widest as f64);
        let set = Type::new(11.0).anchored(Anchor::Middle).upwards();
        svg.text((self.left - beside, (self.top + self.bottom) / 2.0), label, set);
    }

    pub fn x_label(&self, svg: &mut Svg, label: &str) {
        let middle = (self.left + self.right) / 2.0;
        svg.text((middle, self.bottom + 31.0), label, Type::new(11.0).anchored(Anchor::Middle));
    }

    pub fn title(&self, svg: &mut Svg, title: &str) {
        let middle = (self.left + self.right) / 2.0;
        svg.text((middle, self.top - 8.0), title, Type::new(12.0).bold().anchored(Anchor::Middle));
    }

    pub fn curve(&self, svg: &mut Svg, values: impl IntoIterator<Item = Point>, paint: Paint) {
        let points: Vec<Point> = values.into_iter().map(|value| self.at(value)).collect();
        svg.polyline(&points, paint);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check_ticks(low: f64, high: f64, count: usize, expected: &[&str]) {
        let ticks = Scale::new((low, high), (0.0, 1.0)).ticks(count);
        assert_eq!(ticks.iter().map(|&tick| tick_label(tick, &ticks)).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn ticks_are_round() {
        check_ticks(0.0, 40.0, 4, &["0", "10", "20", "30", "40"]);
        check_ticks(-0.12, 0.31, 4, &["0.0", "0.2"]);
        check_ticks(-3.0, 2.0, 5, &["−3", "−2", "−1", "0", "1", "2"]);
        check_ticks(248.2, 251.9, 3, &["250"]);
    }

    #[test]
    fn a_scale_may_fall() {
        assert_eq!(Scale::new((2.0, 4.0), (100.0, 0.0)).at(3.0), 50.0);
    }

    #[test]
    fn an_invalid_range_is_still_drawn() {
        for range in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            let scale = Scale::new(range, (0.0, 10.0));
            assert!(scale.at(1.0).is_finite());
            assert!(scale.ticks(5).len() < 20);
        }
        assert_eq!(range_of([f64::NAN], 0.1), (0.0, 1.0));
    }
}
