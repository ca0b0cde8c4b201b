//! A search for gates around a body, shown while it runs.

use crate::bodies;
use crate::jobs::{Job, PortionEnd};
use crate::message::{ArchiveChange, AxisEntry, EvolutionEnd, NicheEntry, PlayEvent, RequestResult};
use crate::refusal::Refused;
use crate::request::EvolveRequest;
use nbc_base::model::{Axis, Body};
use nbc_session::report::axis_word;
use nbc_session::{BodySearch, Observer};
use nbc_swarm::evolve::{Elite, NicheKey};

/// The largest and the smallest side of a box, and the most generations.
const SIDES: std::ops::RangeInclusive<usize> = 2..=10;
const MOST_GENERATIONS: u32 = 1000;

/// A search that begins.
///
/// # Errors
/// When the body is not one, or the box is too small or too large.
pub(super) fn begin(request: &EvolveRequest) -> Result<BodySearch, Refused> {
    let start = request.body.as_deref().map(bodies::body).transpose()?;
    let [width, height] = start.as_ref().map_or(request.bounds, |body| [body.width(), body.height()]);
    if !SIDES.contains(&width) || !SIDES.contains(&height) {
        let sides = format!("expected a box of {} to {} voxels a side", SIDES.start(), SIDES.end());
        return Err(Refused::Body(sides));
    }
    let generations = request.generations.clamp(1, MOST_GENERATIONS);
    Ok(BodySearch::new(start, [width, height], generations, request.seed))
}

/// Does a generation, and reports the niches that have changed.
///
/// # Errors
/// When it is stopped.
pub(super) fn advance(search: &mut BodySearch, job: &mut Job) -> Result<PortionEnd, Refused> {
    job.check()?;
    // A body without a third stimulus would have another behavior in the designer.
    let fits = |body: &Body| bodies::body(&body.rows()).is_ok_and(|own| own.palette() == body.palette());
    let changed = search.advance(&job.simulator(), fits);
    job.outbox.event(PlayEvent::Archive(change(search, job.id, &changed)));
    let (done, generations) = (search.search().generation(), search.search().evolution().generations);
    job.progress(done.into(), generations.into());
    if done < generations {
        return Ok(PortionEnd::More);
    }
    job.check()?;
    let end = EvolutionEnd { generations, evaluations: search.search().evaluations() };
    Ok(PortionEnd::Done(Some(RequestResult::Evolve(end))))
}

fn change(search: &BodySearch, id: u64, changed: &[NicheKey]) -> ArchiveChange {
    let search = search.search();
    let evolution = search.evolution();
    let axis = |&axis: &Axis| AxisEntry(axis_word(axis), axis.bins(evolution.palette.inputs()));
    let niche = |(key, elite): (&NicheKey, &Elite)| NicheEntry {
        place: key.0.clone(),
        fitness: elite.fitness,
        body: elite.body.rows(),
        letters: elite.behavior.to_string(),
        function: elite.behavior.function().name(),
    };
    ArchiveChange {
        id,
        generation: search.generation(),
        axes: evolution.descriptors.iter().map(axis).collect(),
        niches: search.best().filter(|(key, _)| changed.contains(key)).map(niche).collect(),
        evaluations: search.evaluations(),
    }
}
