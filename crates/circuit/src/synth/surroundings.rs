//! The surroundings of a gate in a wide network: few inputs, the gates between them and the gate, and the gates after
//! it through which it is observed. Over every pattern of the inputs they show where the gate matters.

use std::cmp::Reverse;

use crate::network::{Signal, counting_word, word};
use crate::synth::candidates::Rows;
use crate::synth::graph::Graph;

const MOST_INPUTS: usize = 10;
/// The most levels and gates after the gate, and the largest fan-out that is followed.
const MOST_LEVELS: u32 = 4;
const MOST_AFTER: usize = 24;
const MOST_FANOUT: usize = 12;
/// The most gates before the gate and beside it.
const MOST_BEFORE: usize = 60;
const MOST_SIGNALS: usize = 100;

#[derive(Default)]
pub struct Surroundings {
    depends: Vec<bool>,
    inside: Vec<bool>,
    /// The row of each signal in the surroundings in `words`.
    places: Vec<u32>,
    leaves: Vec<Signal>,
    /// Signals that do not depend on the gate: the leaves, then gates.
    before: Vec<Signal>,
    /// The gates after the gate, drivers first.
    after: Vec<Signal>,
    /// Signals whose listeners are not yet marked.
    pending: Vec<Signal>,
    width: usize,
    /// The values of each row, and those with the gate inverted.
    words: Vec<u64>,
    flipped: Vec<u64>,
}

impl Surroundings {
    pub fn look(&mut self, graph: &Graph<'_>, gate: Signal) {
        self.mark_dependents(graph, gate);
        self.leaves.clear();
        for levels in (0..=MOST_LEVELS).rev() {
            self.collect_after(graph, gate, levels);
            self.collect_leaves(graph, gate);
            if self.leaves.len() < MOST_INPUTS || levels == 0 {
                break;
            }
        }
        self.collect_before(graph);
        self.simulate(graph, gate);
    }

    pub fn rows(&self) -> Rows<'_> {
        Rows { words: &self.words, width: self.width, places: Some(&self.places) }
    }

    pub fn before(&self) -> &[Signal] {
        &self.before
    }

    fn mark_dependents(&mut self, graph: &Graph<'_>, gate: Signal) {
        self.depends.clear();
        self.depends.resize(graph.nodes.len(), false);
        self.depends[gate as usize] = true;
        self.pending.push(gate);
        while let Some(signal) = self.pending.pop() {
            for &listener in graph.fanout(signal) {
                if !std::mem::replace(&mut self.depends[listener as usize], true) {
                    self.pending.push(listener);
                }
            }
        }
    }

    /// All pins that depend on the gate are among them, so that no input changes with the gate.
    fn collect_after(&mut self, graph: &Graph<'_>, gate: Signal, levels: u32) {
        let after = &mut self.after;
        after.clear();
        after.push(gate);
        let mut level = 0;
        for _ in 0..levels {
            let next = after.len();
            for i in level..next {
                for &listener in followed(graph, after[i]) {
                    if !after.contains(&listener) {
                        after.push(listener);
                    }
                }
            }
            after[next..].sort_unstable();
            after.truncate(1 + MOST_AFTER);
            level = next;
        }
        after.sort_unstable_by_key(|&signal| graph.position(signal));
        let mut kept = 1;
        for i in 1..after.len() {
            let known = |pin: Signal| !self.depends[pin as usize] || after[..kept].contains(&pin);
            if graph.node(after[i]).pins.into_iter().all(known) {
                after[kept] = after[i];
                kept += 1;
            }
        }
        after.truncate(kept);
        let seen = graph.is_output(gate) || graph.fanout(gate).iter().any(|listener| !after.contains(listener));
        // A gate that is seen directly always matters.
        if seen {
            after.clear();
        } else {
            after.remove(0);
        }
    }

    fn collect_leaves(&mut self, graph: &Graph<'_>, gate: Signal) {
        let pins = self.after.iter().chain([&gate]).flat_map(|&signal| graph.node(signal).pins);
        self.leaves.clear();
        self.leaves.extend(pins.filter(|&pin| pin > 1 && !self.depends[pin as usize]));
        self.leaves.sort_unstable();
        self.leaves.dedup();
    }

    fn collect_before(&mut self, graph: &Graph<'_>) {
        self.inside.clear();
        self.inside.resize(graph.nodes.len(), false);
        let mut inner = Vec::new();
        self.leaves.iter().for_each(|&leaf| self.inside[leaf as usize] = true);
        while inner.len() < MOST_BEFORE
            && let Some(at) = self.cheapest_leaf(graph)
        {
            let gate = self.leaves.swap_remove(at);
            inner.push(gate);
            for pin in graph.node(gate).pins {
                if pin > 1 && !self.inside[pin as usize] {
                    self.inside[pin as usize] = true;
                    self.leaves.push(pin);
                }
            }
        }
        self.add_side_gates(graph, &mut inner);
        inner.sort_unstable_by_key(|&signal| graph.position(signal));
        self.before.clear();
        self.before.extend(&self.leaves);
        self.before.extend(inner);
    }

    /// Of several, the one latest in order.
    fn cheapest_leaf(&self, graph: &Graph<'_>) -> Option<usize> {
        let rank = |&(_, &leaf): &(usize, &Signal)| {
            let [a, b] = graph.node(leaf).pins;
            let new = |pin: Signal| usize::from(pin > 1 && !self.inside[pin as usize]);
            (new(a) + if a == b { 0 } else { new(b) }, Reverse(graph.position(leaf)))
        };
        let gates = self.leaves.iter().enumerate().filter(|&(_, &leaf)| graph.node(leaf).alive);
        let (at, &leaf) = gates.min_by_key(rank)?;
        (self.leaves.len() + rank(&(at, &leaf)).0 <= MOST_INPUTS + 1).then_some(at)
    }

    fn add_side_gates(&mut self, graph: &Graph<'_>, inner: &mut Vec<Signal>) {
        let mut at = 0;
        while at < self.leaves.len() + inner.len() && inner.len() < MOST_SIGNALS {
            let from = if at < self.leaves.len() { self.leaves[at] } else { inner[at - self.leaves.len()] };
            at += 1;
            for &listener in followed(graph, from) {
                let known = |pin: Signal| pin <= 1 || self.inside[pin as usize];
                let new = !self.inside[listener as usize] && !self.depends[listener as usize];
                if new && graph.node(listener).pins.into_iter().all(known) {
                    self.inside[listener as usize] = true;
                    inner.push(listener);
                }
            }
        }
    }

    /// Computes the values of all rows: the constants, the signals before, the gate and those after it.
    fn simulate(&mut self, graph: &Graph<'_>, gate: Signal) {
        self.width = (1usize << self.leaves.len()).div_ceil(64);
        self.words.clear();
        self.words.resize(self.width, 0);
        self.words.resize(2 * self.width, !0);
        self.places.resize(graph.nodes.len(), 0);
        (self.places[0], self.places[1]) = (0, 1);
        for i in 0..self.before.len() {
            let signal = self.before[i];
            self.places[signal as usize] = 2 + i as u32;
            if i < self.leaves.len() {
                self.words.extend((0..self.width).map(|block| counting_word(i, block)));
            } else {
                self.append(graph, signal);
            }
        }
        self.places[gate as usize] = 2 + self.before.len() as u32;
        self.append(graph, gate);
        for i in 0..self.after.len() {
            self.places[self.after[i] as usize] = self.places[gate as usize] + 1 + i as u32;
            self.append(graph, self.after[i]);
        }
    }

    fn append(&mut self, graph: &Graph<'_>, signal: Signal) {
        let node = graph.node(signal);
        let [a, b] = node.pins.map(|pin| self.places[pin as usize] as usize * self.width);
        for i in 0..self.width {
            let value = word(node.function, self.words[a + i], self.words[b + i]);
            self.words.push(value);
        }
    }

    /// The patterns in which the gate matters and is 1, and those in which it matters and is 0.
    pub fn observe(&mut self, graph: &Graph<'_>, gate: Signal, on: &mut Vec<u64>, off: &mut Vec<u64>) {
        let start = self.places[gate as usize] as usize * self.width;
        on.clear();
        on.resize(self.width, if self.after.is_empty() { !0 } else { 0 });
        self.flipped.clear();
        self.flipped.extend(self.words[start..start + self.width].iter().map(|word| !word));
        for i in 0..self.after.len() {
            let signal = self.after[i];
            self.append_flipped(graph, signal, start);
            let shown = graph.is_output(signal) || graph.fanout(signal).iter().any(|to| !self.after.contains(to));
            if shown {
                let row = (i + 1) * self.width;
                (0..self.width).for_each(|j| on[j] |= self.flipped[row + j] ^ self.words[start + row + j]);
            }
        }
        // Fewer than six inputs fill a part of the word only, and repeat in the rest.
        let values = &self.words[start..start + self.width];
        off.clear();
        off.extend(on.iter().zip(values).map(|(care, value)| care & !value));
        on.iter_mut().zip(values).for_each(|(care, value)| *care &= value);
    }

    fn append_flipped(&mut self, graph: &Graph<'_>, signal: Signal, start: usize) {
        let node = graph.node(signal);
        let rows = node.pins.map(|pin| self.places[pin as usize] as usize * self.width);
        for i in 0..self.width {
            let [a, b] = rows.map(|row| if row >= start { self.flipped[row - start + i] } else { self.words[row + i] });
            self.flipped.push(word(node.function, a, b));
        }
    }
}

fn followed<'g>(graph: &'g Graph<'_>, from: Signal) -> &'g [Signal] {
    let listeners = graph.fanout(from);
    if listeners.len() <= MOST_FANOUT { listeners } else { &[] }
}
