//! What mutants of the best robots do: whether they keep the behavior of their parent, and how many others they show.

use std::collections::{BTreeMap, BTreeSet};

use nbc_base::model::{Body, Genotype, MutationWeights, Rules, Setting};
use nbc_session::report;
use nbc_sim::Simulator;
use nbc_swarm::Proportion;
use nbc_swarm::evolve::{develop, mutate};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::transfer::shown;
use crate::{Fallible, LEAST_DISTANCE, Run, champions};

/// Mutants of a robot.
const MUTANTS: usize = 6;
/// Mutations until a mutant's body must differ from that of its parent.
const TRIES: usize = 200;

/// A mutant with another body, after as few mutations as it takes.
fn mutant(parent: &Body, genotype: &Genotype, rng: &mut ChaCha8Rng) -> Option<Body> {
    let mut child = genotype.clone();
    (0..TRIES).find_map(|_| {
        mutate(&mut child, &MutationWeights::default(), Rules::PAPER, rng);
        let body = develop(&child, parent.palette(), Rules::PAPER, parent.width(), parent.height()).ok();
        body.filter(|body| body != parent)
    })
}

/// By the difficulty of the parent: the share of mutants with its behavior, and the mean number of others among them.
pub fn print(boxes: &[(&str, &BTreeMap<u64, Run>)]) -> Fallible<()> {
    println!("\n| box | | no stimulus | one | both | XOR and XNOR |\n|---|---|---|---|---|---|");
    let simulator = Simulator::default();
    for (name, runs) in boxes {
        let mut same = [Proportion::default(); 4];
        let mut others = [0.0; 4];
        let mut parents = [0.0; 4];
        for (number, parent) in champions(runs, LEAST_DISTANCE).into_iter().enumerate() {
            let mut rng = ChaCha8Rng::seed_from_u64(number as u64);
            let genotype = parent.genotype.as_ref().ok_or("the runs of the paper have networks")?;
            let mutants: Vec<Body> = (0..MUTANTS).filter_map(|_| mutant(&parent.body, genotype, &mut rng)).collect();
            let shown = shown(&simulator, &Setting::default(), &mutants);
            let group = report::difficulty_of(parent.behavior);
            parents[group] += 1.0;
            same[group].attempts += shown.len();
            same[group].successes += shown.iter().filter(|&&shown| shown == Some(parent.behavior)).count();
            let different = shown.iter().flatten().filter(|&&shown| shown != parent.behavior);
            others[group] += different.collect::<BTreeSet<_>>().len() as f64;
        }
        print!("| {name} | the parent's behavior");
        same.iter().for_each(|group| print!(" | {:.0} %", 100.0 * group.share()));
        print!(" |\n| {name} | other behaviors");
        others.iter().zip(parents).for_each(|(others, parents)| print!(" | {:.1}", others / parents));
        println!(" |");
    }
    Ok(())
}
