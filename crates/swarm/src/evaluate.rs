//! Evaluation of candidates by the paper's protocol, and the loop of asking, evaluating and telling (paper, Methods;
//! docs/physics.md 10).

use crate::distance::WalkMemory;
use crate::evaluation::{Evaluated, EvaluationProtocol, EvaluationTask};
use crate::evolve::{Candidate, CandidateOutcome, Rivals, Search};
use crate::{Work, distance, gate, seeing};
use nbc_base::model::{Body, Evolution, SearchObjective};
use nbc_sim::Simulator;

pub fn evolve_generation(search: &mut Search) -> Work {
    let candidates = search.ask();
    let (outcomes, work) = evaluate(&Simulator::default(), search, &candidates);
    search.tell(&candidates, &outcomes);
    work
}

pub fn evaluate(simulator: &Simulator, search: &Search, candidates: &[Candidate]) -> (Vec<CandidateOutcome>, Work) {
    let tasks: Vec<EvaluationTask> = candidates.iter().map(|candidate| EvaluationTask::of(search, candidate)).collect();
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
    evaluate_remembering(simulator, &WalkMemory::default(), protocol, tasks)
}

pub(crate) fn evaluate_remembering(
    simulator: &Simulator,
    memory: &WalkMemory,
    protocol: &EvaluationProtocol,
    tasks: &[EvaluationTask],
) -> Vec<Evaluated> {
    match protocol.objective {
        SearchObjective::Distance => distance::evaluate(simulator, memory, protocol, tasks),
        SearchObjective::Gate | SearchObjective::Wave => gate::evaluate(simulator, protocol, tasks),
        SearchObjective::Images => seeing::evaluate(simulator, protocol, tasks),
    }
}

pub fn full_steps(protocol: &EvaluationProtocol) -> u64 {
    match protocol.objective {
        SearchObjective::Distance => protocol.distance_steps(),
        SearchObjective::Gate | SearchObjective::Wave => gate::steps(protocol),
        SearchObjective::Images => u64::from(protocol.variable.steps()),
    }
}

/// For an empty archive, so that nothing is left out. Bodies must be valid (see [`crate::evolve::validate`]).
pub fn evaluate_bodies(simulator: &Simulator, evolution: &Evolution, bodies: Vec<Body>) -> Vec<CandidateOutcome> {
    let tasks: Vec<EvaluationTask> = bodies
        .into_iter()
        .map(|body| EvaluationTask { body, rivals: Rivals::none(evolution.palette.inputs()), expected: None })
        .collect();
    let done = evaluate_tasks(simulator, &EvaluationProtocol::of(evolution), &tasks);
    done.into_iter().map(|evaluated| evaluated.outcome).collect()
}
