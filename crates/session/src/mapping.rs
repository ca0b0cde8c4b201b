//! A circuit as cells of a library.

use nbc_circuit::timing::{Delays, Held, WhyKept};
use nbc_circuit::waves::WaveMachine;
use nbc_circuit::{CellLibrary, NetId, Netlist, Proof, Timing, prove_forms};

/// A circuit made of cells, and proved.
#[derive(Clone, Debug)]
pub struct Mapping {
    /// The netlist as written.
    pub source: Netlist,
    /// The netlist of cells.
    pub netlist: Netlist,
    /// The available cells.
    pub cells: CellLibrary,
    /// How the two netlists were proved equal, before registers became latches of another form, which has a proof of
    /// its own; or the steps of a wave machine.
    pub proof: Proof,
    /// A net of each memory element that should have become a latch of one robot and has not.
    pub kept: Vec<(NetId, WhyKept)>,
    /// Whether no proof was found that registers of another form store the same, because latches are not recognized.
    pub unproved_registers: bool,
    /// The wave machine, if the circuit was to be one.
    pub waves: Option<WaveMachine>,
}

impl Mapping {
    /// The same circuit with latches of one robot; none if the library has no robot for them.
    ///
    /// # Panics
    /// When they store something else, which is a fault of the compiler.
    pub(super) fn held(self) -> Option<Self> {
        let Held { netlist, kept, .. } = Held::of(&self.netlist, &self.cells)?;
        let proof = prove_forms(&self.netlist, &netlist);
        if let Some(Err(error)) = &proof {
            panic!("the registers of `{}` differ from those of its source: {error}", self.source.name);
        }
        Some(Self { netlist, kept, unproved_registers: proof.is_none(), ..self })
    }

    /// When each net has settled; the hold of a wave machine is the length of a step.
    pub fn timing(&self) -> Timing {
        match &self.waves {
            None => Timing::of(&self.netlist, &self.cells, Delays::Clock),
            Some(machine) => Timing::of_steps(machine.cycles_per_step() as u32),
        }
    }
}
