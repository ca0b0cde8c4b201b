//! Checks of a result without simulating.

use nbc_base::model::{CYCLE_STEPS, SearchObjective};
use nbc_swarm::evolve::{CandidateOutcome, Scores};
use nbc_swarm::{Evaluated, EvaluationProtocol, EvaluationTask, Measurement, Task, TaskResult, full_steps};

pub fn is_plausible(result: &TaskResult, task: &Task) -> bool {
    match (result, task) {
        (TaskResult::Evaluation(evaluated), Task::Evaluation(protocol, task)) => can_be(evaluated, protocol, task),
        (TaskResult::Screening(Ok(Some((clock, margin)))), Task::Screening { most, .. }) => {
            (1..=*most).contains(clock) && !margin.is_nan()
        }
        (TaskResult::Measurement(Ok(measurement)), Task::Measurement(_)) => is_possible(measurement),
        (TaskResult::Screening(_), Task::Screening { .. }) | (TaskResult::Measurement(_), Task::Measurement(_)) => true,
        (TaskResult::Swarm(bits), Task::Swarm(swarm)) => {
            // A swarm ends before the cycle in which a robot fails.
            let whole = match bits.fault {
                None => swarm.cycles(),
                Some((robot, _)) if robot >= swarm.robots() => return false,
                Some((_, fault)) => (fault.env_step.saturating_sub(1) / CYCLE_STEPS) as usize,
            };
            let is_whole = bits.cycles.len() == whole && (bits.fault.is_none() || whole < swarm.cycles());
            is_whole && bits.cycles.iter().all(|cycle| cycle.len() == swarm.robots())
        }
        _ => false,
    }
}

fn is_possible(Measurement { displacement, behavior, character }: &Measurement) -> bool {
    let rates = [character.error_rate, character.glitch_rate];
    displacement.iter().all(|number| number.is_finite())
        && displacement.behavior() == *behavior
        && rates.iter().all(|rate| (0.0..=1.0).contains(rate))
        && !character.margin.is_nan()
        && character.radius.is_none()
        && character.settle.len() == transitions(behavior.stimuli())
}

fn transitions(stimuli: usize) -> usize {
    let patterns = 1 << stimuli;
    patterns * (patterns - 1)
}

fn can_be(evaluated: &Evaluated, protocol: &EvaluationProtocol, task: &EvaluationTask) -> bool {
    let steps = evaluated.work.env_steps.checked_add(evaluated.work.left_out);
    let is_complete = steps == Some(full_steps(protocol));
    let CandidateOutcome::Measured(scores) = &evaluated.outcome else { return is_complete };
    let could_enter = match protocol.objective {
        SearchObjective::Distance => task.rivals.admit(scores.behavior, &[f64::INFINITY, scores.fitness[1]]),
        SearchObjective::Gate | SearchObjective::Wave | SearchObjective::Images => {
            task.rivals.admit(scores.behavior, &scores.fitness)
        }
    };
    let unit = match protocol.objective {
        // Patterns that a body does not tell apart are simulated once.
        SearchObjective::Distance => u64::from(protocol.fixed_steps),
        // A gate that is wrong in a world is not tried in those that follow.
        // A body that enters has seen every image.
        SearchObjective::Images => full_steps(protocol),
        SearchObjective::Gate | SearchObjective::Wave => full_steps(protocol) / (1 + protocol.others.len() as u64),
    };
    let is_whole = evaluated.work.left_out.is_multiple_of(unit) && evaluated.work.env_steps > 0;
    is_complete && could_enter && is_sound(protocol, scores) && is_whole
}

/// Whether the numbers are finite, and the behavior is one that is asked for, or else the one that they show.
fn is_sound(protocol: &EvaluationProtocol, scores: &Scores) -> bool {
    let fits = scores.behavior.stimuli() == protocol.stimuli && scores.displacement.len() == 1 << protocol.stimuli;
    let finite = scores.fitness.iter().chain(&*scores.displacement).all(|number| number.is_finite());
    let is_asked = match protocol.behaviors.as_slice() {
        // The body may walk the wrong way before some images.
        [] if protocol.objective == SearchObjective::Images => true,
        [] => scores.displacement.behavior() == scores.behavior,
        asked => asked.contains(&scores.behavior),
    };
    finite && fits && is_asked
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task_message::tests::evolution;
    use nbc_base::model::{Body, Displacements, Evolution, Palette};
    use nbc_sim::Simulator;
    use nbc_swarm::evolve::Search;
    use nbc_swarm::{Work, evaluate_tasks, measure};

    fn opposite(displacement: Displacements) -> Displacements {
        Displacements::under(2, |pattern| if displacement.at(pattern) > 0.0 { -1.0 } else { 1.0 })
    }

    #[test]
    fn results_of_both_objectives_are_plausible_and_changed_ones_are_not() {
        for objective in [SearchObjective::Distance, SearchObjective::Gate, SearchObjective::Wave] {
            let evolution = Evolution { objective, ..evolution() };
            let search = Search::new(&evolution, 1);
            let tasks: Vec<EvaluationTask> =
                search.ask().iter().take(6).map(|candidate| EvaluationTask::of(&search, candidate)).collect();
            let protocol = EvaluationProtocol::of(&evolution);
            for (done, task) in evaluate_tasks(&Simulator::default(), &protocol, &tasks).iter().zip(&tasks) {
                assert!(can_be(done, &protocol, task), "{done:?}");
                let longer = Work { env_steps: done.work.env_steps + 1, ..done.work };
                assert!(!can_be(&Evaluated { work: longer, ..*done }, &protocol, task));
                let CandidateOutcome::Measured(scores) = done.outcome else { continue };
                let other = Scores { displacement: opposite(scores.displacement), ..scores };
                let other = Evaluated { outcome: CandidateOutcome::Measured(other), ..*done };
                assert!(!can_be(&other, &protocol, task));
            }
        }
    }

    #[test]
    fn a_measurement_and_a_screening_are_plausible_and_changed_ones_are_not() {
        let body = Body::parse(&["34", "43"], &Palette::paper()).unwrap();
        let measurement = measure(&Simulator::default(), &body).unwrap();
        let task = Task::Measurement(body.clone());
        let plausible =
            |measurement: &Measurement| is_plausible(&TaskResult::Measurement(Ok(measurement.clone())), &task);
        assert!(plausible(&measurement));
        let away = opposite(measurement.displacement);
        assert!(!plausible(&Measurement { displacement: away, ..measurement.clone() }));
        let mut rate = measurement.clone();
        rate.character.error_rate = f64::NAN;
        assert!(!plausible(&rate));
        let task = Task::Screening { body, behavior: measurement.behavior, most: 2 };
        let plausible = |screened| is_plausible(&TaskResult::Screening(Ok(screened)), &task);
        assert!(plausible(None) && plausible(Some((2, 0.1))) && !plausible(Some((3, 0.1))));
        assert!(!is_plausible(&TaskResult::Measurement(Ok(measurement)), &task), "another kind");
    }
}
