//! Storage: the latches and flip-flops of a netlist, and the net that opens and closes each
//! (docs/timing.md, "Static timing"). Those of registers are known from lowering; loops that were written as cells are
//! recognized by what they do.

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
        let lowered: BTreeSet<NetId> = netlist.latches.iter().flat_map(|latch| latch.cells.clone()).collect();
        let made = netlist.latches.iter().map(|latch| {
            let mut nets = element::shortest_loop(netlist, latch.cells[0], |id| latch.cells.contains(&id));
            nets.sort_unstable();
            (nets, Some((latch.enable, !latch.open)), latch.is_second)
        });
        let written = element::elements(netlist, &loops, &lowered).into_iter().map(|nets| (nets, None, false));
        let mut last = None;
        for (nets, closing, is_second) in made.chain(written) {
            let number = storage.latches.len();
            match latch::latch(netlist, &inverters, &nets, closing, &kind) {
                Ok(latch) => {
                    let pair = last.filter(|_| is_second);
                    let pair = pair.map(|first| FlipFlop { first, second: number, rising: latch.open });
                    storage.flip_flops.extend(pair);
                    storage.latches.push(latch);
                    last = Some(number);
                }
                Err(why) => {
                    storage.unphased.push(Unphased { nets, why });
                    last = None;
                }
            }
        }
        storage
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
