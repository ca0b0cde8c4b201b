//! Cells of three inputs: a network of gates of two is covered by cells of two and three. Cuts of at most three signals
//! give each gate the functions that a cell could compute for it, as in mappers for lookup tables (Cong & Ding, 1994;
//! Mishchenko et al., "Improvements to technology mapping for LUT-based FPGAs", 2007).

mod cover;
mod cuts;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::cells::{CellKind, CellLibrary};
use crate::network::{Gate, Network, Signal};
use crate::options::{Effort, MapOptions, MappingObjective};
use crate::synth::candidates::below;
use crate::synth::prices::{Prices, complete};
use crate::synth::reduce::{alternative, cover, reduce};
use nbc_base::model::Function;

pub use cover::Coverer;

/// The most gates of a network that is covered in more than two ways.
const MOST_GATES: usize = 3_000;
/// Cells more than the fewest so far with which the search returns to those.
const MOST_LOSS: u32 = 2;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NetworkCell {
    pub function: Function,
    pub pins: Vec<Signal>,
}

/// Cells in topological order, between numbered inputs and outputs, with signals as in a [`Network`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CellNetwork {
    pub inputs: usize,
    pub cells: Vec<NetworkCell>,
    pub outputs: Vec<Signal>,
}

impl CellNetwork {
    /// A function of the first input alone has one pin.
    pub fn of(network: &Network) -> Self {
        let cell = |gate: &Gate| {
            let used = if gate.function.depends_on(1) { 2 } else { 1 };
            NetworkCell { function: gate.function, pins: gate.pins[..used].to_vec() }
        };
        Self {
            inputs: network.inputs,
            cells: network.gates.iter().map(cell).collect(),
            outputs: network.outputs.clone(),
        }
    }

    pub fn add(&mut self, function: Function, pins: Vec<Signal>) -> Signal {
        let signal = (2 + self.inputs + self.cells.len()) as Signal;
        assert!(pins.iter().all(|&pin| pin < signal), "a cell listens to earlier signals");
        self.cells.push(NetworkCell { function, pins });
        signal
    }
}

/// `reduced` is the network in cells of two inputs, and the result if the library has no others.
pub fn widen(
    network: &Network,
    reduced: &Network,
    stages: &[u32],
    library: &CellLibrary,
    options: &MapOptions,
) -> CellNetwork {
    if !library.is_wide() {
        return CellNetwork::of(reduced);
    }
    let coverer = Coverer::new(library, options.objective);
    let weight = |covered: &CellNetwork| coverer.weight(covered);
    let mut best = coverer.cover(reduced);
    // Cells of three inputs compute gates with inverted pins too, so the fewest gates of any kind are a good start.
    let gates = any_gate();
    let few = reduce(network, stages, &gates, &MapOptions { objective: MappingObjective::Area, ..options.clone() });
    let mut now = few.unwrap_or_else(|_| reduced.clone());
    let other = coverer.cover(&now);
    if weight(&other) <= weight(&best) {
        best = other;
    } else {
        now = reduced.clone();
    }
    let prices = Prices::of(&gates);
    // A circuit that was written in functions of three inputs still has them as cuts. A reduction takes some apart.
    if let Ok(given) = cover(network, &prices, stages) {
        let other = coverer.cover(&given);
        if weight(&other) < weight(&best) {
            (best, now) = (other, given);
        }
    }
    let size = now.gates.len();
    let rounds = match options.effort {
        _ if size > MOST_GATES || size == 0 => 0,
        Effort::Fast => 0,
        Effort::Normal => (60 * size).min(200_000 / (size + 40)),
    };
    let mut random = ChaCha8Rng::seed_from_u64(0x6e62_6377_6964_6572);
    let (mut start, mut level) = (now.clone(), weight(&best));
    let combinational = stages.iter().all(|&stage| stage == 0);
    for round in 0..rounds {
        if options.cancel.is_raised() || !combinational {
            break;
        }
        let next = alternative(&now, &prices, 1 + below(&mut random, 6) as u64, &mut random);
        let covered = coverer.cover(&next);
        let found = weight(&covered);
        let slack = if below(&mut random, 6) == 0 { (2 * (rounds - round) / rounds) as u32 } else { 0 };
        if found <= (level.0 + slack, level.1) {
            (now, level) = (next, found);
        }
        if found <= weight(&best) {
            (best, start) = (covered, now.clone());
        }
        if level.0 > weight(&best).0 + MOST_LOSS {
            (now, level) = (start.clone(), weight(&best));
        }
    }
    best
}

fn any_gate() -> CellLibrary {
    let kind =
        |function: Function| CellKind { cost: u32::from(function != Function::NOT), ..CellKind::uniform(1, 1.0) };
    complete().map(|function| (function, kind(function))).collect()
}
