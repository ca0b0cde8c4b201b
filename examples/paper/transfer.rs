//! Whether the best robots of the runs still show their behavior in other worlds.

use std::collections::BTreeMap;

use nbc_base::model::{Behavior, Body, PhysicsWorld, Setting, Variation};
use nbc_session::report;
use nbc_sim::Simulator;
use nbc_swarm::{FIXED_STEPS, Proportion, WorldSample, fixed_displacements};

use crate::{Fallible, LEAST_DISTANCE, Run, champions};

/// The worlds of each size of changes.
const WORLDS: usize = 5;

/// The behaviors that bodies show; none if a simulation was faulty.
pub fn shown(simulator: &Simulator, setting: &Setting, bodies: &[Body]) -> Vec<Option<Behavior>> {
    let walked = fixed_displacements(simulator, setting, bodies, FIXED_STEPS);
    walked.into_iter().map(|walked| walked.ok().map(|walked| walked.behavior())).collect()
}

/// The share of champions, by difficulty, whose four directions stay the same in worlds that vary by so much.
pub fn print(boxes: &[(&str, &BTreeMap<u64, Run>)]) -> Fallible<()> {
    println!("\n| box | worlds | no stimulus | one | both | XOR and XNOR |\n|---|---|---|---|---|---|");
    let simulator = Simulator::default();
    for (name, runs) in boxes {
        let robots = champions(runs, LEAST_DISTANCE);
        let bodies: Vec<Body> = robots.iter().map(|elite| elite.body.clone()).collect();
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
                for (elite, shown) in robots.iter().zip(shown(&simulator, &setting, &bodies)) {
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
