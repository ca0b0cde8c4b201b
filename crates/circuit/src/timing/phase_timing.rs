//! The timing of a circuit by the phases of its clocks: registers, the times of each clock and input, the slowest
//! paths, and what is not timed by phases.

use serde::Serialize;

use crate::lowering::KeptLatch;
use crate::timing::{ClockPath, ClockTimes, InputTimes, Timing};
use crate::{CellKind, FlipFlop, Latch, NetId, Netlist, Unphased};
use nbc_base::diag::counted;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PhaseTiming {
    pub latches: Vec<TimedLatch>,
    pub flip_flops: Vec<TimedFlipFlop>,
    pub clocks: Vec<ClockTimes>,
    pub unphased: Vec<UnphasedLoop>,
    pub kept: Vec<KeptLatch>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TimedLatch {
    pub nets: Vec<String>,
    pub enable: String,
    /// The value of `enable` for which the latch is open.
    pub open: bool,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TimedFlipFlop {
    /// The nets that keep the bit of its second latch.
    pub nets: Vec<String>,
    pub clock: String,
    /// Whether it takes its data when the clock rises.
    pub rising: bool,
}

/// A loop that a change is assumed to pass twice.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UnphasedLoop {
    pub nets: Vec<String>,
    pub why: String,
}

impl PhaseTiming {
    pub fn of<'k>(
        netlist: &Netlist,
        timing: &Timing,
        kind: impl Fn(NetId) -> &'k CellKind,
        kept: &[KeptLatch],
    ) -> Self {
        let name = |net: NetId| netlist.net_name(net);
        let storage = &timing.storage;
        let latch = |latch: &Latch| TimedLatch {
            nets: netlist.net_names(&latch.cells),
            enable: name(latch.root),
            open: latch.open,
        };
        let flip_flop = |pair: &FlipFlop| {
            let second = &storage.latches[pair.second];
            TimedFlipFlop { nets: netlist.net_names(&second.cells), clock: name(second.root), rising: pair.rising }
        };
        let unphased =
            |loops: &Unphased| UnphasedLoop { nets: netlist.net_names(&loops.nets), why: loops.why.explain(netlist) };
        Self {
            latches: storage.latches.iter().map(latch).collect(),
            flip_flops: storage.flip_flops.iter().map(flip_flop).collect(),
            clocks: ClockTimes::all(netlist, storage, timing.hold, kind),
            unphased: storage.unphased.iter().map(unphased).collect(),
            kept: kept.to_vec(),
        }
    }

    pub fn describe(&self) -> String {
        let clocks = self.clocks.iter().map(describe_clock);
        let unphased = self.unphased.iter().map(|UnphasedLoop { nets, why }| {
            format!("unphased {}: {why}; timed as a loop that a change passes twice\n", nets.join(" "))
        });
        let kept = self.kept.iter().map(|KeptLatch { net, why }| format!("kept     {net} stays as written: {why}\n"));
        clocks.chain(kept).chain(unphased).collect()
    }
}

fn describe_clock(times: &ClockTimes) -> String {
    let ClockTimes { clock, high, low, period, borrowed, inputs, paths, races, .. } = times;
    let period = counted(*period as usize, "cycle");
    let mut text = format!("clock    {clock}: high {high}, low {low}, period {period} at least");
    if *borrowed > 0 {
        text += &format!("; data arrive up to {} after a latch has opened", counted(*borrowed as usize, "cycle"));
    }
    text.push('\n');
    for InputTimes { input, rises, setup, hold } in inputs {
        let edge = if *rises { "rises" } else { "falls" };
        let setup = counted(*setup as usize, "cycle");
        text += &format!("input    {input}: stable {setup} before {clock} {edge}, {hold} after\n");
    }
    for ClockPath { ends, cycles, nets } in paths {
        text += &format!("path     {ends} {}: {}\n", counted(*cycles as usize, "cycle"), nets.join(" -> "));
    }
    for nets in races {
        text += &format!("race     {}: its data may change before {clock} has closed it\n", nets.join(" "));
    }
    text
}
