//! Pictures of one robot.

use crate::cli::Failure;
use crate::cli::draw::arguments::DrawArguments;
use crate::cli::draw::canvas::Canvas;
use crate::cli::draw::kind::Kind;
use crate::cli::wording::DrawError;
use crate::model::{Body, CYCLE_STEPS, Robot, Schedule, Setting, Trial};
use crate::report::{self, Film, STRIDE, Stage, Svg};
use crate::sim::Simulator;

/// A body with its title.
pub(super) struct Subject {
    pub(super) title: String,
    pub(super) body: Body,
}

impl Subject {
    pub(super) fn of(robot: &Robot) -> Self {
        Self { title: format!("{}: {}, {}", robot.name, robot.function(), robot.behavior), body: robot.body.clone() }
    }
}

impl DrawArguments {
    pub(super) fn draw_robot(&self, canvas: &Canvas, robot: &Subject) -> Result<(), Failure> {
        let Subject { title, body } = robot;
        let schedule = self.schedule()?;
        match self.kind {
            Kind::Apng | Kind::Gif => {
                let stage = Stage::of_trial(&Setting::default(), body, &schedule, STRIDE);
                let lanes = vec![format!("{} x {}", body.width(), body.height())];
                let largest = body.width().max(body.height());
                canvas.film(&Film { title: title.clone(), lanes, scheme: self.scheme(), largest }, stage)
            }
            Kind::Pose => {
                let step = self.step(&schedule)?;
                canvas.picture(&report::draw_pose(title, body, &schedule, step, self.scheme()))
            }
            Kind::Spacetime => canvas.picture(&diagram(title, body, schedule)),
            Kind::Sprite => canvas.picture(&report::draw_portrait(title, body, self.scheme())),
            Kind::Strip => canvas.picture(&report::draw_strip(title, body, &schedule, self.scheme())),
            Kind::Comparison | Kind::Heatmap | Kind::Progress => Err(self.not_of("a robot", "the folder of a run")),
            Kind::Dot | Kind::Report | Kind::Schematic | Kind::Vcd => {
                Err(self.not_of("a robot", "a source file (.nb)"))
            }
        }
    }

    /// The env step of a pose.
    fn step(&self, schedule: &Schedule) -> Result<u32, Failure> {
        let end = schedule.steps();
        let Some(cycle) = self.at else { return Ok(end) };
        let step = (cycle * f64::from(CYCLE_STEPS)).round();
        if step <= f64::from(end) {
            return Ok(step as u32);
        }
        Err(DrawError::AfterEnd { at: cycle, end: f64::from(end) / f64::from(CYCLE_STEPS) }.into())
    }
}

fn diagram(title: &str, body: &Body, schedule: Schedule) -> Svg {
    let trial = Trial { body: body.clone(), schedule };
    let trajectory = Simulator::default().run_trials(&Setting::default(), std::slice::from_ref(&trial)).remove(0);
    report::draw_robot(title, &trial.schedule, &trajectory)
}
