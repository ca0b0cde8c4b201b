//! Votes of tables: a vote is a table of three inputs of which each is a table of three features, so that three robots
//! of three senses and one more see nine features. Votes are added one after another on the rows that those before get
//! wrong.

use crate::arithmetic::majority;
use crate::bits::Bits;
use crate::forest::{count_votes, weights};
use crate::graph::{GateGraph, Literal};
use crate::tree::Feature;

/// A function of three features: bit `4a + 2b + c` is its value.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Table {
    features: [usize; 3],
    entries: [bool; 8],
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Vote {
    tables: [Table; 3],
    entries: [bool; 8],
}

#[derive(Clone, Debug)]
pub struct Votes {
    margins: Vec<f64>,
    votes: Vec<Vote>,
}

const STEP: f64 = 0.5;

/// How often the tables of a vote are chosen again, each for the rows in which the other two leave the vote open.
const ROUNDS: usize = 2;

/// The most features of which all pairs are tried: those that alone tell most.
const SHORTLIST: usize = 64;

const FEWEST: usize = 10;

impl Votes {
    pub fn new(rows: usize) -> Self {
        Self { margins: vec![0.0; rows], votes: Vec::new() }
    }

    pub fn add(&mut self, features: &[Feature], target: &Bits, is_simple: bool) {
        let weights = weights(&self.margins, STEP);
        let vote = if is_simple { Vote::simple } else { Vote::new }(features, target, &weights);
        self.count(&vote, features, target, 1.0);
        self.votes.push(vote);
    }

    pub fn choose_again(&mut self, at: usize, features: &[Feature], target: &Bits) {
        self.count(&self.votes[at].clone(), features, target, -1.0);
        let vote = Vote::new(features, target, &weights(&self.margins, STEP));
        self.count(&vote, features, target, 1.0);
        self.votes[at] = vote;
    }

    fn count(&mut self, vote: &Vote, features: &[Feature], target: &Bits, times: f64) {
        let wrong = vote.answers(features).xor(target);
        count_votes(&mut self.margins, &wrong, times);
    }

    pub fn len(&self) -> usize {
        self.votes.len()
    }

    pub fn answers(&self, features: &[Feature]) -> Bits {
        let votes: Vec<Bits> = self.votes.iter().map(|vote| vote.answers(features)).collect();
        let is_most = |row: usize| votes.iter().filter(|vote| vote.get(row)).count() * 2 > votes.len();
        Bits::of((0..features[0].bits.rows()).map(is_most))
    }

    pub fn build(&self, graph: &mut GateGraph, features: &[Feature]) -> Literal {
        let votes: Vec<Literal> = self.votes.iter().map(|vote| vote.build(graph, features)).collect();
        majority(graph, &votes)
    }
}

impl Vote {
    fn simple(features: &[Feature], target: &Bits, weights: &[f64]) -> Self {
        let rows: Vec<usize> = (0..target.rows()).collect();
        let table = Table::best(features, target, weights, &rows);
        // The table alone: the function of three equal tables that is each of them.
        let entries = std::array::from_fn(|at| at == 7);
        Self { tables: [table.clone(), table.clone(), table], entries }
    }

    fn new(features: &[Feature], target: &Bits, weights: &[f64]) -> Self {
        let rows: Vec<usize> = (0..target.rows()).collect();
        let mut after = weights.to_vec();
        let tables = std::array::from_fn(|_| {
            let table = Table::best(features, target, &after, &rows);
            let wrong = table.answers(features).xor(target);
            let all: f64 = after.iter().sum();
            let error: f64 = wrong.ones().map(|row| after[row]).sum::<f64>() / all;
            // As AdaBoost weighs rows for the next table.
            let factor = ((1.0 - error) / error.max(1e-3)).sqrt();
            for (row, weight) in after.iter_mut().enumerate() {
                *weight *= if wrong.get(row) { factor } else { 1.0 / factor };
            }
            table
        });
        let mut vote = Self { tables, entries: [false; 8] };
        vote.choose_entries(features, target, weights);
        for _ in 0..ROUNDS {
            for at in 0..3 {
                vote.choose_table(at, features, target, weights);
            }
        }
        vote
    }

    fn choose_entries(&mut self, features: &[Feature], target: &Bits, weights: &[f64]) {
        let answers = self.tables.each_ref().map(|table| table.answers(features));
        let mut sums = [0.0; 8];
        for (row, weight) in weights.iter().enumerate() {
            let at = answers.iter().fold(0, |at, bits| at << 1 | usize::from(bits.get(row)));
            sums[at] += if target.get(row) { *weight } else { -weight };
        }
        self.entries = sums.map(|sum| sum > 0.0);
    }

    fn choose_table(&mut self, at: usize, features: &[Feature], target: &Bits, weights: &[f64]) {
        let answers = self.tables.each_ref().map(|table| table.answers(features));
        let value = |row: usize, own: bool| {
            let bit = |table: usize| if table == at { own } else { answers[table].get(row) };
            self.entries[(0..3).fold(0, |place, table| place << 1 | usize::from(bit(table)))]
        };
        let rows: Vec<usize> = (0..target.rows()).filter(|&row| value(row, false) != value(row, true)).collect();
        if rows.len() < FEWEST {
            return;
        }
        let wanted = Bits::of((0..target.rows()).map(|row| value(row, true) == target.get(row)));
        self.tables[at] = Table::best(features, &wanted, weights, &rows);
        self.choose_entries(features, target, weights);
    }

    fn answers(&self, features: &[Feature]) -> Bits {
        let answers = self.tables.each_ref().map(|table| table.answers(features));
        let at = |row: usize| answers.iter().fold(0, |at, bits| at << 1 | usize::from(bits.get(row)));
        Bits::of((0..answers[0].rows()).map(|row| self.entries[at(row)]))
    }

    fn build(&self, graph: &mut GateGraph, features: &[Feature]) -> Literal {
        let pins = self.tables.each_ref().map(|table| table.build(graph, features));
        graph.table(pins, bits_of(&self.entries))
    }
}

impl Table {
    /// The table that gets most of these rows right, by their weights: the best pair of features, and the best third.
    fn best(features: &[Feature], target: &Bits, weights: &[f64], rows: &[usize]) -> Self {
        let mut signed = vec![0.0; target.rows()];
        for &row in rows {
            signed[row] = if target.get(row) { weights[row] } else { -weights[row] };
        }
        let sum = |bits: &Bits| bits.ones().map(|row| signed[row]).sum::<f64>();
        let all: f64 = signed.iter().sum();
        let alone: Vec<f64> = features.iter().map(|feature| sum(&feature.bits)).collect();
        let mut listed: Vec<usize> = (0..features.len()).collect();
        listed.sort_by(|&one, &two| {
            let told = |at: usize| alone[at].abs() + (all - alone[at]).abs();
            told(two).total_cmp(&told(one))
        });
        listed.truncate(SHORTLIST);
        listed.sort_unstable();
        let mut pair = (-1.0, [listed[0]; 2]);
        for (at, &one) in listed.iter().enumerate() {
            for &two in &listed[at + 1..] {
                let both = sum(&features[one].bits.and(&features[two].bits));
                let cells = [both, alone[one] - both, alone[two] - both, all - alone[one] - alone[two] + both];
                let told = cells.iter().map(|cell| cell.abs()).sum();
                if told > pair.0 {
                    pair = (told, [one, two]);
                }
            }
        }
        let [one, two] = pair.1;
        let place = |row: usize, third: usize| {
            [one, two, third].iter().fold(0, |at, &feature| at << 1 | usize::from(features[feature].bits.get(row)))
        };
        let mut best = (-1.0, one, [0.0; 8]);
        for &third in &listed {
            let mut cells = [0.0; 8];
            for &row in rows {
                cells[place(row, third)] += signed[row];
            }
            let told = cells.iter().map(|cell: &f64| cell.abs()).sum();
            if told > best.0 {
                best = (told, third, cells);
            }
        }
        Self { features: [one, two, best.1], entries: best.2.map(|cell| cell > 0.0) }
    }

    fn answers(&self, features: &[Feature]) -> Bits {
        let bits = self.features.map(|feature| &features[feature].bits);
        let at = |row: usize| bits.iter().fold(0, |at, bits| at << 1 | usize::from(bits.get(row)));
        Bits::of((0..bits[0].rows()).map(|row| self.entries[at(row)]))
    }

    fn build(&self, graph: &mut GateGraph, features: &[Feature]) -> Literal {
        graph.table(self.features.map(|feature| features[feature].literal), bits_of(&self.entries))
    }
}

fn bits_of(entries: &[bool; 8]) -> u8 {
    entries.iter().rev().fold(0, |bits, &entry| bits << 1 | u8::from(entry))
}
