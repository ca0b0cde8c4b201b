//! The walk over a wide network as a whole: it works on samples of the patterns, and SAT checks its result every few
//! steps. A wrong step is undone, and its counterexample is added to the samples.

use rand_chacha::ChaCha8Rng;

use crate::network::Network;
use crate::proof::{Comparison, random_word};
use crate::synth::care::CareSet;
use crate::synth::prices::Prices;
use crate::synth::walk::{self, WalkPlan};

const WORDS: usize = 32;
const MOST_WORDS: usize = 128;
/// Visits between two proofs: initial, smallest and largest number.
const BATCH: [u64; 3] = [32, 8, 1_000];
/// Propagations of the solver that take about as long as a visit.
const PROPAGATIONS: u64 = 4_000;
/// The most signals that a comparison collects, as a multiple of those of the network.
const MOST_SIGNALS: usize = 6;

/// Searches for a cheaper network in `plan.visits` visits. Each call of the solver counts as one, and so do
/// [`PROPAGATIONS`] of its propagations. Every network that it passes through is proved equal to the first, where the
/// conditions of `care` hold if there are any.
pub fn improve_on_samples(
    network: &Network,
    prices: &Prices,
    stages: &[u32],
    care: Option<&CareSet>,
    plan: WalkPlan<'_>,
    random: &mut ChaCha8Rng,
) -> Network {
    if plan.is_cancelled() {
        return network.clone();
    }
    let mut samples = Samples::new(network.inputs, care, random);
    let clauses = care.map_or(&[][..], |care| &care.clauses);
    let [mut batch, least, most] = BATCH;
    let mut now = network.clone();
    let mut comparison = Comparison::within(network, clauses);
    let mut work = 0;
    while work < plan.visits && !now.gates.is_empty() {
        let short = WalkPlan { visits: batch, ..plan };
        let next = walk::improve(&now, prices, stages, &samples.words, short, random);
        if plan.is_cancelled() {
            break;
        }
        let before = comparison.work();
        let compared = comparison.compare(&next);
        let [calls, propagations] = [0, 1].map(|i| comparison.work()[i] - before[i]);
        work += batch + calls + propagations / PROPAGATIONS;
        match compared {
            Ok(()) => {
                now = next;
                batch = (batch + batch / 2).min(most);
            }
            Err((_, pattern)) => {
                samples.learn(&pattern, random);
                batch = (batch / 2).max(least);
            }
        }
        if comparison.signals() > MOST_SIGNALS * network.signals() {
            comparison = Comparison::within(&now, clauses);
        }
    }
    now
}

struct Samples {
    words: Vec<Vec<u64>>,
    next: usize,
    /// Whether each input stays as it is in the neighbors of a pattern.
    fixed: Vec<bool>,
}

impl Samples {
    fn new(inputs: usize, care: Option<&CareSet>, random: &mut ChaCha8Rng) -> Self {
        let fixed = (0..inputs).map(|input| care.is_some_and(|care| care.constrains(input))).collect();
        let words = match care {
            None => (0..inputs).map(|_| (0..WORDS).map(|word| random_word(word, random)).collect()).collect(),
            Some(care) => care.words.iter().map(|words| spread(words)).collect(),
        };
        Self { words, next: WORDS, fixed }
    }

    /// Adds a pattern with 63 of its neighbors; if there are many already, they replace the oldest ones that were not
    /// random.
    fn learn(&mut self, pattern: &[bool], random: &mut ChaCha8Rng) {
        let at = if self.next < MOST_WORDS { self.next } else { WORDS + self.next % (MOST_WORDS - WORDS) };
        for ((words, &value), &fixed) in self.words.iter_mut().zip(pattern).zip(&self.fixed) {
            let mut draw = || rand::Rng::next_u64(random);
            // The first pattern is kept. Half of the others differ from it in one of sixteen inputs, half in one of
            // four.
            let near = draw() & draw();
            let flips = (near & draw() & draw() & 0xffff_ffff | near & !0xffff_ffff) & !1;
            let flips = if fixed { 0 } else { flips };
            let word = flips ^ if value { !0 } else { 0 };
            if at < words.len() { words[at] = word } else { words.push(word) }
        }
        self.next += 1;
    }
}

fn spread(words: &[u64]) -> Vec<u64> {
    (0..WORDS).map(|word| words[word * words.len() / WORDS]).collect()
}
