//! Substeps per second for bodies of the paper's three boxes: one simulation alone, and eight in parallel with each
//! instruction set of the processor, with one body or eight different ones.
//!
//! `cargo bench --bench substeps` prints, for each, elements (lane-substeps) per second of one core.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use nbc_base::model::{Body, CYCLE_STEPS, Pattern, Schedule, Setting, Trial};
use nbc_sim::{Constants, InstructionSet, Kernel, LaneBackend, Simulator};

fn substeps(criterion: &mut Criterion) {
    let setting = Setting::default();
    // One thread, because the figures are for one core.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool of one thread");
    let mut group = criterion.benchmark_group("substeps");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    let wide = InstructionSet::available().into_iter().filter_map(|set| Kernel::new(set, 8));
    let kernels: Vec<Kernel> = [Kernel::SCALAR].into_iter().chain(wide).collect();
    for side in [5, 7, 10] {
        for &kernel in &kernels {
            for bodies in ["one body", "different bodies"] {
                let shift = |lane| if bodies == "one body" { 0 } else { lane };
                let schedule = Schedule::constant(Pattern::PAIRS[1], CYCLE_STEPS);
                let trial = |lane| Trial { body: Body::patchwork(side, shift(lane)), schedule: schedule.clone() };
                let trials: Vec<Trial> = (0..kernel.lanes()).map(trial).collect();
                if kernel.lanes() == 1 && bodies != "one body" {
                    continue;
                }
                let simulator = Simulator::new(LaneBackend { kernel, ..LaneBackend::default() });
                let substeps = u64::from(CYCLE_STEPS * Constants::default().substeps);
                group.throughput(Throughput::Elements(kernel.lanes() as u64 * substeps));
                let name = format!("{} lanes, {}, {bodies}", kernel.lanes(), kernel.set().name());
                group.bench_function(BenchmarkId::new(format!("{side}x{side}"), name), |bencher| {
                    bencher.iter(|| pool.install(|| black_box(simulator.run_trials(&setting, &trials))));
                });
            }
        }
    }
    group.finish();
}

criterion_group!(benches, substeps);
criterion_main!(benches);
