//! Performances by group of behaviors (paper, figure 4): every run as a dot, a cross at the mean, gaps where groups of
//! another difficulty differ, and below a table of all pairs. Accuracies of bodies are drawn alike.

use crate::Color;
use crate::chart::{Panel, range_of, with_minus};
use crate::element::{Anchor, Paint, Type};
use crate::groups::{BehaviorGroup, GroupComparison, describe_method, mark};
use crate::svg::Svg;
use nbc_base::diag::counted;

const SIGNIFICANT: f64 = 0.05;
const TOP: f64 = 52.0;
const HEIGHT: f64 = 260.0;
const NAMES: f64 = 56.0;
const PITCH: f64 = 74.0;
const CELLS: f64 = 64.0;
const CELL: (f64, f64) = (84.0, 30.0);
const LEGEND: f64 = 52.0;

pub fn draw_comparison(title: &str, unit: &str, groups: &[BehaviorGroup], comparisons: &[GroupComparison]) -> Svg {
    let slots: Vec<f64> = (0..groups.len())
        .scan(-0.4, |slot, place| {
            *slot += if is_set_apart(groups, comparisons, place) { 1.5 } else { 1.0 };
            Some(*slot)
        })
        .collect();
    let last = slots.last().copied().unwrap_or(0.0) + 0.6;
    let table = TOP + HEIGHT + NAMES;
    let mut svg = Svg::titled(
        (last * PITCH + 84.0).max(CELLS + groups.len() as f64 * CELL.0).max(520.0),
        table + LEGEND + groups.len() as f64 * CELL.1,
        title,
    );
    let high = range_of(groups.iter().flat_map(|group| group.values.iter().copied()), 0.08).1;
    let panel = Panel::new((64.0, TOP), last * PITCH, HEIGHT, (0.0, last), (0.0, high));
    panel.y_axis(&mut svg, 5, unit);
    panel.frame(&mut svg);
    for (group, &slot) in groups.iter().zip(&slots) {
        let color = [4, 5, 2].map(Color::series)[group.stimuli.min(2)];
        svg.group(&format!("group-{}", group.name), group.name, |svg| {
            draw_values(svg, &panel, slot, (group.name, "run"), &group.values, color);
        });
    }
    draw_table(&mut svg, table, groups, comparisons);
    svg
}

/// Whether a group is the first of its difficulty, and each of this difficulty goes significantly less far than each of
/// the groups before.
fn is_set_apart(groups: &[BehaviorGroup], comparisons: &[GroupComparison], place: usize) -> bool {
    let difficulty = groups[place].difficulty;
    let found = |group: &BehaviorGroup| !group.values.is_empty();
    let mut across = comparisons.iter().filter(|pair| {
        let [easier, harder] = pair.groups.map(|at| groups[at].difficulty);
        easier < difficulty && harder == difficulty
    });
    groups[..place].iter().all(|before| before.difficulty < difficulty)
        && groups[..place].iter().any(found)
        && groups.iter().any(|group| group.difficulty == difficulty && found(group))
        && across.all(|pair| pair.p_adjusted < SIGNIFICANT && pair.a12 > 0.5)
}

/// A dot for each value, a cross at their mean, and below the panel the name and the number of values.
pub(super) fn draw_values(
    svg: &mut Svg,
    panel: &Panel,
    slot: f64,
    (name, what): (&str, &str),
    values: &[f64],
    color: Color,
) {
    let count = values.len();
    for (i, &value) in values.iter().enumerate() {
        let beside = ((i as f64 + 0.5) / count as f64 - 0.5) * 0.5;
        svg.circle(panel.at((slot + beside, value)), 3.6, Paint::fill(color).with_opacity(0.85));
    }
    let x = panel.x.at(slot);
    svg.text((x, panel.bottom + 16.0), name, Type::new(11.0).anchored(Anchor::Middle));
    let small = Type::new(9.5).colored(Color::GRAY).anchored(Anchor::Middle);
    svg.text((x, panel.bottom + 30.0), &counted(count, what), small);
    if count > 0 {
        let mean = values.iter().sum::<f64>() / count as f64;
        svg.cross(panel.at((slot, mean)), Paint::stroke(Color::BLACK, 2.0));
    }
}

/// A row for each group but the last, a column for each but the first: A12 with its mark, and p.
fn draw_table(svg: &mut Svg, top: f64, groups: &[BehaviorGroup], comparisons: &[GroupComparison]) {
    let small = Type::new(10.0).colored(Color::GRAY);
    let legend = [
        "A12: how often a run of the row goes farther than one of the column; * p < 0.05, ** p < 0.01, *** p < 0.001",
        &format!("p: {}; x: mean", describe_method(comparisons)),
    ];
    for (line, y) in legend.iter().zip([top, top + 14.0]) {
        svg.text((14.0, y), line, small);
    }
    let corner =
        |row: usize, column: usize| (CELLS + (column as f64 - 1.0) * CELL.0, top + LEGEND - 14.0 + row as f64 * CELL.1);
    let name = Type::new(11.0).anchored(Anchor::Middle);
    for (at, group) in groups.iter().enumerate() {
        if at > 0 {
            let (x, y) = corner(0, at);
            svg.text((x + CELL.0 / 2.0, y - 6.0), group.name, name);
        }
        if at + 1 < groups.len() {
            svg.text((14.0, corner(at, 1).1 + CELL.1 / 2.0 + 4.0), group.name, Type::new(11.0));
        }
    }
    for pair in comparisons {
        let (x, y) = corner(pair.groups[0], pair.groups[1]);
        let stars = mark(pair.p_adjusted);
        let shade = Paint::fill(Color::series(0)).with_opacity(0.12 * stars.len() as f64);
        svg.rect((x + 1.0, y + 1.0), CELL.0 - 2.0, CELL.1 - 2.0, shade);
        let ties = if pair.is_approximate { " (ties)" } else { "" };
        svg.text((x + CELL.0 / 2.0, y + 13.0), &format!("{:.2}{stars}", pair.a12), name);
        let p = format!("{}{ties}", p_value(pair.p_adjusted));
        svg.text((x + CELL.0 / 2.0, y + 25.0), &p, Type::new(9.0).colored(Color::GRAY).anchored(Anchor::Middle));
    }
}

fn p_value(p: f64) -> String {
    if p < 0.001 { with_minus(&format!("{p:.1e}")) } else { format!("{p:.3}") }
}

/// Draws the shares, from 0 to 1, of each evolution side by side: a dot for each body, a cross at the mean.
pub fn draw_accuracies(title: &str, groups: &[(&str, Vec<f64>)]) -> Svg {
    let (height, pitch) = (220.0, 100.0);
    let percent: Vec<Vec<f64>> =
        groups.iter().map(|(_, shares)| shares.iter().map(|share| 100.0 * share).collect()).collect();
    let least = percent.iter().flatten().copied().fold(100.0, f64::min);
    let width = (groups.len() as f64 * pitch).max(200.0);
    let mut svg = Svg::titled(width + 84.0, TOP + height + 46.0, title);
    let low = (10.0 * libm::floor(least / 10.0)).min(90.0);
    let panel = Panel::new((64.0, TOP), width, height, (-0.5, groups.len() as f64 - 0.5), (low, 101.0));
    panel.y_axis(&mut svg, 5, "told apart, %");
    panel.frame(&mut svg);
    for (place, ((name, _), values)) in groups.iter().zip(&percent).enumerate() {
        let color = Color::series(place);
        svg.group(&format!("evolution-{name}"), name, |svg| {
            draw_values(svg, &panel, place as f64, (name, "body"), values, color);
        });
    }
    svg
}
