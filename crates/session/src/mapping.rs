//! A circuit as cells of a library.

use nbc_circuit::timing::{Delays, Held, Pulsed, PulsedRegisters};
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
    /// Set if they are pulsed latches or latches of one robot.
    pub registers: Option<PulsedRegisters>,
    /// No proof was found that registers of another form store the same, because latches are not recognized.
    pub unproved_registers: bool,
    pub waves: Option<WaveMachine>,
}

impl Mapping {
    pub(super) fn pulsed(self) -> Self {
        let Pulsed { netlist, registers } = Pulsed::of(&self.netlist, &self.cells);
        self.with(netlist, registers)
    }

    /// `None` if the library has no robot for them.
    pub(super) fn held(self) -> Option<Self> {
        let Held { netlist, kept, .. } = Held::of(&self.netlist, &self.cells)?;
        Some(self.with(netlist, PulsedRegisters { pulses: Vec::new(), kept }))
    }

    /// Panics if the registers store something else, which is a fault of the compiler.
    fn with(self, netlist: Netlist, registers: PulsedRegisters) -> Self {
        let proof = prove_forms(&self.netlist, &netlist, &registers.pulses);
        if let Some(Err(error)) = &proof {
            panic!("the registers of `{}` differ from those of its source: {error}", self.source.name);
        }
        Self { netlist, registers: Some(registers), unproved_registers: proof.is_none(), ..self }
    }

    /// The hold of a wave machine is the length of a step.
    pub fn timing(&self) -> Timing {
        match &self.waves {
            None => Timing::of(&self.netlist, &self.cells, Delays::Clock),
            Some(machine) => Timing::of_steps(machine.cycles_per_step() as u32),
        }
    }
}
