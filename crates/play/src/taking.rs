//! Makes files for a page to download from a part of a swarm's run: pages, films, pictures, waveforms and tables.

use std::io;

use crate::export::export;
use crate::jobs::Job;
use crate::live_page::live_page;
use crate::programs;
use crate::refusal::Refused;
use crate::request::TakeKind;
use crate::site::{PlaySite, SCHEME};
use nbc_base::model::CYCLE_STEPS;
use nbc_session::report::{self, FRAMES_PER_CYCLE, Film, Stage, SwarmOutcome};
use nbc_session::{Checked, Choice, Excerpt, RunEnd, Session, SimulationRun, run_page};

pub(super) const HTML: &str = "text/html; charset=utf-8";
const MOST_CYCLES: u32 = 200;
const MOST_FILMED: u32 = 60;

impl TakeKind {
    pub(super) fn most(self) -> u32 {
        if self == Self::Gif { MOST_FILMED } else { MOST_CYCLES }
    }

    /// The ending of its name, and its media type.
    pub(super) fn ending(self) -> (&'static str, &'static str) {
        match self {
            Self::Page => ("html", HTML),
            Self::Gif => ("gif", "image/gif"),
            Self::Png => ("png", "image/png"),
            Self::Svg => ("svg", "image/svg+xml"),
            Self::Vcd => ("vcd", "text/plain; charset=utf-8"),
            Self::Csv => ("csv", "text/csv; charset=utf-8"),
        }
    }
}

pub(super) fn make(session: &Session, excerpt: &Excerpt, kind: TakeKind, job: &mut Job) -> Result<Vec<u8>, Refused> {
    let run = session.replay(excerpt, job);
    if run.end == RunEnd::Cancelled {
        return Err(Refused::Cancelled);
    }
    let trace = &run.swarm.trace;
    Ok(match kind {
        TakeKind::Page => {
            let outcome = SwarmOutcome::Simulation(&run.result);
            run_page(&run.result.circuit, &[(outcome, &run.swarm)], SCHEME).into_bytes()
        }
        TakeKind::Gif => film(excerpt, &run).map_err(|error| Refused::unwritable("film", &error))?,
        TakeKind::Png => report::png(&report::draw_swarm(trace)),
        TakeKind::Svg => report::draw_swarm(trace).finish().into_bytes(),
        TakeKind::Vcd => report::vcd(trace).into_bytes(),
        TakeKind::Csv => report::cycle_table(trace).into_bytes(),
    })
}

pub(super) fn exported(
    session: &Session,
    checked: &Checked,
    choice: &Choice,
    job: &Job,
) -> Result<(String, Vec<u8>), Refused> {
    let (circuit, options) = programs::chosen(checked, choice, job)?;
    let compiled = session.compile(checked, &circuit, &options)?;
    job.check()?;
    let page = export(session, checked, &compiled).map_err(|found| Refused::Export(found.into()))?;
    Ok((format!("{}.html", compiled.plan.circuit.circuit), page.html.into_bytes()))
}

pub(super) fn live(
    site: &PlaySite,
    checked: &Checked,
    choice: &Choice,
    job: &Job,
) -> Result<(String, Vec<u8>), Refused> {
    let template = site.shell.template().ok_or(Refused::NoLivePages)?;
    let (page, _) = live_page(&template, site.folder.world(), checked, choice, &job.options())?;
    Ok((format!("{}.html", page.circuit), page.html.into_bytes()))
}

fn film(excerpt: &Excerpt, run: &SimulationRun) -> io::Result<Vec<u8>> {
    let assembly = &excerpt.compiled.assembly;
    let start = (excerpt.start.robots(), Session::LIVE_CYCLES);
    let stage = Stage::of_running_swarm(assembly, &run.swarm.trace, start, CYCLE_STEPS / FRAMES_PER_CYCLE);
    let sides = assembly.members.iter().map(|member| member.robot.body.width().max(member.robot.body.height()));
    let film = Film {
        title: assembly.circuit.clone(),
        lanes: assembly.members.iter().map(|one| format!("{} ({})", one.net, one.robot.function())).collect(),
        scheme: SCHEME,
        largest: sides.max().unwrap_or(1),
        stimuli: 2,
        ground: stage.ground,
    };
    let mut bytes = Vec::new();
    report::write_gif(&film, stage, &mut bytes, &mut |_| {})?;
    Ok(bytes)
}
