//! Evaluation of candidates by the paper's protocol, and the loop of asking, evaluating and telling (paper, Methods;
//! docs/physics.md 10).

use crate::evaluation::{Evaluated, EvaluationProtocol, EvaluationTask, setting};
use crate::evolve::{Candidate, CandidateOutcome, Rivals, Scores, Search};
use crate::noise::RobotNoise;
use crate::{Work, gate};
use nbc_base::model::{
    Body, Direction, Displacements, Evolution, Pattern, Schedule, SearchObjective, Trajectory, Trial,
};
use nbc_sim::Simulator;

/// Advances a search by one generation: asks, evaluates in parallel, tells.
pub fn evolve_generation(search: &mut Search) -> Work {
    let candidates = search.ask();
    let (outcomes, work) = evaluate(&Simulator::default(), search, &candidates);
    search.tell(&candidates, &outcomes);
    work
}

/// The result of each candidate for the current archive.
pub fn evaluate(simulator: &Simulator, search: &Search, candidates: &[Candidate]) -> (Vec<CandidateOutcome>, Work) {
    let tasks: Vec<EvaluationTask> =
        candidates.iter().map(|candidate| EvaluationTask::of(search, &candidate.body)).collect();
    let done = evaluate_tasks(simulator, &EvaluationProtocol::of(search.evolution()), &tasks);
    let work = done.iter().fold(Work::default(), |sum, evaluated| sum.plus(evaluated.work));
    (done.into_iter().map(|evaluated| evaluated.outcome).collect(), work)
}

/// The result of each task. It depends on the protocol and the task alone, not on the other tasks.
pub fn evaluate_tasks(
    simulator: &Simulator,
    protocol: &EvaluationProtocol,
    tasks: &[EvaluationTask],
) -> Vec<Evaluated> {
    match protocol.objective {
        SearchObjective::Distance => distance(simulator, protocol, tasks),
        SearchObjective::Gate | SearchObjective::Wave => gate::evaluate(simulator, protocol, tasks),
    }
}

/// Env steps of a full evaluation, in which nothing is left out.
pub fn full_steps(protocol: &EvaluationProtocol) -> u64 {
    match protocol.objective {
        SearchObjective::Distance => protocol.distance_steps(),
        SearchObjective::Gate | SearchObjective::Wave => gate::steps(protocol),
    }
}

/// The result of each body for an empty archive, so that nothing is left out. Bodies must be valid (see
/// [`crate::evolve::validate`]).
pub fn evaluate_bodies(simulator: &Simulator, evolution: &Evolution, bodies: Vec<Body>) -> Vec<CandidateOutcome> {
    let tasks: Vec<EvaluationTask> = bodies
        .into_iter()
        .map(|body| EvaluationTask { body, rivals: Rivals::none(evolution.palette.inputs()) })
        .collect();
    let done = evaluate_tasks(simulator, &EvaluationProtocol::of(evolution), &tasks);
    done.into_iter().map(|evaluated| evaluated.outcome).collect()
}

/// Displacements under each constant pattern, in voxels, or the fault of a simulation.
///
/// # Errors
/// The first fault.
///
/// # Panics
/// When there is not one trajectory for each pattern of two or three stimuli.
pub fn fixed_displacements(trajectories: &[Trajectory]) -> Result<Displacements, nbc_base::model::Fault> {
    if let Some(fault) = trajectories.iter().find_map(|trajectory| trajectory.fault) {
        return Err(fault);
    }
    let moved: Vec<f64> = trajectories.iter().map(|one| displacement(&one.com_x, 0, one.com_x.len() - 1)).collect();
    Ok(Displacements::try_from(moved).expect("a trajectory for each pattern"))
}

/// The trials of a body under each constant pattern of its inputs.
pub fn fixed_trials(body: &Body, steps: u32) -> Vec<Trial> {
    let trial = |pattern| Trial { body: body.clone(), schedule: Schedule::constant(pattern, steps) };
    Pattern::all(body.palette().inputs()).map(trial).collect()
}

/// The paper's two fitnesses: a fixed simulation under each pattern, then the variable one for bodies whose fixed
/// fitness can still win a niche.
fn distance(simulator: &Simulator, protocol: &EvaluationProtocol, tasks: &[EvaluationTask]) -> Vec<Evaluated> {
    let (setting, noise) = (setting(&protocol.world), RobotNoise::new(&protocol.world.noise, 0));
    let body = |task: &EvaluationTask| noise.worn(&task.body);
    // Under a constant pattern there is nothing to miss.
    let trials: Vec<Trial> = tasks.iter().flat_map(|task| fixed_trials(&body(task), protocol.fixed_steps)).collect();
    let mut trajectories = simulator.run_trials(&setting, &trials).into_iter();
    let mut own = |task: &EvaluationTask| {
        let own: Vec<Trajectory> = trajectories.by_ref().take(1 << protocol.stimuli).collect();
        fixed_scores(task, &own)
    };
    let first: Vec<Result<Scores, CandidateOutcome>> = tasks.iter().map(&mut own).collect();
    let schedule = noise.sensed(&protocol.variable);
    let variable = |task: &EvaluationTask| Trial { body: body(task), schedule: schedule.clone() };
    let remaining: Vec<Trial> =
        tasks.iter().zip(&first).filter(|(_, scores)| scores.is_ok()).map(|(task, _)| variable(task)).collect();
    let steps = protocol.distance_steps();
    let mut long = simulator.run_trials(&setting, &remaining).into_iter();
    let second = |scores: Result<Scores, CandidateOutcome>| {
        let left_out = if scores.is_ok() { 0 } else { u64::from(protocol.variable.steps()) };
        let outcome = match scores {
            Ok(scores) => variable_outcome(&protocol.variable, scores, &long.next().expect("one for each remaining")),
            Err(outcome) => outcome,
        };
        Evaluated { outcome, work: Work { env_steps: steps - left_out, left_out } }
    };
    first.into_iter().map(second).collect()
}

/// The scores after the fixed simulations, with an upper bound for the first fitness.
fn fixed_scores(task: &EvaluationTask, fixed: &[Trajectory]) -> Result<Scores, CandidateOutcome> {
    let displacement = fixed_displacements(fixed).map_err(CandidateOutcome::Faulty)?;
    let least = displacement.iter().map(|d| d.abs()).fold(f64::INFINITY, f64::min);
    let scores = Scores { fitness: [f64::INFINITY, least], behavior: displacement.behavior(), displacement };
    let admitted = task.rivals.admit(scores.behavior, &scores.fitness);
    if admitted { Ok(scores) } else { Err(CandidateOutcome::Surpassed) }
}

/// The result after the variable simulation: the sum of distances, if each spell's direction is that of the fixed
/// simulations.
fn variable_outcome(schedule: &Schedule, scores: Scores, trajectory: &Trajectory) -> CandidateOutcome {
    if let Some(fault) = trajectory.fault {
        return CandidateOutcome::Faulty(fault);
    }
    let (mut at, mut sum) = (0, 0.0);
    for spell in &schedule.spells {
        let end = at + spell.steps as usize;
        let moved = displacement(&trajectory.com_x, at, end);
        if Direction::of(moved) != scores.behavior.direction(spell.pattern) {
            return CandidateOutcome::Inconsistent;
        }
        sum += moved.abs();
        at = end;
    }
    CandidateOutcome::Measured(Scores { fitness: [sum, scores.fitness[1]], ..scores })
}

fn displacement(com_x: &[f64], from: usize, to: usize) -> f64 {
    com_x[to] - com_x[from]
}
