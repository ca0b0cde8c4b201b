//! A search for gates around a body, shown while it runs.

use std::sync::Arc;

use crate::bodies;
use crate::crew_part::{CrewPart, CrewResult, GivenParts};
use crate::jobs::{Job, PortionEnd};
use crate::message::{ArchiveChange, EvolutionEnd, PlayEvent, RequestResult};
use crate::refusal::Refused;
use crate::request::EvolveRequest;
use crate::shell::{Crew, Shell};
use nbc_base::model::Body;
use nbc_session::report::{ArchiveAxis, EliteData};
use nbc_session::{BodySearch, Observer};
use nbc_swarm::evolve::{NicheKey, Scores};

const SIDES: std::ops::RangeInclusive<usize> = 2..=10;
const MOST_GENERATIONS: u32 = 1000;

const LEAST_BODIES: usize = 2;

pub(super) struct SharedSearch {
    search: BodySearch,
    shell: Arc<dyn Shell>,
    begun: Option<BegunGeneration>,
}

struct BegunGeneration {
    bodies: Vec<Body>,
    own: Vec<Option<Scores>>,
    others: Arc<GivenParts>,
}

impl SharedSearch {
    pub(super) fn begin(request: &EvolveRequest, shell: Arc<dyn Shell>) -> Result<Self, Refused> {
        let start = request.body.as_deref().map(bodies::body).transpose()?;
        let [width, height] = start.as_ref().map_or(request.bounds, |body| [body.width(), body.height()]);
        if !SIDES.contains(&width) || !SIDES.contains(&height) {
            let sides = format!("expected a box of {} to {} voxels a side", SIDES.start(), SIDES.end());
            return Err(Refused::Body(sides));
        }
        let generations = request.generations.clamp(1, MOST_GENERATIONS);
        let search = BodySearch::new(start, [width, height], generations, request.seed);
        Ok(Self { search, shell, begun: None })
    }

    pub(super) fn advance(&mut self, job: &mut Job) -> Result<PortionEnd, Refused> {
        job.check()?;
        let Some((bodies, found)) = self.generation(job) else { return Ok(PortionEnd::Waits) };
        let changed = self.search.tell(bodies, found);
        let search = self.search.search();
        job.outbox.event(PlayEvent::Archive(change(&self.search, job.id, &changed)));
        let (done, generations) = (search.generation(), search.evolution().generations);
        job.progress(done.into(), generations.into());
        if done < generations {
            return Ok(PortionEnd::More);
        }
        job.check()?;
        let end = EvolutionEnd { generations, evaluations: search.counts().evaluations };
        Ok(PortionEnd::Done(Some(RequestResult::Evolve(end))))
    }

    fn generation(&mut self, job: &Job) -> Option<(Vec<Body>, Vec<Option<Scores>>)> {
        let size = self.shell.crew().map_or(0, Crew::size);
        // Results of workers that have left will not come.
        if let Some(begun) = self.begun.take_if(|_| size > 0) {
            let Some(others) = begun.others.take() else {
                self.begun = Some(begun);
                return None;
            };
            let others = others.into_iter().flat_map(CrewResult::scores);
            return Some((begun.bodies, begun.own.into_iter().chain(others).collect()));
        }
        self.begun = None;
        // A body without a third stimulus would have another behavior in the designer.
        let fits = |body: &Body| bodies::body(&body.rows()).is_ok_and(|own| own.palette() == body.palette());
        let trials = self.search.ask(fits);
        let parts = (trials.bodies.len() / LEAST_BODIES).clamp(1, size + 1);
        let Some(crew) = self.shell.crew().filter(|_| parts > 1) else {
            let found = trials.measure(&job.simulator());
            return Some((trials.bodies, found));
        };
        let mut split = trials.split(parts).into_iter();
        let own = split.next().expect("there is a part");
        let others = crew.give(split.map(|trials| CrewPart::Bodies(Box::new(trials))).collect());
        self.begun = Some(BegunGeneration { bodies: trials.bodies, own: own.measure(&job.simulator()), others });
        None
    }
}

fn change(search: &BodySearch, id: u64, changed: &[NicheKey]) -> ArchiveChange {
    let search = search.search();
    let evolution = search.evolution();
    // A niche of this search has one elite.
    let changed = search.archive().niches().filter(|(key, _)| changed.contains(key));
    ArchiveChange {
        id,
        generation: search.generation(),
        axes: ArchiveAxis::all(&evolution.descriptors, evolution.palette.inputs()),
        niches: changed.map(|(key, elites)| EliteData::of(search.seed(), key, &elites[0])).collect(),
        evaluations: search.counts().evaluations,
    }
}
