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

/// A run. Each door has the tasks of a generation done where it can, and saves what it wants to save:
/// [`EvolutionRun::ask`], an [`nbc_swarm::Executor`], [`EvolutionRun::tell`].
#[derive(Clone, Debug)]
pub struct EvolutionRun {
    search: Search,
    work: Work,
}

impl EvolutionRun {
    /// A run at its start.
    pub fn new(evolution: &Evolution, seed: u64) -> Self {
        Self { search: Search::new(evolution, seed), work: Work::default() }
    }

    /// The run of a checkpoint that is called `name`.
    #[cfg(feature = "disk")]
    pub fn resume(checkpoint: Checkpoint, name: &str, evolution: &Evolution, seed: u64) -> Result<Self, Diagnostic> {
        let work = Work { env_steps: checkpoint.env_steps, left_out: checkpoint.left_out };
        Ok(Self { search: checkpoint.resume(name, evolution, seed)?, work })
    }

    /// The search.
    pub fn search(&self) -> &Search {
        &self.search
    }

    /// The work of all evaluations.
    pub fn work(&self) -> Work {
        self.work
    }

    /// The candidates of the next generation.
    pub fn ask(&self) -> Vec<Candidate> {
        self.search.ask()
    }

    /// The evaluations of candidates for the archive as it is.
    pub fn tasks(&self, candidates: &[Candidate]) -> Vec<Task> {
        let protocol = Arc::new(EvaluationProtocol::of(self.search.evolution()));
        let task = |candidate| Task::Evaluation(Arc::clone(&protocol), EvaluationTask::of(&self.search, candidate));
        candidates.iter().map(task).collect()
    }

    /// Takes the results of a generation's tasks, in order of its candidates. Returns the line of its history.
    ///
    /// # Panics
    /// When the tasks were no evaluations.
    pub fn tell(&mut self, candidates: &[Candidate], results: Vec<TaskResult>) -> EvolutionLine {
        let results: Vec<Evaluated> = results.into_iter().map(TaskResult::evaluated).collect();
        let outcomes: Vec<CandidateOutcome> = results.iter().map(|evaluated| evaluated.outcome).collect();
        self.add_work(results.iter().fold(Work::default(), |sum, evaluated| sum.plus(evaluated.work)));
        self.tell_outcomes(candidates, &outcomes);
        self.line()
    }

    /// Takes the outcomes of a generation that were found in another way.
    pub fn tell_outcomes(&mut self, candidates: &[Candidate], outcomes: &[CandidateOutcome]) {
        self.search.tell(candidates, outcomes);
    }

    /// Adds the work of evaluations whose outcomes [`EvolutionRun::tell_outcomes`] takes.
    pub fn add_work(&mut self, work: Work) {
        self.work = self.work.plus(work);
    }

    /// The line of the history for the current state.
    pub fn line(&self) -> EvolutionLine {
        EvolutionLine::of(&self.search, self.work)
    }

    /// The bytes of a checkpoint.
    #[cfg(feature = "disk")]
    pub fn checkpoint(&self) -> Vec<u8> {
        Checkpoint::print(&self.search, self.work.env_steps, self.work.left_out)
    }
}
