//! Champions of several runs by behavior (paper, figure 3): each path in body lengths over cycles, one panel for each
//! behavior.

use crate::Color;
use crate::chart::{Panel, range_of};
use crate::element::{Anchor, Paint, Type};
use crate::svg::Svg;
use nbc_base::model::{Behavior, CYCLE_STEPS, Trajectory};

const COLUMNS: usize = 8;
const MAX_POINTS: usize = 400;

#[derive(Clone, Debug)]
pub struct Champions {
    pub behavior: Behavior,
    /// Each champion's path, and the columns of its body.
    pub paths: Vec<(Trajectory, usize)>,
}

/// `changes` are the cycles at which the stimuli change.
pub fn draw_champions(title: &str, champions: &[Champions], changes: &[f64]) -> Svg {
    let columns = COLUMNS.min(champions.len().max(1));
    let (width, pitch) = (columns as f64 * 132.0 + 70.0, 256.0);
    let mut svg = Svg::titled(width.max(320.0), 72.0 + pitch * champions.len().div_ceil(columns) as f64, title);
    let note = "in brackets: body lengths gone, quarter by quarter, on the mean";
    svg.text((14.0, 45.0), note, Type::new(10.0).colored(Color::GRAY));
    for (i, group) in champions.iter().enumerate() {
        let corner = (62.0 + (i % columns) as f64 * 132.0, 78.0 + (i / columns) as f64 * pitch);
        let word = group.behavior.to_string();
        svg.group(&format!("champions-{word}"), &word, |svg| {
            draw_panel(svg, corner, group, changes, i % columns == 0);
        });
    }
    svg
}

/// A path in body lengths from its start.
fn lengths((trajectory, columns): &(Trajectory, usize)) -> Vec<f64> {
    let start = trajectory.com_x.first().copied().unwrap_or(0.0);
    trajectory.com_x.iter().map(|x| (x - start) / (*columns).max(1) as f64).collect()
}

fn draw_panel(svg: &mut Svg, corner: (f64, f64), group: &Champions, changes: &[f64], first: bool) {
    let paths: Vec<Vec<f64>> = group.paths.iter().map(lengths).collect();
    let place = range_of(paths.iter().flatten().copied(), 0.06);
    let cycles = |steps: usize| steps as f64 / f64::from(CYCLE_STEPS);
    let longest = paths.iter().map(|path| cycles(path.len().saturating_sub(1))).fold(1.0, f64::max);
    let panel = Panel::new(corner, 112.0, 180.0, place, (0.0, longest)).downwards();
    svg.text((panel.left, panel.top - 7.0), &group.behavior.to_string(), Type::new(11.0).bold());
    let function = Type::new(10.0).colored(Color::GRAY).anchored(Anchor::End);
    svg.text((panel.right, panel.top - 7.0), group.behavior.function().name(), function);
    panel.x_axis(svg, 4);
    if first {
        panel.y_axis(svg, 5, "time (cycles)");
    }
    for &cycle in changes {
        let y = panel.y.at(cycle);
        svg.line((panel.left, y), (panel.right, y), Paint::stroke(Color::GRAY, 0.8).dashed(2.0));
    }
    panel.frame(svg);
    for (i, path) in paths.iter().enumerate() {
        let stride = path.len().div_ceil(MAX_POINTS).max(1);
        let points = path.iter().enumerate().step_by(stride).map(|(step, &x)| (x, cycles(step)));
        panel.curve(svg, points, Paint::stroke(Color::series(i), 1.2));
    }
    let mean = paths.iter().map(|path| walked(path)).sum::<f64>() / paths.len().max(1) as f64;
    panel.x_label(svg, &format!("body lengths ({mean:.1})"));
}

/// The length of the path in body lengths, in both directions: the sum over its quarters.
fn walked(path: &[f64]) -> f64 {
    let quarter = (path.len().saturating_sub(1) / 4).max(1);
    let stops: Vec<f64> = path.iter().copied().step_by(quarter).collect();
    stops.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum()
}
