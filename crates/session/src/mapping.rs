//! A circuit as cells of a library.

use nbc_circuit::waves::WaveMachine;
use nbc_circuit::{CellLibrary, KeptLatch, Netlist, Proof, Timing};

#[derive(Clone, Debug)]
pub struct Mapping {
    pub source: Netlist,
    pub netlist: Netlist,
    pub cells: CellLibrary,
    /// Proves that both netlists are equal, before registers become cells, which is proved for each kind of register
    /// once. For a wave machine, proves its steps.
    pub proof: Proof,
    /// The state that should have become latches of one robot and has not.
    pub kept: Vec<KeptLatch>,
    pub waves: Option<WaveMachine>,
}

impl Mapping {
    /// The hold of a wave machine is the length of a step.
    pub fn timing(&self) -> Timing {
        match &self.waves {
            None => Timing::of(&self.netlist, &self.cells),
            Some(machine) => Timing::of_steps(machine.cycles_per_step() as u32),
        }
    }
}
