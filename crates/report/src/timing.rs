//! The timing of a swarm: arrival, required and slack, the slowest path, memory and fan-out, as text and as data.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::WaveTiming;
use crate::phases::PhaseTiming;
use nbc_base::diag::counted;
use nbc_circuit::timing::fan_out;
use nbc_circuit::waves::WaveMachine;
use nbc_circuit::{Memory, NetId, Netlist, Timing, rings};
use nbc_swarm::{Assembly, Member};

/// The static timing of a swarm, in cycles after its inputs switched.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SwarmTiming {
    /// Cycles after which every net is correct.
    pub hold: u32,
    /// The slowest path, input first. It passes a loop twice, by the change and by the response to it.
    pub critical_path: Vec<PathStep>,
    /// The nets of rings of inverters, which keep changing.
    pub rings: Vec<String>,
    pub robots: Vec<RobotTiming>,
    pub memory: Vec<Memory>,
    pub phases: PhaseTiming,
    /// The steps and phases of a wave machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub waves: Option<WaveTiming>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PathStep {
    pub net: String,
    /// The robot that drives it; none for an input.
    pub robot: Option<String>,
    pub cycles: u32,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobotTiming {
    pub net: String,
    pub robot: String,
    pub clock: u32,
    pub arrival: u32,
    /// Cycles after which it must be correct so that the hold suffices.
    pub required: u32,
    pub slack: u32,
    /// The number of stimuli and output ports that it drives.
    pub fan_out: usize,
}

impl SwarmTiming {
    pub fn of(mapped: &Netlist, timing: &Timing, assembly: &Assembly, phases: PhaseTiming) -> Self {
        let players: BTreeMap<NetId, &Member> = mapped.cells().map(|(id, _)| id).zip(&assembly.members).collect();
        let clock = |id: NetId| players.get(&id).map_or(0, |member| member.robot.character.clock);
        let listeners: BTreeMap<NetId, usize> = fan_out(mapped).into_iter().collect();
        let step = |&id: &NetId| PathStep {
            net: mapped.net_name(id),
            robot: players.get(&id).map(|member| member.robot.name.clone()),
            cycles: clock(id),
        };
        let robot = |(&id, member): (&NetId, &&Member)| RobotTiming {
            net: member.net.clone(),
            robot: member.robot.name.clone(),
            clock: clock(id),
            arrival: timing.arrival(id),
            required: timing.required(id),
            slack: timing.slack(id),
            fan_out: listeners[&id],
        };
        Self {
            hold: timing.hold,
            critical_path: timing.critical_path.iter().map(step).collect(),
            rings: mapped.net_names(&rings(mapped)),
            robots: players.iter().map(robot).collect(),
            memory: Memory::all(mapped, timing, clock),
            phases,
            waves: None,
        }
    }

    /// The timing of a wave machine, whose rings are waves and never need to settle.
    pub fn with_waves(self, machine: &WaveMachine) -> Self {
        Self { rings: Vec::new(), waves: Some(WaveTiming::of(machine)), ..self }
    }

    /// What a user of the swarm needs to know, in a line; `hold` suffices for the rows that were run.
    pub fn describe_hold(&self, hold: Option<usize>) -> String {
        if let Some(waves) = &self.waves {
            return waves.describe_step();
        }
        if !self.rings.is_empty() {
            return describe_rings(&self.rings);
        }
        let cycles = counted(hold.unwrap_or(self.hold as usize), "cycle");
        format!("timing   hold each row for {cycles} or longer; `nbc build --emit timing` shows why\n")
    }

    pub fn describe(&self) -> String {
        let step = |step: &PathStep| match &step.robot {
            Some(robot) => format!("{} ({robot}, {})", step.net, counted(step.cycles as usize, "cycle")),
            None => step.net.clone(),
        };
        let path: Vec<String> = self.critical_path.iter().map(step).collect();
        let mut text = match &self.waves {
            Some(waves) => waves.describe(),
            None => describe_settling(self.hold, &path, &self.rings),
        };
        text += &self.phases.describe();
        text += &describe_memory(&self.memory);
        text + &describe_fan_out(self.robots.iter().map(|robot| (robot.net.clone(), robot.fan_out)))
    }
}

pub fn describe_memory(memory: &[Memory]) -> String {
    let line = |Memory { nets, pulse, setup, hold }: &Memory| {
        let hold = counted(*hold as usize, "cycle");
        format!("memory   {}: pulse {pulse}, set-up {setup}, hold {hold}\n", nets.join(" "))
    };
    memory.iter().map(line).collect()
}

/// The hold and the slowest path, input first, as a line for people; for a netlist with rings, which never settles,
/// their nets.
pub fn describe_settling(hold: u32, path: &[String], rings: &[String]) -> String {
    match rings {
        [] => format!("timing   settles within {}: {}\n", counted(hold as usize, "cycle"), describe_path(path)),
        _ => describe_rings(rings),
    }
}

fn describe_rings(rings: &[String]) -> String {
    format!("timing   never settles, because these inverters form a ring: {}\n", rings.join(" "))
}

/// The nets of a path, each once.
pub fn describe_path(path: &[String]) -> String {
    let mut shown: Vec<&str> = Vec::new();
    let mut again: Option<&str> = None;
    for net in path {
        if shown.contains(&net.as_str()) {
            again = again.or(Some(net));
        } else {
            shown.push(net);
        }
    }
    let again = again.map_or(String::new(), |net| format!(", and once more round the loop from {net}"));
    shown.join(" -> ") + &again
}

pub fn describe_fan_out(nets: impl Iterator<Item = (String, usize)>) -> String {
    let busiest = nets.max_by_key(|(net, fan_out)| (*fan_out, std::cmp::Reverse(net.clone())));
    busiest.map_or(String::new(), |(net, fan_out)| format!("fan-out  {fan_out} at most, of {net}\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_names_each_net_once() {
        let path = |nets: &str| describe_path(&nets.split(' ').map(str::to_owned).collect::<Vec<_>>());
        assert_eq!(path("a b q"), "a -> b -> q");
        assert_eq!(path("d n q nq q nq"), "d -> n -> q -> nq, and once more round the loop from q");
    }
}
