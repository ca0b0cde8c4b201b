//! Evaluation of candidates by the paper's protocol, and the loop of asking, evaluating and telling (paper, Methods;
//! docs/physics.md 10).

use std::collections::{BTreeMap, BTreeSet};

use crate::evaluation::{Evaluated, EvaluationProtocol, EvaluationTask, setting};
use crate::evolve::{Candidate, CandidateOutcome, Rivals, Scores, Search};
use crate::noise::RobotNoise;
use crate::{Work, gate};
use nbc_base::model::{
    Body, Direction, Displacements, Evolution, Fault, MaterialKind, Pattern, Schedule, SearchObjective, Setting,
    Trajectory, Trial,
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

/// The displacement of each body under each constant pattern, in voxels, or the first fault of its simulations. A
/// stimulus that a body does not sense changes nothing, so patterns that differ in such a one alone are simulated once.
pub fn fixed_displacements(
    simulator: &Simulator,
    setting: &Setting,
    bodies: &[Body],
    steps: u32,
) -> Vec<Result<Displacements, Fault>> {
    let trial = |body: &Body, pattern| Trial { body: body.clone(), schedule: Schedule::constant(pattern, steps) };
    let sensed: Vec<Vec<Pattern>> = bodies.iter().map(sensed_patterns).collect();
    let different = |patterns: &Vec<Pattern>| patterns.iter().copied().collect::<BTreeSet<_>>();
    let of_body = |(body, patterns)| different(patterns).into_iter().map(move |pattern| trial(body, pattern));
    let trials: Vec<Trial> = bodies.iter().zip(&sensed).flat_map(of_body).collect();
    let mut trajectories = simulator.run_trials(setting, &trials).into_iter();
    let of_patterns = |patterns: &Vec<Pattern>| {
        let own: BTreeMap<Pattern, Trajectory> = different(patterns).into_iter().zip(trajectories.by_ref()).collect();
        let walked = patterns.iter().map(|pattern| match &own[pattern] {
            Trajectory { fault: Some(fault), .. } => Err(*fault),
            Trajectory { com_x, .. } => Ok(displacement(com_x, 0, com_x.len() - 1)),
        });
        let walked = walked.collect::<Result<Vec<f64>, Fault>>()?;
        Ok(Displacements::try_from(walked).expect("one for each pattern of two or three stimuli"))
    };
    sensed.iter().map(of_patterns).collect()
}

/// The different simulations under a constant pattern that [`fixed_displacements`] needs for a body.
fn fixed_simulations(body: &Body) -> u64 {
    sensed_patterns(body).into_iter().collect::<BTreeSet<_>>().len() as u64
}

/// What a body senses of each pattern: the stimuli of its sensors.
fn sensed_patterns(body: &Body) -> Vec<Pattern> {
    let palette = body.palette();
    let mut sensed = vec![false; palette.inputs()];
    for &code in body.codes() {
        // A fourth stimulus is always absent.
        if let Some(MaterialKind::Sensor(response)) = palette.kind(code)
            && let Some(sensed) = sensed.get_mut(response.stimulus)
        {
            *sensed = true;
        }
    }
    let of_pattern = |pattern: Pattern| Pattern::of(sensed.iter().enumerate().map(|(i, &on)| on && pattern.has(i)));
    Pattern::all(palette.inputs()).map(of_pattern).collect()
}

/// The paper's two fitnesses: a fixed simulation under each pattern, then the variable one for bodies whose fixed
/// fitness can still win a niche.
fn distance(simulator: &Simulator, protocol: &EvaluationProtocol, tasks: &[EvaluationTask]) -> Vec<Evaluated> {
    let (setting, noise) = (setting(&protocol.world), RobotNoise::new(&protocol.world.noise, 0));
    let bodies: Vec<Body> = tasks.iter().map(|task| noise.worn(&task.body)).collect();
    // Under a constant pattern there is nothing to miss.
    let walked = fixed_displacements(simulator, &setting, &bodies, protocol.fixed_steps);
    let first: Vec<Result<Scores, CandidateOutcome>> =
        tasks.iter().zip(walked).map(|(task, walked)| fixed_scores(task, walked)).collect();
    let schedule = noise.sensed(&protocol.variable);
    let variable = |body: &Body| Trial { body: body.clone(), schedule: schedule.clone() };
    let remaining: Vec<Trial> =
        bodies.iter().zip(&first).filter(|(_, scores)| scores.is_ok()).map(|(body, _)| variable(body)).collect();
    let mut long = simulator.run_trials(&setting, &remaining).into_iter();
    let second = |(body, scores): (&Body, Result<Scores, CandidateOutcome>)| {
        let fixed = fixed_simulations(body) * u64::from(protocol.fixed_steps);
        let (outcome, env_steps) = match scores {
            Ok(scores) => {
                let trajectory = long.next().expect("one for each remaining");
                let variable = u64::from(protocol.variable.steps());
                (variable_outcome(&protocol.variable, scores, &trajectory), fixed + variable)
            }
            Err(outcome) => (outcome, fixed),
        };
        Evaluated { outcome, work: Work { env_steps, left_out: protocol.distance_steps() - env_steps } }
    };
    bodies.iter().zip(first).map(second).collect()
}

/// The scores after the fixed simulations, with an upper bound for the first fitness.
fn fixed_scores(task: &EvaluationTask, walked: Result<Displacements, Fault>) -> Result<Scores, CandidateOutcome> {
    let displacement = walked.map_err(CandidateOutcome::Faulty)?;
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

#[cfg(test)]
mod tests {
    use nbc_base::model::Palette;

    use super::*;

    #[test]
    fn a_stimulus_that_a_body_does_not_sense_is_not_simulated_and_changes_no_distance() {
        let simulator = Simulator::default();
        let rows = [["343", "353"], ["343", "383"], ["563", "343"], ["343", "333"], ["353", "378"]];
        let bodies = rows.map(|rows| Body::parse(&rows, &Palette::paper()).unwrap());
        assert_eq!(bodies.each_ref().map(fixed_simulations), [2, 2, 4, 1, 4]);
        let found = fixed_displacements(&simulator, &Setting::default(), &bodies, 84);
        for (body, found) in bodies.iter().zip(found) {
            let trial = |pattern| Trial { body: body.clone(), schedule: Schedule::constant(pattern, 84) };
            let trials: Vec<Trial> = Pattern::all(2).map(trial).collect();
            let walked = simulator.run_trials(&Setting::default(), &trials);
            let each: Vec<f64> = walked.iter().map(|one| displacement(&one.com_x, 0, 84)).collect();
            assert_eq!(found.unwrap(), Displacements::try_from(each).unwrap());
        }
    }

    #[test]
    fn a_body_of_three_senses_has_eight_patterns() {
        let body = |rows: &[&str]| Body::parse(rows, &Palette::three()).unwrap();
        let patterns =
            |body: Body| sensed_patterns(&body).iter().map(|one| one.digits(3)).collect::<Vec<_>>().join(" ");
        assert_eq!(patterns(body(&["3a4", "373"])), "000 001 000 001 100 101 100 101");
        assert_eq!(fixed_simulations(&body(&["3a4", "576"])), 8);
    }
}
