//! Gait film-strips (paper, figure 2, right): one row for each spell of the schedule, snapshots of its last cycle side
//! by side, each over the ghosts of the two before it.

use crate::Color;
use crate::chart::with_minus;
use crate::color::Scheme;
use crate::element::{Paint, Point, Type};
use crate::image::draw_image;
use crate::looks::Looks;
use crate::stage::{Moment, Stage};
use crate::svg::Svg;
use nbc_base::model::{Body, CYCLE_STEPS, Schedule, Setting, Spell};

const SHOTS: usize = 7;
const STRIDE: u32 = CYCLE_STEPS / SHOTS as u32;
const GHOSTS: usize = 2;
const MAX_ROWS: usize = 40;
const IMAGE: f64 = 40.0;

pub fn draw_strip(title: &str, body: &Body, schedule: &Schedule, scheme: Scheme) -> Svg {
    let setting = Setting::default();
    let rows = snapshots(&setting, body, schedule);
    let side = body.width().max(body.height()) as f64;
    let scale = (110.0 / (side * 1.35)).min(16.0);
    let (pitch, height) = (side * 1.5 * scale + 14.0, tallest(&rows) * scale + 34.0);
    let mut svg = Svg::new(76.0 + pitch * SHOTS as f64, 58.0 + height * rows.len().max(1) as f64, title);
    svg.text((14.0, 28.0), title, Type::new(15.0).bold());
    let shown = if body.palette().image().is_some() { "image" } else { "pattern" };
    let note = format!("the last cycle under each {shown}; below the {shown}, voxels walked");
    svg.text((14.0, 46.0), &note, Type::new(10.0).colored(Color::GRAY));
    let looks = Looks::of([body], scheme);
    for (r, WalkedSpell { spell, walked, moments }) in rows.iter().enumerate() {
        let ground = 54.0 + (r as f64 + 1.0) * height - 18.0;
        match &spell.image {
            Some(image) => draw_image(&mut svg, (14.0, ground - 18.0 - IMAGE), IMAGE, image),
            None => {
                let pattern = spell.pattern.digits(body.palette().stimuli());
                svg.text((14.0, ground - 18.0), &pattern, Type::new(15.0).bold());
            }
        }
        let is_faulty = moments.last().is_some_and(|moment| moment.faults[0]);
        let walked = if is_faulty { "none".to_owned() } else { with_minus(&format!("{walked:+.2}")) };
        svg.text((14.0, ground - 4.0), &walked, Type::new(10.0).colored(Color::GRAY));
        svg.line((60.0, ground), (svg.width() - 12.0, ground), Paint::stroke(Color::GRAY, 1.5));
        for shot in GHOSTS..moments.len() {
            let left = 66.0 + (shot - GHOSTS) as f64 * pitch + pitch / 2.0;
            draw_shot(&mut svg, &moments[..=shot], (left, ground), scale, &looks);
        }
    }
    svg
}

/// How high the body ever reaches, in voxels above the ground.
fn tallest(rows: &[WalkedSpell<'_>]) -> f64 {
    let voxels = rows.iter().flat_map(|row| &row.moments).flat_map(|moment| &moment.poses[0].voxels);
    let heights = voxels.flat_map(|(corners, _)| corners.map(|(_, y)| y - 1.0));
    heights.filter(|height| height.is_finite()).fold(1.0, f64::max)
}

struct WalkedSpell<'a> {
    spell: &'a Spell,
    /// Voxels walked in it, up to the last of its moments.
    walked: f64,
    /// Moments of its last cycle, after as many that only leave ghosts.
    moments: Vec<Moment>,
}

fn snapshots<'a>(setting: &Setting, body: &Body, schedule: &'a Schedule) -> Vec<WalkedSpell<'a>> {
    let mut ends: Vec<u32> = Vec::new();
    let mut rows: Vec<WalkedSpell<'a>> = Vec::new();
    for spell in schedule.spells.iter().take(MAX_ROWS) {
        ends.push(ends.last().copied().unwrap_or(0) + spell.steps);
        rows.push(WalkedSpell { spell, walked: 0.0, moments: Vec::new() });
    }
    let mut start = None;
    for moment in Stage::of_trial(setting, body, schedule, STRIDE) {
        let Some(row) = ends.iter().position(|end| moment.step <= *end) else { break };
        let place = moment.centers[0][0];
        let WalkedSpell { walked, moments, .. } = &mut rows[row];
        let from = *start.get_or_insert(place);
        *walked = place - from;
        if moment.step == ends[row] {
            start = Some(place);
        }
        moments.push(moment);
        if moments.len() > SHOTS + GHOSTS {
            moments.remove(0);
        }
    }
    rows
}

fn draw_shot(svg: &mut Svg, moments: &[Moment], (middle, ground): Point, scale: f64, looks: &Looks) {
    let last = moments.len() - 1;
    let camera = moments[last].centers[0][0];
    let to_pixel = |(x, y): Point| (middle + (x - camera) * scale, ground - (y - 1.0) * scale);
    for (age, opacity) in [(2, 0.12), (1, 0.28), (0, 1.0)] {
        if let Some(at) = last.checked_sub(age) {
            moments[at].poses[0].draw(svg, looks, opacity, to_pixel);
        }
    }
    if moments[last].faults[0] {
        svg.text((middle - 24.0, ground + 13.0), "unstable", Type::new(10.0).colored(Color::FAULT).bold());
    }
}
