//! Spacetime diagrams (paper, figures 2 and 5): time runs downwards in cycles, position across in voxels. Beside each
//! path are the bits that the robot sensed and the bit that it output.

use std::collections::BTreeSet;

use crate::Color;
use crate::chart::{Panel, range_of, with_minus};
use crate::element::{Anchor, Paint, Point, Type};
use crate::svg::{Svg, shorten};
use nbc_base::model::{CYCLE_STEPS, Column, Fault, Schedule, Trajectory, Trial};
use nbc_swarm::{RobotTrace, StimulusSource, SwarmTrace};

const PANEL_WIDTH: f64 = 150.0;
const LETTER_WIDTH: f64 = 7.0;
const BESIDE_PANEL: f64 = 130.0;
const MOST_WALKED: usize = 12;
const STRIP_WIDTH: f64 = 13.0;
const STRIP_GAP: f64 = 4.0;
const MARGIN: f64 = 56.0;
const HEADING: f64 = 74.0;
const FOOT: f64 = 46.0;
const MAX_COLUMNS: usize = 6;
const MAX_PANELS: usize = 36;
/// The most points of one path: more than its panel has pixels from top to bottom.
const MAX_POINTS: usize = 800;

#[derive(Clone, Debug)]
pub struct Track {
    pub title: String,
    pub subtitle: String,
    /// Positions in voxels, evenly spaced over the cycles, both ends included.
    pub path: Vec<f64>,
    pub cycles: f64,
    pub sensed: Vec<Strip>,
    pub output: Option<Strip>,
    pub fault: Option<f64>,
}

#[derive(Clone, Debug)]
pub struct Strip {
    pub name: String,
    pub color: Color,
    pub spells: Spells,
}

/// Spells of one value: the end of each in cycles, and the value.
#[derive(Clone, Debug)]
pub enum Spells {
    Bits(Vec<(f64, bool)>),
    Values(Vec<(f64, String)>),
}

impl Strip {
    pub fn of_cycles(name: impl Into<String>, color: Color, bits: impl IntoIterator<Item = bool>) -> Self {
        let spells = bits.into_iter().enumerate().map(|(cycle, bit)| ((cycle + 1) as f64, bit)).collect();
        Self { name: name.into(), color, spells: Spells::Bits(spells) }
    }

    fn of_input(trace: &SwarmTrace, port: usize, color: Color) -> Self {
        let Column { name, width, .. } = &trace.inputs[port];
        let values = (0..trace.cycles.len()).map(|cycle| trace.input_values(cycle).swap_remove(port));
        if *width == 1 {
            return Self::of_cycles(name, color, values.map(|value| value.bits[0] == Some(true)));
        }
        let spells = values.enumerate().map(|(cycle, value)| ((cycle + 1) as f64, value.to_string())).collect();
        Self { name: name.clone(), color, spells: Spells::Values(spells) }
    }
}

pub fn draw_robot(name: &str, trial: &Trial, trajectory: &Trajectory) -> Svg {
    let (schedule, palette) = (&trial.schedule, trial.body.palette());
    // An image has no strip: it is not one bit.
    let stimuli = if palette.image().is_some() { 0 } else { palette.stimuli() };
    let cycles_of = |steps: u32| f64::from(steps) / f64::from(CYCLE_STEPS);
    let ends: Vec<f64> = schedule
        .spells
        .iter()
        .scan(0, |steps, spell| {
            *steps += spell.steps;
            Some(cycles_of(*steps))
        })
        .collect();
    let strip = |i: usize| Strip {
        name: format!("stimulus {}", i + 1),
        color: Color::stimulus(i),
        spells: Spells::Bits(
            schedule.spells.iter().zip(&ends).map(|(spell, &end)| (end, spell.pattern.has(i))).collect(),
        ),
    };
    let track = Track {
        title: String::new(),
        subtitle: String::new(),
        path: trajectory.com_x.clone(),
        cycles: (trajectory.com_x.len().saturating_sub(1)) as f64 / f64::from(CYCLE_STEPS),
        sensed: (0..stimuli).map(strip).collect(),
        output: None,
        fault: trajectory.fault.map(|fault| cycles_of(fault.env_step - 1)),
    };
    let heading = format!("voxels walked: {}", walked(schedule, stimuli, trajectory));
    // The heading needs more width than the path if there are many patterns.
    let panel = (heading.chars().count() as f64 * LETTER_WIDTH - BESIDE_PANEL).max(2.0 * PANEL_WIDTH);
    let rows = [Row { heading: Some(heading), tracks: &[track], changes: &ends, panel }];
    draw_rows(&format!("{name} in space and time"), cycles_of(schedule.steps()), &rows)
}

/// Such as `00 +1.20, 11 −0.31`, or `+1.20, −0.31` without stimuli: complete spells, and of many the first.
fn walked(schedule: &Schedule, stimuli: usize, trajectory: &Trajectory) -> String {
    let mut start = 0;
    let mut told = Vec::new();
    for spell in &schedule.spells {
        let end = start + spell.steps as usize;
        let Some(place) = trajectory.com_x.get(end) else { break };
        let voxels = with_minus(&format!("{:+.2}", place - trajectory.com_x[start]));
        told.push(format!("{} {voxels}", spell.pattern.digits(stimuli)).trim_start().to_owned());
        start = end;
        if told.len() == MOST_WALKED && schedule.spells.len() > MOST_WALKED {
            told.push("\u{2026}".to_owned());
            break;
        }
    }
    told.join(", ")
}

/// As in the paper, figure 5. Of a large swarm it shows the robots of outputs and of named nets.
pub fn draw_swarm(trace: &SwarmTrace) -> Svg {
    let changes = input_changes(trace);
    let chosen: BTreeSet<usize> = trace.by_interest().into_iter().take(MAX_PANELS).collect();
    let robots: Vec<Track> = chosen.iter().map(|&k| robot_track(trace, k)).collect();
    let outputs: Vec<Track> = (0..trace.shown.len().min(MAX_PANELS)).filter_map(|o| output_track(trace, o)).collect();
    let heading = match trace.robots.len() - chosen.len() {
        0 => "each robot with its own stimuli".to_owned(),
        more => format!(
            "{} robots with their own stimuli, those of outputs and of named nets first; {more} more are not shown",
            chosen.len()
        ),
    };
    let mut rows = rows(&heading, &robots, &changes);
    rows.extend(self::rows("outputs against the inputs of the swarm", &outputs, &changes));
    draw_rows(&format!("{} in space and time", trace.circuit), length(trace), &rows)
}

pub fn draw_chosen(trace: &SwarmTrace, robots: &[usize]) -> Svg {
    let changes = input_changes(trace);
    let tracks: Vec<Track> =
        robots.iter().map(|&k| Track { sensed: input_strips(trace), ..robot_track(trace, k) }).collect();
    let rows = rows("robots against the inputs of the swarm", &tracks, &changes);
    draw_rows(&format!("{} in space and time", trace.circuit), length(trace), &rows)
}

fn rows<'a>(heading: &str, tracks: &'a [Track], changes: &'a [f64]) -> Vec<Row<'a>> {
    let mut heading = Some(heading.to_owned());
    let row = |tracks| Row { heading: heading.take(), tracks, changes, panel: PANEL_WIDTH };
    tracks.chunks(MAX_COLUMNS).map(row).collect()
}

fn length(trace: &SwarmTrace) -> f64 {
    (trace.cycles.len() + usize::from(trace.fault().is_some())) as f64
}

fn input_changes(trace: &SwarmTrace) -> Vec<f64> {
    let pairs = trace.cycles.windows(2).enumerate();
    pairs.filter(|(_, pair)| pair[0].inputs != pair[1].inputs).map(|(cycle, _)| (cycle + 1) as f64).collect()
}

fn robot_track(trace: &SwarmTrace, k: usize) -> Track {
    let robot = &trace.robots[k];
    let sensed = (0..robot.senses.len()).filter_map(|i| {
        let bits = trace.cycles.iter().map(|cycle| cycle.sensed[k].has(i));
        let wired = !matches!(robot.senses[i], StimulusSource::Constant(_));
        wired.then(|| Strip::of_cycles(&robot.sensed_nets[i], signal_color(trace, robot.senses[i]), bits))
    });
    let bits = trace.cycles.iter().map(|cycle| cycle.bits[k]);
    Track {
        title: format!("{} = {}", robot.net, robot.function),
        subtitle: robot.robot.clone(),
        sensed: sensed.collect(),
        output: Some(Strip::of_cycles(&robot.net, Color::OUTPUT, bits)),
        ..bare_track(trace, robot)
    }
}

fn output_track(trace: &SwarmTrace, output: usize) -> Option<Track> {
    let StimulusSource::Robot(k) = trace.shown[output] else { return None };
    let robot = &trace.robots[k];
    let bits = trace.cycles.iter().map(|cycle| cycle.outputs[output]);
    let name = trace.outputs.iter().flat_map(Column::bits).nth(output)?;
    Some(Track {
        title: format!("output {name}"),
        subtitle: format!("robot {}", robot.net),
        sensed: input_strips(trace),
        output: Some(Strip::of_cycles(name, Color::OUTPUT, bits)),
        ..bare_track(trace, robot)
    })
}

fn input_strips(trace: &SwarmTrace) -> Vec<Strip> {
    (0..trace.inputs.len().min(8)).map(|port| Strip::of_input(trace, port, Color::input(port))).collect()
}

fn signal_color(trace: &SwarmTrace, source: StimulusSource) -> Color {
    let StimulusSource::Input(bit) = source else { return Color::OUTPUT };
    let ports = trace.inputs.iter().enumerate();
    let mut bits = ports.flat_map(|(port, column)| std::iter::repeat_n(port, column.width));
    Color::input(bits.nth(bit).unwrap_or(0))
}

fn bare_track(trace: &SwarmTrace, robot: &RobotTrace) -> Track {
    let step = |fault: Fault| f64::from(fault.env_step - 1) / f64::from(CYCLE_STEPS);
    Track {
        title: String::new(),
        subtitle: String::new(),
        path: robot.com_x.clone(),
        cycles: robot.com_x.len().saturating_sub(1) as f64 / trace.samples_per_cycle.max(1) as f64,
        sensed: Vec::new(),
        output: None,
        fault: robot.fault.map(step),
    }
}

struct Row<'a> {
    heading: Option<String>,
    tracks: &'a [Track],
    changes: &'a [f64],
    panel: f64,
}

impl Row<'_> {
    fn strips(&self) -> f64 {
        let most = self.tracks.iter().map(|track| track.sensed.len()).max().unwrap_or(0);
        most as f64 * (STRIP_WIDTH + STRIP_GAP)
    }

    fn pitch(&self) -> f64 {
        self.strips() + self.panel + STRIP_WIDTH + STRIP_GAP + 26.0
    }

    fn width(&self) -> f64 {
        MARGIN + self.tracks.len() as f64 * self.pitch() + 10.0
    }
}

fn draw_rows(title: &str, cycles: f64, rows: &[Row<'_>]) -> Svg {
    let height = (cycles * 9.0).clamp(220.0, 620.0);
    let top = 44.0;
    let pitch = HEADING + height + FOOT;
    let width = rows.iter().map(Row::width).fold(title.chars().count() as f64 * 10.8 + 28.0, f64::max);
    let mut svg = Svg::new(width, top + pitch * rows.len() as f64, title);
    svg.text((14.0, 28.0), title, Type::new(17.0).bold());
    for (r, row) in rows.iter().enumerate() {
        draw_row(&mut svg, row, top + r as f64 * pitch, cycles, height);
    }
    svg
}

fn draw_row(svg: &mut Svg, row: &Row<'_>, top: f64, cycles: f64, height: f64) {
    if let Some(heading) = &row.heading {
        svg.text((14.0, top + 18.0), heading, Type::new(12.0).colored(Color::GRAY));
    }
    for (column, track) in row.tracks.iter().enumerate() {
        let left = MARGIN + column as f64 * row.pitch() + row.strips();
        let start = track.path.first().copied().unwrap_or(0.0);
        let place = range_of(track.path.iter().map(|x| x - start), 0.06);
        let panel = Panel::new((left, top + HEADING), row.panel, height, place, (0.0, cycles)).downwards();
        let id = format!("track-{}-{}", track.title, top as u32);
        svg.group(&id, &track.title, |svg| {
            if column == 0 {
                draw_time_axis(svg, &panel, row.strips());
            }
            draw_track(svg, track, &panel, row.changes);
            panel.x_label(svg, "position (voxels)");
        });
    }
}

fn draw_time_axis(svg: &mut Svg, panel: &Panel, strips: f64) {
    let outside = Panel { left: panel.left - strips, ..*panel };
    outside.y_axis(svg, 8, "time (cycles)");
}

fn draw_track(svg: &mut Svg, track: &Track, panel: &Panel, changes: &[f64]) {
    draw_heading(svg, track, panel);
    panel.x_axis(svg, ((panel.right - panel.left) / 45.0) as usize);
    for (i, strip) in track.sensed.iter().rev().enumerate() {
        draw_strip(svg, strip, panel, panel.left - (i + 1) as f64 * (STRIP_WIDTH + STRIP_GAP));
    }
    if let Some(strip) = &track.output {
        draw_strip(svg, strip, panel, panel.right + STRIP_GAP);
    }
    let left = panel.left - track.sensed.len() as f64 * (STRIP_WIDTH + STRIP_GAP);
    for &cycle in changes {
        let y = panel.y.at(cycle);
        svg.line((left, y), (panel.right + STRIP_GAP + STRIP_WIDTH, y), Paint::stroke(Color::GRAY, 0.8).dashed(2.0));
    }
    panel.frame(svg);
    draw_path(svg, track, panel);
}

fn draw_heading(svg: &mut Svg, track: &Track, panel: &Panel) {
    let left = panel.left - track.sensed.len() as f64 * (STRIP_WIDTH + STRIP_GAP);
    let line =
        |svg: &mut Svg, above: f64, text: &str, set: Type| svg.text((left, panel.top - above), &shorten(text, 30), set);
    line(svg, 38.0, &track.title, Type::new(12.0).bold());
    line(svg, 24.0, &track.subtitle, Type::new(10.0).colored(Color::GRAY));
    let mut x = left;
    for strip in &track.sensed {
        let name = shorten(&strip.name, 10);
        svg.rect((x, panel.top - 16.0), 8.0, 8.0, Paint::fill(strip.color));
        svg.text((x + 11.0, panel.top - 8.5), &name, Type::new(10.0));
        x += 20.0 + name.chars().count() as f64 * 6.2;
    }
    if let Some(strip) = &track.output {
        let end = panel.right + STRIP_GAP + STRIP_WIDTH;
        svg.rect((end - 8.0, panel.top - 16.0), 8.0, 8.0, Paint::fill(strip.color));
        svg.text((end - 11.0, panel.top - 8.5), &shorten(&strip.name, 10), Type::new(10.0).anchored(Anchor::End));
    }
}

fn draw_strip(svg: &mut Svg, strip: &Strip, panel: &Panel, left: f64) {
    svg.rect((left, panel.top), STRIP_WIDTH, panel.bottom - panel.top, Paint::fill(strip.color).with_opacity(0.08));
    match &strip.spells {
        Spells::Bits(spells) => draw_bits(svg, strip.color, spells, panel, left),
        Spells::Values(spells) => draw_values(svg, strip.color, spells, panel, left),
    }
}

fn draw_values(svg: &mut Svg, color: Color, spells: &[(f64, String)], panel: &Panel, left: f64) {
    let mut from = panel.y.at(0.0);
    for run in spells.chunk_by(|one, next| one.1 == next.1) {
        let (end, value) = &run[run.len() - 1];
        let to = panel.y.at(*end);
        svg.rect((left, from), STRIP_WIDTH, to - from, Paint::fill(color).with_opacity(0.18).with_stroke(color, 1.0));
        if value.chars().count() as f64 * 5.6 + 4.0 < to - from {
            let set = Type::new(9.0).anchored(Anchor::Middle).upwards();
            svg.text((left + STRIP_WIDTH - 3.5, (from + to) / 2.0), value, set);
        }
        from = to;
    }
}

fn draw_bits(svg: &mut Svg, color: Color, spells: &[(f64, bool)], panel: &Panel, left: f64) {
    let x = |bit: bool| if bit { left + STRIP_WIDTH - 1.0 } else { left + 1.0 };
    let mut from = panel.y.at(0.0);
    let mut steps: Vec<Point> = Vec::new();
    for run in spells.chunk_by(|one, next| one.1 == next.1) {
        let (end, bit) = run[run.len() - 1];
        let to = panel.y.at(end);
        if bit {
            svg.rect((left, from), STRIP_WIDTH, to - from, Paint::fill(color).with_opacity(0.35));
        }
        steps.extend([(x(bit), from), (x(bit), to)]);
        from = to;
    }
    svg.polyline(&steps, Paint::stroke(color, 1.6));
}

fn draw_path(svg: &mut Svg, track: &Track, panel: &Panel) {
    let Some(&start) = track.path.first() else { return };
    let last = track.path.len() - 1;
    let stride = track.path.len().div_ceil(MAX_POINTS).max(1);
    let time = |i: usize| if last == 0 { 0.0 } else { i as f64 / last as f64 * track.cycles };
    let kept: BTreeSet<usize> = (0..=last).step_by(stride).chain([last]).collect();
    panel.curve(svg, kept.into_iter().map(|i| (track.path[i] - start, time(i))), Paint::stroke(Color::BLACK, 1.4));
    if let Some(when) = track.fault {
        let nearest = ((when / track.cycles.max(f64::MIN_POSITIVE)) * last as f64).clamp(0.0, last as f64) as usize;
        let (x, y) = panel.at((track.path[nearest] - start, when));
        svg.cross((x, y), Paint::stroke(Color::FAULT, 2.5));
        let set = Type::new(10.0).colored(Color::FAULT).bold().anchored(Anchor::Middle);
        let middle = (panel.left + panel.right) / 2.0;
        svg.text((middle, (y + 18.0).min(panel.bottom - 6.0)), &format!("unstable in cycle {}", when as u64 + 1), set);
    }
}
