//! Lane-substeps per second of one core for bodies of the paper's three boxes, with each kernel of the processor, one
//! body in all lanes or different ones: `cargo bench --bench substeps`. It prints medians of the rounds with their
//! range, in CPU time.

use nbc_base::model::{Body, CYCLE_STEPS, Pattern, Schedule, Setting, Trial};
use nbc_sim::{Constants, InstructionSet, Kernel, LaneBackend, Simulator};

use processor::processor_seconds;

mod processor;

const ROUNDS: usize = 15;

fn main() {
    // One thread, because the figures are for one core.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool of one thread");
    for side in [5, 7, 10] {
        pool.install(|| race(side));
    }
}

/// Times each kernel with bodies of a full box.
fn race(side: usize) {
    let wide = InstructionSet::available().into_iter().flat_map(|set| [4, 8].map(|lanes| Kernel::new(set, lanes)));
    let kernels: Vec<Kernel> = [Some(Kernel::SCALAR)].into_iter().chain(wide).flatten().collect();
    let cases = kernels.into_iter().flat_map(|kernel| [(kernel, 0), (kernel, 1)]);
    let mut found: Vec<(Kernel, usize, Vec<f64>)> = cases
        .filter(|&(kernel, shift)| kernel.lanes() > 1 || shift == 0)
        .map(|(k, shift)| (k, shift, vec![]))
        .collect();
    for _ in 0..ROUNDS {
        for (kernel, shift, rates) in &mut found {
            rates.push(rate(side, *kernel, *shift));
        }
    }
    for (kernel, shift, mut rates) in found {
        rates.sort_by(f64::total_cmp);
        let bodies = if shift == 0 { "one body" } else { "different bodies" };
        let (set, lanes) = (kernel.set().name(), kernel.lanes());
        let (median, least, most) = (rates[ROUNDS / 2], rates[0], rates[ROUNDS - 1]);
        println!("{side}x{side} {lanes} lanes, {set:8} {bodies:16} {median:9.0} ({least:.0} to {most:.0})");
    }
}

/// Lane-substeps per second of CPU time in a cycle from a fresh start. The bodies of two lanes are `shift` apart.
fn rate(side: usize, kernel: Kernel, shift: usize) -> f64 {
    let schedule = Schedule::constant(Pattern::PAIRS[1], CYCLE_STEPS);
    let trial = |lane| Trial { body: Body::patchwork(side, lane * shift), schedule: schedule.clone() };
    let trials: Vec<Trial> = (0..kernel.lanes()).map(trial).collect();
    let simulator = Simulator::new(LaneBackend { kernel, ..LaneBackend::default() });
    let start = processor_seconds();
    std::hint::black_box(simulator.run_trials(&Setting::default(), &trials));
    f64::from(CYCLE_STEPS * Constants::default().substeps) * trials.len() as f64 / (processor_seconds() - start)
}
