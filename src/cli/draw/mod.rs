//! `nbc draw`: one picture, film, waveform or page of a robot, a library, an evolution run or a circuit's swarm.

mod arguments;
mod canvas;
mod evolution_run;
mod faults;
mod film;
mod kinds;
mod options;
mod picture;
mod program;
mod program_pictures;
mod request;
mod robot_pictures;
mod run_pictures;
mod spacetime;
mod titled;
pub(super) mod wording;

use std::path::Path;

use serde::Serialize;

use crate::cli::options::robots::RobotsArguments;
use crate::cli::{Context, Failure, OutputFormat, Status, robots};
use nbc_base::source::Sources;
use nbc_session::report::Schema;
use nbc_session::store;

use canvas::Canvas;
use kinds::Kind;
use picture::{Drawn, PictureKind, SubjectKind};
use request::DrawRequest;
use titled::TitledBody;

pub(super) use arguments::DrawArguments;
pub(super) use evolution_run::{is_run, read as read_run};
pub(super) use run_pictures::run_page;

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct DrawnFile {
    file: String,
    /// As in `--as`.
    kind: &'static str,
}

impl DrawArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let Self { kind: Kind(kind), output, request } = self;
        let canvas = Canvas::new(&output, kind)?;
        let subject = subject_kind(&request.what);
        options::check_options(&request, kind, subject)?;
        let Drawn { drawing, faults } = draw(kind, subject, &request, context)?;
        canvas.write(drawing)?;
        context.tell(&faults, &Sources::default());
        context.wrote(&output);
        if context.format == OutputFormat::Json {
            let drawn = DrawnFile { file: output.display().to_string(), kind: kind.word };
            context.print_json(Schema::Drawn, &drawn)?;
        }
        Ok(Status::Done)
    }
}

fn subject_kind(what: &str) -> SubjectKind {
    let path = Path::new(what);
    match () {
        () if what.ends_with(".nb") => SubjectKind::Program,
        () if evolution_run::is_run(path) => SubjectKind::Run,
        () if store::built_in(what).is_some() || path.is_dir() => SubjectKind::Library,
        () => SubjectKind::Robot,
    }
}

fn draw(kind: &PictureKind, subject: SubjectKind, request: &DrawRequest, context: &Context) -> Result<Drawn, Failure> {
    match subject {
        SubjectKind::Program => kind.of_program(request),
        SubjectKind::Run => {
            let results = evolution_run::read(Path::new(&request.what), context)?;
            let Some(behavior) = request.behavior else { return kind.of_run(&results, request) };
            let robot = evolution_run::champion(&results, behavior).ok_or_else(|| request.none_of(behavior))?;
            kind.of_robot(&robot, request)
        }
        SubjectKind::Library => draw_library(kind, request),
        SubjectKind::Robot => kind.of_robot(&robot(&request.what, &request.making.library)?, request),
    }
}

fn draw_library(kind: &PictureKind, request: &DrawRequest) -> Result<Drawn, Failure> {
    let what = &request.what;
    let library = robots::robots_of(Path::new(what))?;
    let Some(behavior) = request.behavior else {
        return kind.of_library(&titled::of_library(what, &library), request);
    };
    let robot = library.robots_for(behavior.function()).next();
    kind.of_robot(&TitledBody::of(robot.ok_or_else(|| request.none_of(behavior))?), request)
}

fn robot(what: &str, library: &RobotsArguments) -> Result<TitledBody, Failure> {
    let (body, library) = (robots::read_body(what, library)?, robots::named_library(library)?);
    match robots::find(&library, what) {
        Ok(robot) => Ok(TitledBody::of(robot)),
        Err(_) => {
            let title = Path::new(what).file_stem().map(|stem| stem.to_string_lossy().into_owned());
            Ok(TitledBody { title: title.unwrap_or_default(), body })
        }
    }
}
