//! Wave machines: clocked circuits in which every gate is a register too (docs/waves.md).
//!
//! A robot of clock 1 shows in each cycle what its stimuli of the cycle before ask for. If every loop of a circuit is
//! as long as every other, in robots, its state travels round as a wave and needs no latch; and between two waves of
//! one machine there is room for those of others.

mod certify;
mod clock_run;
mod clock_step;
mod graph;
mod machine;
mod phases;
mod search;
mod timing;
mod wording;

pub use certify::certify;
pub use clock_run::{ClockRun, LANES};
pub use clock_step::{ClockStep, StateBit};
pub use machine::{Reading, WaveMachine, WaveOutput, WaveState};
pub use timing::{Chain, NetPhase, WaveTiming};
pub use wording::WaveError;

use crate::cells::CellLibrary;
use crate::network::Network;
use crate::options::{Effort, MapOptions, MappingObjective};
use crate::synth::reduce;
use crate::waves::graph::WaveLogic;
use crate::waves::search::{WaveCells, search};
use crate::{MapError, Netlist};

#[derive(Clone, Debug, Default)]
pub struct WaveOptions {
    /// Cycles of a step; the fewest if not set.
    pub cycles: Option<u32>,
    /// Cycles of a beat: every cell has a clock of at most so many cycles.
    pub beat: u32,
    pub mapping: MapOptions,
}

pub fn usable(library: &CellLibrary, beat: u32) -> CellLibrary {
    let is_usable = |kind: &crate::CellKind| kind.clock <= beat && (beat > 1 || !kind.glitches);
    let kinds = library.all();
    kinds.filter(|(_, kind)| is_usable(kind)).map(|(function, kind)| (function, kind.clone())).collect()
}

pub fn balance(source: &Netlist, library: &CellLibrary, options: &WaveOptions) -> Result<WaveMachine, WaveError> {
    let step = ClockStep::of(source)?;
    let beat = options.beat.max(1);
    let cells = usable(library, beat);
    let logic = WaveLogic::of(&step);
    if let Some(wanted) = options.cycles.filter(|cycles| !cycles.is_multiple_of(beat)) {
        return Err(WaveError::UnevenStep { wanted, beat });
    }
    let period = options.cycles.map(|cycles| cycles / beat);
    let short = |least: u32| WaveError::ShortStep { wanted: options.cycles.unwrap_or(0), least: least * beat };
    let starts = mappings(&logic.network, &cells, &options.mapping)?;
    let balanced = search(&logic, starts, &cells, period, &options.mapping).map_err(short)?;
    let blocks = logic.blocks(&step, &WaveCells::new(&cells).of(&balanced.network));
    WaveMachine::new(&step, &balanced.graph, &blocks, &balanced.phases, &cells, beat).ok_or(WaveError::NoBuffer)
}

const MANY_GATES: usize = 4_000;

/// Wide logic is mapped with few cells only and little effort: its buffers take most of the time and of the robots.
fn mappings(logic: &Network, cells: &CellLibrary, options: &MapOptions) -> Result<Vec<Network>, WaveError> {
    let stages = vec![0; logic.inputs];
    let map = |objective, effort| {
        let options = MapOptions { objective, effort, ..options.clone() };
        reduce(logic, &stages, cells, &options).map_err(|missing| {
            let known = cells.functions().collect();
            WaveError::Unmapped(MapError::Incomplete { missing, known, completions: cells.completions() })
        })
    };
    if logic.gates.len() > MANY_GATES {
        return Ok(vec![map(MappingObjective::Area, Effort::Fast)?]);
    }
    [MappingObjective::Area, MappingObjective::Delay].into_iter().map(|goal| map(goal, options.effort)).collect()
}

#[cfg(test)]
mod tests;
