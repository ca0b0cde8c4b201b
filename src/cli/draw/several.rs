//! Pictures of several robots: those of a library, or the champions of a run.

use std::collections::BTreeMap;

use crate::cli::Failure;
use crate::cli::draw::arguments::DrawArguments;
use crate::cli::draw::canvas::Canvas;
use crate::cli::draw::kind::Kind;
use crate::model::{Behavior, Body, CYCLE_STEPS, Library, Schedule, Setting, Trial};
use crate::report::{self, Champions, Film, Portrait, STRIDE, Stage, Svg};
use crate::sim::Simulator;

/// Robots with a title.
pub(super) struct Several {
    pub(super) title: String,
    pub(super) robots: Vec<One>,
}

/// One of several robots.
pub(super) struct One {
    pub(super) behavior: Behavior,
    pub(super) name: String,
    pub(super) body: Body,
}

/// The robots of a library, in its order.
pub(super) fn of_library(name: &str, library: &Library) -> Several {
    let robots = library.robots.iter().map(|robot| One {
        behavior: robot.behavior,
        name: robot.name.clone(),
        body: robot.body.clone(),
    });
    let title = if name == "shipped" { "the robots that come with nbc".to_owned() } else { name.to_owned() };
    Several { title, robots: robots.collect() }
}

impl DrawArguments {
    pub(super) fn draw_several(&self, canvas: &Canvas, several: &Several) -> Result<(), Failure> {
        match self.kind {
            Kind::Apng | Kind::Gif => self.film(canvas, several),
            Kind::Spacetime => canvas.picture(&champions(several, &self.schedule()?)),
            Kind::Sprite => canvas.picture(&self.portraits(several)),
            Kind::Comparison | Kind::Heatmap | Kind::Progress => Err(self.not_of("a library", "the folder of a run")),
            Kind::Pose | Kind::Strip => Err(self.not_of("a library", "one robot, or one `--behavior` of it,")),
            Kind::Dot | Kind::Report | Kind::Schematic | Kind::Vcd => {
                Err(self.not_of("a library", "a source file (.nb)"))
            }
        }
    }

    fn portraits(&self, several: &Several) -> Svg {
        let portrait = |one: &One| Portrait {
            title: one.behavior.function().to_string(),
            subtitle: format!("{}, {}", one.behavior, one.name),
            body: one.body.clone(),
        };
        let portraits: Vec<Portrait> = several.robots.iter().map(portrait).collect();
        report::draw_portraits(&several.title, &portraits, self.scheme())
    }

    fn film(&self, canvas: &Canvas, several: &Several) -> Result<(), Failure> {
        let bodies: Vec<Body> = several.robots.iter().map(|one| one.body.clone()).collect();
        let largest = bodies.iter().map(|body| body.width().max(body.height())).max().unwrap_or(1);
        let lanes = several.robots.iter().map(|one| one.name.clone()).collect();
        let film = Film { title: several.title.clone(), lanes, scheme: self.scheme(), largest };
        canvas.film(&film, Stage::of_trials(&Setting::default(), &bodies, &self.schedule()?, STRIDE))
    }
}

/// Every robot's path under one schedule, by behavior.
pub(super) fn champions(several: &Several, schedule: &Schedule) -> Svg {
    let trial = |one: &One| Trial { body: one.body.clone(), schedule: schedule.clone() };
    let trials: Vec<Trial> = several.robots.iter().map(trial).collect();
    let trajectories = Simulator::default().run_trials(&Setting::default(), &trials);
    let mut paths: BTreeMap<u8, Champions> = BTreeMap::new();
    for (one, trajectory) in several.robots.iter().zip(trajectories) {
        let bits = one.behavior.function().bits();
        let group = paths.entry(bits).or_insert_with(|| Champions { behavior: one.behavior, paths: Vec::new() });
        group.paths.push((trajectory, one.body.width()));
    }
    let groups: Vec<Champions> = paths.into_values().collect();
    report::draw_champions(&several.title, &groups, &changes(schedule))
}

/// The cycles at which a schedule's stimuli change.
fn changes(schedule: &Schedule) -> Vec<f64> {
    let ends = schedule.spells.iter().scan(0, |steps, spell| {
        *steps += spell.steps;
        Some(f64::from(*steps) / f64::from(CYCLE_STEPS))
    });
    ends.take(schedule.spells.len().saturating_sub(1)).collect()
}
