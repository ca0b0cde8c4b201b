//! Runs over time: a line for each seed, their median, and the band between the worst and the best.

use crate::Color;
use crate::chart::{Panel, range_of};
use crate::element::{Paint, Point, Type};
use crate::svg::Svg;

/// A quantity over time, for several seeds.
#[derive(Clone, Debug)]
pub struct Course {
    /// The title of the panel.
    pub title: String,
    /// The vertical axis, with its unit.
    pub unit: String,
    /// For each seed, pairs of time and value in order of time.
    pub runs: Vec<Vec<Point>>,
}

/// Draws quantities one below the other over one axis of time. Those of one unit have one scale, so that they compare.
pub fn draw_progress(title: &str, time: &str, courses: &[Course]) -> Svg {
    let mut svg = Svg::new(640.0, 40.0 + 240.0 * courses.len() as f64, title);
    svg.text((14.0, 28.0), title, Type::new(16.0).bold());
    let until = range_of(courses.iter().flat_map(|course| course.runs.iter().flatten().map(|at| at.0)), 0.0).1;
    for (i, course) in courses.iter().enumerate() {
        let alike = courses.iter().filter(|other| other.unit == course.unit);
        let values: Vec<f64> = alike.flat_map(|other| other.runs.iter().flatten().map(|at| at.1)).collect();
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
    let times = times(&course.runs);
    if course.runs.len() > 1 {
        let at = |rank: fn(&[f64]) -> f64| times.iter().map(move |&time| (time, rank(&values_at(&course.runs, time))));
        let band: Vec<Point> = at(|sorted| sorted[sorted.len() - 1])
            .chain(at(|sorted| sorted[0]).collect::<Vec<_>>().into_iter().rev())
            .map(|value| panel.at(value))
            .collect();
        svg.polygon(&band, Paint::fill(Color::series(5)).with_opacity(0.25));
    }
    for run in &course.runs {
        panel.curve(svg, run.iter().copied(), Paint::stroke(Color::series(5), 0.9));
    }
    let median = times.iter().map(|&time| (time, median(&values_at(&course.runs, time))));
    panel.curve(svg, median, Paint::stroke(Color::series(0), 2.2));
    panel.frame(svg);
}

/// All times at which any run has a value.
fn times(runs: &[Vec<Point>]) -> Vec<f64> {
    let mut times: Vec<f64> = runs.iter().flatten().map(|at| at.0).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// The values of all runs at a time, in order of size.
fn values_at(runs: &[Vec<Point>], time: f64) -> Vec<f64> {
    let last = |run: &Vec<Point>| run[..run.partition_point(|at| at.0 <= time)].last().or(run.first()).map(|at| at.1);
    let mut values: Vec<f64> = runs.iter().filter_map(last).collect();
    values.sort_by(f64::total_cmp);
    values
}

fn median(sorted: &[f64]) -> f64 {
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { (sorted[middle - 1] + sorted[middle]) / 2.0 }
}
