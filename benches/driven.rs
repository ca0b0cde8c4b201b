//! Env steps per second of different robots that are driven from outside, on flat ground and on stairs, with each
//! kernel in turn: `cargo bench --bench driven`. It prints medians of the rounds with their range, in CPU time.

use nbc_sim::{Constants, Grid, InstructionSet, Kernel, Scene, SceneObject, Scenes};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use processor::processor_seconds;

mod processor;

/// Columns and rows of a body.
const SIDE: usize = 5;
const BODIES: usize = 64;
const ROUNDS: usize = 15;
/// Env steps of a round.
const STEPS: usize = 40;
/// Columns of the ground.
const WIDTH: usize = 100;

fn main() {
    // One thread, because the figures are for one core.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool of one thread");
    for (name, heights) in [("flat", [0; 4]), ("stairs", [0, 1, 2, 1])] {
        pool.install(|| race(name, heights));
    }
}

/// Times each kernel on ground of these heights.
fn race(name: &str, heights: [usize; 4]) {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let bodies: Vec<Grid> = (0..BODIES).map(|_| body(&mut random)).collect();
    let ground = ground(heights);
    let mut found: Vec<(Kernel, Scenes, Vec<f64>)> = Vec::new();
    let kernels = InstructionSet::available().into_iter().flat_map(|set| [4, 8].map(|lanes| Kernel::new(set, lanes)));
    for kernel in [Some(Kernel::SCALAR)].into_iter().chain(kernels).flatten() {
        let scene = |body: &Grid| {
            let objects = [(body, [1, 1]), (&ground, [0, 0])];
            let objects = objects.map(|(grid, at)| SceneObject { grid: grid.clone(), at });
            Scene::new(&objects, &Constants::default())
        };
        found.push((kernel, Scenes::with_kernel(bodies.iter().map(scene).collect(), kernel), Vec::new()));
    }
    for round in 0..ROUNDS {
        for (_, scenes, rates) in &mut found {
            rates.push(rate(scenes, round));
        }
    }
    for (kernel, _, mut rates) in found {
        rates.sort_by(f64::total_cmp);
        let (set, lanes) = (kernel.set().name(), kernel.lanes());
        let (median, least, most) = (rates[ROUNDS / 2], rates[0], rates[ROUNDS - 1]);
        println!("{name:6} {lanes} lanes, {set:8} {median:7.0} ({least:.0} to {most:.0})");
    }
}

/// Env steps per second of CPU time under random targets.
fn rate(scenes: &mut Scenes, round: usize) -> f64 {
    (0..scenes.len()).for_each(|n| scenes.reset(n));
    let mut random = ChaCha8Rng::seed_from_u64(round as u64);
    let start = processor_seconds();
    for _ in 0..STEPS {
        for n in 0..scenes.len() {
            let targets: Vec<f64> = (0..scenes.scene(n).targets()).map(|_| random.random_range(0.6..1.6)).collect();
            scenes.set_targets(n, &targets);
        }
        scenes.advance(1);
    }
    (STEPS * scenes.len()) as f64 / (processor_seconds() - start)
}

/// A random body in one piece with an actuator: two fifths of its cells are empty.
fn body(random: &mut ChaCha8Rng) -> Grid {
    loop {
        let code = |_| match random.random_range(0..20u8) {
            ..8 => 0,
            other => 1 + other % 4,
        };
        let codes: Vec<u8> = (0..SIDE * SIDE).map(code).collect();
        if is_in_one_piece(&codes) && codes.iter().any(|code| *code > 2) {
            return Grid::structure(SIDE, SIDE, &codes);
        }
    }
}

fn is_in_one_piece(codes: &[u8]) -> bool {
    let mut left: Vec<usize> = (0..codes.len()).filter(|at| codes[*at] > 0).collect();
    let mut reached: Vec<usize> = left.pop().into_iter().collect();
    while let Some(at) = reached.pop() {
        let is_near = |other: &usize| {
            let apart = |one: usize, two: usize| one.abs_diff(two);
            apart(at / SIDE, other / SIDE) + apart(at % SIDE, other % SIDE) == 1
        };
        reached.extend(left.iter().copied().filter(is_near));
        left.retain(|other| !is_near(other));
    }
    left.is_empty()
}

/// Ground of columns of these heights above its lowest row, five of each, which repeat.
fn ground(heights: [usize; 4]) -> Grid {
    let rows = heights.iter().max().map_or(1, |most| most + 1);
    let is_there = |row: usize, column: usize| rows - 1 - row <= heights[column / SIDE % heights.len()];
    let codes: Vec<u8> = (0..rows * WIDTH).map(|at| if is_there(at / WIDTH, at % WIDTH) { 5 } else { 0 }).collect();
    Grid::structure(WIDTH, rows, &codes)
}
