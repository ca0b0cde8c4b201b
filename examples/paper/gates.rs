//! Whether the best robots of the runs are gates: right soon after any switch of their inputs, not only in one order.

use std::collections::BTreeMap;

use nbc_base::model::Body;
use nbc_session::report;
use nbc_sim::Simulator;
use nbc_swarm::{Proportion, screen, walk};

use crate::{Fallible, Run, Spread, champions, whole};

/// The largest clock of a gate, in cycles.
const CLOCK: u32 = 4;

/// For runs of several objectives: when they found all behaviors, and of the elite of each run and behavior with the
/// largest fitness of that number, whether it is a gate and how far it walks at least, by difficulty.
pub fn print(objectives: &[(&str, &BTreeMap<u64, Run>, usize)]) -> Fallible<()> {
    println!(
        "\n| objective | all 16 behaviors after | no stimulus | one | both | XOR and XNOR |\n|---|---|---|---|---|---|"
    );
    let simulator = Simulator::default();
    let mut distances = String::new();
    for &(name, runs, fitness) in objectives {
        let elites = champions(runs, fitness);
        let mut gates = [Proportion::default(); 4];
        for elite in &elites {
            let group = &mut gates[report::difficulty_of(elite.behavior)];
            group.attempts += 1;
            let clock = screen(&simulator, &elite.body, elite.behavior, CLOCK).ok().flatten();
            group.successes += usize::from(clock.is_some());
        }
        print!("| {name} | {:.0}", Spread::of(runs.values().map(whole)));
        gates.iter().for_each(|group| print!(" | {} of {}", group.successes, group.attempts));
        println!(" |");
        let bodies: Vec<Body> = elites.iter().map(|elite| elite.body.clone()).collect();
        let mut least: [Vec<f64>; 4] = Default::default();
        for (elite, walked) in elites.iter().zip(walk(&simulator, &bodies)) {
            let Ok(walked) = walked else { continue };
            let shortest = walked.iter().map(|walk| walk.abs()).fold(f64::INFINITY, f64::min);
            least[report::difficulty_of(elite.behavior)].push(shortest);
        }
        distances += &format!("| {name}");
        least.iter().for_each(|group| distances += &format!(" | {:.2}", Spread::of(group.iter().copied()).median));
        distances += " |\n";
    }
    print!("\n| objective | no stimulus | one | both | XOR and XNOR |\n|---|---|---|---|---|\n{distances}");
    Ok(())
}
