//! Storage: the latches and flip-flops of a netlist, and the net that opens and closes each (docs/timing.md, "Static
//! timing"). Those of registers are known from lowering; loops that were written as cells are recognized by what they
//! do.

mod cone;
mod element;
mod latch;
mod raise;

use std::collections::{BTreeMap, BTreeSet};

use crate::cells::CellKind;
use crate::loops::Loops;
use crate::{NetId, Netlist};

pub(crate) use cone::Inverters;
pub(crate) use latch::Follower;
pub use latch::{Latch, Unphased, WhyUnphased};
pub use raise::latches_as_registers;
pub(crate) use raise::{Raised, pair_latches};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FlipFlop {
    pub first: usize,
    pub second: usize,
    pub rising: bool,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Storage {
    pub latches: Vec<Latch>,
    pub flip_flops: Vec<FlipFlop>,
    pub unphased: Vec<Unphased>,
}

impl Storage {
    pub fn of<'k>(netlist: &Netlist, kind: impl Fn(NetId) -> &'k CellKind) -> Self {
        let loops = Loops::of(netlist);
        if loops.cores().is_empty() {
            return Self::default();
        }
        let inverters = Inverters::of(netlist);
        let mut storage = Self::default();
        let mut last = None;
        for lowered in &netlist.latches {
            let inside = |id| lowered.cells.contains(&id);
            let mut nets = element::shortest_loop(netlist, lowered.cells[0], inside);
            nets.sort_unstable();
            let closing = Some((lowered.enable, !lowered.open));
            let latch = latch::latch(netlist, &inverters, &nets, closing, &kind);
            let number = storage.add(latch, nets);
            if let (true, Some(first), Some(second)) = (lowered.is_second, last, number) {
                storage.flip_flops.push(FlipFlop { first, second, rising: storage.latches[second].open });
            }
            last = number;
        }
        let lowered: BTreeSet<NetId> = netlist.latches.iter().flat_map(|latch| latch.cells.clone()).collect();
        let written = storage.latches.len();
        for nets in element::elements(netlist, &loops, &lowered) {
            storage.add(latch::latch(netlist, &inverters, &nets, None, &kind), nets);
        }
        storage.flip_flops.extend(flip_flops(&storage.latches, written, &inverters));
        storage
    }

    /// The number of the latch, if it is one.
    fn add(&mut self, found: Result<Latch, WhyUnphased>, nets: Vec<NetId>) -> Option<usize> {
        match found {
            Ok(latch) => self.latches.push(latch),
            Err(why) => {
                self.unphased.push(Unphased { nets, why });
                return None;
            }
        }
        Some(self.latches.len() - 1)
    }

    /// The nets that open and close latches, each with the number of its latches, most first.
    pub fn roots(&self) -> Vec<(NetId, usize)> {
        let mut counts: BTreeMap<NetId, usize> = BTreeMap::new();
        self.latches.iter().for_each(|latch| *counts.entry(latch.root).or_insert(0) += 1);
        let mut roots: Vec<_> = counts.into_iter().collect();
        roots.sort_by_key(|&(root, count)| (std::cmp::Reverse(count), root));
        roots
    }
}

/// Of the latches from `written` on. The second latch of a pair takes only the state of the first, and is open when that is closed. Any two neighbors in
/// a chain are such a pair, so the edge of more pairs counts first; between equals it is the rise.
fn flip_flops(latches: &[Latch], written: usize, inverters: &Inverters) -> Vec<FlipFlop> {
    let pairs = pairs(latches, written, inverters);
    let key = |pair: &FlipFlop| (latches[pair.second].root, pair.rising);
    let mut counts: BTreeMap<(NetId, bool), usize> = BTreeMap::new();
    pairs.iter().for_each(|pair| *counts.entry(key(pair)).or_insert(0) += 1);
    let mut ordered: Vec<&FlipFlop> = pairs.iter().collect();
    ordered.sort_by_key(|pair| (std::cmp::Reverse((counts[&key(pair)], pair.rising)), pair.second));
    let mut is_paired = vec![false; latches.len()];
    let mut found = Vec::new();
    for pair in ordered {
        if !is_paired[pair.first] && !is_paired[pair.second] {
            (is_paired[pair.first], is_paired[pair.second]) = (true, true);
            found.push(pair.clone());
        }
    }
    found.sort_by_key(|pair| pair.second);
    found
}

fn pairs(latches: &[Latch], written: usize, inverters: &Inverters) -> Vec<FlipFlop> {
    let owner: BTreeMap<NetId, usize> = (0..)
        .zip(latches)
        .skip(written)
        .flat_map(|(i, latch)| latch.cells.iter().map(move |&cell| (cell, i)))
        .collect();
    let mut pairs = Vec::new();
    for (second, latch) in latches.iter().enumerate().skip(written) {
        let mut drivers = latch.data.iter().map(|&net| owner.get(&inverters.root(net).0));
        let Some(Some(&first)) = drivers.next() else { continue };
        let opposite = latches[first].root == latch.root && latches[first].open != latch.open;
        if opposite && drivers.all(|driver| driver == Some(&first)) {
            pairs.push(FlipFlop { first, second, rising: latch.open });
        }
    }
    pairs
}
