//! One seed of an evolution: its search, with the work of its evaluations.

use std::sync::Arc;

use crate::report::EvolutionLine;
#[cfg(feature = "disk")]
use crate::store::Checkpoint;
#[cfg(feature = "disk")]
use nbc_base::diag::Diagnostic;
use nbc_base::model::Evolution;
use nbc_swarm::evolve::{Candidate, CandidateOutcome, Search};
use nbc_swarm::{Evaluated, EvaluationProtocol, EvaluationTask, Task, TaskResult, Work};

/// A run of one seed: [`Search::ask`], [`EvolutionRun::tasks`], an [`nbc_swarm::Executor`], [`EvolutionRun::tell`].
#[derive(Clone, Debug)]
pub struct EvolutionRun {
    search: Search,
    work: Work,
}

impl EvolutionRun {
    pub fn new(evolution: &Evolution, seed: u64) -> Self {
        Self { search: Search::new(evolution, seed), work: Work::default() }
    }

    /// `name` is that of the checkpoint, for messages.
    #[cfg(feature = "disk")]
    pub fn resume(checkpoint: Checkpoint, name: &str, evolution: &Evolution, seed: u64) -> Result<Self, Diagnostic> {
        let work = Work { env_steps: checkpoint.env_steps, left_out: checkpoint.left_out };
        Ok(Self { search: checkpoint.resume(name, evolution, seed)?, work })
    }

    pub fn search(&self) -> &Search {
        &self.search
    }

    pub fn work(&self) -> Work {
        self.work
    }

    pub fn tasks(&self, candidates: &[Candidate]) -> Vec<Task> {
        let protocol = Arc::new(EvaluationProtocol::of(self.search.evolution()));
        let task = |candidate| Task::Evaluation(Arc::clone(&protocol), EvaluationTask::of(&self.search, candidate));
        candidates.iter().map(task).collect()
    }

    /// `results` are in the order of `candidates`. Returns the line of the history.
    pub fn tell(&mut self, candidates: &[Candidate], results: Vec<TaskResult>) -> EvolutionLine {
        let results: Vec<Evaluated> = results.into_iter().map(TaskResult::evaluated).collect();
        let outcomes: Vec<CandidateOutcome> = results.iter().map(|evaluated| evaluated.outcome).collect();
        self.add_work(results.iter().fold(Work::default(), |sum, evaluated| sum.plus(evaluated.work)));
        self.search.tell(candidates, &outcomes);
        self.line()
    }

    /// Takes outcomes that were found without tasks; their work is added by [`EvolutionRun::add_work`].
    pub fn tell_outcomes(&mut self, candidates: &[Candidate], outcomes: &[CandidateOutcome]) {
        self.search.tell(candidates, outcomes);
    }

    pub fn add_work(&mut self, work: Work) {
        self.work = self.work.plus(work);
    }

    pub fn line(&self) -> EvolutionLine {
        EvolutionLine::of(&self.search, self.work)
    }

    #[cfg(feature = "disk")]
    pub fn checkpoint(&self) -> Vec<u8> {
        Checkpoint::print(&self.search, self.work.env_steps, self.work.left_out)
    }
}
