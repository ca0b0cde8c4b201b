//! The timing of a circuit by the phases of its clocks: registers, the times of each clock and input, the slowest
//! paths, and what is not timed by phases.

use serde::Serialize;

use nbc_base::diag::counted;
use nbc_circuit::timing::{ClockPath, ClockTimes, InputTimes, PathEnds, WhyKept};
use nbc_circuit::{CellKind, FlipFlop, Latch, NetId, Netlist, Timing, Unphased};

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PhaseTiming {
    pub latches: Vec<LatchReport>,
    pub flip_flops: Vec<FlipFlopReport>,
    /// The inputs that open and close latches.
    pub clocks: Vec<ClockReport>,
    pub unphased: Vec<UnphasedReport>,
    /// Memory that did not become latches of one robot, although these were requested.
    pub kept: Vec<KeptReport>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct KeptReport {
    pub net: String,
    pub why: &'static str,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LatchReport {
    pub nets: Vec<String>,
    pub enable: String,
    /// The value of `enable` for which the latch is open.
    pub open: bool,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FlipFlopReport {
    /// The nets that keep the bit of its second latch.
    pub nets: Vec<String>,
    pub clock: String,
    /// Whether it takes its data when the clock rises.
    pub rising: bool,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClockReport {
    pub clock: String,
    /// The fewest cycles for which it must be high.
    pub high: u32,
    /// The fewest cycles for which it must be low.
    pub low: u32,
    /// The fewest cycles from one rise to the next.
    pub period: u32,
    /// The least time high and low, if both are the same.
    #[serde(skip)]
    pub half: u32,
    /// The longest time after opening at which data still arrive at a latch.
    pub borrowed: u32,
    pub inputs: Vec<InputReport>,
    /// The slowest path of each kind.
    pub paths: Vec<PathReport>,
    /// The latches whose data may change before they are closed.
    pub races: Vec<Vec<String>>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct InputReport {
    pub input: String,
    /// Whether the edge is the one at which the clock rises.
    pub rises: bool,
    /// Cycles for which the input must be stable before the edge.
    pub setup: u32,
    /// Cycles for which it must be stable after the edge.
    pub hold: u32,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PathReport {
    pub ends: &'static str,
    pub cycles: u32,
    pub nets: Vec<String>,
}

/// A loop that a change is assumed to pass twice.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UnphasedReport {
    pub nets: Vec<String>,
    pub why: String,
}

impl PhaseTiming {
    pub fn of<'k>(
        netlist: &Netlist,
        timing: &Timing,
        kind: impl Fn(NetId) -> &'k CellKind,
        kept: &[(NetId, WhyKept)],
    ) -> Self {
        let name = |net: NetId| netlist.net_name(net);
        let storage = &timing.storage;
        let latch = |latch: &Latch| LatchReport {
            nets: names(netlist, &latch.cells),
            enable: name(latch.root),
            open: latch.open,
        };
        let flip_flop = |pair: &FlipFlop| {
            let second = &storage.latches[pair.second];
            FlipFlopReport { nets: names(netlist, &second.cells), clock: name(second.root), rising: pair.rising }
        };
        let unphased =
            |loops: &Unphased| UnphasedReport { nets: names(netlist, &loops.nets), why: loops.why.explain(netlist) };
        let kept_report = |&(net, why): &(NetId, WhyKept)| KeptReport { net: name(net), why: why.explain() };
        let clocks = ClockTimes::all(netlist, storage, timing.hold, kind);
        Self {
            latches: storage.latches.iter().map(latch).collect(),
            flip_flops: storage.flip_flops.iter().map(flip_flop).collect(),
            clocks: clocks.iter().map(|times| ClockReport::of(netlist, times)).collect(),
            unphased: storage.unphased.iter().map(unphased).collect(),
            kept: kept.iter().map(kept_report).collect(),
        }
    }

    pub fn describe(&self) -> String {
        let clocks = self.clocks.iter().map(ClockReport::describe);
        let unphased = self.unphased.iter().map(|UnphasedReport { nets, why }| {
            format!("unphased {}: {why}; timed as a loop that a change passes twice\n", nets.join(" "))
        });
        let kept = self.kept.iter().map(|KeptReport { net, why }| format!("kept     {net} stays as written: {why}\n"));
        clocks.chain(kept).chain(unphased).collect()
    }
}

impl ClockReport {
    fn of(netlist: &Netlist, times: &ClockTimes) -> Self {
        let name = |net: NetId| netlist.net_name(net);
        let &ClockTimes { clock, high, low, period, half, borrowed, .. } = times;
        let input = |&InputTimes { input, rises, setup, hold }: &InputTimes| InputReport {
            input: name(input),
            rises,
            setup,
            hold,
        };
        let path = |path: &ClockPath| PathReport {
            ends: match path.ends {
                PathEnds::InputToRegister => "input to register",
                PathEnds::RegisterToRegister => "register to register",
                PathEnds::RegisterToOutput => "register to output",
            },
            cycles: path.cycles,
            nets: names(netlist, &path.nets),
        };
        Self {
            clock: name(clock),
            high,
            low,
            period,
            half,
            borrowed,
            inputs: times.inputs.iter().map(input).collect(),
            paths: times.paths.iter().map(path).collect(),
            races: times.races.iter().map(|nets| names(netlist, nets)).collect(),
        }
    }

    fn describe(&self) -> String {
        let Self { clock, high, low, period, borrowed, inputs, paths, races, .. } = self;
        let period = counted(*period as usize, "cycle");
        let mut text = format!("clock    {clock}: high {high}, low {low}, period {period} at least");
        if *borrowed > 0 {
            text += &format!("; data arrive up to {} after a latch has opened", counted(*borrowed as usize, "cycle"));
        }
        text.push('\n');
        for InputReport { input, rises, setup, hold } in inputs {
            let edge = if *rises { "rises" } else { "falls" };
            let setup = counted(*setup as usize, "cycle");
            text += &format!("input    {input}: stable {setup} before {clock} {edge}, {hold} after\n");
        }
        for PathReport { ends, cycles, nets } in paths {
            text += &format!("path     {ends} {}: {}\n", counted(*cycles as usize, "cycle"), nets.join(" -> "));
        }
        for nets in races {
            text += &format!("race     {}: its data may change before {clock} has closed it\n", nets.join(" "));
        }
        text
    }
}

fn names(netlist: &Netlist, nets: &[NetId]) -> Vec<String> {
    nets.iter().map(|&net| netlist.net_name(net)).collect()
}
