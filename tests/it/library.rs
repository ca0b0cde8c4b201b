//! The built-in robots as gates.

use nbc_base::model::{CYCLE_STEPS, Direction, Pattern, Robot, Schedule, Setting, Spell, Trial};
use nbc_session::store::shipped_library;
use nbc_sim::Simulator;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const SWITCHES: usize = 25;
/// Cycles by which a hold may exceed the clock.
const SLACK: u32 = 3;

/// Random patterns, each different from the previous one, with the number of cycles of each hold.
fn holds(clock: u32, seed: u64) -> Vec<(Pattern, u32)> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut pattern = 0;
    let mut hold = |_| {
        pattern = (pattern + rng.random_range(1..4u32)) % 4;
        (Pattern::PAIRS[pattern as usize], rng.random_range(clock..=clock + SLACK))
    };
    (0..=SWITCHES).map(&mut hold).collect()
}

/// The holds after the first with a wrong output from the clock's cycle on.
fn wrong(robot: &Robot, holds: &[(Pattern, u32)], com_x: &[f64]) -> usize {
    let clock = robot.character.clock as usize;
    let mut cycles = com_x.windows(CYCLE_STEPS as usize + 1).step_by(CYCLE_STEPS as usize);
    let mut is_wrong = |&(pattern, count): &(Pattern, u32)| {
        let right = robot.behavior.direction(pattern);
        let walked: Vec<f64> =
            cycles.by_ref().take(count as usize).map(|cycle| cycle[cycle.len() - 1] - cycle[0]).collect();
        walked[clock - 1..].iter().any(|&displacement| Direction::of(displacement) != right)
    };
    let found: Vec<bool> = holds.iter().map(&mut is_wrong).collect();
    found[1..].iter().filter(|wrong| **wrong).count()
}

#[test]
fn each_gate_is_correct_after_random_switches() {
    let robots = &shipped_library().robots;
    let setting = Setting { world_width: 2000, ..Setting::default() };
    let plans: Vec<_> = (0u64..).zip(robots).map(|(seed, robot)| holds(robot.character.clock, seed)).collect();
    let spells = |plan: &[(Pattern, u32)]| {
        plan.iter().map(|&(pattern, cycles)| Spell { pattern, steps: cycles * CYCLE_STEPS }).collect()
    };
    let trials: Vec<Trial> = robots
        .iter()
        .zip(&plans)
        .map(|(robot, plan)| Trial { body: robot.body.clone(), schedule: Schedule { spells: spells(plan) } })
        .collect();
    for ((robot, plan), trajectory) in robots.iter().zip(&plans).zip(Simulator::default().run_trials(&setting, &trials))
    {
        assert_eq!(trajectory.fault, None, "{}", robot.name);
        let wrong = wrong(robot, plan, &trajectory.com_x);
        // A robot with a known error rate may make some errors here too: three times its rate, plus one.
        let allowed = match robot.character.error_rate {
            0.0 => 0,
            rate => 1 + (3.0 * rate * SWITCHES as f64) as usize,
        };
        assert!(wrong <= allowed, "{}: {wrong} of {SWITCHES} switches wrong, {allowed} allowed", robot.name);
    }
}
