//! A circuit as cells of a library.

use nbc_circuit::timing::{Delays, Held, KeptLatch};
use nbc_circuit::waves::WaveMachine;
use nbc_circuit::{CellLibrary, Netlist, Proof, Timing, prove_forms};

#[derive(Clone, Debug)]
pub struct Mapping {
    pub source: Netlist,
    pub netlist: Netlist,
    pub cells: CellLibrary,
    /// Proves that both netlists are equal, before registers change their form, which has a proof of its own. For a
    /// wave machine, proves its steps.
    pub proof: Proof,
    /// The memory elements that should have become latches of one robot and have not.
    pub kept: Vec<KeptLatch>,
    /// No proof was found that registers of another form store the same, because latches are not recognized.
    pub unproved_registers: bool,
    pub waves: Option<WaveMachine>,
}

impl Mapping {
    /// `None` if the library has no robot for latches of one robot. Panics if they store something else, which is a
    /// fault of the compiler.
    pub(super) fn held(self) -> Option<Self> {
        let Held { netlist, kept, .. } = Held::of(&self.netlist, &self.cells)?;
        let proof = prove_forms(&self.netlist, &netlist);
        if let Some(Err(error)) = &proof {
            panic!("the registers of `{}` differ from those of its source: {error}", self.source.name);
        }
        Some(Self { netlist, kept, unproved_registers: proof.is_none(), ..self })
    }

    /// The hold of a wave machine is the length of a step.
    pub fn timing(&self) -> Timing {
        match &self.waves {
            None => Timing::of(&self.netlist, &self.cells, Delays::Clock),
            Some(machine) => Timing::of_steps(machine.cycles_per_step() as u32),
        }
    }
}
