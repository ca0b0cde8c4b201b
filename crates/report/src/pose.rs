//! A body as the physics bends it: its pose at one moment of a trial, over the outline it has at rest.

use crate::Color;
use crate::chart::with_minus;
use crate::color::Scheme;
use crate::element::{Paint, Point, Type};
use crate::image::draw_image;
use crate::looks::Looks;
use crate::sprite::{Pose, draw_legend, legend_size};
use crate::stage::{Moment, Stage};
use crate::svg::Svg;
use nbc_base::model::{Body, CYCLE_STEPS, Schedule, Setting};

const VOXEL: f64 = 30.0;
const IMAGE: f64 = 64.0;

/// After the end of the schedule or after a fault, this draws the last pose.
pub fn draw_pose(title: &str, body: &Body, schedule: &Schedule, step: u32, scheme: Scheme) -> Svg {
    let moment = moment_at(body, schedule, step);
    let (width, height) = (body.width() as f64, body.height() as f64);
    let ground = 60.0 + (height * 1.35 + 0.2) * VOXEL;
    let span = (width * 1.9 + 1.0) * VOXEL;
    let looks = Looks::of([body], scheme);
    let (wide, high) = legend_size(&looks, body);
    let size = ((span + 50.0 + wide).max(title.chars().count() as f64 * 9.5 + 28.0), (ground + 42.0).max(72.0 + high));
    let image = moment.spells[0].image.as_deref();
    let legend = (span + 44.0, 66.0);
    let room = if image.is_some() { high + 26.0 + IMAGE } else { high };
    let mut svg = Svg::new(size.0, size.1.max(72.0 + room), title);
    svg.text((14.0, 28.0), title, Type::new(15.0).bold());
    let camera = moment.centers[0][0];
    let to_pixel = |(x, y): Point| (20.0 + span / 2.0 + (x - camera) * VOXEL, ground - (y - 1.0) * VOXEL);
    draw_ground(&mut svg, span, ground, camera);
    draw_rest(&mut svg, body, camera, to_pixel);
    moment.poses[0].draw(&mut svg, &looks, 1.0, to_pixel);
    let shown = match image {
        Some(_) => String::new(),
        None => format!("stimuli {}, ", moment.spells[0].pattern.digits(body.palette().stimuli())),
    };
    let when = format!(
        "after {:.2} cycles, {shown}{} voxels along",
        f64::from(moment.step) / f64::from(CYCLE_STEPS),
        with_minus(&format!("{:+.2}", camera - start_of(body))),
    );
    svg.text((14.0, 46.0), &when, Type::new(11.0).colored(Color::GRAY));
    let note = if moment.faults[0] {
        ("the simulation went unstable here", Color::FAULT)
    } else {
        ("dashed: the body at rest; ticks: voxels", Color::GRAY)
    };
    svg.text((20.0, ground + 31.0), note.0, Type::new(10.0).colored(note.1));
    draw_legend(&mut svg, legend, body, &looks);
    if let Some(image) = image {
        svg.text((legend.0, legend.1 + high + 16.0), "image", Type::new(11.0).colored(Color::GRAY));
        draw_image(&mut svg, (legend.0, legend.1 + high + 22.0), IMAGE, image);
    }
    svg
}

fn moment_at(body: &Body, schedule: &Schedule, step: u32) -> Moment {
    let mut spells = schedule.spells.clone();
    let mut left = step;
    for spell in &mut spells {
        spell.steps = spell.steps.min(left);
        left -= spell.steps;
    }
    spells.retain(|spell| spell.steps > 0);
    let cut = Schedule { spells };
    let stride = cut.steps().max(1);
    Stage::of_trial(&Setting::default(), body, &cut, stride).last().expect("a stage has its start")
}

fn start_of(body: &Body) -> f64 {
    let stage = &mut Stage::of_trial(&Setting::default(), body, &Schedule::default(), 1);
    stage.next().map_or(0.0, |moment| moment.centers[0][0])
}

fn draw_ground(svg: &mut Svg, span: f64, ground: f64, camera: f64) {
    svg.rect((20.0, ground), span, 10.0, Paint::fill(Color::GROUND));
    let half = span / 2.0 / VOXEL;
    for voxel in (camera - half).ceil() as i64..=(camera + half).floor() as i64 {
        let x = 20.0 + span / 2.0 + (voxel as f64 - camera) * VOXEL;
        svg.line((x, ground + 10.0), (x, ground + 15.0), Paint::stroke(Color::GRAY, 1.0));
    }
}

fn draw_rest(svg: &mut Svg, body: &Body, camera: f64, to_pixel: impl Fn(Point) -> Point) {
    let left = camera - body.width() as f64 / 2.0;
    for (corners, _) in Pose::at_rest(body).voxels {
        let placed = corners.map(|(x, y)| to_pixel((x + left, y + 1.0)));
        svg.polygon(&placed, Paint::stroke(Color::GRAY, 0.7).dashed(2.0));
    }
}
