//! The timing of a circuit by the phases of its clocks: registers, the times of each clock and input, the slowest
//! paths, and what is not timed by phases.

use serde::Serialize;

use nbc_base::diag::counted;
use nbc_circuit::timing::{ClockPath, ClockTimes, InputTimes, PathEnds, WhyKept};
use nbc_circuit::{CellKind, FlipFlop, Latch, NetId, Netlist, Timing, Unphased};

/// The registers and clocks of a circuit.
#[derive(Clone, Debug, Serialize)]
pub struct PhaseTiming {
    /// The latches.
    pub latches: Vec<LatchReport>,
    /// The flip-flops, each of two of these latches.
    pub flip_flops: Vec<FlipFlopReport>,
    /// The times of each clock.
    pub clocks: Vec<ClockReport>,
    /// The memory and loops that a change is assumed to pass twice.
    pub unphased: Vec<UnphasedReport>,
    /// The registers that stay as they are, although latches of another form were asked for.
    pub kept: Vec<KeptReport>,
}

/// A register that stays as it is.
#[derive(Clone, Debug, Serialize)]
pub struct KeptReport {
    /// Its net.
    pub net: String,
    /// The reason.
    pub why: &'static str,
}

/// A latch.
#[derive(Clone, Debug, Serialize)]
pub struct LatchReport {
    /// The nets that keep the bit.
    pub nets: Vec<String>,
    /// The net that opens and closes it.
    pub enable: String,
    /// The value of that net for which the latch is open.
    pub open: bool,
}

/// A flip-flop.
#[derive(Clone, Debug, Serialize)]
pub struct FlipFlopReport {
    /// The nets that keep the bit of its second latch.
    pub nets: Vec<String>,
    /// Its clock.
    pub clock: String,
    /// Whether it takes its data when the clock rises.
    pub rising: bool,
}

/// The times of a clock, in cycles.
#[derive(Clone, Debug, Serialize)]
pub struct ClockReport {
    /// The clock.
    pub clock: String,
    /// The least time high.
    pub high: u32,
    /// The least time low.
    pub low: u32,
    /// The least time from one rise to the next.
    pub period: u32,
    /// The least time high and low, if both are the same.
    #[serde(skip)]
    pub half: u32,
    /// The longest time for which data arrive at a latch after it has opened.
    pub borrowed: u32,
    /// The times of the other inputs.
    pub inputs: Vec<InputReport>,
    /// The slowest path of each kind.
    pub paths: Vec<PathReport>,
    /// The latches whose data may change before they are closed.
    pub races: Vec<Vec<String>>,
}

/// The time for which an input must be stable around an edge of a clock, in cycles.
#[derive(Clone, Debug, Serialize)]
pub struct InputReport {
    /// The input.
    pub input: String,
    /// Whether it is the edge at which the clock rises.
    pub rises: bool,
    /// Cycles before the edge.
    pub setup: u32,
    /// Cycles after the edge.
    pub hold: u32,
}

/// A slowest path.
#[derive(Clone, Debug, Serialize)]
pub struct PathReport {
    /// Its ends, such as `register to register`.
    pub ends: &'static str,
    /// Its cycles.
    pub cycles: u32,
    /// Its nets, from an input on.
    pub nets: Vec<String>,
}

/// A loop that a change is assumed to pass twice.
#[derive(Clone, Debug, Serialize)]
pub struct UnphasedReport {
    /// Its nets.
    pub nets: Vec<String>,
    /// The reason.
    pub why: String,
}

impl PhaseTiming {
    /// The registers and clocks of a timed netlist whose cells are of these kinds; `kept` is memory that has not become
    /// latches of one robot.
    pub fn of<'k>(
        netlist: &Netlist,
        timing: &Timing,
        kind: impl Fn(NetId) -> &'k CellKind,
        kept: &[(NetId, WhyKept)],
    ) -> Self {
        let named = Named(netlist);
        let storage = &timing.storage;
        let clocks = ClockTimes::all(netlist, storage, timing.hold, kind);
        Self {
            latches: storage.latches.iter().map(|latch| named.latch(latch)).collect(),
            flip_flops: storage.flip_flops.iter().map(|pair| named.flip_flop(&storage.latches, pair)).collect(),
            clocks: clocks.iter().map(|times| named.clock(times)).collect(),
            unphased: storage.unphased.iter().map(|unphased| named.unphased(unphased)).collect(),
            kept: kept.iter().map(|&kept| named.kept(kept)).collect(),
        }
    }

    /// The times as lines for people.
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

/// A netlist whose nets are named.
struct Named<'a>(&'a Netlist);

impl Named<'_> {
    fn name(&self, net: NetId) -> String {
        self.0.net_name(net)
    }

    fn names(&self, nets: &[NetId]) -> Vec<String> {
        nets.iter().map(|&net| self.name(net)).collect()
    }

    fn latch(&self, latch: &Latch) -> LatchReport {
        LatchReport { nets: self.names(&latch.cells), enable: self.name(latch.root), open: latch.open }
    }

    fn flip_flop(&self, latches: &[Latch], pair: &FlipFlop) -> FlipFlopReport {
        let second = &latches[pair.second];
        FlipFlopReport { nets: self.names(&second.cells), clock: self.name(second.root), rising: pair.rising }
    }

    fn clock(&self, times: &ClockTimes) -> ClockReport {
        let &ClockTimes { clock, high, low, period, half, borrowed, .. } = times;
        let input = |&InputTimes { input, rises, setup, hold }: &InputTimes| InputReport {
            input: self.name(input),
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
            nets: self.names(&path.nets),
        };
        ClockReport {
            clock: self.name(clock),
            high,
            low,
            period,
            half,
            borrowed,
            inputs: times.inputs.iter().map(input).collect(),
            paths: times.paths.iter().map(path).collect(),
            races: times.races.iter().map(|nets| self.names(nets)).collect(),
        }
    }

    fn kept(&self, (net, why): (NetId, WhyKept)) -> KeptReport {
        KeptReport { net: self.name(net), why: why.explain() }
    }

    fn unphased(&self, unphased: &Unphased) -> UnphasedReport {
        UnphasedReport { nets: self.names(&unphased.nets), why: unphased.why.explain(self.0) }
    }
}
