//! Evaluation of candidates by the paper's protocol, and the loop of asking, evaluating and telling (paper, Methods;
//! docs/physics.md 10).

use crate::evolve::{Candidate, CandidateOrigin, CandidateOutcome, Scores, Search};
use crate::model::{
    Behavior, Body, Direction, Evolution, Genotype, Pattern, Schedule, SearchObjective, Setting, Trajectory, Trial,
};
use crate::sim::Simulator;
use crate::swarm::{Work, gate};

/// Advances a search by one generation: asks, evaluates in parallel, tells.
pub fn evolve_generation(search: &mut Search) -> Work {
    let candidates = search.ask();
    let (outcomes, work) = evaluate(&Simulator::default(), search, &candidates);
    search.tell(&candidates, &outcomes);
    work
}

/// The result of each candidate for the current archive.
pub fn evaluate(simulator: &Simulator, search: &Search, candidates: &[Candidate]) -> (Vec<CandidateOutcome>, Work) {
    match search.evolution().objective {
        SearchObjective::Distance => distance(simulator, search, candidates),
        SearchObjective::Gate => gate::evaluate(simulator, search, candidates),
    }
}

/// The result of each body for an empty archive, so that nothing is left out. Bodies must be valid (see
/// [`crate::evolve::validate`]).
pub fn evaluate_bodies(simulator: &Simulator, evolution: &Evolution, bodies: Vec<Body>) -> Vec<CandidateOutcome> {
    let candidate = |(index, body): (u32, Body)| {
        let genotype = Genotype { nodes: Vec::new(), links: Vec::new() };
        Candidate { index, origin: CandidateOrigin::Random, genotype, body, undeveloped: 0 }
    };
    let candidates: Vec<Candidate> = (0..).zip(bodies).map(candidate).collect();
    evaluate(simulator, &Search::new(evolution, 0), &candidates).0
}

/// Displacements under the four constant patterns, in voxels, or the fault of a simulation.
///
/// # Errors
/// The first fault.
pub fn fixed_displacements(trajectories: &[Trajectory; 4]) -> Result<[f64; 4], crate::model::Fault> {
    if let Some(fault) = trajectories.iter().find_map(|trajectory| trajectory.fault) {
        return Err(fault);
    }
    Ok([0, 1, 2, 3].map(|i| displacement(&trajectories[i].com_x, 0, trajectories[i].com_x.len() - 1)))
}

/// The trials of a body under the four constant patterns.
pub fn fixed_trials(body: &Body, steps: u32) -> [Trial; 4] {
    Pattern::PAIRS.map(|pattern| Trial { body: body.clone(), schedule: Schedule::constant(pattern, steps) })
}

/// The paper's two fitnesses: four fixed simulations, then the variable one for candidates whose fixed fitness can
/// still win a niche.
fn distance(simulator: &Simulator, search: &Search, candidates: &[Candidate]) -> (Vec<CandidateOutcome>, Work) {
    let evolution = search.evolution();
    let setting = Setting::default();
    let trials: Vec<Trial> =
        candidates.iter().flat_map(|candidate| fixed_trials(&candidate.body, evolution.fixed_steps)).collect();
    let mut work = Work { env_steps: steps(&trials), left_out: 0 };
    let trajectories = simulator.run_trials(&setting, &trials);
    let first: Vec<Result<Scores, CandidateOutcome>> = candidates
        .iter()
        .zip(trajectories.chunks_exact(4))
        .map(|(candidate, four)| fixed_scores(search, candidate, four))
        .collect();
    let variable = |candidate: &Candidate| Trial { body: candidate.body.clone(), schedule: evolution.variable.clone() };
    let remaining: Vec<Trial> = candidates
        .iter()
        .zip(&first)
        .filter(|(_, scores)| scores.is_ok())
        .map(|(candidate, _)| variable(candidate))
        .collect();
    work.env_steps += steps(&remaining);
    work.left_out += u64::from(evolution.variable.steps()) * (candidates.len() - remaining.len()) as u64;
    let mut long = simulator.run_trials(&setting, &remaining).into_iter();
    let outcomes = first
        .into_iter()
        .map(|scores| match scores {
            Ok(scores) => variable_outcome(&evolution.variable, scores, &long.next().expect("one for each remaining")),
            Err(outcome) => outcome,
        })
        .collect();
    (outcomes, work)
}

/// The scores after the fixed simulations, with an upper bound for the first fitness.
fn fixed_scores(search: &Search, candidate: &Candidate, four: &[Trajectory]) -> Result<Scores, CandidateOutcome> {
    let four = four.first_chunk::<4>().expect("four trials for each candidate");
    let displacement = fixed_displacements(four).map_err(CandidateOutcome::Faulty)?;
    let least = displacement.iter().map(|d| d.abs()).fold(f64::INFINITY, f64::min);
    let scores = Scores { fitness: [f64::INFINITY, least], behavior: Behavior::of(&displacement), displacement };
    if search.could_take(&candidate.body, &scores) { Ok(scores) } else { Err(CandidateOutcome::Surpassed) }
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

/// The number of env steps of trials.
pub(crate) fn steps(trials: &[Trial]) -> u64 {
    trials.iter().map(|trial| u64::from(trial.schedule.steps())).sum()
}
