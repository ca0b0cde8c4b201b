//! A swarm that a page can run.

use serde::Serialize;

use nbc_base::model::Column;
use nbc_session::report::{SchematicPages, VoxelLook};
use nbc_swarm::StimulusSource;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct SwarmAnswer {
    pub(crate) swarm: Box<ShownSwarm>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct SettledOutputs {
    /// For each row of inputs; none of a swarm with a state.
    pub(crate) outputs: Option<Vec<String>>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ShownSwarm {
    /// Counts the swarms of a connection; frames have its lowest byte.
    pub(crate) number: u32,
    pub(crate) circuit: String,
    pub(crate) swarm: Option<String>,
    pub(crate) inputs: Vec<Column>,
    pub(crate) outputs: Vec<Column>,
    /// The source of each bit of the outputs.
    pub(crate) shown: Vec<StimulusSource>,
    pub(crate) robots: Vec<SwarmRobot>,
    /// The gates of the circuit as it is written.
    pub(crate) gates: usize,
    pub(crate) registers: Vec<ShownRegister>,
    pub(crate) listing: Option<ShownListing>,
    pub(crate) looks: Vec<VoxelLook>,
    pub(crate) schematic: SchematicPages,
    pub(crate) timing: String,
    /// Cycles after which every change has settled.
    pub(crate) hold: u32,
    pub(crate) clocks: Vec<ShownClock>,
    /// Cycles at the start in which the robots take their shape.
    pub(crate) start: usize,
    /// The ground's columns, which repeat: the rows from and up to which each is voxels; none if it is flat.
    pub(crate) ground: Vec<Vec<u8>>,
    /// Poses in a cycle.
    pub(crate) frames: u32,
    /// For each robot, the env steps by which its own cycles are ahead at the start and the millionths by which they
    /// are faster; none with a common clock.
    pub(crate) own_clocks: Vec<(u32, i32)>,
    pub(crate) waves: Option<ShownWaves>,
    pub(crate) script: Option<ShownScript>,
}

/// An input that opens and closes latches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ShownClock {
    /// The bit of the inputs.
    pub(crate) bit: usize,
    /// Cycles that are enough between two changes of it, for the registers and for the outputs.
    pub(crate) half: u32,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ShownScript {
    pub(crate) title: String,
    /// The cycles whose inputs it gives.
    pub(crate) cycles: usize,
    pub(crate) environment: Option<ShownEnvironment>,
}

/// What is on the other side of a circuit's ports while a test runs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ShownEnvironment {
    pub(crate) name: String,
    /// The text that it writes, each piece with the cycles before it; none if it never writes any.
    pub(crate) screen: Option<Vec<(usize, String)>>,
    pub(crate) memories: Vec<ShownMemory>,
}

/// A memory of an environment. Words are in hexadecimal.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ShownMemory {
    pub(crate) name: String,
    /// Bits of a word.
    pub(crate) width: usize,
    /// The number of words.
    pub(crate) size: usize,
    /// The words that it begins with, without the zeros at the end.
    pub(crate) words: Vec<String>,
    /// For each of its reads the addresses, each with the cycles before it.
    pub(crate) reads: Vec<Vec<(usize, usize)>>,
    /// The written words, each with the cycles before it and its address.
    pub(crate) writes: Vec<(usize, usize, String)>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ShownRegister {
    /// The name of its net, after those of the calls that it is in where another has the same.
    pub(crate) name: String,
    /// The robots that have its bits, the most significant first.
    pub(crate) robots: Vec<usize>,
}

/// A table over an output, such as the instructions of a machine or the transitions of its states.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ShownListing {
    pub(crate) port: String,
    pub(crate) rows: Vec<ListingRow>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ListingRow {
    /// The digits of the output for which it is, `-` for any; the first row that fits counts.
    pub(crate) bits: String,
    /// These digits, and what the table has for them, as in the source.
    pub(crate) at: String,
    pub(crate) text: String,
    pub(crate) line: usize,
}

/// A wave machine; docs/play-protocol.md says whose wave a robot carries in a cycle.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ShownWaves {
    /// Cycles of a step.
    pub(crate) step: usize,
    /// Cycles of a beat.
    pub(crate) beat: u32,
    /// Machines that run at once on the same robots.
    pub(crate) threads: u32,
    /// For each robot, the beat of a step in which it reads its stimuli.
    pub(crate) phases: Vec<i64>,
    /// The cycle in which the first step of the first thread begins, from 0.
    pub(crate) begins: i64,
    /// The bit of the inputs that is the clock, which no robot senses.
    pub(crate) clock: Option<usize>,
    pub(crate) registers: Vec<WaveRegister>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct WaveRegister {
    pub(crate) name: String,
    /// The most significant first.
    pub(crate) bits: Vec<WaveBit>,
}

/// Where and when a bit of such a register is seen.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct WaveBit {
    pub(crate) source: StimulusSource,
    /// The cycles from the beginning of the step after to the one at whose end the source has the bit.
    pub(crate) after: i64,
    /// The values after no step, after one, and so on, before the source has any.
    pub(crate) starts: Vec<bool>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct SwarmRobot {
    /// The name by which files and the schematic know its net.
    pub(crate) net: String,
    /// The name in the source, or for a net without one what drives it, such as `nand(d, e)`.
    pub(crate) label: String,
    /// Whether the source has a name for it.
    pub(crate) named: bool,
    pub(crate) function: &'static str,
    pub(crate) robot: String,
    /// Words with their texts.
    pub(crate) about: Vec<[String; 2]>,
    pub(crate) senses: Vec<StimulusSource>,
    /// The rows from the top.
    pub(crate) body: Vec<String>,
    /// Columns and rows.
    pub(crate) size: [usize; 2],
    /// The numbers of the corner points around each voxel, and its index in the looks.
    pub(crate) voxels: Vec<[usize; 5]>,
    pub(crate) points: usize,
    pub(crate) clock: u32,
    pub(crate) margin: f64,
    pub(crate) errors: f64,
}
