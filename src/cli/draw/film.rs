//! Films of robots that move.

use crate::cli::Failure;
use crate::cli::draw::faults;
use crate::cli::draw::picture::{Drawing, Drawn, FilmFormat};
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::titled::{TitledBody, TitledRobots};
use nbc_base::model::{Body, Setting};
use nbc_session::SwarmRun;
use nbc_session::report::{Film, Stage};

pub(super) fn of_robot(format: FilmFormat, robot: &TitledBody, request: &DrawRequest) -> Result<Drawn, Failure> {
    let TitledBody { title, body } = robot;
    let lanes = vec![format!("{} x {}", body.width(), body.height())];
    let schedule = request.schedule([body])?;
    let stage = Stage::of_trial(&Setting::default(), body, &schedule, request.stride());
    let drawing = film(format, title, lanes, std::slice::from_ref(body), request, stage);
    Ok(Drawn { drawing, faults: faults::until(title, body, &schedule, schedule.steps()) })
}

pub(super) fn of_library(format: FilmFormat, robots: &TitledRobots, request: &DrawRequest) -> Result<Drawn, Failure> {
    let bodies: Vec<Body> = robots.robots.iter().map(|one| one.body.clone()).collect();
    let lanes = robots.robots.iter().map(|one| one.name.clone()).collect();
    let schedule = request.schedule(&bodies)?;
    let stage = Stage::of_trials(&Setting::default(), &bodies, &schedule, request.stride());
    let faults = faults::of_paths(&robots.robots, &faults::walk(&bodies, &schedule));
    Ok(Drawn { drawing: film(format, &robots.title, lanes, &bodies, request, stage), faults })
}

pub(super) fn of_program(format: FilmFormat, request: &DrawRequest) -> Result<Drawn, Failure> {
    let ran = request.ran(None)?;
    let SwarmRun { compiled, trace } = ran.swarm();
    let assembly = &compiled.assembly;
    let bodies: Vec<Body> = assembly.members.iter().map(|member| member.robot.body.clone()).collect();
    let lanes = assembly.members.iter().map(|member| format!("{} ({})", member.net, member.robot.function()));
    let stage = Stage::of_swarm(assembly, trace, request.stride());
    let drawing = film(format, &assembly.circuit, lanes.collect(), &bodies, request, stage);
    Ok(Drawn { drawing, faults: faults::of_swarm(trace) })
}

fn film(
    format: FilmFormat,
    title: &str,
    lanes: Vec<String>,
    bodies: &[Body],
    request: &DrawRequest,
    stage: Stage,
) -> Drawing {
    let largest = bodies.iter().map(|body| body.width().max(body.height())).max().unwrap_or(1);
    let stimuli = bodies.iter().map(|body| body.palette().stimuli()).fold(2, usize::max);
    let (title, ground) = (title.to_owned(), stage.ground);
    let film = Film { title, lanes, scheme: request.scheme(), largest, stimuli, ground };
    Drawing::Film { format, film: Box::new(film), stage: Box::new(stage) }
}
