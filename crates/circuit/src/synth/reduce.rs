//! The reduction of a network: which searches run, in which order, for which effort.

use std::collections::BTreeSet;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::CancelFlag;
use crate::cells::CellLibrary;
use crate::network::{Network, Signal};
use crate::options::{Effort, MapOptions, MappingObjective};
use crate::synth::candidates::below;
use crate::synth::chains::{balanced, levels};
use crate::synth::exact::{self, ExactResult};
use crate::synth::graph::{Graph, every_pattern};
use crate::synth::parts::in_parts;
use crate::synth::phases::assign_phases;
use crate::synth::prices::Prices;
use crate::synth::samples::improve_on_samples;
use crate::synth::shared_pairs::share_pairs;
use crate::synth::walk::{self, DelayGoal, MANY_GATES, WalkPlan};
use nbc_base::model::Function;

const WHOLE_INPUTS: usize = 12;
/// The same where inputs are registers: more patterns take longer there, and save few cells.
const WHOLE_STATES: usize = 10;
const WHOLE_GATES: usize = 600;
/// The product of gates and 64-bit words of patterns above which a walk over every pattern makes fewer visits.
const WHOLE_WORK: u64 = 1_200_000_000;
/// The gates of a part of a wide network whose gates are seen in their surroundings, or in samples of the patterns.
const NEAR_GATES: usize = 300;
const FAR_GATES: usize = 1_500;
/// The visits to each gate, and to all gates at most, that make gates earlier at no cost.
const SHORTENING_VISITS: u64 = 10;
const MOST_SHORTENING: u64 = 20_000;
/// Above this number of gates, a network is only shared and mapped.
const MOST_GATES: usize = 100_000;

pub fn reduce(
    network: &Network,
    stages: &[u32],
    library: &CellLibrary,
    options: &MapOptions,
) -> Result<Network, Function> {
    let target = Prices::of(library);
    let reduction = Reduction { prices: &target, stages, effort: options.effort, cancel: &options.cancel };
    let mut random = ChaCha8Rng::seed_from_u64(0x6e62_6373_796e_7468);
    let mut direct = cover(network, &target, stages)?;
    if direct.gates.len() > MOST_GATES || direct.gates.is_empty() {
        return Ok(direct);
    }
    let tree = reduction.tree(network, &direct)?;
    let mut source = network;
    if let Some((balanced, covered)) = &tree
        && cost(covered, &target) <= cost(&direct, &target)
    {
        (source, direct) = (balanced, covered.clone());
    }
    let best = reduction.search_both_ways(source, &direct, &mut random)?;
    let best = reduction.fewest(best);
    if options.objective != MappingObjective::Delay {
        return Ok(reduction.shorten(&best, &mut random));
    }
    let best = reduction.shorten_slowest_path(&best, &mut random);
    Ok(match tree {
        Some((_, covered)) if depth(&covered, &target) < depth(&best, &target) => {
            let other = reduction.shorten_slowest_path(&covered, &mut random);
            let rank = |network: &Network| (depth(network, &target), cost(network, &target));
            if rank(&other) < rank(&best) { other } else { best }
        }
        _ => best,
    })
}

/// The same without the inputs that no gate reads, such as clocks, which would only make the patterns more.
pub fn reduce_between_registers(
    network: &Network,
    stages: &[u32],
    library: &CellLibrary,
    options: &MapOptions,
) -> Result<Network, Function> {
    let pins = network.gates.iter().flat_map(|gate| gate.pins);
    let read: BTreeSet<usize> = pins.filter_map(|pin| (pin as usize).checked_sub(2)).collect();
    let read: Vec<usize> = read.range(..network.inputs).copied().collect();
    if read.len() == network.inputs || stages.iter().all(|&stage| stage == 0) {
        return reduce(network, stages, library, options);
    }
    let mut own = Network::new(read.len());
    let mut inputs = vec![0; network.inputs];
    read.iter().enumerate().for_each(|(at, &input)| inputs[input] = own.input(at));
    own.outputs = own.include(network, &inputs);
    let stages: Vec<u32> = read.iter().filter_map(|&input| stages.get(input).copied()).collect();
    let reduced = reduce(&own, &stages, library, options)?;
    let mut whole = Network::new(network.inputs);
    let made = whole.include(&reduced, &read.iter().map(|&input| network.input(input)).collect::<Vec<_>>());
    let is_port = |signal: Signal| (signal as usize) < 2 + network.inputs;
    let shown = network.outputs.iter().zip(made);
    whole.outputs = shown.map(|(&output, made)| if is_port(output) { output } else { made }).collect();
    Ok(whole)
}

/// Another network of the same function, at the end of a short walk; it may have some cells more.
pub fn alternative(network: &Network, prices: &Prices, visits: u64, random: &mut ChaCha8Rng) -> Network {
    let plan = WalkPlan::downhill(visits);
    match (network.inputs <= WHOLE_INPUTS, below(random, 8)) {
        (true, 0) => {
            walk::improve_all(network, prices, &[], WalkPlan { delay: DelayGoal::SlowestPath, ..plan }, random)
        }
        (true, _) => {
            walk::wander(network, prices, &every_pattern(network.inputs), WalkPlan { climb: 3, ..plan }, random)
        }
        (false, _) => improve_on_samples(network, prices, &[], plan, random),
    }
}

/// The cheaper of two networks; of equal cost, the one with the shorter slowest path, or the first.
fn cheaper(one: Network, two: Network, prices: &Prices) -> Network {
    let rank = |network: &Network| (cost(network, prices), depth(network, prices));
    if rank(&two) < rank(&one) { two } else { one }
}

pub fn cost(network: &Network, prices: &Prices) -> u32 {
    network.gates.iter().map(|gate| prices.cell(gate.function)).sum()
}

pub fn cover(network: &Network, prices: &Prices, stages: &[u32]) -> Result<Network, Function> {
    let swept = network.swept();
    let mut graph = Graph::new(&Network::new(network.inputs), prices, stages, &[]);
    let mut made: Vec<Signal> = (0..2 + network.inputs as Signal).collect();
    for gate in &swept.gates {
        let signal = graph.compose(gate.function, gate.pins.map(|pin| made[pin as usize])).ok_or(gate.function)?;
        // Held, because no gate reads it yet.
        graph.hold(signal);
        made.push(signal);
    }
    made[2 + network.inputs..].iter().for_each(|&signal| graph.let_go(signal));
    Ok(graph.finish(swept.outputs.iter().map(|&output| made[output as usize])))
}

#[derive(Clone, Copy)]
struct Reduction<'a> {
    prices: &'a Prices,
    stages: &'a [u32],
    effort: Effort,
    cancel: &'a CancelFlag,
}

impl<'a> Reduction<'a> {
    fn is_combinational(&self) -> bool {
        self.stages.iter().all(|&stage| stage == 0)
    }

    fn is_narrow(&self, network: &Network) -> bool {
        let most = if self.is_combinational() { WHOLE_INPUTS } else { WHOLE_STATES };
        network.inputs <= most && network.gates.len() <= WHOLE_GATES
    }

    /// The network with trees in the place of chains, if it is deeper than one and a half times these, and its cells.
    fn tree(&self, network: &Network, direct: &Network) -> Result<Option<(Network, Network)>, Function> {
        let highest = |network: &Network| levels(network).into_iter().max().unwrap_or(0);
        let Some(tree) = balanced(&network.swept()) else { return Ok(None) };
        let covered = cover(&tree, self.prices, self.stages)?;
        let is_lower = 3 * highest(&covered) < 2 * highest(direct);
        Ok((is_lower && covered.gates.len() <= MOST_GATES).then_some((tree, covered)))
    }

    fn downhill(&self, visits: u64) -> WalkPlan<'a> {
        WalkPlan { cancel: Some(self.cancel), ..WalkPlan::downhill(visits) }
    }

    fn search_both_ways(
        &self,
        network: &Network,
        direct: &Network,
        random: &mut ChaCha8Rng,
    ) -> Result<Network, Function> {
        if direct.gates.len() > MANY_GATES && self.effort != Effort::Fast {
            return self.search_large(network, direct, random);
        }
        let exclusive = self.prices.cost(Function::XOR).unwrap_or(4);
        let best = self.search(direct, 2, random);
        if exclusive <= 1 || self.effort == Effort::Fast && !self.is_narrow(direct) {
            return Ok(best);
        }
        // An exclusive or is counted as slightly less than its cells.
        let ideal = Prices::abstracted(2 * exclusive - 1);
        let few = Reduction { prices: &ideal, ..*self }.search(&cover(network, &ideal, self.stages)?, 1, random);
        let mapped = cover(&few, self.prices, self.stages)?;
        let other = self.search(&cheaper(direct.clone(), mapped, self.prices), 2, random);
        Ok(cheaper(best, other, self.prices))
    }

    /// Minimizes the gates of any kind with free inverters, where a search is stuck less often, then the cost.
    fn search_large(&self, network: &Network, direct: &Network, random: &mut ChaCha8Rng) -> Result<Network, Function> {
        let ideal = self.prices.ideal();
        let start = (0..2).try_fold(cover(network, &ideal, self.stages)?, |now, _| {
            Ok(cheaper(now.clone(), cover(&share_pairs(&now), &ideal, self.stages)?, &ideal))
        })?;
        let few = Reduction { prices: &ideal, ..*self }.search(&start, 1, random);
        let mut best = self.in_phases(direct.clone(), &few, random)?;
        let halfway = self.prices.halfway();
        let start = cover(&best, &halfway, self.stages)?;
        let few = Reduction { prices: &halfway, ..*self }.search(&start, 2, random);
        best = self.in_phases(best, &few, random)?;
        Ok(self.search(&best, 1, random))
    }

    fn in_phases(&self, best: Network, other: &Network, random: &mut ChaCha8Rng) -> Result<Network, Function> {
        let best = cheaper(best, cover(other, self.prices, self.stages)?, self.prices);
        let phased = assign_phases(other, self.prices, random).map(|phased| cover(&phased, self.prices, self.stages));
        Ok(match phased {
            Some(phased) => cheaper(best, phased?, self.prices),
            None => best,
        })
    }

    fn search(&self, network: &Network, share: u64, random: &mut ChaCha8Rng) -> Network {
        if !self.is_narrow(network) {
            let wide = self.search_wide(network, share, random);
            return if self.is_narrow(&wide) { self.search_whole(&wide, share, random) } else { wide };
        }
        match network.gates.len() > MANY_GATES && self.effort == Effort::Normal {
            true => self.search_whole(&self.search_wide(network, share, random), share, random),
            false => self.search_whole(network, share, random),
        }
    }

    fn search_whole(&self, network: &Network, share: u64, random: &mut ChaCha8Rng) -> Network {
        let gates = network.gates.len() as u64;
        let visits = match self.effort {
            Effort::Fast => (8 * gates).min(1_000),
            Effort::Normal => (25 * gates + gates * gates / 20).clamp(150, 6_000),
        };
        let words = (1u64 << network.inputs).div_ceil(64);
        let visits = visits.min(WHOLE_WORK / (words * gates.max(1)));
        let downhill = self.downhill(visits * share);
        let bold = WalkPlan { climb: 400, patience: visits / 4, ..downhill };
        let first = walk::improve_all(network, self.prices, self.stages, downhill, random);
        walk::improve_all(&first, self.prices, self.stages, bold, random)
    }

    fn search_wide(&self, network: &Network, share: u64, random: &mut ChaCha8Rng) -> Network {
        let round = Round::of(self.effort);
        let rounds = if self.effort == Effort::Fast { 1 } else { 2 * share };
        (0..rounds).fold(network.clone(), |best, _| {
            let gates = best.gates.len() as u64;
            let first = below(random, NEAR_GATES) + 1;
            let near = self.no_dearer(best, |best| {
                in_parts(best, self.stages, first, NEAR_GATES, |part, stages| {
                    let plan = self.downhill(round.near(part.gates.len() as u64, gates));
                    walk::improve(part, self.prices, stages, &[], plan, random)
                })
            });
            if round.far == 0 || self.is_narrow(&near) {
                return near;
            }
            let first = below(random, FAR_GATES) + 1;
            self.no_dearer(near, |near| {
                in_parts(near, self.stages, first, FAR_GATES, |part, stages| {
                    let plan = self.downhill(round.far(part.gates.len() as u64, gates));
                    improve_on_samples(part, self.prices, stages, plan, random)
                })
            })
        })
    }

    fn no_dearer(&self, best: Network, search: impl FnOnce(&Network) -> Network) -> Network {
        let next = cover(&search(&best), self.prices, self.stages).expect("the network is made of the library's cells");
        if cost(&next, self.prices) <= cost(&best, self.prices) { next } else { best }
    }

    fn fewest(&self, best: Network) -> Network {
        let nodes = match self.effort {
            Effort::Fast => 10_000,
            Effort::Normal => 100_000,
        };
        if best.inputs > exact::MOST_INPUTS || !self.is_combinational() || !self.prices.are_even() {
            return best;
        }
        match exact::fewer(&best, self.prices, cost(&best, self.prices), nodes, self.cancel) {
            ExactResult::Made(network) => network,
            ExactResult::Impossible | ExactResult::Unknown => best,
        }
    }

    fn shorten(&self, network: &Network, random: &mut ChaCha8Rng) -> Network {
        let visits = (SHORTENING_VISITS * network.gates.len() as u64).min(MOST_SHORTENING);
        let plan = WalkPlan { delay: DelayGoal::Shorten, ..self.downhill(visits) };
        match self.is_narrow(network) {
            true => walk::improve_all(network, self.prices, self.stages, plan, random),
            false => walk::improve(network, self.prices, self.stages, &[], plan, random),
        }
    }

    fn shorten_slowest_path(&self, network: &Network, random: &mut ChaCha8Rng) -> Network {
        let rounds = match self.effort {
            Effort::Fast => 1,
            Effort::Normal => 3,
        };
        let rank = |network: &Network| (depth(network, self.prices), cost(network, self.prices));
        let mut best = network.clone();
        let mut now = network.clone();
        for _ in 0..rounds {
            for delay in [DelayGoal::SlowestPath, DelayGoal::Keep] {
                let plan = WalkPlan { delay, ..self.downhill((10 * now.gates.len() as u64).min(3_000)) };
                now = match self.is_narrow(&now) {
                    true => walk::improve_all(&now, self.prices, self.stages, plan, random),
                    false => improve_on_samples(&now, self.prices, self.stages, plan, random),
                };
            }
            if rank(&now) < rank(&best) {
                best = now.clone();
            }
        }
        best
    }
}

#[derive(Clone, Copy)]
struct Round {
    /// Visits to each gate that see its surroundings, and the most such visits to all gates.
    near: u64,
    most_near: u64,
    /// Visits to each gate that see samples of the whole part, and the most such visits to all gates.
    far: u64,
    most_far: u64,
    /// The most such visits to a part, times its gates.
    work: u64,
}

impl Round {
    fn of(effort: Effort) -> Self {
        match effort {
            Effort::Fast => Self { near: 2, most_near: 100_000, far: 0, most_far: 0, work: 0 },
            Effort::Normal => Self { near: 26, most_near: 130_000, far: 20, most_far: 10_000, work: 3_000_000 },
        }
    }

    fn near(&self, part: u64, all: u64) -> u64 {
        (self.near * part).min(self.most_near * part / all.max(1))
    }

    fn far(&self, part: u64, all: u64) -> u64 {
        (self.far * part).min(self.most_far * part / all.max(1)).min(self.work / part.max(1))
    }
}

fn depth(network: &Network, prices: &Prices) -> u32 {
    Graph::new(network, prices, &[], &[]).depth()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::library;
    use crate::proof::equal;

    fn reduced(network: &Network, cells: &str) -> Network {
        reduce(network, &[], &library(cells), &MapOptions::default()).unwrap()
    }

    #[test]
    fn observability_dont_cares_allow_cheaper_gates() {
        // The exclusive or matters only if `a` is 1: there it is the opposite of `b`.
        let mut network = Network::new(2);
        let different = network.add(Function::XOR, [2, 3]);
        let both = network.add(Function::AND, [2, different]);
        network.outputs.push(both);
        assert_eq!(reduced(&network, "nand not").gates.len(), 3);
        assert_eq!(reduced(&network, "a_and_notb not").gates.len(), 1);
    }

    #[test]
    fn exclusive_ors_of_nand_cells_share_their_first_gates() {
        let mut network = Network::new(3);
        let half = network.add(Function::XOR, [2, 3]);
        let sum = network.add(Function::XOR, [half, 4]);
        let pairs = [network.add(Function::AND, [2, 3]), network.add(Function::AND, [half, 4])];
        let carry = network.add(Function::OR, pairs);
        network.outputs = vec![sum, carry];
        assert_eq!(reduced(&network, "nand").gates.len(), 9);
    }

    #[test]
    fn a_decoder_of_the_fewest_cells_has_two_levels() {
        let excluded = Function::parse("nota_and_b").unwrap();
        let mut network = Network::new(3);
        let high = network.add(Function::AND, [4, 2]);
        let low = network.add(excluded, [high, 4]);
        let one = network.add(Function::AND, [3, low]);
        let zero = network.add(excluded, [one, low]);
        let two = network.add(excluded, [3, high]);
        let three = network.add(excluded, [two, high]);
        network.outputs = vec![zero, one, two, three];
        let library = library("and nota_and_b a_and_notb");
        let reduced = reduce(&network, &[], &library, &MapOptions::default()).unwrap();
        assert_eq!((reduced.gates.len(), depth(&reduced, &Prices::of(&library))), (6, 2));
    }

    #[test]
    fn a_cancelled_search_ends_with_a_network_of_the_same_function() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for inputs in [3, 14] {
            let mut network = Network::new(inputs);
            for i in 0..200 {
                let pins = [below(&mut random, 2 + inputs + i), 2 + below(&mut random, inputs + i)];
                network.add([Function::XOR, Function::AND, Function::OR][i % 3], pins.map(|pin| pin as Signal));
            }
            let signals = network.signals() as Signal;
            network.outputs = (signals - 6..signals).collect();
            let library = library("nand not");
            for objective in [MappingObjective::Area, MappingObjective::Delay] {
                let options = MapOptions { objective, ..MapOptions::default() };
                options.cancel.raise();
                let cancelled = reduce(&network, &[], &library, &options).unwrap();
                assert!(equal(&network, &cancelled).is_ok());
                assert!(cancelled.gates.iter().all(|gate| library.get(gate.function).is_some()));
                let whole = MapOptions { effort: Effort::Fast, ..MapOptions::default() };
                assert!(cancelled.gates.len() > reduce(&network, &[], &library, &whole).unwrap().gates.len());
            }
        }
    }

    #[test]
    fn constant_outputs_and_copied_inputs_need_no_cells() {
        let mut network = Network::new(2);
        let never = network.add(Function::XOR, [2, 2]);
        let same = network.add(Function::OR, [3, never]);
        network.outputs = vec![never, same];
        let reduced = reduced(&network, "nand");
        assert_eq!((reduced.gates.len(), reduced.outputs), (0, vec![0, 3]));
    }
}
