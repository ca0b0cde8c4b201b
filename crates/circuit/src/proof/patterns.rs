//! Random patterns of inputs. Control logic depends on patterns in which few inputs are 1 or few are 0, so some words
//! are biased.

use rand_chacha::ChaCha8Rng;

/// The values of one input in word number `word` of 64 patterns. In half of the words ones and zeros are equally
/// frequent; in the others either is rare.
pub fn random_word(word: usize, random: &mut ChaCha8Rng) -> u64 {
    let rarity = (word / 2 % 8).saturating_sub(3);
    let rare = (0..rarity).fold(rand::Rng::next_u64(random), |bits, _| bits & rand::Rng::next_u64(random));
    if word.is_multiple_of(2) { rare } else { !rare }
}
