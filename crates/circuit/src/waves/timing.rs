//! The timing of a wave machine: its step, its threads, and the phase of each net.

use serde::Serialize;

use crate::NetId;
use crate::waves::WaveMachine;
use nbc_base::diag::counted;
use nbc_base::model::CYCLE_SECONDS;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WaveTiming {
    /// Cycles of a step.
    pub step: usize,
    /// Cycles of a beat, for which robots sense the same.
    pub beat: u32,
    /// The number of threads: machines that run at once on the same robots.
    pub threads: u32,
    pub robots: usize,
    /// Robots that only delay a net.
    pub buffers: usize,
    pub has_fewest_buffers: bool,
    /// The steps that each thread makes in a second of the robots' time.
    pub steps_per_second: f64,
    /// The input ports that are read, each with the beat of a step in which it is applied.
    pub inputs: Vec<NetPhase>,
    /// The robots in order, each with the beat of a step in which it reads its stimuli.
    pub phases: Vec<NetPhase>,
    /// The output ports, each with the beat of a step at whose end it is read.
    pub outputs: Vec<NetPhase>,
    /// The longest chains of robots that only delay a net, longest first.
    pub chains: Vec<Chain>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NetPhase {
    pub net: String,
    pub phase: i64,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Chain {
    pub net: String,
    pub robots: usize,
}

impl WaveTiming {
    pub fn of(machine: &WaveMachine) -> Self {
        let netlist = &machine.netlist;
        let net = |id: NetId, phase: i64| NetPhase { net: netlist.net_name(id), phase };
        let applied = netlist.inputs().iter().zip(&machine.inputs);
        let mut chains: Vec<Chain> = machine
            .chains()
            .into_iter()
            .map(|(driver, robots)| Chain { net: netlist.net_name(driver), robots })
            .collect();
        chains.sort_by_key(|chain| std::cmp::Reverse(chain.robots));
        Self {
            step: machine.cycles_per_step(),
            beat: machine.beat,
            threads: machine.period,
            robots: machine.cells(),
            buffers: machine.buffers,
            has_fewest_buffers: machine.has_fewest_buffers,
            steps_per_second: 1.0 / (machine.cycles_per_step() as f64 * CYCLE_SECONDS),
            inputs: applied.filter_map(|(&id, phase)| Some(net(id, (*phase)?))).collect(),
            phases: netlist.cells().map(|(id, _)| net(id, machine.phase[&id])).collect(),
            outputs: netlist.outputs().iter().zip(&machine.outputs).map(|(&id, out)| net(id, out.phase)).collect(),
            chains,
        }
    }

    pub fn describe_step(&self) -> String {
        format!(
            "step     {}, {} at once, {:.2} steps a second each\n",
            counted(self.step, "cycle"),
            counted(self.threads as usize, "thread"),
            self.steps_per_second
        )
    }

    pub fn describe(&self) -> String {
        let mut text = self.describe_step();
        if self.beat > 1 {
            text += &format!("beat     {}: robots sense the same for so long\n", counted(self.beat as usize, "cycle"));
        }
        let fewest = if self.has_fewest_buffers { "as few as these gates allow" } else { "maybe more than needed" };
        text += &format!("robots   {}, of which {} only delay, {fewest}\n", self.robots, self.buffers);
        let list = |nets: &[NetPhase]| first_of(nets.iter().map(|net| format!("{} {}", net.net, net.phase)));
        for (word, nets) in [("inputs ", &self.inputs), ("phases ", &self.phases), ("outputs", &self.outputs)] {
            if !nets.is_empty() {
                text += &format!("{word}  {}\n", list(nets));
            }
        }
        if !self.chains.is_empty() {
            let chains = self.chains.iter().map(|chain| format!("{} {}", chain.net, chain.robots));
            text += &format!("chains   {}\n", first_of(chains));
        }
        text
    }
}

fn first_of(words: impl ExactSizeIterator<Item = String>) -> String {
    const MOST: usize = 24;
    let more = words.len().saturating_sub(MOST);
    let shown = words.take(MOST).collect::<Vec<_>>().join(", ");
    if more > 0 { format!("{shown} and {more} more, which `--format json` lists") } else { shown }
}
