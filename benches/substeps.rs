//! Substeps a second for bodies of the paper's three boxes: one simulation alone, and as many in the lanes as the processor has.
//!
//! `cargo bench` prints, for each box, elements (lane-substeps) a second.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use nbc::model::{Body, Pattern, Schedule, Setting, Trial};
use nbc::sim::run_trials;

/// Env steps of one trial: a cycle.
const STEPS: u32 = 84;
/// Substeps of an env step (docs/physics.md 1).
const SUBSTEPS: u64 = 30;

/// A body of every material, as large as its box.
fn body(side: usize) -> Body {
    let codes = (0..side * side).map(|i| [3, 4, 2, 7, 6, 1, 5, 8, 3][(i + i / side) % 9]).collect();
    Body::new(side, side, codes)
}

fn substeps(criterion: &mut Criterion) {
    let setting = Setting::paper();
    // One thread: the figures are those of one core.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool of one thread");
    let mut group = criterion.benchmark_group("substeps");
    group.sample_size(10).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(3));
    for side in [5, 7, 10] {
        for trials in [1, 8] {
            let trial = Trial { body: body(side), schedule: Schedule::constant(Pattern::PAIRS[1], STEPS) };
            let batch = vec![trial; trials];
            group.throughput(Throughput::Elements(trials as u64 * u64::from(STEPS) * SUBSTEPS));
            group.bench_function(BenchmarkId::new(format!("{side}x{side}"), format!("{trials} at once")), |bencher| {
                bencher.iter(|| pool.install(|| black_box(run_trials(&setting, &batch))));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, substeps);
criterion_main!(benches);
