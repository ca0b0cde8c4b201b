//! A page with a player, or with all plots of a run.

use crate::cli::Failure;
use crate::cli::draw::evolution_run::each_champion;
use crate::cli::draw::picture::{Drawing, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::pictures::comparison::comparison;
use crate::cli::draw::pictures::progress::progress;
use crate::cli::draw::pictures::spacetime::champions;
use crate::cli::draw::request::DrawRequest;
use crate::cli::runs::run_page as swarm_page;
use nbc_base::model::{CYCLE_STEPS, Pattern, Schedule, SearchObjective, Spell};
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

    fn of_run(&self, results: &EvolutionResults, request: &DrawRequest) -> Result<Drawing, Failure> {
        Ok(Drawing::Text(run_page(results, request.scheme())))
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawing, Failure> {
        Ok(Drawing::Text(swarm_page(&request.what, &request.ran(Some(Room::SWARM))?, request.scheme())))
    }
}

/// The page of a run with all its plots.
pub(in crate::cli) fn run_page(results: &EvolutionResults, scheme: Scheme) -> String {
    let spell = |pattern| Spell { pattern, steps: 10 * CYCLE_STEPS };
    let schedule = Schedule { spells: Pattern::all(results.stimuli).map(spell).collect() };
    let figure = |heading: &str, drawing| PageFigure { heading: heading.to_owned(), drawing };
    let mut figures = vec![
        figure("Progress", progress(results)),
        figure("Champions in space and time", champions(&each_champion(results), &schedule)),
    ];
    if results.objective == SearchObjective::Distance && results.stimuli == 2 {
        figures.push(figure("Groups of behaviors", comparison(results)));
    }
    report::draw_evolution_page(results, &figures, scheme)
}
