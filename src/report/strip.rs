//! Gait film-strips (paper, figure 3, right): one row for each spell of the schedule, snapshots of its last cycle side by side, each over
//! the ghosts of the two before it.

use crate::model::{Body, CYCLE_STEPS, Schedule, Setting};
use crate::report::Color;
use crate::report::sprite::Scheme;
use crate::report::stage::{Moment, Stage};
use crate::report::svg::{Paint, Point, Svg, Type};

/// Snapshots in a row.
const SHOTS: usize = 7;
/// Env steps from snapshot to snapshot.
const STRIDE: u32 = CYCLE_STEPS / SHOTS as u32;
const GHOSTS: usize = 2;
const MAX_ROWS: usize = 40;

/// Draws the strip of a body under a schedule.
pub fn draw_strip(title: &str, body: &Body, schedule: &Schedule, scheme: Scheme) -> Svg {
    let setting = Setting { palette: crate::model::Palette::paper(), ..Setting::paper() };
    let rows = snapshots(&setting, body, schedule);
    let side = body.width().max(body.height()) as f64;
    let scale = (110.0 / (side * 1.35)).min(16.0);
    let (pitch, height) = (side * 1.5 * scale + 14.0, body.height() as f64 * 1.4 * scale + 34.0);
    let mut svg = Svg::new(76.0 + pitch * SHOTS as f64, 48.0 + height * rows.len().max(1) as f64, title);
    svg.text((14.0, 28.0), title, Type::new(15.0).bold());
    for (r, (pattern, moments)) in rows.iter().enumerate() {
        let ground = 44.0 + (r as f64 + 1.0) * height - 18.0;
        svg.text((14.0, ground - 4.0), pattern, Type::new(15.0).bold());
        svg.line((60.0, ground), (svg.width() - 12.0, ground), Paint::stroke(Color::GRAY, 1.5));
        for shot in GHOSTS..moments.len() {
            let left = 66.0 + (shot - GHOSTS) as f64 * pitch + pitch / 2.0;
            draw_shot(&mut svg, &moments[..=shot], (left, ground), scale, scheme);
        }
    }
    svg
}

/// The pattern of each spell, and moments of its last cycle after as many that only leave ghosts.
fn snapshots(setting: &Setting, body: &Body, schedule: &Schedule) -> Vec<(String, Vec<Moment>)> {
    let mut ends: Vec<(u32, String)> = Vec::new();
    for spell in schedule.spells.iter().take(MAX_ROWS) {
        let start = ends.last().map_or(0, |(end, _)| *end);
        ends.push((start + spell.steps, spell.pattern.to_string()));
    }
    let mut rows: Vec<(String, Vec<Moment>)> = ends.iter().map(|(_, word)| (word.clone(), Vec::new())).collect();
    for moment in Stage::of_trial(setting, body, schedule, STRIDE) {
        let Some(row) = ends.iter().position(|(end, _)| moment.step <= *end) else { break };
        let kept = &mut rows[row].1;
        kept.push(moment);
        if kept.len() > SHOTS + GHOSTS {
            kept.remove(0);
        }
    }
    rows
}

/// The last of these moments over the ghosts of those before it, in one frame of reference.
fn draw_shot(svg: &mut Svg, moments: &[Moment], (middle, ground): Point, scale: f64, scheme: Scheme) {
    let last = moments.len() - 1;
    let camera = moments[last].centers[0][0];
    let to_pixel = |(x, y): Point| (middle + (x - camera) * scale, ground - (y - 1.0) * scale);
    for (age, opacity) in [(2, 0.12), (1, 0.28), (0, 1.0)] {
        if let Some(at) = last.checked_sub(age) {
            moments[at].poses[0].draw(svg, scheme, opacity, to_pixel);
        }
    }
    if moments[last].faults[0] {
        svg.text((middle - 24.0, ground + 13.0), "unstable", Type::new(10.0).colored(Color::FAULT).bold());
    }
}
