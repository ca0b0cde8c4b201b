//! How late each shipped robot answers where its stimuli change within its cycles: the table of docs/own-clocks.md.
//!
//!     cargo run --release --example own_clocks

use nbc_base::model::{
    Behavior, CYCLE_STEPS, Direction, Hears, Pattern, Robot, Schedule, Setting, Spell, Trajectory, Trial,
};
use nbc_sim::Simulator;

/// Env steps between the phases that are tried.
const STRIDE: usize = 6;
/// Cycles of the pattern before, and all cycles.
const BEFORE: [u32; 2] = [5, 6];
const CYCLES: u32 = 14;

struct Switch {
    from: Pattern,
    to: Pattern,
    env_step: u32,
}

fn main() {
    println!("| robot | clock | `hears: cycle` | `hears: always` | wrong where it should stay | unstable |");
    println!("|---|---|---|---|---|---|");
    for robot in nbc_session::store::shipped_library().robots {
        println!("{}", row(&robot));
    }
}

fn row(robot: &Robot) -> String {
    let patterns: Vec<Pattern> = Pattern::all(robot.behavior.stimuli()).collect();
    let mut switches = Vec::new();
    for (&from, &to) in patterns.iter().flat_map(|from| patterns.iter().map(move |to| (from, to))) {
        for before in BEFORE.into_iter().filter(|_| from != to) {
            let steps = (0..CYCLE_STEPS).step_by(STRIDE).map(|phase| before * CYCLE_STEPS + phase);
            switches.extend(steps.map(|env_step| Switch { from, to, env_step }));
        }
    }
    let spell = Spell::of;
    let schedule = |&Switch { from, to, env_step }: &Switch| Schedule {
        spells: vec![spell(from, env_step), spell(to, CYCLES * CYCLE_STEPS - env_step)],
    };
    let trials: Vec<Trial> =
        switches.iter().map(|switch| Trial { body: robot.body.clone(), schedule: schedule(switch) }).collect();
    let found = Simulator::default().run_trials(&Setting::default(), &trials);
    let sound = || switches.iter().zip(&found).filter(|(_, walk)| walk.fault.is_none());
    let late = |hears: Hears| sound().map(|(switch, walk)| lateness(robot.behavior, switch, walk, hears)).max();
    let stays = |switch: &Switch| robot.behavior.direction(switch.from) == robot.behavior.direction(switch.to);
    let is_wrong =
        |hears: Hears| move |(switch, walk): &(&Switch, &Trajectory)| lateness(robot.behavior, switch, walk, hears) > 0;
    let wrong = |hears: Hears| sound().filter(|(switch, _)| stays(switch)).filter(is_wrong(hears)).count();
    let [cycle, always] = [Hears::Cycle, Hears::Always].map(|hears| (late(hears).unwrap_or(0), wrong(hears)));
    let (tries, unstable) = (sound().filter(|(switch, _)| stays(switch)).count(), switches.len() - sound().count());
    let clock = robot.character.clock;
    format!(
        "| `{}` | {clock} | {} | {} | {} and {} of {tries} | {unstable} |",
        robot.name, cycle.0, always.0, cycle.1, always.1
    )
}

/// Env steps after a switch until the output is right and stays right; 0 if it was never wrong.
fn lateness(behavior: Behavior, switch: &Switch, walk: &Trajectory, hears: Hears) -> u32 {
    let right = behavior.direction(switch.to);
    let is_read = |step: &u32| hears == Hears::Always || step.is_multiple_of(CYCLE_STEPS);
    let is_wrong = |step: &u32| {
        let moved = walk.com_x[*step as usize] - walk.com_x[(step - CYCLE_STEPS) as usize];
        let is_still = hears == Hears::Always && moved.abs() < Hears::DEAD_ZONE;
        !is_still && Direction::of(moved) != right
    };
    let end = CYCLES * CYCLE_STEPS;
    let last_wrong = (switch.env_step + 1..=end).rev().filter(is_read).find(is_wrong);
    let next = |step: u32| if hears == Hears::Always { step + 1 } else { step + CYCLE_STEPS };
    last_wrong.map_or(0, |step| next(step) - switch.env_step)
}
