//! Pictures of bodies: with their materials, at one moment, or as snapshots of a gait.

use crate::cli::Failure;
use crate::cli::draw::faults;
use crate::cli::draw::picture::{Drawing, Drawn};
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::titled::{NamedBody, TitledBody, TitledRobots, of_swarm};
use nbc_session::report::{self, Portrait};

pub(super) fn portrait(robot: &TitledBody, request: &DrawRequest) -> Result<Drawn, Failure> {
    Ok(Drawing::Picture(report::draw_portrait(&robot.title, &robot.body, request.scheme())).into())
}

pub(super) fn portraits(robots: &TitledRobots, request: &DrawRequest) -> Result<Drawn, Failure> {
    let portrait = |one: &NamedBody| Portrait {
        title: one.behavior.function().to_string(),
        subtitle: format!("{}, {}", one.behavior, one.name),
        body: one.body.clone(),
    };
    let portraits: Vec<Portrait> = robots.robots.iter().map(portrait).collect();
    Ok(Drawing::Picture(report::draw_portraits(&robots.title, &portraits, request.scheme())).into())
}

pub(super) fn portraits_of_swarm(request: &DrawRequest) -> Result<Drawn, Failure> {
    portraits(&of_swarm(&request.compiled()?.assembly), request)
}

pub(super) fn pose(TitledBody { title, body }: &TitledBody, request: &DrawRequest) -> Result<Drawn, Failure> {
    let schedule = request.schedule([body])?;
    let step = request.step(&schedule)?;
    let pose = report::draw_pose(title, body, &schedule, step, request.scheme());
    Ok(Drawn { drawing: Drawing::Picture(pose), faults: faults::until(title, body, &schedule, step) })
}

pub(super) fn strip(TitledBody { title, body }: &TitledBody, request: &DrawRequest) -> Result<Drawn, Failure> {
    let schedule = request.schedule([body])?;
    let strip = report::draw_strip(title, body, &schedule, request.scheme());
    Ok(Drawn { drawing: Drawing::Picture(strip), faults: faults::until(title, body, &schedule, schedule.steps()) })
}
