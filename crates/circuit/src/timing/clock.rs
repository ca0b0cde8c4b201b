//! The times of a clock: for how long it must be high and low, and for how long the other inputs must be stable before
//! and after it switches.

use std::collections::BTreeSet;

use petgraph::visit::{Dfs, NodeIndexable};
use serde::Serialize;

use crate::cells::CellKind;
use crate::timing::arrivals::{Arrivals, Delay};
use crate::timing::phase::{MOST_ROOTS, Passage, Phase, RootValues, earliest, passages, phases};
use crate::timing::update::NetUpdate;
use crate::{Latch, NetId, Netlist, Node, Storage, WhyUnphased};

/// After this many periods without an end, data do not arrive in time.
const MOST_PERIODS: usize = 64;

/// The times of an input that opens and closes latches, in cycles. They hold for robots with delays between one cycle
/// and their clock.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClockTimes {
    pub clock: String,
    /// The least time for which it must be 1, in cycles.
    pub high: u32,
    /// The least time for which it must be 0, in cycles.
    pub low: u32,
    /// The least time from one rise to the next, in cycles.
    pub period: u32,
    /// The least time for which it must be 1 and 0 in turn, if both are the same, in cycles.
    #[serde(skip)]
    pub half: u32,
    /// The longest time between the opening of a latch and the arrival of its data, at this period.
    pub borrowed: u32,
    pub inputs: Vec<InputTimes>,
    pub paths: Vec<ClockPath>,
    /// The latches whose data may change before they are closed.
    pub races: Vec<Vec<String>>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct InputTimes {
    pub input: String,
    pub rises: bool,
    /// Cycles before the edge from which it must be stable.
    pub setup: u32,
    /// Cycles after the edge until which it must be stable.
    pub hold: u32,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClockPath {
    /// `input to register`, `register to register` or `register to output`.
    pub ends: &'static str,
    /// The time that a change takes along it, in cycles.
    pub cycles: u32,
    /// The nets along it, from an input on.
    pub nets: Vec<String>,
}

impl ClockTimes {
    /// The times of each input that opens and closes latches; without clocks whose latches do not settle in a row, and
    /// without those that drive memory whose state depends on delays. `hold` is the time after which every row has
    /// settled.
    pub fn all<'k>(netlist: &Netlist, storage: &Storage, hold: u32, kind: impl Fn(NetId) -> &'k CellKind) -> Vec<Self> {
        let roots: Vec<NetId> = storage.roots().into_iter().map(|(root, _)| root).take(MOST_ROOTS).collect();
        let values = phases(netlist, &roots);
        let is_input = |root: &&NetId| matches!(netlist.node(**root), Node::Input(_));
        let times = |&clock: &NetId| Clocked { netlist, storage, kind: &kind, clock, values: &values }.times(hold);
        let is_safe = |clock: &&NetId| !drives_race(netlist, storage, **clock);
        roots.iter().filter(is_input).filter(is_safe).filter_map(times).collect()
    }
}

/// Whether an input drives memory whose state depends on delays when it closes. No time of the input is enough for it.
fn drives_race(netlist: &Netlist, storage: &Storage, input: NetId) -> bool {
    let races: BTreeSet<NetId> = storage
        .unphased
        .iter()
        .filter(|unphased| unphased.why == WhyUnphased::Race)
        .flat_map(|unphased| unphased.nets.iter().copied())
        .collect();
    let mut driven = Dfs::new(netlist.graph(), input);
    !races.is_empty() && std::iter::from_fn(|| driven.next(netlist.graph())).any(|net| races.contains(&net))
}

struct Clocked<'a, F> {
    netlist: &'a Netlist,
    storage: &'a Storage,
    kind: &'a F,
    clock: NetId,
    /// The values that the nets that open and close latches may have at rest.
    values: &'a [RootValues],
}

/// The phases in which the clock is 0, and those in which it is 1.
type Halves = [Vec<(Vec<Passage>, Phase)>; 2];

impl<'k, F: Fn(NetId) -> &'k CellKind> Clocked<'_, F> {
    fn times(&self, hold: u32) -> Option<ClockTimes> {
        let halves = self.halves(&[self.clock]);
        let works = |high: u32, low: u32| self.borrowed(&halves, high, low).is_some();
        if !works(hold, hold) {
            return None;
        }
        let high = least(1, hold, |high| works(high, hold));
        let low = least(1, hold, |low| works(hold, low));
        let period = least(high + low, 2 * hold, |period| works(high, period - high) && works(period - low, low));
        Some(ClockTimes {
            clock: self.netlist.net_name(self.clock),
            high,
            low,
            period,
            half: least(high.max(low), hold, |half| works(half, half)),
            borrowed: self.borrowed(&halves, high, period - high)?,
            inputs: self.inputs(),
            paths: self.paths(&halves),
            races: self.races(&halves),
        })
    }

    fn delay(&self) -> Delay<'_, F> {
        Delay { netlist: self.netlist, kind: self.kind }
    }

    fn halves(&self, sources: &[NetId]) -> Halves {
        [false, true].map(|value| {
            let of_half = self.values.iter().filter(|values| values[&self.clock] == value);
            let phase = |values: &RootValues| {
                let passages = passages(self.netlist, self.storage, values, sources, self.kind);
                let phase = Phase::new(self.netlist, self.storage, &passages);
                (passages, phase)
            };
            of_half.map(phase).collect()
        })
    }

    fn open(&self, value: bool) -> impl Iterator<Item = &Latch> {
        self.storage.latches.iter().filter(move |latch| latch.root == self.clock && latch.open == value)
    }

    /// The longest time for which data arrive at a latch after it has opened; `None` if the clock, high and low for
    /// these times again and again, closes a latch before it has settled.
    fn borrowed(&self, halves: &Halves, high: u32, low: u32) -> Option<u32> {
        let mut late = vec![0; self.netlist.graph().node_bound()];
        for _ in 0..MOST_PERIODS {
            let mut borrowed = 0;
            let before = late.clone();
            for (value, cycles) in [(true, high), (false, low)] {
                let changes = self.changes(&halves[usize::from(value)], &late);
                for latch in self.open(value) {
                    let settled = latch.cells.iter().map(|cell| changes[cell.index()]).max().unwrap_or(0);
                    if settled > cycles + latch.chain.len() as u32 {
                        return None;
                    }
                    let opened: u32 = latch.chain.iter().map(|&id| (self.kind)(id).clock).sum();
                    let data = latch.data.iter().map(|net| changes[net.index()]).max().unwrap_or(0);
                    borrowed = borrowed.max(data.saturating_sub(opened));
                }
                late = changes.iter().map(|change| change.saturating_sub(cycles)).collect();
            }
            if late == before {
                return Some(borrowed);
            }
        }
        None
    }

    /// The latest change of each net after an edge of the clock; `late` has the changes that are still to come.
    fn changes(&self, phases: &[(Vec<Passage>, Phase)], late: &[u32]) -> Vec<u32> {
        let mut changes = late.to_vec();
        for (_, phase) in phases {
            let start = |update: &NetUpdate| match phase.net(update) {
                net if net == self.clock => Some(0),
                net => Some(late[net.index()]).filter(|&late| late > 0 && phase.is_real(update)),
            };
            let arrivals = Arrivals::from(&self.delay(), phase, start);
            for (i, update) in phase.updates.iter().enumerate().filter(|(_, update)| phase.is_real(update)) {
                let change = &mut changes[update.node.index()];
                *change = (*change).max(arrivals.times[i].unwrap_or(0));
            }
        }
        changes
    }

    fn inputs(&self) -> Vec<InputTimes> {
        let others = self.netlist.inputs().iter().filter(|&&input| input != self.clock);
        others.flat_map(|&input| self.around(input)).collect()
    }

    fn around(&self, input: NetId) -> Vec<InputTimes> {
        let halves = self.halves(&[input]);
        let edge = |rises: bool| {
            let mut times: Option<InputTimes> = None;
            for (passages, phase) in &halves[usize::from(!rises)] {
                let launch = |update: &NetUpdate| (phase.net(update) == input).then_some(0);
                let arrivals = Arrivals::from(&self.delay(), phase, launch);
                let earliest = earliest(self.netlist, self.storage, passages, &[input], &[]);
                for latch in self.open(!rises) {
                    let settled = (0..).zip(&phase.updates).filter(|(_, update)| latch.cells.contains(&update.node));
                    let Some(settled) = settled.filter_map(|(i, _)| arrivals.times[i]).max() else { continue };
                    let setup = settled.saturating_sub(latch.chain.len() as u32);
                    let closed = latch.chain.iter().map(|&id| (self.kind)(id).clock).sum();
                    let hold = latch.needed(self.netlist, self.kind, closed, &earliest).unwrap_or(0);
                    let old = times.take().map_or((0, 0), |old| (old.setup, old.hold));
                    let input = self.netlist.net_name(input);
                    times = Some(InputTimes { input, rises, setup: setup.max(old.0), hold: hold.max(old.1) });
                }
            }
            times
        };
        [true, false].into_iter().filter_map(edge).collect()
    }

    fn paths(&self, halves: &Halves) -> Vec<ClockPath> {
        let own = self.storage.latches.iter().filter(|latch| latch.root == self.clock);
        let mut data: BTreeSet<NetId> = own.flat_map(|latch| latch.data.iter().copied()).collect();
        for pair in &self.storage.flip_flops {
            self.storage.latches[pair.second].data.iter().for_each(|net| _ = data.remove(net));
        }
        data.remove(&self.clock);
        let outputs: BTreeSet<NetId> = self.netlist.outputs().iter().copied().collect();
        let others: Vec<NetId> = self.netlist.inputs().iter().copied().filter(|&id| id != self.clock).collect();
        let from_inputs = self.halves(&others);
        let kinds = [
            ("input to register", &from_inputs, &others[..], &data),
            ("register to register", halves, &[self.clock][..], &data),
            ("register to output", halves, &[self.clock][..], &outputs),
        ];
        kinds.into_iter().filter_map(|(ends, halves, from, to)| self.slowest(ends, halves, from, to)).collect()
    }

    fn slowest(&self, ends: &'static str, halves: &Halves, from: &[NetId], to: &BTreeSet<NetId>) -> Option<ClockPath> {
        let mut slowest: Option<ClockPath> = None;
        for (_, phase) in halves.iter().flatten() {
            let launch = |update: &NetUpdate| from.contains(&phase.net(update)).then_some(0);
            let arrivals = Arrivals::from(&self.delay(), phase, launch);
            if let Some((cycles, event)) = arrivals.last(|update| to.contains(&phase.updates[update].node))
                && slowest.as_ref().is_none_or(|slowest| cycles > slowest.cycles)
            {
                slowest = Some(ClockPath { ends, cycles, nets: self.netlist.net_names(&arrivals.path(phase, event)) });
            }
        }
        slowest
    }

    /// The latches of this clock whose data may change before they are closed, although no other input switches.
    fn races(&self, halves: &Halves) -> Vec<Vec<String>> {
        let closing = |passages: &[Passage]| {
            let latches = self.storage.latches.iter().zip(passages.to_vec());
            let own = latches.filter(|(latch, passage)| latch.root == self.clock && *passage == Passage::Closing);
            own.map(|(latch, _)| latch.cells.clone()).collect::<Vec<_>>()
        };
        let found: BTreeSet<Vec<NetId>> = halves.iter().flatten().flat_map(|(passages, _)| closing(passages)).collect();
        found.iter().map(|nets| self.netlist.net_names(nets)).collect()
    }
}

/// The least number between two that fits; the greatest fits.
fn least(mut least: u32, mut greatest: u32, fits: impl Fn(u32) -> bool) -> u32 {
    while least < greatest {
        let middle = (least + greatest) / 2;
        if fits(middle) { greatest = middle } else { least = middle + 1 }
    }
    least
}
