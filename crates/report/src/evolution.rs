//! Evolution runs in words and lines: a line a generation for programs, a table at the end for people.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::Serialize;

use nbc_base::diag::counted;
use nbc_base::model::Behavior;
use nbc_swarm::Work;
use nbc_swarm::evolve::{ArchiveStats, Counts, Search};

/// A run after a generation, as a line of `progress.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EvolutionLine {
    /// Generations done.
    pub generation: u32,
    #[serde(flatten)]
    pub counts: Counts,
    /// Filled niches.
    pub filled: usize,
    /// Filled niches as a share of all.
    pub coverage: f64,
    /// Sum over filled niches of the best first fitness.
    pub qd_score: f64,
    /// Behaviors found.
    pub behaviors: usize,
    /// The fitnesses of the best of each behavior.
    pub best: BTreeMap<String, [f64; 2]>,
    #[serde(flatten)]
    pub work: Work,
}

impl EvolutionLine {
    pub fn of(search: &Search, work: Work) -> Self {
        let ArchiveStats { filled, coverage, qd_score, champions, .. } = search.archive().stats();
        Self {
            generation: search.generation(),
            counts: search.counts(),
            filled,
            coverage,
            qd_score,
            behaviors: champions.len(),
            best: champions.iter().map(|best| (best.behavior.to_string(), best.fitness)).collect(),
            work,
        }
    }
}

pub fn evolution_table(search: &Search, work: Work) -> String {
    let stats = search.archive().stats();
    let [first, second] = search.evolution().objective.columns();
    let mut text = format!("{:<10}{:<12}{:>8}{first:>11}{second:>11}\n", "behavior", "function", "niches");
    for best in &stats.champions {
        let function = best.behavior.function();
        let [a, b] = best.fitness;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{:<10}{function:<12}{:>8}{a:>11.3}{b:>11.3}", best.behavior, best.niches);
    }
    let counts = search.counts();
    let _ = writeln!(
        text,
        "{}, {} ({} left early, {} inconsistent, {}), {} drawn; {} of {} niches ({:.1} %), {} of {} behaviors, \
         QD-score {:.2}",
        counted(search.generation() as usize, "generation"),
        counted(counts.evaluations as usize, "evaluation"),
        counts.surpassed,
        counts.inconsistent,
        counted(counts.faults as usize, "fault"),
        counted(counts.undeveloped as usize, "invalid body"),
        stats.filled,
        stats.niches,
        100.0 * stats.coverage,
        stats.champions.len(),
        Behavior::all(search.evolution().palette.inputs()).count(),
        stats.qd_score,
    );
    let share = 100.0 * work.left_out as f64 / (work.env_steps + work.left_out).max(1) as f64;
    let _ = writeln!(
        text,
        "{} env steps simulated; {share:.0} % of the protocol left out as it could not matter",
        work.env_steps
    );
    text
}
