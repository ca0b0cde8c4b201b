//! Methods of proof, and the random patterns that one of them begins with.

use rand_chacha::ChaCha8Rng;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    Exhaustive {
        patterns: u64,
    },
    /// Equal gate by gate, whatever cells each gate is made of.
    Structural,
    Sat {
        calls: usize,
    },
}

/// The values of one input in word number `word` of 64 patterns. In half of the words ones and zeros are equally
/// frequent; in the others either is rare, because control logic depends on patterns with few ones or few zeros.
pub fn random_word(word: usize, random: &mut ChaCha8Rng) -> u64 {
    let rarity = (word / 2 % 8).saturating_sub(3);
    let rare = (0..rarity).fold(rand::Rng::next_u64(random), |bits, _| bits & rand::Rng::next_u64(random));
    if word.is_multiple_of(2) { rare } else { !rare }
}
