//! Whether the best robots of the runs still show their behavior in other worlds.

use std::collections::BTreeMap;

use nbc_base::model::{Behavior, PhysicsWorld, Setting, Trajectory, Variation};
use nbc_session::report;
use nbc_sim::Simulator;
use nbc_swarm::{Proportion, WorldSample, fixed_displacements, fixed_trials};

use crate::{Fallible, LEAST_DISTANCE, Run, champions};

/// The worlds of each size of changes.
const WORLDS: usize = 5;

/// Env steps under each constant pattern: ten cycles.
pub const STEPS: u32 = 840;

/// The behaviors that bodies show, from four walks of each; none if one was faulty.
pub fn shown(walked: &[Trajectory]) -> Vec<Option<Behavior>> {
    walked.chunks(4).map(|four| fixed_displacements(four).ok().map(|walked| Behavior::of(&walked))).collect()
}

/// The share of champions, by difficulty, whose four directions stay the same in worlds that vary by so much.
pub fn print(boxes: &[(&str, &BTreeMap<u64, Run>)]) -> Fallible<()> {
    println!("\n| box | worlds | no stimulus | one | both | XOR and XNOR |\n|---|---|---|---|---|---|");
    let simulator = Simulator::default();
    for (name, runs) in boxes {
        let robots = champions(runs, LEAST_DISTANCE);
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
                let trials: Vec<_> = robots.iter().flat_map(|elite| fixed_trials(&elite.body, STEPS)).collect();
                let walked = simulator.run_trials(&setting, &trials);
                for (elite, shown) in robots.iter().zip(shown(&walked)) {
                    let group = &mut same[report::difficulty_of(elite.behavior)];
                    group.attempts += 1;
                    group.successes += usize::from(shown == Some(elite.behavior));
                }
            }
            print!("| {name} | {percent} %");
            same.iter().for_each(|group| print!(" | {:.0} %", 100.0 * group.share()));
            println!(" |");
        }
    }
    Ok(())
}
