//! A page with a player, or with all plots of a run.

use crate::cli::Failure;
use crate::cli::draw::evolution_run::each_champion;
use crate::cli::draw::faults;
use crate::cli::draw::picture::{Drawing, Drawn, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::pictures::comparison::comparison;
use crate::cli::draw::pictures::progress::progress;
use crate::cli::draw::pictures::spacetime::champions;
use crate::cli::draw::request::DrawRequest;
use crate::cli::runs::run_page as swarm_page;
use nbc_base::diag::Diagnostic;
use nbc_base::model::SearchObjective;
use nbc_session::report::{self, EvolutionResults, PageFigure, Scheme};
use nbc_swarm::Room;

pub(super) struct PagePicture;

impl PictureKind for PagePicture {
    fn description(&self) -> KindDescription {
        let extensions = &["html"];
        let options = &["--safe-colors"];
        KindDescription {
            extensions,
            options,
            ..KindDescription::new("report", "A page with a player", SubjectKind::Program)
        }
    }

    fn of_run(&self, results: &EvolutionResults, request: &DrawRequest) -> Result<Drawn, Failure> {
        let (page, faults) = run_page(results, request.scheme());
        Ok(Drawn { drawing: Drawing::Text(page), faults })
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawn, Failure> {
        let ran = request.ran(Some(Room::SWARM))?;
        let page = swarm_page(&request.what, &ran, request.scheme());
        Ok(Drawn { drawing: Drawing::Text(page), faults: faults::of_swarm(&ran.swarm().trace) })
    }
}

pub(in crate::cli) fn run_page(results: &EvolutionResults, scheme: Scheme) -> (String, Vec<Diagnostic>) {
    let figure = |heading: &str, drawing| PageFigure { heading: heading.to_owned(), drawing };
    let (paths, faults) = champions(&each_champion(results), &results.shown(10));
    let mut figures = vec![figure("Progress", progress(results)), figure("Champions in space and time", paths)];
    if results.objective == SearchObjective::Distance && results.stimuli == 2 {
        figures.push(figure("Groups of behaviors", comparison(results)));
    }
    (report::draw_evolution_page(results, &figures, scheme), faults)
}
