//! Replacements of a gate: functions of one, two or three other signals that agree with it wherever it matters.

use rand_chacha::ChaCha8Rng;

use crate::network::{Signal, inverted};
use nbc_base::model::Function;

pub const TRIES: usize = 24;

const MOST_PAIRS: usize = 2_000;

/// Buckets of the table that finds exclusive ors, and the words of patterns that choose the bucket.
const BUCKETS: usize = 256;
const HASHED_WORDS: usize = 16;

#[derive(Clone, Copy, Debug)]
pub struct Rows<'a> {
    pub words: &'a [u64],
    pub width: usize,
    /// The row of each signal; `None` where its row is its number.
    pub places: Option<&'a [u32]>,
}

impl<'a> Rows<'a> {
    fn of(self, signal: Signal) -> &'a [u64] {
        let row = self.places.map_or(signal, |places| places[signal as usize]) as usize;
        &self.words[row * self.width..][..self.width]
    }
}

#[derive(Clone, Copy, Debug)]
pub enum Replacement {
    Signal(Signal),
    One(Function, [Signal; 2]),
    Two(Function, Signal, Function, [Signal; 2]),
}

type Literal = (Signal, bool);

/// The function and the signal that a candidate's rest is combined with.
type Outer = Option<(Function, Signal)>;

/// The place of a word, and its patterns in which the value must be 1 and 0.
#[derive(Clone, Copy, Debug)]
struct HotWord {
    at: usize,
    on: u64,
    off: u64,
}

#[derive(Default)]
pub struct Finder {
    pub on: Vec<u64>,
    pub off: Vec<u64>,
    pub divisors: Vec<Signal>,
    pub exclusive: bool,
    pub found: Vec<Replacement>,
    /// The words in which the gate matters; those that refute most come first.
    hot: Vec<HotWord>,
    ands: Vec<Literal>,
    ors: Vec<Literal>,
    buckets: Vec<Vec<Signal>>,
}

impl Finder {
    pub fn new() -> Self {
        Self { exclusive: true, buckets: vec![Vec::new(); BUCKETS], ..Self::default() }
    }

    pub fn find(&mut self, rows: Rows<'_>, deep: bool, random: &mut ChaCha8Rng) {
        self.found.clear();
        let (on, off) = (std::mem::take(&mut self.on), std::mem::take(&mut self.off));
        self.find_flat(rows, &on, &off, None, random);
        if deep && !self.divisors.is_empty() {
            (0..3).for_each(|shape| self.find_deep(rows, &on, &off, shape, random));
        }
        (self.on, self.off) = (on, off);
    }

    /// Finds signals and functions of two signals that are 1 on `on` and 0 on `off`, `outer` being applied to them.
    fn find_flat(&mut self, rows: Rows<'_>, on: &[u64], off: &[u64], outer: Outer, random: &mut ChaCha8Rng) {
        self.ands.clear();
        self.ors.clear();
        if on.iter().all(|&word| word == 0) || off.iter().all(|&word| word == 0) {
            let constant = Signal::from(on.iter().any(|&word| word != 0));
            self.push_signal(constant, outer);
            return;
        }
        self.sort_words(on, off);
        for i in 0..self.divisors.len() {
            let signal = self.divisors[i];
            self.classify(signal, fits(rows.of(signal), &self.hot), outer);
        }
        self.find_pairs(rows, true, outer, random);
        self.find_pairs(rows, false, outer, random);
        if self.exclusive {
            self.find_exclusive(rows, outer);
        }
    }

    fn sort_words(&mut self, on: &[u64], off: &[u64]) {
        self.hot.clear();
        let words = on.iter().zip(off).enumerate().map(|(at, (&on, &off))| HotWord { at, on, off });
        self.hot.extend(words.filter(|word| word.on | word.off != 0));
        self.hot.sort_by_key(|word| std::cmp::Reverse(word.on.count_ones().min(word.off.count_ones())));
    }

    fn classify(&mut self, signal: Signal, fits: Fits, outer: Outer) {
        if fits.covers_on && fits.avoids_off {
            self.push_signal(signal, outer);
        }
        if fits.avoids_on && fits.covers_off {
            self.push(Function::NOT, [signal; 2], outer);
        }
        let ands = [(fits.covers_on, false), (fits.avoids_on, true)];
        let ors = [(fits.avoids_off, false), (fits.covers_off, true)];
        self.ands.extend(ands.into_iter().filter(|(fits, _)| *fits).map(|(_, inverted)| (signal, inverted)));
        self.ors.extend(ors.into_iter().filter(|(fits, _)| *fits).map(|(_, inverted)| (signal, inverted)));
    }

    /// Pairs of literals whose AND is 0 where the gate must be 0, or whose OR is 1 where it must be 1.
    fn find_pairs(&mut self, rows: Rows<'_>, and: bool, outer: Outer, random: &mut ChaCha8Rng) {
        let literals = std::mem::take(if and { &mut self.ands } else { &mut self.ors });
        let target = self.hot.iter().map(|word| (word.at, if and { word.off } else { word.on }));
        let aimed: Vec<(usize, u64)> = target.filter(|&(_, target)| target != 0).collect();
        let start = if literals.is_empty() { 0 } else { below(random, literals.len()) };
        let (mut found, mut compared) = (0, 0);
        'pairs: for i in 0..literals.len() {
            let one = literals[(start + i) % literals.len()];
            for j in 0..i {
                let two = literals[(start + j) % literals.len()];
                if pair_fits(rows, one, two, &aimed, and) {
                    self.push(pair_function(one.1, two.1, and), [one.0, two.0], outer);
                    found += 1;
                }
                compared += 1;
                if found > 4 * TRIES || compared > MOST_PAIRS {
                    break 'pairs;
                }
            }
        }
        *(if and { &mut self.ands } else { &mut self.ors }) = literals;
    }

    fn find_exclusive(&mut self, rows: Rows<'_>, outer: Outer) {
        let hot = std::mem::take(&mut self.hot);
        let hashed = &hot[..hot.len().min(HASHED_WORDS)];
        let fold = |hash: u64| (hash.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56) as usize % BUCKETS;
        let target = bucket(hashed, |word| word.on);
        self.buckets.iter_mut().for_each(Vec::clear);
        let mut compared = 0;
        for i in 0..self.divisors.len() {
            let signal = self.divisors[i];
            let values = rows.of(signal);
            let own = bucket(hashed, |word| values[word.at]);
            let place = fold(own ^ target);
            let most = MOST_PAIRS - compared;
            for j in 0..self.buckets[place].len().min(most) {
                compared += 1;
                let other = self.buckets[place][j];
                if let Some(function) = exclusive_fits(values, rows.of(other), &hot) {
                    self.push(function, [signal, other], outer);
                }
            }
            self.buckets[fold(own)].push(signal);
        }
        self.hot = hot;
    }

    fn find_deep(&mut self, rows: Rows<'_>, on: &[u64], off: &[u64], shape: usize, random: &mut ChaCha8Rng) {
        let pick = rand::Rng::next_u32(random) as usize;
        let without = |set: &[u64], values: &[u64], turn: u64| -> Vec<u64> {
            set.iter().zip(values).map(|(word, value)| word & (value ^ turn)).collect()
        };
        let (outer, rest_on, rest_off) = match shape {
            0 if !self.ands.is_empty() => {
                let (signal, inverted) = self.ands[pick % self.ands.len()];
                let rest = without(off, rows.of(signal), if inverted { !0 } else { 0 });
                ((pair_function(inverted, false, true), signal), on.to_vec(), rest)
            }
            1 if !self.ors.is_empty() => {
                let (signal, inverted) = self.ors[pick % self.ors.len()];
                let rest = without(on, rows.of(signal), if inverted { 0 } else { !0 });
                ((pair_function(inverted, false, false), signal), rest, off.to_vec())
            }
            2 => {
                let signal = self.divisors[pick % self.divisors.len()];
                let values = rows.of(signal);
                let turned = |to: &[u64], from: &[u64]| -> Vec<u64> {
                    (0..on.len()).map(|i| to[i] & !values[i] | from[i] & values[i]).collect()
                };
                ((Function::XOR, signal), turned(on, off), turned(off, on))
            }
            _ => return,
        };
        let literals = (std::mem::take(&mut self.ands), std::mem::take(&mut self.ors));
        self.find_flat(rows, &rest_on, &rest_off, Some(outer), random);
        (self.ands, self.ors) = literals;
    }

    fn push_signal(&mut self, signal: Signal, outer: Outer) {
        self.found.push(match outer {
            None => Replacement::Signal(signal),
            Some((function, other)) => Replacement::One(function, [other, signal]),
        });
    }

    fn push(&mut self, function: Function, pins: [Signal; 2], outer: Outer) {
        self.found.push(match outer {
            None => Replacement::One(function, pins),
            Some((outer, other)) => Replacement::Two(outer, other, function, pins),
        });
    }
}

pub fn below(random: &mut ChaCha8Rng, bound: usize) -> usize {
    ((u64::from(rand::Rng::next_u32(random)) * bound as u64) >> 32) as usize
}

/// A hash of the values where the gate matters. It is the same for their inverse.
fn bucket(hashed: &[HotWord], value: impl Fn(&HotWord) -> u64) -> u64 {
    let bit = (hashed[0].on | hashed[0].off).trailing_zeros();
    let turn = if value(&hashed[0]) >> bit & 1 == 1 { !0 } else { 0 };
    hashed.iter().fold(0, |hash, word| hash.rotate_left(23) ^ ((value(word) ^ turn) & (word.on | word.off)))
}

fn pair_fits(rows: Rows<'_>, one: Literal, two: Literal, aimed: &[(usize, u64)], and: bool) -> bool {
    let (a, b) = (rows.of(one.0), rows.of(two.0));
    // An OR is 1 on the target where the AND of the opposite literals is 0.
    let turn = |inverted: bool| if inverted == and { !0 } else { 0 };
    let (x, y) = (turn(one.1), turn(two.1));
    aimed.iter().all(|&(i, target)| (a[i] ^ x) & (b[i] ^ y) & target == 0)
}

fn exclusive_fits(a: &[u64], b: &[u64], hot: &[HotWord]) -> Option<Function> {
    let (mut xor, mut xnor) = (true, true);
    for &HotWord { at, on, off } in hot {
        let differ = a[at] ^ b[at];
        xor &= differ & off == 0 && !differ & on == 0;
        xnor &= differ & on == 0 && !differ & off == 0;
        if !xor && !xnor {
            return None;
        }
    }
    Some(if xor { Function::XOR } else { Function::XNOR })
}

fn pair_function(one: bool, two: bool, and: bool) -> Function {
    inverted(if and { Function::AND } else { Function::OR }, [one, two])
}

struct Fits {
    covers_on: bool,
    avoids_on: bool,
    covers_off: bool,
    avoids_off: bool,
}

fn fits(values: &[u64], hot: &[HotWord]) -> Fits {
    let (mut one_on, mut zero_on, mut one_off, mut zero_off) = (0, 0, 0, 0);
    for &HotWord { at, on, off } in hot {
        let value = values[at];
        one_on |= value & on;
        zero_on |= !value & on;
        one_off |= value & off;
        zero_off |= !value & off;
        if one_on != 0 && zero_on != 0 && one_off != 0 && zero_off != 0 {
            break;
        }
    }
    Fits { covers_on: zero_on == 0, avoids_on: one_on == 0, covers_off: zero_off == 0, avoids_off: one_off == 0 }
}
