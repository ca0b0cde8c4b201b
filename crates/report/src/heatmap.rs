//! Archives as heat maps: the best fitness over two axes, with one map for each behavior or class if the archive has
//! such an axis.

use std::collections::{BTreeMap, BTreeSet};

use crate::Color;
use crate::chart::{Scale, range_of, tick_label};
use crate::element::{Anchor, Paint, Type};
use crate::svg::Svg;
use nbc_base::model::{Axis, Behavior, Count, Function};
use nbc_swarm::evolve::NicheKey;

const CELL: f64 = 26.0;
const COLUMNS: usize = 8;
const LEFT: f64 = 46.0;
const TOP: f64 = 66.0;
const GAP: (f64, f64) = (28.0, 52.0);
const KEY: f64 = 80.0;
const KEY_HEIGHT: f64 = 150.0;

/// Five steps of a map from dark to light that keeps its order in gray and for any color vision.
const MAP: [Color; 5] = [
    Color::new(68, 1, 84),
    Color::new(59, 82, 139),
    Color::new(33, 145, 140),
    Color::new(94, 201, 98),
    Color::new(253, 231, 37),
];

type Cells = BTreeMap<(u16, u16), f64>;

pub struct ArchiveMap<'a> {
    pub unit: &'a str,
    pub axes: &'a [Axis],
    pub stimuli: usize,
    pub niches: &'a [(&'a NicheKey, f64)],
}

/// Unless one of the two axes is that of behaviors or of classes, there is a small map for each of those.
pub fn draw_heatmap(title: &str, archive_map: &ArchiveMap<'_>, x: usize, y: usize) -> Svg {
    let axes = [x, y].map(|axis| Columns::of(archive_map, axis));
    let split = archive_map.axes.iter().position(|axis| !matches!(axis, Axis::Count { .. }));
    let split = split.filter(|&axis| axis != x && axis != y);
    let maps = collect(archive_map, x, y, split);
    let range = range_of(maps.values().flat_map(Cells::values).copied(), 0.0);
    let behaviors = |axis| Columns::of(archive_map, axis).bins.into_iter().map(Some).collect();
    let shown: Vec<Option<u16>> = split.map_or(vec![None], behaviors);
    let columns = COLUMNS.min(shown.len());
    let pitch = (axes[0].bins.len() as f64 * CELL + GAP.0, axes[1].bins.len() as f64 * CELL + GAP.1);
    let width = (LEFT + columns as f64 * pitch.0 + KEY).max(title.chars().count() as f64 * 10.0 + 30.0);
    let height = (TOP + shown.len().div_ceil(columns) as f64 * pitch.1).max(TOP + KEY_HEIGHT + 30.0);
    let mut svg = Svg::titled(width, height, title);
    let empty = Cells::new();
    for (i, behavior) in shown.iter().enumerate() {
        let place = (i % columns, i / columns);
        let corner = (LEFT + place.0 as f64 * pitch.0, TOP + place.1 as f64 * pitch.1);
        let cells = maps.get(behavior).unwrap_or(&empty);
        let map = Map { cells, axes: &axes, range, leftmost: place.0 == 0, lowest: i + columns >= shown.len() };
        let function = behavior.map(|bits| Function::of(archive_map.stimuli, bits as u8));
        let word = function.map_or(String::new(), |function| Behavior::from(function).to_string());
        let function = function.map_or("", Function::name);
        svg.group(&format!("map-{word}"), &format!("{word} {function}"), |svg| {
            map.draw(svg, corner, (&word, function));
        });
    }
    draw_key(&mut svg, LEFT + columns as f64 * pitch.0 + 14.0, range, archive_map.unit);
    svg
}

fn collect(archive_map: &ArchiveMap<'_>, x: usize, y: usize, split: Option<usize>) -> BTreeMap<Option<u16>, Cells> {
    let mut maps: BTreeMap<Option<u16>, Cells> = BTreeMap::new();
    for &(NicheKey(key), best) in archive_map.niches {
        let cells = maps.entry(split.map(|axis| key[axis])).or_default();
        let cell = cells.entry((key[x], key[y])).or_insert(best);
        *cell = cell.max(best);
    }
    maps
}

fn axis_label(axis: Axis) -> &'static str {
    match axis {
        Axis::Count { of: Count::Voxels, .. } => "voxels (bin)",
        Axis::Count { of: Count::Active, .. } => "active voxels (bin)",
        Axis::Count { of: Count::Sensory, .. } => "sensory voxels (bin)",
        Axis::Behavior => "behavior",
        Axis::Class => "class",
    }
}

struct Columns {
    axis: Axis,
    bins: Vec<u16>,
    stimuli: usize,
}

impl Columns {
    fn of(archive_map: &ArchiveMap<'_>, place: usize) -> Self {
        let (axis, stimuli) = (archive_map.axes[place], archive_map.stimuli);
        let filled = || archive_map.niches.iter().map(|(NicheKey(key), _)| key[place]).collect::<BTreeSet<u16>>();
        let bins = match axis {
            Axis::Count { bins, .. } => (0..bins as u16).collect(),
            Axis::Behavior if stimuli == 2 => (0..16).collect(),
            Axis::Behavior | Axis::Class => filled().into_iter().collect(),
        };
        Self { axis, bins, stimuli }
    }

    fn label(&self, bin: u16) -> String {
        match self.axis {
            Axis::Count { .. } => (bin + 1).to_string(),
            Axis::Behavior | Axis::Class => Behavior::from(Function::of(self.stimuli, bin as u8)).to_string(),
        }
    }
}

pub fn heat(share: f64) -> Color {
    let place = share.clamp(0.0, 1.0) * (MAP.len() - 1) as f64;
    let below = (place as usize).min(MAP.len() - 2);
    MAP[below].mix(MAP[below + 1], place - below as f64)
}

pub fn share((low, high): (f64, f64), value: f64) -> f64 {
    if high > low { (value - low) / (high - low) } else { 1.0 }
}

struct Map<'a> {
    cells: &'a Cells,
    axes: &'a [Columns; 2],
    range: (f64, f64),
    leftmost: bool,
    lowest: bool,
}

impl Map<'_> {
    fn draw(&self, svg: &mut Svg, (left, top): (f64, f64), (word, function): (&str, &str)) {
        let [columns, rows] = self.axes;
        let (across, down) = (columns.bins.len(), rows.bins.len());
        let (width, height) = (across as f64 * CELL, down as f64 * CELL);
        svg.text((left, top - 6.0), word, Type::new(11.0).bold());
        let small = Type::new(9.0).colored(Color::GRAY);
        svg.text((left + width, top - 6.0), function, small.anchored(Anchor::End));
        for row in 0..down {
            for column in 0..across {
                // The second axis grows upwards.
                let corner = (left + column as f64 * CELL, top + (down - 1 - row) as f64 * CELL);
                let found = self.cells.get(&(columns.bins[column], rows.bins[row]));
                let color = found.map_or(Color::WHITE, |&value| heat(share(self.range, value)));
                svg.rect(corner, CELL, CELL, Paint::fill(color).with_stroke(Color::PALE, 1.0));
            }
        }
        let middle = small.anchored(Anchor::Middle);
        for column in 0..across {
            let name = columns.label(columns.bins[column]);
            svg.text((left + (column as f64 + 0.5) * CELL, top + height + 11.0), &name, middle);
        }
        for row in 0..down {
            let y = top + (down as f64 - row as f64 - 0.5) * CELL + 3.0;
            svg.text((left - 4.0, y), &rows.label(rows.bins[row]), small.anchored(Anchor::End));
        }
        if self.lowest {
            svg.text((left + width / 2.0, top + height + 24.0), axis_label(columns.axis), middle);
        }
        if self.leftmost {
            let beside = if matches!(rows.axis, Axis::Count { .. }) { 18.0 } else { 36.0 };
            svg.text((left - beside, top + height / 2.0), axis_label(rows.axis), middle.upwards());
        }
    }
}

fn draw_key(svg: &mut Svg, left: f64, range: (f64, f64), unit: &str) {
    const STEPS: u32 = 70;
    let step_height = KEY_HEIGHT / f64::from(STEPS);
    for step in 0..STEPS {
        let color = heat(1.0 - (f64::from(step) + 0.5) / f64::from(STEPS));
        svg.rect((left, TOP + step_height * f64::from(step)), 14.0, step_height + 0.5, Paint::fill(color));
    }
    let scale = Scale::new(range, (TOP + KEY_HEIGHT, TOP));
    let ticks = scale.ticks(5);
    for &tick in &ticks {
        let y = scale.at(tick);
        svg.line((left + 14.0, y), (left + 18.0, y), Paint::stroke(Color::GRAY, 1.0));
        svg.text((left + 21.0, y + 3.5), &tick_label(tick, &ticks), Type::new(10.0).colored(Color::GRAY));
    }
    svg.text((left + 52.0, TOP + KEY_HEIGHT / 2.0), unit, Type::new(11.0).anchored(Anchor::Middle).upwards());
}
