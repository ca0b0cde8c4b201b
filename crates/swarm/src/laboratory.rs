//! Where tasks are done: by the simulator of this program, or elsewhere.

use crate::{SwarmBits, Task, TaskResult, evaluate_tasks, measure, screen};
use nbc_sim::Simulator;

/// A place where tasks are done. The results depend on the tasks alone.
pub trait Laboratory: Sync {
    /// The result of each task, which is of the task's kind; calls `observe` after each.
    fn perform(&self, tasks: &[Task], observe: &dyn Fn()) -> Vec<TaskResult>;
}

impl Laboratory for Simulator {
    fn perform(&self, tasks: &[Task], observe: &dyn Fn()) -> Vec<TaskResult> {
        let one = |task: &Task| {
            let result = perform_one(self, task);
            observe();
            result
        };
        tasks.iter().map(one).collect()
    }
}

/// The result of each task. Evaluations by the same protocol are done together.
pub fn perform(simulator: &Simulator, tasks: &[Task]) -> Vec<TaskResult> {
    let mut results: Vec<Option<TaskResult>> = vec![None; tasks.len()];
    for first in 0..tasks.len() {
        if results[first].is_some() {
            continue;
        }
        let Task::Evaluation(protocol, _) = &tasks[first] else {
            results[first] = Some(perform_one(simulator, &tasks[first]));
            continue;
        };
        let alike = (first..tasks.len()).filter_map(|place| match &tasks[place] {
            Task::Evaluation(other, task) if other == protocol => Some((place, task.clone())),
            _ => None,
        });
        let (places, group): (Vec<usize>, Vec<_>) = alike.unzip();
        for (place, evaluated) in places.into_iter().zip(evaluate_tasks(simulator, protocol, &group)) {
            results[place] = Some(TaskResult::Evaluation(evaluated));
        }
    }
    results.into_iter().map(|result| result.expect("each task is done")).collect()
}

fn perform_one(simulator: &Simulator, task: &Task) -> TaskResult {
    match task {
        Task::Evaluation(protocol, task) => {
            TaskResult::Evaluation(evaluate_tasks(simulator, protocol, std::slice::from_ref(task))[0])
        }
        Task::Screening { body, behavior, most } => TaskResult::Screening(screen(simulator, body, *behavior, *most)),
        Task::Measurement(body) => TaskResult::Measurement(measure(simulator, body)),
        Task::Swarm(swarm) => TaskResult::Swarm(SwarmBits::simulate(simulator, swarm)),
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::sync::Arc;

    use super::*;
    use crate::evolve::Search;
    use crate::{EvaluationProtocol, EvaluationTask};
    use nbc_base::model::{Body, Evolution, Palette, SearchObjective};

    fn evaluations(objective: SearchObjective) -> Vec<Task> {
        let evolution = Evolution { objective, ..crate::evolve::tests::evolution() };
        let (search, protocol) = (Search::new(&evolution, 3), Arc::new(EvaluationProtocol::of(&evolution)));
        let task = |body: &Body| Task::Evaluation(Arc::clone(&protocol), EvaluationTask::of(&search, body));
        search.ask().iter().take(2).map(|candidate| task(&candidate.body)).collect()
    }

    #[test]
    fn tasks_of_all_kinds_together_have_the_results_of_each_alone() {
        let body = Body::parse(&["34", "43"], &Palette::paper()).unwrap();
        let screening = Task::Screening { body, behavior: "RRRL".parse().unwrap(), most: 1 };
        let [mut tasks, gates] = [SearchObjective::Distance, SearchObjective::Gate].map(evaluations);
        tasks.insert(1, screening);
        gates.into_iter().for_each(|task| tasks.insert(2, task));
        let (simulator, done) = (Simulator::default(), Cell::new(0));
        let alone = simulator.perform(&tasks, &|| done.set(done.get() + 1));
        assert_eq!((perform(&simulator, &tasks), done.get()), (alone, tasks.len()));
    }
}
