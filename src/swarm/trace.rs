//! What a swarm did: every robot's path, and every net's bit in every cycle.

use serde::Serialize;

use crate::model::{Fault, Function};
use crate::swarm::Signal;

/// A swarm's run from its start to the end of its stimulation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SwarmTrace {
    /// The circuit's name.
    pub circuit: String,
    /// The names of the input ports.
    pub inputs: Vec<String>,
    /// The names of the output ports.
    pub outputs: Vec<String>,
    /// What each output port shows.
    pub shown: Vec<Signal>,
    /// Samples of the robots' paths in one cycle.
    pub samples_per_cycle: usize,
    /// The robots, in order of the assembly's members.
    pub robots: Vec<RobotTrace>,
    /// The cycles, first to last.
    pub cycles: Vec<CycleTrace>,
}

/// One robot's part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RobotTrace {
    /// The net whose bit it is.
    pub net: String,
    /// The gate it plays, of `senses[0]` and `senses[1]`.
    #[serde(serialize_with = "as_text")]
    pub function: Function,
    /// The robot's name in its library.
    pub robot: String,
    /// What it senses as stimulus 1 and stimulus 2.
    pub senses: [Signal; 2],
    /// The names of the nets it senses, likewise.
    pub sensed_nets: [String; 2],
    /// Horizontal place of the center of mass in voxels: the start, then `samples_per_cycle` samples a cycle.
    pub com_x: Vec<f64>,
    /// What stopped it, if anything did; from then on it stands still.
    pub fault: Option<Fault>,
}

/// The bits of one cycle.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CycleTrace {
    /// The input ports during the cycle.
    pub inputs: Vec<bool>,
    /// What each robot sensed during the cycle, stimulus 1 first.
    pub sensed: Vec<[bool; 2]>,
    /// Each robot's output at the cycle's end.
    pub bits: Vec<bool>,
    /// The output ports at the cycle's end.
    pub outputs: Vec<bool>,
}

fn as_text<S: serde::Serializer>(value: &impl std::fmt::Display, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(value)
}
