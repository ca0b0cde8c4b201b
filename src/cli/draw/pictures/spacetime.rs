//! Paths over time.

use std::collections::BTreeMap;

use crate::cli::Failure;
use crate::cli::draw::evolution_run::each_champion;
use crate::cli::draw::picture::{Drawing, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::titled_body::TitledBody;
use crate::cli::draw::titled_robots::{NamedBody, TitledRobots};
use crate::cli::draw::wording::DrawError;
use nbc_base::model::{CYCLE_STEPS, Function, Schedule, Setting, Trial};
use nbc_session::SwarmRun;
use nbc_session::report::{self, Champions, EvolutionResults, Svg};
use nbc_sim::Simulator;
use nbc_swarm::SwarmTrace;

pub(super) struct SpacetimePicture;

impl PictureKind for SpacetimePicture {
    fn description(&self) -> KindDescription {
        let options = &["--robots", "--schedule"];
        KindDescription { options, ..KindDescription::new("spacetime", "Paths over time", SubjectKind::Library) }
    }

    fn of_robot(&self, robot: &TitledBody, request: &DrawRequest) -> Result<Drawing, Failure> {
        let trial = Trial { body: robot.body.clone(), schedule: request.schedule([&robot.body])? };
        let trajectory = Simulator::default().run_trials(&Setting::default(), std::slice::from_ref(&trial)).remove(0);
        Ok(Drawing::Picture(report::draw_robot(&robot.title, &trial, &trajectory)))
    }

    fn of_library(&self, robots: &TitledRobots, request: &DrawRequest) -> Result<Drawing, Failure> {
        Ok(Drawing::Picture(champions(robots, &request.schedule(robots.robots.iter().map(|one| &one.body))?)))
    }

    fn of_run(&self, results: &EvolutionResults, request: &DrawRequest) -> Result<Drawing, Failure> {
        self.of_library(&each_champion(results), request)
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawing, Failure> {
        let ran = request.ran(None)?;
        let SwarmRun { trace, .. } = ran.swarm();
        if request.robots.is_empty() {
            return Ok(Drawing::Picture(report::draw_swarm(trace)));
        }
        let chosen = request.robots.iter().map(|net| robots_of(trace, net)).collect::<Result<Vec<_>, _>>()?;
        Ok(Drawing::Picture(report::draw_chosen(trace, &chosen.concat())))
    }
}

/// The indices of the robots that drive a net, or all nets that begin with the text before a final `*`.
fn robots_of(trace: &SwarmTrace, net: &str) -> Result<Vec<usize>, Failure> {
    let robots = &trace.robots;
    let is_meant = |driven: &str| match net.strip_suffix('*') {
        Some(beginning) => driven.starts_with(beginning),
        None => driven == net,
    };
    let meant: Vec<usize> = (0..robots.len()).filter(|&k| is_meant(&robots[k].net)).collect();
    if meant.is_empty() {
        let known = robots.iter().map(|robot| robot.net.clone()).collect();
        return Err(DrawError::UnknownNet { net: net.to_owned(), known }.into());
    }
    Ok(meant)
}

/// Every robot's path under one schedule, by behavior.
pub(super) fn champions(several: &TitledRobots, schedule: &Schedule) -> Svg {
    let trial = |one: &NamedBody| Trial { body: one.body.clone(), schedule: schedule.clone() };
    let trials: Vec<Trial> = several.robots.iter().map(trial).collect();
    let trajectories = Simulator::default().run_trials(&Setting::default(), &trials);
    let mut paths: BTreeMap<Function, Champions> = BTreeMap::new();
    for (one, trajectory) in several.robots.iter().zip(trajectories) {
        let function = one.behavior.function();
        let group = paths.entry(function).or_insert_with(|| Champions { behavior: one.behavior, paths: Vec::new() });
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
