//! Curves over time: the width of a material, and the stimuli of a schedule.

use crate::Color;
use crate::chart::Panel;
use crate::color::Scheme;
use crate::element::{Paint, Point, Type};
use crate::svg::Svg;
use nbc_base::model::{CYCLE_STEPS, Material, MaterialKind, Palette, Pattern, Schedule, Spell};
use nbc_sim::{Constants, Signals};

const WIDTH: f64 = 420.0;
const LEFT: f64 = 52.0;
const TOP: f64 = 30.0;
const PANEL: f64 = 110.0;
const TRACK: f64 = 34.0;
const SAMPLES: u32 = 240;

/// `None` for a passive material.
pub fn draw_response(material: &Material) -> Option<Svg> {
    let palette = Palette::new(vec![material.clone()]);
    let signals = Signals::new(&palette, &Constants::default());
    let (samples, is_sensor) = match material.kind {
        MaterialKind::Rigid | MaterialKind::Soft => return None,
        MaterialKind::Actuator(drive) => (periods(&signals, drive.period), false),
        MaterialKind::Sensor(response) => (appearance(&signals, response.stimulus), true),
    };
    let end = samples.last().map_or(1.0, |(time, _)| *time);
    let mut svg = Svg::new(WIDTH, TOP + PANEL + 40.0, &material.name);
    let panel = Panel::new((LEFT, TOP), WIDTH - LEFT - 12.0, PANEL, (0.0, end), (0.5, 1.7));
    if is_sensor {
        mark_present(&mut svg, &panel);
    }
    panel.x_axis(&mut svg, 6);
    panel.y_axis(&mut svg, 4, "width");
    panel.frame(&mut svg);
    panel.title(&mut svg, &material.name);
    panel.x_label(&mut svg, "cycles");
    let color = material.paper_code().map_or(Color::SERIES[0], |code| Scheme::default().color(code));
    panel.curve(&mut svg, samples, Paint::stroke(color, 2.0));
    Some(svg)
}

fn periods(signals: &Signals, period: u32) -> Vec<Point> {
    let (steps, nothing) = (2 * period, Spell::of(Pattern::new(&[]), 1));
    let every = steps.div_ceil(SAMPLES).max(1) as usize;
    (0..=steps).step_by(every).map(|step| (cycles(step), signals.target(1, step, &nothing))).collect()
}

fn appearance(signals: &Signals, stimulus: usize) -> Vec<Point> {
    let width = |present: bool| {
        let pattern: Vec<bool> = (0..=stimulus).map(|i| present && i == stimulus).collect();
        signals.target(1, 0, &Spell::of(Pattern::new(&pattern), 1))
    };
    let ends = |cycle: u8| {
        let (start, width) = (f64::from(cycle), width(cycle == 1));
        [(start, width), (start + 1.0, width)]
    };
    (0..3).flat_map(ends).collect()
}

fn mark_present(svg: &mut Svg, panel: &Panel) {
    let (left, right) = (panel.at((1.0, 0.0)).0, panel.at((2.0, 0.0)).0);
    svg.rect((left, panel.top), right - left, PANEL, Paint::fill(Color::PALE));
    svg.text((left + 4.0, panel.top + 12.0), "present", Type::new(10.0).colored(Color::GRAY));
}

pub fn draw_schedule(title: &str, schedule: &Schedule, stimuli: &[(usize, &str)]) -> Svg {
    let height = TRACK * stimuli.len().max(1) as f64;
    let mut svg = Svg::new(WIDTH, TOP + height + 40.0, title);
    let whole = Panel::new((LEFT, TOP), WIDTH - LEFT - 12.0, height, (0.0, cycles(schedule.steps())), (0.0, 1.0));
    whole.x_axis(&mut svg, 8);
    whole.title(&mut svg, title);
    whole.x_label(&mut svg, "cycles");
    for (at, (stimulus, name)) in stimuli.iter().enumerate() {
        let top = TOP + TRACK * at as f64;
        let track = Panel::new((LEFT, top), WIDTH - LEFT - 12.0, TRACK, (0.0, cycles(schedule.steps())), (-0.2, 1.2));
        track.frame(&mut svg);
        svg.text((6.0, top + TRACK / 2.0 + 4.0), name, Type::new(11.0));
        track.curve(&mut svg, presence(schedule, *stimulus), Paint::stroke(Color::series(at), 2.0));
    }
    svg
}

fn presence(schedule: &Schedule, stimulus: usize) -> Vec<Point> {
    let mut start = 0;
    let mut points = Vec::new();
    for spell in &schedule.spells {
        let level = f64::from(u8::from(spell.pattern.has(stimulus)));
        points.push((cycles(start), level));
        start += spell.steps;
        points.push((cycles(start), level));
    }
    points
}

fn cycles(steps: u32) -> f64 {
    f64::from(steps) / f64::from(CYCLE_STEPS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn actuators_and_sensors_have_a_curve() {
        let palette = Palette::paper();
        let drawn: Vec<_> = palette.materials().iter().map(|material| draw_response(material).is_some()).collect();
        assert_eq!(drawn, [false, false, true, true, true, true, true, true]);
    }

    #[test]
    fn a_sensor_jumps_when_its_stimulus_appears_and_disappears() {
        let palette = Palette::new(vec![Palette::paper().material(8).unwrap().clone()]);
        let widths = appearance(&Signals::new(&palette, &Constants::default()), 1);
        assert_eq!(widths, [(0.0, 0.6), (1.0, 0.6), (1.0, 1.6), (2.0, 1.6), (2.0, 0.6), (3.0, 0.6)]);
    }

    #[test]
    fn a_stimulus_is_drawn_at_both_ends_of_each_spell() {
        let [off, on] = [[false, false], [false, true]].map(|present| Pattern::new(&present));
        let spells = vec![Spell::of(off, 84), Spell::of(on, 168)];
        assert_eq!(presence(&Schedule { spells }, 1), [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (3.0, 1.0)]);
    }
}
