//! Performances by group of behaviors (paper, figure 5): every run as a dot, a cross at the mean, gaps where groups
//! differ, and the statistics below.

use crate::diag::counted;
use crate::report::Color;
use crate::report::chart::{Panel, range_of};
use crate::report::element::{Anchor, Paint, Point, Type};
use crate::report::groups::{BehaviorGroup, GroupComparison, SideComparison};
use crate::report::svg::Svg;

/// Groups with an adjusted p below this differ significantly.
const SIGNIFICANT: f64 = 0.05;
const TOP: f64 = 52.0;
const HEIGHT: f64 = 260.0;
/// Room for the names of the groups: at most four lines and the number of runs.
const NAMES: f64 = 100.0;
const LINE: f64 = 14.0;

/// Draws the groups side by side with all pairwise comparisons; `unit` is the measured quantity.
pub fn draw_comparison(
    title: &str,
    unit: &str,
    groups: &[BehaviorGroup],
    comparisons: &[GroupComparison],
    sides: Option<SideComparison>,
) -> Svg {
    let slots: Vec<f64> = (0..groups.len())
        .scan(-0.4, |slot, place| {
            *slot += if stands_apart(groups, comparisons, place) { 1.5 } else { 1.0 };
            Some(*slot)
        })
        .collect();
    let last = slots.last().copied().unwrap_or(0.0) + 0.6;
    let statistics = TOP + HEIGHT + NAMES;
    let mut svg = Svg::new(
        (last * 96.0 + 100.0).max(520.0),
        statistics + ((comparisons.len() + usize::from(sides.is_some())) as f64 + 1.0) * LINE + 14.0,
        title,
    );
    svg.text((14.0, 28.0), title, Type::new(16.0).bold());
    let high = range_of(groups.iter().flat_map(|group| group.values.iter().copied()), 0.08).1;
    let panel = Panel::new((64.0, TOP), svg.width() - 84.0, HEIGHT, (0.0, last), (0.0, high));
    panel.y_axis(&mut svg, 5);
    panel.y_label(&mut svg, unit);
    panel.frame(&mut svg);
    for (group, &slot) in groups.iter().zip(&slots) {
        let first = group.name.split(',').next().unwrap_or_default();
        svg.group(&format!("group-{first}"), group.name, |svg| draw_group(svg, &panel, group, slot));
    }
    draw_statistics(&mut svg, (14.0, statistics), groups, comparisons);
    if let Some(SideComparison { p, a12 }) = sides {
        let y = statistics + LINE * (comparisons.len() as f64 + 1.4);
        draw_statistic(&mut svg, (14.0, y), "XXYY against XYXY", p, &format!("{a12:.2}, alone: not adjusted"));
    }
    svg
}

/// Whether a group differs significantly from every group before it.
fn stands_apart(groups: &[BehaviorGroup], comparisons: &[GroupComparison], place: usize) -> bool {
    let significant =
        |before: usize| comparisons.iter().any(|pair| pair.groups == [before, place] && pair.p_adjusted < SIGNIFICANT);
    place > 0 && (0..place).filter(|&before| !groups[before].values.is_empty()).all(significant)
}

fn draw_group(svg: &mut Svg, panel: &Panel, group: &BehaviorGroup, slot: f64) {
    let color = [Color::series(4), Color::series(5), Color::series(2)][group.stimuli.min(2)];
    let count = group.values.len();
    for (i, &value) in group.values.iter().enumerate() {
        // The dots of a group are next to each other.
        let beside = ((i as f64 + 0.5) / count as f64 - 0.5) * 0.5;
        svg.circle(panel.at((slot + beside, value)), 3.6, Paint::fill(color).with_opacity(0.85));
    }
    let (x, _) = panel.at((slot, 0.0));
    let words: Vec<&str> = group.name.split(", ").collect();
    for (i, word) in words.iter().enumerate() {
        svg.text((x, panel.bottom + 16.0 + 13.0 * i as f64), word, Type::new(11.0).anchored(Anchor::Middle));
    }
    let small = Type::new(9.5).colored(Color::GRAY).anchored(Anchor::Middle);
    let runs = counted(count, "run");
    svg.text((x, panel.bottom + 17.0 + 13.0 * words.len() as f64), &runs, small);
    if count > 0 {
        let (x, y) = panel.at((slot, group.values.iter().sum::<f64>() / count as f64));
        let paint = Paint::stroke(Color::BLACK, 2.0);
        svg.line((x - 5.0, y - 5.0), (x + 5.0, y + 5.0), paint);
        svg.line((x - 5.0, y + 5.0), (x + 5.0, y - 5.0), paint);
    }
}

/// A line for each comparison.
fn draw_statistics(svg: &mut Svg, (left, top): Point, groups: &[BehaviorGroup], comparisons: &[GroupComparison]) {
    let small = Type::new(10.0).colored(Color::GRAY);
    let method = "exact two-sided Mann-Whitney U, Holm-adjusted; A12: how often the first exceeds the second; x: mean";
    svg.text((left, top), method, small);
    for (i, pair) in comparisons.iter().enumerate() {
        let y = top + LINE * (i as f64 + 1.4);
        let [a, b] = pair.groups.map(|place| groups[place].name.split(',').next().unwrap_or_default());
        let ties = if pair.is_approximate { ", approximate for ties" } else { "" };
        let a12 = format!("{:.2}{ties}", pair.a12);
        draw_statistic(svg, (left, y), &format!("{a} against {b}"), pair.p_adjusted, &a12);
    }
}

fn draw_statistic(svg: &mut Svg, (left, y): Point, compared: &str, p: f64, a12: &str) {
    svg.text((left, y), compared, Type::new(10.0));
    svg.text((left + 130.0, y), &format!("p = {}", p_value(p)), Type::new(10.0));
    svg.text((left + 220.0, y), &format!("A12 = {a12}"), Type::new(10.0));
}

fn p_value(p: f64) -> String {
    if p < 0.001 { format!("{p:.1e}") } else { format!("{p:.3}") }
}
