//! The course of a synthesis: which searches run, in which order, for which effort.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::circuit::cells::CellLibrary;
use crate::circuit::map::MapOptions;
use crate::circuit::network::{Network, Signal};
use crate::circuit::synth::graph::Graph;
use crate::circuit::synth::prices::Prices;
use crate::circuit::synth::walk::{self, Plan};
use crate::circuit::synth::window::{self, Panes};
use crate::model::Function;

/// How much work to put into the search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Effort {
    /// Little: for quick looks.
    Fast,
    /// Well under a second for most circuits.
    #[default]
    Normal,
    /// As good as it gets in minutes.
    High,
}

/// The most inputs of a network that is searched as a whole.
const WHOLE_INPUTS: usize = 11;
/// The most gates of a network that is searched as a whole.
const WHOLE_GATES: usize = 500;
/// Above so many gates, a network is only shared and mapped.
const MOST_GATES: usize = 100_000;

/// The network in cells of the library, as cheap as the effort finds it.
///
/// # Errors
/// A function that the library cannot make.
pub fn reduce(
    network: &Network,
    stages: &[u32],
    library: &CellLibrary,
    options: MapOptions,
) -> Result<Network, Function> {
    let effort = options.effort;
    let target = Prices::of(library);
    let mut random = ChaCha8Rng::seed_from_u64(0x6e62_6373_796e_7468);
    let direct = cover(network, &target, stages)?;
    if direct.gates.len() > MOST_GATES || direct.gates.is_empty() {
        return Ok(direct);
    }
    let exclusive = target.cost(Function::XOR).unwrap_or(4);
    let mut best = search(&direct, &target, stages, effort, 2, &mut random);
    if exclusive > 1 {
        // Where an exclusive or is dear, first aim at few gates of any kind, then at cells.
        let ideal = Prices::abstracted(2 * exclusive - 1);
        let few = search(&cover(network, &ideal, stages)?, &ideal, stages, effort, 1, &mut random);
        let mapped = search(&cover(&few, &target, stages)?, &target, stages, effort, 2, &mut random);
        best = cheaper(best, mapped, &target);
    }
    Ok(best)
}

/// The cheaper of two networks, the first where they cost the same.
fn cheaper(one: Network, two: Network, prices: &Prices) -> Network {
    if cost(&two, prices) < cost(&one, prices) { two } else { one }
}

/// What a network's cells cost.
pub fn cost(network: &Network, prices: &Prices) -> u32 {
    network.gates.iter().map(|gate| prices.cell(gate.function)).sum()
}

/// Each gate made of the cheapest cells for its function, equal cells shared.
///
/// # Errors
/// A function that cannot be made.
pub fn cover(network: &Network, prices: &Prices, stages: &[u32]) -> Result<Network, Function> {
    let swept = network.swept();
    let mut graph = Graph::new(&Network::new(network.inputs), prices, stages, &[]);
    let mut made: Vec<Signal> = (0..2 + network.inputs as Signal).collect();
    for gate in &swept.gates {
        let signal = graph.compose(gate.function, gate.pins.map(|pin| made[pin as usize])).ok_or(gate.function)?;
        // Held, because nothing listens to it yet.
        graph.hold(signal);
        made.push(signal);
    }
    made[2 + network.inputs..].iter().for_each(|&signal| graph.let_go(signal));
    Ok(graph.finish(swept.outputs.iter().map(|&output| made[output as usize])))
}

/// The search that fits a network's width and the effort, `share` being the part of the work that it may take.
fn search(
    network: &Network,
    prices: &Prices,
    stages: &[u32],
    effort: Effort,
    share: u64,
    random: &mut ChaCha8Rng,
) -> Network {
    let gates = network.gates.len();
    if network.inputs <= WHOLE_INPUTS && gates <= WHOLE_GATES {
        let visits = match effort {
            Effort::Fast => (8 * gates as u64).min(2_000),
            Effort::Normal => (60 * gates as u64).clamp(200, 4_000),
            Effort::High => 400_000,
        };
        let plan = Plan { visits: visits * share, climb: 0, patience: u64::MAX };
        let calm = walk::improve_all(network, prices, stages, plan, random);
        let plan = Plan { visits: visits * share, climb: 400, patience: visits / 4 };
        return walk::improve_all(&calm, prices, stages, plan, random);
    }
    let (rounds, visits) = match effort {
        Effort::Fast => (1, 60),
        Effort::Normal => (1, 200),
        Effort::High => (60, 400),
    };
    let mut best = network.clone();
    for round in 0..rounds * share {
        let windows = best.gates.len().min(3000);
        let (inputs, size) = if effort == Effort::High && round % 2 == 1 { (10, 50) } else { (8, 30) };
        let panes = Panes { windows, inputs, gates: size, plan: Plan { visits, climb: 0, patience: u64::MAX } };
        let next = window::improve(&best, prices, stages, panes, random);
        let next = cover(&next, prices, stages).expect("the network is made of the library's cells");
        if cost(&next, prices) <= cost(&best, prices) {
            best = next;
        }
    }
    best
}
