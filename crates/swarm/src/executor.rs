//! The interface to what does tasks: the simulator of this program, or workers on other machines.

use crate::distance::WalkMemory;
use crate::evaluate::{evaluate_remembering, evaluate_tasks};
use crate::{SwarmBits, Task, TaskResult, measure, screen};
use nbc_base::source::CancelFlag;
use nbc_sim::Simulator;

/// Does tasks. The results depend on the tasks alone, not on the machine. Any thread can call it.
pub trait Executor: Sync {
    /// `None` if stopped. Calls `observe` after each task. `run` is the number of a series of calls, such as
    /// those of an evolution run; calls at the same time have different numbers.
    fn perform(&self, run: usize, tasks: &[Task], observe: &dyn Fn()) -> Option<Vec<TaskResult>>;
}

/// Does tasks on this machine, and remembers what it has simulated of the bodies that it evaluated.
#[derive(Debug, Default)]
pub struct LocalExecutor {
    simulator: Simulator,
    memory: WalkMemory,
    stop: CancelFlag,
}

impl LocalExecutor {
    pub fn new(simulator: Simulator) -> Self {
        Self { simulator, ..Self::default() }
    }

    #[must_use]
    pub fn until(self, stop: CancelFlag) -> Self {
        Self { stop, ..self }
    }

    #[cfg(test)]
    pub(crate) fn remembered(&self) -> usize {
        self.memory.len()
    }
}

impl Executor for LocalExecutor {
    fn perform(&self, _run: usize, tasks: &[Task], observe: &dyn Fn()) -> Option<Vec<TaskResult>> {
        let results = perform_remembering(&self.simulator, &self.memory, tasks, observe);
        // Simulations that were ended have no result.
        (!self.stop.is_raised()).then_some(results)
    }
}

/// Evaluations by the same protocol are done together. Calls `observe` after each task.
pub fn perform(simulator: &Simulator, tasks: &[Task], observe: &dyn Fn()) -> Vec<TaskResult> {
    perform_remembering(simulator, &WalkMemory::default(), tasks, observe)
}

fn perform_remembering(
    simulator: &Simulator,
    memory: &WalkMemory,
    tasks: &[Task],
    observe: &dyn Fn(),
) -> Vec<TaskResult> {
    let mut results: Vec<Option<TaskResult>> = vec![None; tasks.len()];
    for first in 0..tasks.len() {
        if results[first].is_some() {
            continue;
        }
        let Task::Evaluation(protocol, _) = &tasks[first] else {
            results[first] = Some(perform_one(simulator, &tasks[first]));
            observe();
            continue;
        };
        let alike = (first..tasks.len()).filter_map(|place| match &tasks[place] {
            Task::Evaluation(other, task) if other == protocol => Some((place, task.clone())),
            _ => None,
        });
        let (places, group): (Vec<usize>, Vec<_>) = alike.unzip();
        for (place, evaluated) in places.into_iter().zip(evaluate_remembering(simulator, memory, protocol, &group)) {
            results[place] = Some(TaskResult::Evaluation(evaluated));
            observe();
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
        let evolution = Evolution { objective, width: 2, height: 3, ..crate::evolve::tests::evolution() };
        let (search, protocol) = (Search::new(&evolution, 3), Arc::new(EvaluationProtocol::of(&evolution)));
        let task = |candidate| Task::Evaluation(Arc::clone(&protocol), EvaluationTask::of(&search, candidate));
        search.ask().iter().take(2).map(task).collect()
    }

    #[test]
    fn tasks_of_all_kinds_together_have_the_results_of_each_alone() {
        let body = Body::parse(&["34", "43"], &Palette::paper()).unwrap();
        let screening = Task::Screening { body, behavior: "RRRL".parse().unwrap(), most: 1 };
        let [mut tasks, gates] = [SearchObjective::Distance, SearchObjective::Wave].map(evaluations);
        tasks.insert(1, screening);
        gates.into_iter().for_each(|task| tasks.insert(2, task));
        let (simulator, done) = (Simulator::default(), Cell::new(0));
        let alone = tasks.iter().map(|task| perform_one(&simulator, task)).collect();
        let together = LocalExecutor::default().perform(0, &tasks, &|| done.set(done.get() + 1));
        assert_eq!((together, done.get()), (Some(alone), tasks.len()));
    }
}
