//! Performances by group (paper, figure 5): every run's champion as a dot, a cross at the mean, and gaps where groups differ.

use crate::report::Color;
use crate::report::chart::{Panel, range_of};
use crate::report::svg::{Anchor, Paint, Svg, Type};

/// One group of champions.
#[derive(Clone, Debug)]
pub struct Group {
    /// Its name, such as `XXYY`.
    pub name: String,
    /// How many stimuli its robots answer, which gives the color.
    pub stimuli: usize,
    /// One value for each run.
    pub values: Vec<f64>,
    /// Whether it is worse than every group before it by the test that was used; a gap then stands before it.
    pub apart: bool,
}

/// Draws the groups side by side; `unit` is what is measured, `note` says which test decided where the gaps are.
pub fn draw_comparison(title: &str, unit: &str, note: &str, groups: &[Group]) -> Svg {
    let slots: Vec<f64> = groups
        .iter()
        .scan(-0.5, |slot, group| {
            *slot += if group.apart { 2.0 } else { 1.0 };
            Some(*slot)
        })
        .collect();
    let last = slots.last().copied().unwrap_or(0.0) + 0.7;
    let mut svg = Svg::new((last * 62.0 + 100.0).max(420.0), 420.0, title);
    svg.text((14.0, 28.0), title, Type::new(16.0).bold());
    svg.text((14.0, 410.0), note, Type::new(10.0).colored(Color::GRAY));
    let high = range_of(groups.iter().flat_map(|group| group.values.iter().copied()), 0.08).1;
    let width = svg.width() - 90.0;
    let panel = Panel::new((64.0, 52.0), width, 290.0, (-0.2, last), (0.0, high));
    panel.y_axis(&mut svg, 5);
    panel.y_label(&mut svg, unit);
    panel.frame(&mut svg);
    for (group, &slot) in groups.iter().zip(&slots) {
        svg.group(&format!("group-{}", group.name), &group.name, |svg| draw_group(svg, &panel, group, slot));
    }
    svg
}

fn draw_group(svg: &mut Svg, panel: &Panel, group: &Group, slot: f64) {
    let color = [Color::series(4), Color::series(5), Color::series(2)][group.stimuli.min(2)];
    let count = group.values.len();
    for (i, &value) in group.values.iter().enumerate() {
        // Dots of one group stand beside each other.
        let beside = ((i as f64 + 0.5) / count as f64 - 0.5) * 0.5;
        svg.circle(panel.at((slot + beside, value)), 3.2, Paint::fill(color).with_opacity(0.8));
    }
    let (x, _) = panel.at((slot, 0.0));
    svg.text((x, panel.bottom + 16.0), &group.name, Type::new(10.0).anchored(Anchor::Middle));
    let n = format!("n = {count}");
    svg.text((x, panel.bottom + 29.0), &n, Type::new(9.0).colored(Color::GRAY).anchored(Anchor::Middle));
    if count > 0 {
        let (x, y) = panel.at((slot, group.values.iter().sum::<f64>() / count as f64));
        let paint = Paint::stroke(Color::BLACK, 2.0);
        svg.line((x - 5.0, y - 5.0), (x + 5.0, y + 5.0), paint);
        svg.line((x - 5.0, y + 5.0), (x + 5.0, y - 5.0), paint);
    }
}
