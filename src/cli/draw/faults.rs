//! The robots of a picture whose simulation fails. The picture shows them up to there, and a warning names each.

use crate::cli::draw::titled::NamedBody;
use crate::cli::draw::wording::faulty_robot;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Body, Fault, Schedule, Setting, Trajectory, Trial};
use nbc_sim::Simulator;
use nbc_swarm::SwarmTrace;

pub(super) fn walk<'b>(bodies: impl IntoIterator<Item = &'b Body>, schedule: &Schedule) -> Vec<Trajectory> {
    let trial = |body: &Body| Trial { body: body.clone(), schedule: schedule.clone() };
    let trials: Vec<Trial> = bodies.into_iter().map(trial).collect();
    Simulator::default().run_trials(&Setting::default(), &trials)
}

pub(super) fn of_paths(robots: &[NamedBody], paths: &[Trajectory]) -> Vec<Diagnostic> {
    let named = robots.iter().zip(paths).filter_map(|(one, path)| Some((one, path.fault?)));
    named.map(|(one, fault)| of_body(&format!("{} ({})", one.name, one.behavior), fault)).collect()
}

/// Warns of a robot that fails up to an env step.
pub(super) fn until(title: &str, body: &Body, schedule: &Schedule, step: u32) -> Vec<Diagnostic> {
    let fault = walk([body], schedule).remove(0).fault.filter(|fault| fault.env_step <= step);
    fault.map(|fault| of_body(title, fault)).into_iter().collect()
}

pub(super) fn of_body(name: &str, Fault { env_step, kind }: Fault) -> Diagnostic {
    faulty_robot(format!("robot {name} {kind} in env step {env_step}"))
}

pub(super) fn of_swarm(trace: &SwarmTrace) -> Vec<Diagnostic> {
    trace.fault().map(|fault| faulty_robot(fault.to_string())).into_iter().collect()
}
