//! Whether the best robots of the runs still show their behavior in other worlds.

use std::collections::BTreeMap;

use nbc_base::model::{Behavior, Body, Genotype, PhysicsWorld, Setting, Variation};
use nbc_session::report;
use nbc_sim::Simulator;
use nbc_swarm::{Proportion, WorldSample, fixed_displacements, fixed_trials};

use crate::{Fallible, Run};

/// The worlds of each size of changes.
const WORLDS: usize = 5;

/// Env steps under each constant pattern: ten cycles.
pub const STEPS: u32 = 840;

/// The best robot of each behavior by the least distance, of each run, with its network.
pub fn champions(runs: &BTreeMap<u64, Run>) -> Vec<(Behavior, Body, Option<Genotype>)> {
    let best = |run: &Run, behavior: Behavior| {
        let elites = run.results.niches.iter().flat_map(|(_, elites)| elites);
        let own = elites.filter(|elite| elite.behavior == behavior);
        own.max_by(|a, b| a.fitness[1].total_cmp(&b.fitness[1]))
            .map(|elite| (behavior, elite.body.clone(), elite.genotype.clone()))
    };
    runs.values().flat_map(|run| Behavior::all(2).filter_map(move |behavior| best(run, behavior))).collect()
}

/// The share of champions, by difficulty, whose four directions stay the same in worlds that vary by so much.
pub fn print(boxes: &[(&str, &BTreeMap<u64, Run>)]) -> Fallible<()> {
    println!("\n| box | worlds | no stimulus | one | both | XOR and XNOR |\n|---|---|---|---|---|---|");
    let simulator = Simulator::default();
    for (name, runs) in boxes {
        let robots = champions(runs);
        for percent in [0, 10, 20] {
            let variation = match percent {
                0 => Variation::default(),
                percent => format!("all={percent}%").parse()?,
            };
            let sample = WorldSample { variation, seed: 1 };
            let mut same = [Proportion::default(); 4];
            for number in 0..if percent == 0 { 1 } else { WORLDS } {
                let world = sample.world(&PhysicsWorld::default(), number);
                let setting = Setting { factors: world.factors, ..Setting::default() };
                let trials: Vec<_> = robots.iter().flat_map(|(_, body, _)| fixed_trials(body, STEPS)).collect();
                let walked = simulator.run_trials(&setting, &trials);
                for ((behavior, ..), four) in robots.iter().zip(walked.chunks(4)) {
                    let shown = fixed_displacements(four).ok().map(|walked| Behavior::of(&walked));
                    let group = &mut same[report::difficulty_of(*behavior)];
                    group.attempts += 1;
                    group.successes += usize::from(shown == Some(*behavior));
                }
            }
            print!("| {name} | {percent} %");
            same.iter().for_each(|group| print!(" | {:.0} %", 100.0 * group.share()));
            println!(" |");
        }
    }
    Ok(())
}
