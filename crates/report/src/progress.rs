//! Runs over time: a line for each seed, their median, and the band between the least and the largest.

use crate::Color;
use crate::chart::{Panel, range_of};
use crate::element::{Paint, Point, Type};
use crate::svg::Svg;

#[derive(Clone, Debug)]
pub struct Course {
    pub title: String,
    pub unit: String,
    pub series: Vec<Series>,
}

#[derive(Clone, Debug)]
pub struct Series {
    pub name: String,
    /// For each seed, times and values in order of time.
    pub runs: Vec<Vec<Point>>,
}

impl Course {
    pub fn of(title: impl Into<String>, unit: impl Into<String>, runs: Vec<Vec<Point>>) -> Self {
        Self { title: title.into(), unit: unit.into(), series: vec![Series { name: String::new(), runs }] }
    }

    fn points(&self) -> impl Iterator<Item = Point> + '_ {
        self.series.iter().flat_map(|series| series.runs.iter().flatten().copied())
    }
}

/// Quantities of one unit share a scale.
pub fn draw_progress(title: &str, time: &str, courses: &[Course]) -> Svg {
    let mut svg = Svg::titled(640.0, 40.0 + 240.0 * courses.len() as f64, title);
    let until = range_of(courses.iter().flat_map(|course| course.points().map(|at| at.0)), 0.0).1;
    for (i, course) in courses.iter().enumerate() {
        let alike = courses.iter().filter(|other| other.unit == course.unit);
        let values: Vec<f64> = alike.flat_map(|other| other.points().map(|at| at.1)).collect();
        let (_, high) = range_of(values.iter().copied(), 0.08);
        let low = range_of(values, 0.0).0.min(0.0);
        let panel = Panel::new((64.0, 62.0 + 240.0 * i as f64), 550.0, 170.0, (0.0, until), (low, high));
        svg.group(&format!("course-{i}"), &course.title, |svg| draw_course(svg, &panel, course));
        panel.x_label(&mut svg, time);
    }
    svg
}

fn draw_course(svg: &mut Svg, panel: &Panel, course: &Course) {
    panel.x_axis(svg, 6);
    panel.y_axis(svg, 4, &course.unit);
    panel.title(svg, &course.title);
    if let [Series { runs, .. }] = &course.series[..] {
        draw_band(svg, panel, runs, Color::series(5));
        for run in runs {
            panel.curve(svg, run.iter().copied(), Paint::stroke(Color::series(5), 0.9));
        }
        draw_median(svg, panel, runs, Color::series(0));
    } else {
        for (i, series) in course.series.iter().enumerate() {
            draw_band(svg, panel, &series.runs, Color::series(i));
            draw_median(svg, panel, &series.runs, Color::series(i));
        }
        for (i, series) in course.series.iter().enumerate() {
            let place = (panel.left + 10.0, panel.top + 16.0 + 14.0 * i as f64);
            svg.text(place, &series.name, Type::new(11.0).bold().colored(Color::series(i)));
        }
    }
    panel.frame(svg);
}

fn draw_band(svg: &mut Svg, panel: &Panel, runs: &[Vec<Point>], color: Color) {
    if runs.len() > 1 {
        let times = times(runs);
        let at = |rank: fn(&[f64]) -> f64| times.iter().map(move |&time| (time, rank(&values_at(runs, time))));
        let band: Vec<Point> = at(|sorted| sorted[sorted.len() - 1])
            .chain(at(|sorted| sorted[0]).collect::<Vec<_>>().into_iter().rev())
            .map(|value| panel.at(value))
            .collect();
        svg.polygon(&band, Paint::fill(color).with_opacity(0.25));
    }
}

fn draw_median(svg: &mut Svg, panel: &Panel, runs: &[Vec<Point>], color: Color) {
    let median = times(runs).into_iter().map(|time| (time, median(&values_at(runs, time))));
    panel.curve(svg, median, Paint::stroke(color, 2.2));
}

fn times(runs: &[Vec<Point>]) -> Vec<f64> {
    let ends = runs.iter().filter_map(|run| run.last());
    let end = ends.map(|at| at.0).fold(f64::INFINITY, f64::min);
    let mut times: Vec<f64> = runs.iter().flatten().map(|at| at.0).filter(|&time| time <= end).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

fn values_at(runs: &[Vec<Point>], time: f64) -> Vec<f64> {
    let last = |run: &Vec<Point>| run[..run.partition_point(|at| at.0 <= time)].last().or(run.first()).map(|at| at.1);
    let mut values: Vec<f64> = runs.iter().filter_map(last).collect();
    values.sort_by(f64::total_cmp);
    values
}

pub(super) fn median(sorted: &[f64]) -> f64 {
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { (sorted[middle - 1] + sorted[middle]) / 2.0 }
}
