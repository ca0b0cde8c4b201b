//! Tasks that were handed in together, and their results as they arrive.

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use crate::answer_message::AnswerMessage;
use crate::checker::is_plausible;
use crate::message::TaskKey;
use nbc_swarm::{Task, TaskResult};

pub struct TaskBatch {
    run: u32,
    number: u32,
    tasks: Vec<Task>,
    results: Vec<Option<TakenResult>>,
    handed_in: Instant,
}

#[derive(Clone, Debug)]
struct TakenResult {
    result: TaskResult,
    worker: String,
    trust: Trust,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Trust {
    Claimed,
    Doubted,
    Verified,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    Taken,
    Again,
    Late,
    Implausible,
    Wrong,
    /// It differs from the first result, which came from this worker. Only doing the task here can decide.
    Differs {
        worker: String,
        result: Box<TaskResult>,
    },
}

impl TaskBatch {
    pub fn new(run: u32, number: u32, tasks: Vec<Task>) -> Self {
        Self { run, number, results: vec![None; tasks.len()], tasks, handed_in: Instant::now() }
    }

    pub fn keys(&self) -> Vec<TaskKey> {
        (0..self.tasks.len()).map(|index| self.key(index)).collect()
    }

    fn key(&self, index: usize) -> TaskKey {
        TaskKey { run: self.run, generation: self.number, index: index as u32 }
    }

    pub fn missing_task(&self, key: TaskKey) -> Option<&Task> {
        self.task(key).filter(|_| self.results[key.index as usize].is_none())
    }

    pub fn task(&self, key: TaskKey) -> Option<&Task> {
        let task = self.tasks.get(key.index as usize)?;
        (self.key(key.index as usize) == key).then_some(task)
    }

    /// The first result counts.
    pub fn take(&mut self, worker: &str, answer: &AnswerMessage) -> Verdict {
        let Some(task) = self.task(answer.key) else { return Verdict::Late };
        if !is_plausible(&answer.result, task) {
            return Verdict::Implausible;
        }
        let place = &mut self.results[answer.key.index as usize];
        let Some(first) = place else {
            let (result, worker) = (answer.result.clone(), worker.to_owned());
            *place = Some(TakenResult { result, worker, trust: Trust::Claimed });
            return Verdict::Taken;
        };
        match (first.result == answer.result, first.trust) {
            (true, _) => Verdict::Again,
            (false, Trust::Verified) => Verdict::Wrong,
            (false, _) => Verdict::Differs { worker: first.worker.clone(), result: Box::new(first.result.clone()) },
        }
    }

    pub fn doubt(&mut self, key: TaskKey) {
        if let Some(Some(taken)) = self.results.get_mut(key.index as usize) {
            taken.trust = Trust::Doubted;
        }
    }

    pub fn verify(&mut self, key: TaskKey, result: TaskResult) {
        if self.task(key).is_some() {
            let taken = TakenResult { result, worker: String::new(), trust: Trust::Verified };
            self.results[key.index as usize] = Some(taken);
        }
    }

    pub fn claims(&self, worker: &str) -> impl Iterator<Item = (TaskKey, TaskResult)> {
        self.results.iter().enumerate().filter_map(move |(index, result)| {
            let taken = result.as_ref().filter(|taken| taken.worker == worker && taken.trust == Trust::Claimed)?;
            Some((self.key(index), taken.result.clone()))
        })
    }

    pub fn forget(&mut self, worker: &str) -> Vec<TaskKey> {
        let is_its = |result: &Option<TakenResult>| {
            result.as_ref().is_some_and(|taken| taken.worker == worker && taken.trust == Trust::Claimed)
        };
        let lost: Vec<usize> = (0..self.results.len()).filter(|&index| is_its(&self.results[index])).collect();
        lost.iter().for_each(|&index| self.results[index] = None);
        lost.into_iter().map(|index| self.key(index)).collect()
    }

    pub fn missing(&self) -> usize {
        self.results.iter().filter(|result| result.is_none()).count()
    }

    pub fn results(&self, is_trusted: impl Fn(&str) -> bool) -> Option<(Vec<TaskResult>, BTreeSet<&str>)> {
        let is_usable = |taken: &&TakenResult| match taken.trust {
            Trust::Claimed => is_trusted(&taken.worker),
            Trust::Doubted => false,
            Trust::Verified => true,
        };
        let taken: Option<Vec<&TakenResult>> =
            self.results.iter().map(|result| result.as_ref().filter(is_usable)).collect();
        let claimed = |taken: &&&TakenResult| taken.trust == Trust::Claimed;
        taken.map(|all| {
            let workers = all.iter().filter(claimed).map(|taken| taken.worker.as_str()).collect();
            (all.iter().map(|taken| taken.result.clone()).collect(), workers)
        })
    }

    pub fn overdue(&self, age: Duration) -> Vec<TaskKey> {
        let is_late = self.handed_in.elapsed() >= age;
        let missing = (0..self.results.len()).filter(|&index| is_late && self.results[index].is_none());
        missing.map(|index| self.key(index)).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::task_message::tests::evolution;
    use nbc_base::model::{Fault, FaultKind};
    use nbc_sim::Simulator;
    use nbc_swarm::evolve::{CandidateOutcome, Search};
    use nbc_swarm::{Evaluated, EvaluationProtocol, EvaluationTask, perform};

    fn batch() -> (TaskBatch, Vec<AnswerMessage>) {
        let search = Search::new(&evolution(), 1);
        let protocol = Arc::new(EvaluationProtocol::of(&evolution()));
        let task = |candidate| Task::Evaluation(Arc::clone(&protocol), EvaluationTask::of(&search, candidate));
        let tasks: Vec<Task> = search.ask().iter().take(2).map(task).collect();
        let done = perform(&Simulator::default(), &tasks, &|| ());
        let key = |index| TaskKey { run: 0, generation: 0, index };
        let answers = (0..).zip(done).map(|(index, result)| AnswerMessage { key: key(index), result }).collect();
        (TaskBatch::new(0, 0, tasks), answers)
    }

    fn wrong(answer: &AnswerMessage) -> AnswerMessage {
        let evaluated = answer.result.clone().evaluated();
        let outcome = match evaluated.outcome {
            CandidateOutcome::Inconsistent => {
                CandidateOutcome::Faulty(Fault { env_step: 1, kind: FaultKind::Unstable })
            }
            _ => CandidateOutcome::Inconsistent,
        };
        AnswerMessage { result: TaskResult::Evaluation(Evaluated { outcome, ..evaluated }), ..answer.clone() }
    }

    fn results(batch: &TaskBatch) -> Option<Vec<TaskResult>> {
        batch.results(|worker| worker != "unknown").map(|(results, _)| results)
    }

    #[test]
    fn the_first_result_counts_and_late_ones_do_not() {
        let (mut batch, answers) = batch();
        let late = AnswerMessage { key: TaskKey { generation: 7, ..answers[0].key }, ..answers[0].clone() };
        assert_eq!(batch.take("a", &late), Verdict::Late);
        let beyond = AnswerMessage { key: TaskKey { index: 9, ..answers[0].key }, ..answers[0].clone() };
        assert_eq!(batch.take("a", &beyond), Verdict::Late);
        assert_eq!(batch.take("a", &answers[1]), Verdict::Taken);
        assert_eq!(batch.take("b", &answers[1]), Verdict::Again);
        assert_eq!((batch.missing(), results(&batch)), (1, None));
        assert!(batch.missing_task(answers[0].key).is_some());
        assert!(batch.missing_task(answers[1].key).is_none());
        assert_eq!(batch.take("b", &answers[0]), Verdict::Taken);
        assert_eq!(results(&batch), Some(answers.iter().map(|answer| answer.result.clone()).collect()));
    }

    #[test]
    fn results_of_unknown_workers_and_doubted_ones_are_not_used() {
        let (mut batch, answers) = batch();
        answers.iter().for_each(|answer| _ = batch.take("unknown", answer));
        assert_eq!(results(&batch), None);
        assert_eq!(batch.forget("unknown"), [answers[0].key, answers[1].key]);
        answers.iter().for_each(|answer| _ = batch.take("known", answer));
        batch.doubt(answers[1].key);
        assert_eq!(results(&batch), None);
        batch.verify(answers[1].key, answers[1].result.clone());
        assert_eq!(results(&batch), Some(answers.iter().map(|answer| answer.result.clone()).collect()));
        assert_eq!(batch.forget("known"), [answers[0].key], "what was verified stays");
    }

    #[test]
    fn a_result_that_differs_is_decided_here() {
        let (mut batch, answers) = batch();
        let wrong = wrong(&answers[0]);
        assert_eq!(batch.take("liar", &wrong), Verdict::Taken, "it could be right");
        let differs = Verdict::Differs { worker: "liar".to_owned(), result: Box::new(wrong.result.clone()) };
        assert_eq!(batch.take("good", &answers[0]), differs);
        batch.verify(answers[0].key, answers[0].result.clone());
        assert_eq!(batch.take("liar", &wrong), Verdict::Wrong);
        assert_eq!(batch.take("good", &answers[0]), Verdict::Again);
        let mut longer = answers[0].result.clone().evaluated();
        longer.work.env_steps += 1;
        let impossible = AnswerMessage { result: TaskResult::Evaluation(longer), ..answers[0].clone() };
        assert_eq!(batch.take("liar", &impossible), Verdict::Implausible);
    }
}
