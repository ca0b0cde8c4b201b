//! Classes by a code: each bit of the code tells some classes from the others and is learned alone, and a value is that
//! of the nearest code word (error-correcting output codes, Dietterich and Bakiri 1995).

use std::fmt;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::bits::Bits;
use crate::graph::{GateGraph, Literal};
use crate::tree::{DecisionTree, Feature, Growth};
use crate::votes::Votes;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CodeShape {
    pub bits: usize,
    /// The votes for each bit: one less than a power of two.
    pub votes: usize,
}

impl CodeShape {
    /// The sizes that are tried: on images of digits, fewer bits or votes read fewer of them (docs/learning.md).
    pub const ALL: [Self; 2] = [Self { bits: 8, votes: 15 }, Self { bits: 9, votes: 15 }];
}

impl fmt::Display for CodeShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a code of {} bits, {} votes of tables each", self.bits, self.votes)
    }
}

const MOST_CLASSES: usize = 32;

const RATED: usize = 96;

const RATING_VOTES: usize = 11;

/// One of so many rows rates the divisions, which are learned from the other rows.
const RATING: usize = 4;

/// How often a choice of a code begins at random, and how many changes it then tries.
const SEARCHES: usize = 20;
const CHANGES: usize = 1_500;

/// The bits in which the words of two classes should differ, so that one wrong bit does no harm.
const DISTANCE: u32 = 3;

#[derive(Clone, Debug)]
pub struct Classes {
    pub inputs: Vec<Bits>,
    pub values: Vec<u64>,
    pub of_row: Vec<usize>,
    pub width: usize,
    /// So many rows after each other belong together.
    pub group: usize,
}

impl Classes {
    /// The numbers in rows of output bits, the highest bit first; `None` if they are not few numbers of several bits.
    pub fn of(inputs: Vec<Bits>, outputs: &[Bits], group: usize) -> Option<Self> {
        let width = outputs.len();
        if !(2..=64).contains(&width) {
            return None;
        }
        let rows = outputs[0].rows();
        let number = |row: usize| outputs.iter().fold(0, |number, bit| number << 1 | u64::from(bit.get(row)));
        let numbers: Vec<u64> = (0..rows).map(number).collect();
        let mut values = numbers.clone();
        values.sort_unstable();
        values.dedup();
        let of_row = numbers.iter().map(|number| values.binary_search(number).expect("all are listed")).collect();
        (3..=MOST_CLASSES).contains(&values.len()).then_some(Self { inputs, values, of_row, width, group })
    }

    fn side(&self, division: u64) -> Bits {
        Bits::of(self.of_row.iter().map(|class| division >> class & 1 == 1))
    }
}

#[derive(Clone, Debug)]
pub struct CodeFitting {
    shape: CodeShape,
    graph: GateGraph,
    features: Vec<Feature>,
    /// The divisions that may become bits of the code, and on which side of them the rating rows seem to be.
    divisions: Vec<u64>,
    sides: Vec<Bits>,
    code: Vec<u64>,
    votes: Vec<Votes>,
    again: usize,
}

impl CodeFitting {
    /// The stream of random numbers is that of the seed and the output port.
    pub fn new(shape: CodeShape, classes: &Classes, seed: u64, port: usize) -> Self {
        let graph = GateGraph::new(classes.inputs.len());
        let features = Feature::of_inputs(&graph, &classes.inputs);
        let mut random = stream(seed, port, 0);
        let count = classes.values.len();
        // The first class is always on the side of the zeros, because a division is as good as its inverse.
        let all = (1u64 << count) - 2;
        let mut divisions = Vec::new();
        for _ in 0..RATED * 8 {
            let division = random.random_range(0..=all) & all;
            let ones = division.count_ones() as usize;
            if ones * 3 >= count && ones * 3 <= 2 * count && !divisions.contains(&division) && divisions.len() < RATED {
                divisions.push(division);
            }
        }
        Self { shape, graph, features, divisions, sides: Vec::new(), code: Vec::new(), votes: Vec::new(), again: 0 }
    }

    pub fn shape(&self) -> CodeShape {
        self.shape
    }

    /// Does the next piece of work: rates a division, chooses the code, or learns a vote. Returns false when all is
    /// done.
    pub fn advance(&mut self, classes: &Classes, seed: u64, port: usize) -> bool {
        if let Some(&division) = self.divisions.get(self.sides.len()) {
            self.sides.push(rated(classes, &self.features, division));
            return true;
        }
        if self.code.is_empty() {
            self.code = self.choose(classes, &mut stream(seed, port, 1));
            return true;
        }
        let rows = classes.of_row.len();
        if self.votes.last().is_none_or(|votes| votes.len() == self.shape.votes) {
            if self.votes.len() == self.code.len() {
                return self.choose_again(classes);
            }
            self.votes.push(Votes::new(rows));
        }
        let bit = self.votes.len() - 1;
        self.votes[bit].add(&self.features, &classes.side(self.code[bit]), false);
        true
    }

    fn choose_again(&mut self, classes: &Classes) -> bool {
        let (bit, vote) = (self.again / self.shape.votes, self.again % self.shape.votes);
        if bit == self.code.len() {
            return false;
        }
        self.votes[bit].choose_again(vote, &self.features, &classes.side(self.code[bit]));
        self.again += 1;
        true
    }

    /// The divisions that tell all classes apart by some bits, and get most bits of the rating rows right.
    fn choose(&self, classes: &Classes, random: &mut ChaCha8Rng) -> Vec<u64> {
        let wanted = self.shape.bits.min(self.divisions.len());
        let bits = |is_one: &dyn Fn(usize) -> bool| {
            (0..self.divisions.len()).fold(0u128, |word, at| word | u128::from(is_one(at)) << at)
        };
        let words: Vec<u128> =
            (0..classes.values.len()).map(|class| bits(&|at| self.divisions[at] >> class & 1 == 1)).collect();
        let rows: Vec<(u128, usize)> = rating_rows(classes)
            .enumerate()
            .map(|(place, row)| (bits(&|at| self.sides[at].get(place)), classes.of_row[row]))
            .collect();
        let differ = |one: usize, two: usize, mask: u128| ((words[one] ^ words[two]) & mask).count_ones();
        let worth = |code: &[usize]| {
            let mask = code.iter().fold(0u128, |mask, at| mask | 1 << at);
            let pairs = (0..words.len()).flat_map(|one| (0..one).map(move |two| (one, two)));
            let distance = pairs.map(|(one, two)| differ(one, two, mask)).min().unwrap_or(0);
            let right: u32 = rows.iter().map(|&(word, class)| (!(word ^ words[class]) & mask).count_ones()).sum();
            (distance.min(DISTANCE), right)
        };
        let mut best: Option<((u32, u32), Vec<usize>)> = None;
        for _ in 0..SEARCHES {
            let mut code: Vec<usize> = Vec::new();
            while code.len() < wanted {
                let at = random.random_range(0..self.divisions.len());
                if !code.contains(&at) {
                    code.push(at);
                }
            }
            let mut own = worth(&code);
            for _ in 0..CHANGES {
                let (place, at) = (random.random_range(0..wanted), random.random_range(0..self.divisions.len()));
                if code.contains(&at) {
                    continue;
                }
                let before = std::mem::replace(&mut code[place], at);
                let changed = worth(&code);
                if changed >= own {
                    own = changed;
                } else {
                    code[place] = before;
                }
            }
            if best.as_ref().is_none_or(|(most, _)| own > *most) {
                best = Some((own, code));
            }
        }
        best.map_or_else(Vec::new, |(_, code)| code.into_iter().map(|at| self.divisions[at]).collect())
    }

    pub fn finish(&mut self, classes: &Classes) -> (GateGraph, Vec<Literal>) {
        let bits: Vec<Literal> = self.votes.iter().map(|votes| votes.build(&mut self.graph, &self.features)).collect();
        // Every word that is nearest to one code word; what comes of those farther away is of no account.
        let mut words: Vec<(u64, u64, f64)> = Vec::new();
        let word = |class: usize| (0..self.code.len()).fold(0, |word, at| word | (self.code[at] >> class & 1) << at);
        for seen in 0..1u64 << self.code.len() {
            let far = |class: usize| (seen ^ word(class)).count_ones() as usize;
            let nearest = (0..classes.values.len()).min_by_key(|&class| far(class)).expect("there are classes");
            let is_clear = (0..classes.values.len()).all(|class| class == nearest || far(class) > far(nearest));
            if let Some(&weight) = WEIGHTS.get(far(nearest)).filter(|_| is_clear) {
                words.push((seen, classes.values[nearest], weight));
            }
        }
        let features: Vec<Feature> = bits
            .iter()
            .enumerate()
            .map(|(at, &literal)| Feature {
                literal,
                bits: Bits::of(words.iter().map(|(word, ..)| word >> at & 1 == 1)),
            })
            .collect();
        let weights: Vec<f64> = words.iter().map(|(_, _, weight)| *weight).collect();
        let growth = Growth { depth: usize::MAX, leaf: 0.0 };
        let outputs = (0..classes.width).rev().map(|bit| {
            let target = Bits::of(words.iter().map(|(_, value, _)| value >> bit & 1 == 1));
            DecisionTree::grow(&features, &target, &weights, growth).build(&mut self.graph, &features)
        });
        let outputs = outputs.collect();
        (std::mem::take(&mut self.graph), outputs)
    }
}

/// The weights of words by the bits in which they differ from the nearest code word.
const WEIGHTS: [f64; 3] = [100.0, 1.0, 0.01];

fn stream(seed: u64, port: usize, part: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(2 + 2 * port as u64 + part);
    random
}

fn rating_rows(classes: &Classes) -> impl Iterator<Item = usize> {
    (0..classes.of_row.len()).filter(|row| (row / classes.group).is_multiple_of(RATING))
}

fn rated(classes: &Classes, features: &[Feature], division: u64) -> Bits {
    let rated: Vec<usize> = rating_rows(classes).collect();
    let learned: Vec<usize> =
        (0..classes.of_row.len()).filter(|row| !(row / classes.group).is_multiple_of(RATING)).collect();
    let part = |rows: &[usize]| {
        let pick = |feature: &Feature| Feature { literal: feature.literal, bits: feature.bits.pick(rows) };
        features.iter().map(pick).collect::<Vec<_>>()
    };
    let side = classes.side(division);
    let (own, target) = (part(&learned), side.pick(&learned));
    let mut votes = Votes::new(learned.len());
    for _ in 0..RATING_VOTES {
        votes.add(&own, &target, true);
    }
    votes.answers(&part(&rated))
}
