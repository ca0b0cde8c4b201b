//! Archives as heat maps: the best fitness over two axes, one map for each behavior where the archive has a behavior axis.

use std::collections::BTreeMap;

use crate::evolve::Archive;
use crate::model::{Axis, Behavior, Count, Function};
use crate::report::Color;
use crate::report::chart::{range_of, tick_label};
use crate::report::svg::{Anchor, Paint, Svg, Type};

const CELL: f64 = 26.0;
const COLUMNS: usize = 4;

/// Five steps of a map from dark to light that keeps its order in gray and for any color vision.
const MAP: [Color; 5] = [
    Color::new(68, 1, 84),
    Color::new(59, 82, 139),
    Color::new(33, 145, 140),
    Color::new(94, 201, 98),
    Color::new(253, 231, 37),
];

/// What a map shows: the best first fitness of each pair of bins.
type Cells = BTreeMap<(u16, u16), f64>;

/// Draws an archive over two of its axes, by their places among `axes`; a behavior axis gives small multiples unless it is one of the two.
///
/// # Panics
/// When an axis is not there.
pub fn draw_heatmap(title: &str, archive: &Archive, axes: &[Axis], x: usize, y: usize) -> Svg {
    let split = axes.iter().position(|axis| *axis == Axis::Behavior).filter(|&axis| axis != x && axis != y);
    let maps = collect(archive, x, y, split);
    let (low, high) = range_of(maps.values().flat_map(Cells::values).copied(), 0.0);
    let (across, down) = (bins(axes[x]), bins(axes[y]));
    let shown: Vec<Option<u16>> = split.map_or(vec![None], |_| (0..16).map(Some).collect());
    let (pitch_x, pitch_y) = (across as f64 * CELL + 44.0, down as f64 * CELL + 62.0);
    let columns = COLUMNS.min(shown.len());
    let width = (columns as f64 * pitch_x + 130.0).max(title.chars().count() as f64 * 10.0 + 30.0);
    let mut svg = Svg::new(width, 58.0 + shown.len().div_ceil(columns) as f64 * pitch_y, title);
    svg.text((14.0, 28.0), title, Type::new(16.0).bold());
    let empty = Cells::new();
    for (i, behavior) in shown.iter().enumerate() {
        let corner = (44.0 + (i % columns) as f64 * pitch_x, 64.0 + (i / columns) as f64 * pitch_y);
        let word = behavior.map_or(String::new(), |bits| Behavior::from(Function::new(bits as u8)).to_string());
        let cells = maps.get(behavior).unwrap_or(&empty);
        let map = Map { cells, axes: (axes[x], axes[y]), range: (low, high) };
        svg.group(&format!("map-{word}"), &word, |svg| map.draw(svg, corner, &word));
    }
    draw_key(&mut svg, (low, high));
    svg
}

fn collect(archive: &Archive, x: usize, y: usize, split: Option<usize>) -> BTreeMap<Option<u16>, Cells> {
    let mut maps: BTreeMap<Option<u16>, Cells> = BTreeMap::new();
    for (key, elites) in archive.niches() {
        let best = elites.iter().map(|elite| elite.fitness[0]).fold(f64::NEG_INFINITY, f64::max);
        let cells = maps.entry(split.map(|axis| key.0[axis])).or_default();
        let cell = cells.entry((key.0[x], key.0[y])).or_insert(best);
        *cell = cell.max(best);
    }
    maps
}

fn bins(axis: Axis) -> usize {
    match axis {
        Axis::Count { bins, .. } => bins,
        Axis::Behavior => 16,
    }
}

fn axis_label(axis: Axis) -> &'static str {
    match axis {
        Axis::Count { of: Count::Voxels, .. } => "voxels (bin)",
        Axis::Count { of: Count::Active, .. } => "active voxels (bin)",
        Axis::Count { of: Count::Sensory, .. } => "sensory voxels (bin)",
        Axis::Behavior => "behavior",
    }
}

/// The color of a share from 0 to 1.
pub fn heat(share: f64) -> Color {
    let place = share.clamp(0.0, 1.0) * (MAP.len() - 1) as f64;
    let below = (place as usize).min(MAP.len() - 2);
    MAP[below].mix(MAP[below + 1], place - below as f64)
}

fn share((low, high): (f64, f64), value: f64) -> f64 {
    if high > low { (value - low) / (high - low) } else { 1.0 }
}

/// One map.
struct Map<'a> {
    cells: &'a Cells,
    axes: (Axis, Axis),
    range: (f64, f64),
}

impl Map<'_> {
    fn draw(&self, svg: &mut Svg, (left, top): (f64, f64), word: &str) {
        let (across, down) = (bins(self.axes.0), bins(self.axes.1));
        svg.text((left, top - 6.0), word, Type::new(11.0).bold());
        for row in 0..down {
            for column in 0..across {
                // The second axis grows upwards.
                let corner = (left + column as f64 * CELL, top + (down - 1 - row) as f64 * CELL);
                let found = self.cells.get(&(column as u16, row as u16));
                let color = found.map_or(Color::WHITE, |&value| heat(share(self.range, value)));
                svg.rect(corner, CELL, CELL, Paint::fill(color).with_stroke(Color::PALE, 1.0));
            }
        }
        let (middle, bottom) = (left + across as f64 * CELL / 2.0, top + down as f64 * CELL);
        let small = Type::new(9.0).colored(Color::GRAY).anchored(Anchor::Middle);
        svg.text((middle, bottom + 13.0), axis_label(self.axes.0), small);
        svg.text((left - 7.0, top + down as f64 * CELL / 2.0), axis_label(self.axes.1), small.upwards());
    }
}

fn draw_key(svg: &mut Svg, (low, high): (f64, f64)) {
    let (left, top, height) = (svg.width() - 74.0, 64.0, 140.0);
    for step in 0..50 {
        let y = top + height * f64::from(step) / 50.0;
        svg.rect((left, y), 14.0, height / 50.0 + 0.5, Paint::fill(heat(1.0 - f64::from(step) / 49.0)));
    }
    let values = [low, high];
    svg.text((left + 19.0, top + 8.0), &tick_label(high, &values), Type::new(10.0));
    svg.text((left + 19.0, top + height), &tick_label(low, &values), Type::new(10.0));
    svg.text((left - 8.0, top + height / 2.0), "fitness (voxels)", Type::new(10.0).anchored(Anchor::Middle).upwards());
}
