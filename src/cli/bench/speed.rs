//! Lane-substeps per second of one core.

use std::sync::Arc;
use std::time::{Duration, Instant};

use nbc_base::model::{Body, CYCLE_STEPS, Pattern, Schedule, Setting, Trial};
use nbc_sim::{Constants, Kernel, LaneBackend, Meter, Simulator};

const PATIENCE: Duration = Duration::from_millis(500);

pub(super) fn cycle_substeps() -> f64 {
    f64::from(CYCLE_STEPS * Constants::default().substeps)
}

/// Lane-substeps per second, with lanes whose bodies are `shift` apart.
pub(super) fn race(side: usize, kernel: Kernel, shift: usize, meter: Option<&Arc<Meter>>) -> f64 {
    let schedule = Schedule::constant(Pattern::PAIRS[1], CYCLE_STEPS);
    let trial = |lane| Trial { body: Body::patchwork(side, lane * shift), schedule: schedule.clone() };
    let trials: Vec<Trial> = (0..kernel.lanes()).map(trial).collect();
    let backend = LaneBackend { kernel, meter: meter.cloned(), ..LaneBackend::default() };
    let simulator = Simulator::new(backend);
    let setting = Setting::default();
    let work = trials.len() as f64 * cycle_substeps();
    let simulate = || {
        simulator.run_trials(&setting, &trials);
        work
    };
    // One thread takes all lanes as one batch.
    on_one_thread(|| per_second(PATIENCE, processor_seconds, simulate))
}

pub(super) fn on_one_thread<T: Send>(measure: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread can be started").install(measure)
}

/// Work per second by a clock in seconds, or in wall-clock time if the system does not have it. `step` returns the work
/// that it has done.
pub(super) fn per_second(patience: Duration, clock: fn() -> Option<f64>, mut step: impl FnMut() -> f64) -> f64 {
    let (start, spent, mut work) = (Instant::now(), clock(), 0.0);
    while start.elapsed() < patience {
        work += step();
    }
    work / clock().zip(spent).map_or(start.elapsed().as_secs_f64(), |(now, then)| now - then)
}

/// CPU time of this thread, in seconds, if the system has it (Linux). Other programs do not distort it.
pub(super) fn processor_seconds() -> Option<f64> {
    let statistics = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = statistics.split_whitespace().next()?.parse().ok()?;
    (nanoseconds > 0.0).then_some(nanoseconds / 1e9)
}
