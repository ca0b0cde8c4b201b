//! After how many generations the runs reach what the paper has.

use std::collections::BTreeMap;

use crate::{LEAST_DISTANCE, LONG, Moment, Published, PublishedRobot, Run, Spread, order, whole};

/// Of each published robot, how many runs have one of its behavior that walks at least as far, and after how many
/// generations: at the latest, because what replaced an elite later has hidden when it came.
pub fn print_published(boxes: &[usize], long: &[&BTreeMap<u64, Run>]) -> crate::Fallible<()> {
    println!("\n| behavior | box | published | runs that reach it | after generations |\n|---|---|---|---|---|");
    for robot in Published::read()?.robots {
        let Some(place) = boxes.iter().position(|&side| side == robot.body.len()) else { continue };
        let reached: Vec<f64> = long[place].values().filter_map(|run| since(run, &robot)).map(f64::from).collect();
        let PublishedRobot { behavior, min_displacement, body } = robot;
        print!("| {behavior} | {0}x{0} | {min_displacement:.2} | {1} of ", body.len(), reached.len());
        println!("{} | {:.0} |", long[place].len(), Spread::of(reached.into_iter()));
    }
    Ok(())
}

/// The first generation after which a run is known to have walked as far as a robot.
fn since(run: &Run, robot: &PublishedRobot) -> Option<u32> {
    let champions =
        run.results.progress.iter().filter_map(|line| Some((line.generation, line.best.get(&robot.behavior)?)));
    let elites = run.results.niches.iter().flat_map(|(_, elites)| elites);
    let elites =
        elites.filter(|elite| elite.behavior == robot.behavior).map(|elite| (elite.generation, &elite.fitness));
    let all = champions.chain(elites);
    all.filter(|(_, fitness)| fitness[LEAST_DISTANCE] >= robot.min_displacement).map(|(generation, _)| generation).min()
}

/// The generation in which all runs had all behaviors, and the first one in which each step of the order of difficulty
/// was as significant as in the paper, with the share of those since the former in which it was.
pub fn print_claims(boxes: &[(&str, &BTreeMap<u64, Run>)]) {
    println!("\n| box | generations | all 16 behaviors | no stimulus, one | one, both | both, XOR and XNOR |");
    println!("|---|---|---|---|---|---|");
    for &(name, runs) in boxes {
        let found = runs.values().map(whole).fold(0.0, f64::max) as u32;
        let common = (1..=LONG).rev().find(|&one| runs.values().all(|run| run.line(one).is_some())).unwrap_or(0);
        let mut steps: [Vec<u32>; 3] = Default::default();
        for generation in found..=common {
            let eight = Moment::of(String::new(), runs, generation).groups(|_| true);
            for (step, _) in steps.iter_mut().zip(order(&eight)).filter(|(_, pair)| pair.p_adjusted < 0.001) {
                step.push(generation);
            }
        }
        print!("| {name} | {common} | {found}");
        for step in steps {
            let share = 100.0 * step.len() as f64 / f64::from(common - found + 1);
            print!(" | {} ({share:.0} %)", step.first().map_or("never".to_owned(), u32::to_string));
        }
        println!(" |");
    }
}
