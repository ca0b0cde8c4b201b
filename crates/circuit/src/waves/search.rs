//! The search for logic that makes a small wave machine: a random walk over networks of equal function, each judged
//! with its buffers. Mapping alone counts gates; here a gate that lets a chain of buffers go is as good as a gate less.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::cells::CellLibrary;
use crate::network::Network;
use crate::options::{Effort, MapOptions, MappingObjective};
use crate::synth::prices::Prices;
use crate::synth::{CellNetwork, Coverer, alternative, below};
use crate::waves::graph::{WaveGraph, WaveLogic};
use crate::waves::phases::{Balancing, Phases};

const MOST_GATES: usize = 2_000;

/// Robots more than the best so far with which the search returns to that.
const MOST_LOSS: usize = 4;

/// What is to be small, the most important first: the cycles of a step, then the robots.
pub type Weight = (u32, usize);

#[derive(Clone, Debug)]
pub struct Balanced {
    pub network: Network,
    pub graph: WaveGraph,
    pub phases: Phases,
    pub weight: Weight,
}

impl Balanced {
    /// Balances a network for steps of so many beats, or of the fewest; `Err` has the fewest if that is more.
    pub fn of(logic: &WaveLogic, network: Network, cells: &WaveCells<'_>, period: Option<u32>) -> Result<Self, u32> {
        let graph = logic.graph(&cells.of(&network));
        let balancing = Balancing::new(&graph);
        let found = period.and_then(|period| Some((period, balancing.fewest_buffers(period)?)));
        let (period, (phases, buffers)) = match (found, period) {
            (Some(found), _) => found,
            (None, Some(_)) => return Err(balancing.least_period()),
            (None, None) => {
                let least = balancing.least_period();
                (least, balancing.fewest_buffers(least).expect("this period is long enough"))
            }
        };
        let weight = (period, graph.gates.len() + buffers);
        Ok(Self { network, graph, phases, weight })
    }

    fn is_in_time(logic: &WaveLogic, network: &Network, cells: &WaveCells<'_>, period: u32) -> bool {
        Balancing::new(&logic.graph(&cells.of(network))).is_enough(period)
    }
}

pub struct WaveCells<'a>(Option<Coverer<'a>>);

impl<'a> WaveCells<'a> {
    pub fn new(library: &'a CellLibrary) -> Self {
        Self(library.is_wide().then(|| Coverer::new(library, MappingObjective::Area)))
    }

    pub fn of(&self, network: &Network) -> CellNetwork {
        self.0.as_ref().map_or_else(|| CellNetwork::of(network), |coverer| coverer.cover(network))
    }
}

pub fn search(
    logic: &WaveLogic,
    starts: Vec<Network>,
    cells: &CellLibrary,
    period: Option<u32>,
    options: &MapOptions,
) -> Result<Balanced, u32> {
    let made = WaveCells::new(cells);
    let balanced: Vec<Result<Balanced, u32>> =
        starts.into_iter().map(|network| Balanced::of(logic, network, &made, period)).collect();
    let shortest = balanced.iter().map(|one| one.as_ref().map_or_else(|&least| least, |one| one.weight.0)).min();
    let found = balanced.into_iter().filter_map(Result::ok).min_by_key(|one| one.weight);
    let best = found.ok_or(shortest.unwrap_or(0))?;
    let prices = Prices::of(cells);
    let mut random = ChaCha8Rng::seed_from_u64(0x6e62_6377_6176_6573);
    let gates = best.network.gates.len();
    let rounds = match options.effort {
        _ if gates > MOST_GATES => 0,
        Effort::Fast => 0,
        Effort::Normal => (100 * gates).min(900_000 / (gates + 40)),
    };
    let (mut best, mut now) = (best.clone(), best);
    for round in 0..rounds {
        if options.cancel.is_raised() || now.network.gates.is_empty() {
            break;
        }
        let network = alternative(&now.network, &prices, 1 + below(&mut random, 6) as u64, &mut random);
        // A longer step is rarely worth the time to balance it.
        if network == now.network || !Balanced::is_in_time(logic, &network, &made, now.weight.0) {
            continue;
        }
        let Ok(next) = Balanced::of(logic, network, &made, period) else { continue };
        // Now and then the search takes a network that is a little larger, at first more of them.
        let slack = if below(&mut random, 6) == 0 { 3 * (rounds - round) / rounds } else { 0 };
        let is_taken = next.weight <= (now.weight.0, now.weight.1 + slack);
        if is_taken {
            now = next;
            if now.weight <= best.weight {
                best = now.clone();
            }
        }
        if now.weight > (best.weight.0, best.weight.1 + MOST_LOSS) {
            now = best.clone();
        }
    }
    // The walk may have left an inverter that is a larger gate with a constant; the robot of an inverter is sturdier.
    let plain = best.network.with_plain_inverters(|function| cells.get(function).is_some());
    let plain = Balanced::of(logic, plain, &made, period).ok();
    Ok(plain.filter(|plain| plain.weight <= best.weight).unwrap_or(best))
}
