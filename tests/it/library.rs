//! The built-in robots as gates.

use nbc_base::model::{CYCLE_STEPS, Direction, Pattern, Robot, Schedule, Setting, Spell, Trajectory, Trial};
use nbc_session::store::shipped_library;
use nbc_sim::Simulator;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const SWITCHES: usize = 15;
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
        plan.iter().map(|&(pattern, cycles)| Spell::of(pattern, cycles * CYCLE_STEPS)).collect()
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

fn stream(cycles: usize, seed: u64) -> Vec<Pattern> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..cycles).map(|_| Pattern::PAIRS[rng.random_range(0..4usize)]).collect()
}

/// The gates of clock 1 without glitches, as wave machines use them.
fn quick_gates() -> Vec<Robot> {
    let is_quick = |robot: &Robot| robot.character.clock == 1 && robot.character.glitch_rate == 0.0;
    let quick: Vec<Robot> = shipped_library().robots.iter().filter(|robot| is_quick(robot)).cloned().collect();
    assert_eq!(quick.len(), 18, "all fourteen functions of stimuli, and the constants in two boxes");
    quick
}

/// The cycles with a wrong output of a robot under each of some sequences of patterns, one a cycle, but for the first.
fn wrong_cycles(robot: &Robot, plans: &[Vec<Pattern>]) -> Vec<Vec<usize>> {
    // No robot walks to the end of this ground.
    let setting = Setting { world_width: 32_768, ..Setting::default() };
    let spell = |&pattern: &Pattern| Spell::of(pattern, CYCLE_STEPS);
    let trial = |plan: &Vec<Pattern>| Trial {
        body: robot.body.clone(),
        schedule: Schedule { spells: plan.iter().map(spell).collect() },
    };
    let trials: Vec<Trial> = plans.iter().map(trial).collect();
    let wrong = |(plan, trajectory): (&Vec<Pattern>, Trajectory)| {
        assert_eq!(trajectory.fault, None, "{}", robot.name);
        let walked = trajectory.com_x.windows(CYCLE_STEPS as usize + 1).step_by(CYCLE_STEPS as usize);
        let is_wrong = |(pattern, path): (&Pattern, &[f64])| {
            Direction::of(path[path.len() - 1] - path[0]) != robot.behavior.direction(*pattern)
        };
        plan.iter().zip(walked).enumerate().skip(1).filter(|(_, cycle)| is_wrong(*cycle)).map(|(at, _)| at).collect()
    };
    plans.iter().zip(Simulator::default().run_trials(&setting, &trials)).map(wrong).collect()
}

#[test]
fn quick_gates_are_right_in_each_cycle_of_a_new_pattern() {
    for robot in quick_gates() {
        assert!(wrong_cycles(&robot, &[stream(25, 0)])[0].is_empty(), "{}", robot.name);
    }
}

#[test]
#[ignore = "ten seconds; `cargo test --test it a_thousand_cycles -- --ignored`"]
fn quick_gates_are_right_in_a_thousand_cycles_of_a_new_pattern() {
    let plans: Vec<Vec<Pattern>> = (0..16).map(|seed| stream(65, seed)).collect();
    for robot in quick_gates() {
        assert!(wrong_cycles(&robot, &plans).iter().all(Vec::is_empty), "{}", robot.name);
    }
}

/// Counts the errors that come once in thousands of cycles: under random patterns, and under each pair in turn.
#[test]
#[ignore = "minutes; `cargo test --test it errors_of_long_runs -- --ignored --nocapture`"]
fn errors_of_long_runs() {
    let random = (0..8).map(|seed| stream(1025, seed));
    let pairs = (0..4).flat_map(|first| (first + 1..4).map(move |second| [first, second]));
    let turns = pairs.map(|pair| (0..2049).map(|at| Pattern::PAIRS[pair[at % 2]]).collect());
    let plans: Vec<Vec<Pattern>> = random.chain(turns).collect();
    println!("robot             random  in turn  first");
    let mut errors = 0;
    for robot in quick_gates().iter().filter(|robot| robot.function().arity() > 0) {
        let wrong = wrong_cycles(robot, &plans);
        let count = |some: &[Vec<usize>]| some.iter().map(Vec::len).sum::<usize>();
        let first = wrong.iter().filter_map(|cycles| cycles.first()).min();
        let first = first.map_or("-".to_owned(), ToString::to_string);
        errors += count(&wrong);
        println!("{:<16}  {:>6}  {:>7}  {first}", robot.name, count(&wrong[..8]), count(&wrong[8..]));
    }
    assert_eq!(errors, 0);
}
