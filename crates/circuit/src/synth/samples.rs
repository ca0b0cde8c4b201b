//! The walk over a wide network as a whole: it works on samples of the patterns, and SAT checks its result every few
//! steps. A wrong step is undone, and its counterexample is added to the samples.

use rand_chacha::ChaCha8Rng;

use crate::network::Network;
use crate::proof::{Comparison, random_word};
use crate::synth::prices::Prices;
use crate::synth::walk::{self, WalkPlan};

const WORDS: usize = 32;
const MOST_WORDS: usize = 128;
/// Visits between two proofs: initial, smallest and largest number.
const BATCH: [u64; 3] = [32, 8, 1_000];
/// Propagations of the solver that take about as long as a visit.
const PROPAGATIONS: u64 = 4_000;
const MOST_SIGNALS: usize = 6;

/// A call of the solver counts as a visit, as do [`PROPAGATIONS`] propagations; networks on the way are proved equal.
pub fn improve_on_samples(
    network: &Network,
    prices: &Prices,
    stages: &[u32],
    plan: WalkPlan<'_>,
    random: &mut ChaCha8Rng,
) -> Network {
    if plan.is_cancelled() {
        return network.clone();
    }
    let mut samples = Samples::new(network.inputs, random);
    let [mut batch, least, most] = BATCH;
    let mut now = network.clone();
    let mut comparison = Comparison::with(network);
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
            comparison = Comparison::with(&now);
        }
    }
    now
}

/// Patterns of the inputs, `words[input][word]`.
struct Samples {
    words: Vec<Vec<u64>>,
    next: usize,
}

impl Samples {
    fn new(inputs: usize, random: &mut ChaCha8Rng) -> Self {
        let words = (0..inputs).map(|_| (0..WORDS).map(|word| random_word(word, random)).collect()).collect();
        Self { words, next: WORDS }
    }

    /// Adds a pattern with 63 of its neighbors, which may replace the oldest ones that were not random.
    fn learn(&mut self, pattern: &[bool], random: &mut ChaCha8Rng) {
        let at = if self.next < MOST_WORDS { self.next } else { WORDS + self.next % (MOST_WORDS - WORDS) };
        for (words, &value) in self.words.iter_mut().zip(pattern) {
            let mut draw = || rand::Rng::next_u64(random);
            // The first pattern is kept. Half of the others differ from it in one of sixteen inputs, half in one of
            // four.
            let near = draw() & draw();
            let flips = (near & draw() & draw() & 0xffff_ffff | near & !0xffff_ffff) & !1;
            let word = flips ^ if value { !0 } else { 0 };
            if at < words.len() { words[at] = word } else { words.push(word) }
        }
        self.next += 1;
    }
}
