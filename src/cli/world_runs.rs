//! Tests in samples of worlds, in parallel.

use crate::cli::in_order::in_order;
use crate::cli::{Failure, Interrupt, Progress};
use nbc_session::{Session, WorldResult, WorldRun, Yields};
use nbc_swarm::Robustness;

/// Runs each experiment in all worlds, and passes each result to `tell` as soon as those before it are complete. After
/// an interruption, only complete ones are returned.
pub(super) fn world_runs(
    session: &Session,
    yields: &Yields<'_>,
    interrupt: &Interrupt,
    mut tell: impl FnMut(&Robustness) -> Result<(), Failure>,
) -> Result<Vec<Robustness>, Failure> {
    let bar = Progress::new("testing", yields.work());
    let run = |_: usize, &run: &WorldRun| {
        let observe = || interrupt.observe(bar.part());
        if interrupt.is_raised() { None } else { session.run_in_world(yields, run, &mut observe()) }
    };
    let (mut found, mut tally) = (Vec::new(), yields.tally());
    // After an interruption, which is an error without a failure, no more runs are begun.
    let mut take = |done: Option<WorldResult>| {
        let complete = tally.tell(done.ok_or(None)?);
        complete.into_iter().try_for_each(|robustness| {
            tell(&robustness).map_err(Some)?;
            found.push(robustness);
            Ok::<(), Option<Failure>>(())
        })
    };
    match in_order(rayon::current_num_threads(), &yields.runs(), run, |done| bar.suspend(|| take(done))) {
        Err(Some(failure)) => Err(failure),
        Ok(()) | Err(None) => Ok(found),
    }
}
