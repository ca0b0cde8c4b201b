//! Paths over time.

use std::collections::BTreeMap;

use crate::cli::Failure;
use crate::cli::draw::evolution_run::each_champion;
use crate::cli::draw::faults;
use crate::cli::draw::picture::{Drawing, Drawn};
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::titled::{TitledBody, TitledRobots};
use crate::cli::draw::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{CYCLE_STEPS, Function, Schedule, Trial};
use nbc_session::SwarmRun;
use nbc_session::report::{self, Champions, EvolutionResults, Svg};
use nbc_swarm::SwarmTrace;

pub(super) fn of_robot(robot: &TitledBody, request: &DrawRequest) -> Result<Drawn, Failure> {
    let trial = Trial { body: robot.body.clone(), schedule: request.schedule([&robot.body])? };
    let path = faults::walk([&trial.body], &trial.schedule).remove(0);
    let faults = path.fault.map(|fault| faults::of_body(&robot.title, fault)).into_iter().collect();
    Ok(Drawn { drawing: Drawing::Picture(report::draw_robot(&robot.title, &trial, &path)), faults })
}

pub(super) fn of_library(robots: &TitledRobots, request: &DrawRequest) -> Result<Drawn, Failure> {
    let (svg, faults) = champions(robots, &request.schedule(robots.robots.iter().map(|one| &one.body))?);
    Ok(Drawn { drawing: Drawing::Picture(svg), faults })
}

pub(super) fn of_run(results: &EvolutionResults, request: &DrawRequest) -> Result<Drawn, Failure> {
    of_library(&each_champion(results), request)
}

pub(super) fn of_program(request: &DrawRequest) -> Result<Drawn, Failure> {
    let ran = request.ran(None)?;
    let SwarmRun { trace, .. } = ran.swarm();
    let chosen = request.robots.iter().map(|net| robots_of(trace, net)).collect::<Result<Vec<_>, _>>()?;
    let svg = match &chosen[..] {
        [] => report::draw_swarm(trace),
        chosen => report::draw_chosen(trace, &chosen.concat()),
    };
    Ok(Drawn { drawing: Drawing::Picture(svg), faults: faults::of_swarm(trace) })
}

/// The robots that drive a net, or all nets that begin with the text before a final `*`.
fn robots_of(trace: &SwarmTrace, net: &str) -> Result<Vec<usize>, Failure> {
    let robots = &trace.robots;
    let is_meant = |driven: &str| match net.strip_suffix('*') {
        Some(beginning) => driven.starts_with(beginning),
        None => driven == net,
    };
    let meant: Vec<usize> = (0..robots.len()).filter(|&k| is_meant(&robots[k].net)).collect();
    if meant.is_empty() {
        let known: Vec<String> = robots.iter().map(|robot| robot.net.clone()).collect();
        return Err(wording::unknown_net(net, &known).into());
    }
    Ok(meant)
}

/// Paths under one schedule, by behavior, and warnings of robots that fail.
pub(super) fn champions(several: &TitledRobots, schedule: &Schedule) -> (Svg, Vec<Diagnostic>) {
    let trajectories = faults::walk(several.robots.iter().map(|one| &one.body), schedule);
    let faults = faults::of_paths(&several.robots, &trajectories);
    let mut paths: BTreeMap<Function, Champions> = BTreeMap::new();
    for (one, trajectory) in several.robots.iter().zip(trajectories) {
        let function = one.behavior.function();
        let group = paths.entry(function).or_insert_with(|| Champions { behavior: one.behavior, paths: Vec::new() });
        group.paths.push((trajectory, one.body.width()));
    }
    let groups: Vec<Champions> = paths.into_values().collect();
    (report::draw_champions(&several.title, &groups, &changes(schedule)), faults)
}

/// In cycles.
fn changes(schedule: &Schedule) -> Vec<f64> {
    let ends = schedule.spells.iter().scan(0, |steps, spell| {
        *steps += spell.steps;
        Some(f64::from(*steps) / f64::from(CYCLE_STEPS))
    });
    ends.take(schedule.spells.len().saturating_sub(1)).collect()
}
