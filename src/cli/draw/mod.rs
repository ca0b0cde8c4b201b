//! `nbc draw`: one picture, film, waveform or page of a robot, a library, an evolution run or a circuit's swarm.

mod arguments;
mod canvas;
mod kind;
mod options;
mod order;
mod picture;
mod pictures;
mod program;
mod robot;
mod run;
mod several;

use std::path::Path;

use crate::cli::{Context, Failure, OutputFormat, Status, robots};
use nbc_session::report::Schema;
use nbc_session::store;

use canvas::Canvas;
use kind::Kind;
use order::Order;
use picture::{Drawing, PictureKind, SubjectKind};
use robot::TitledBody;

pub(super) use arguments::DrawArguments;
pub(super) use pictures::run_page;
pub(super) use run::{is_run, read as read_run};

impl DrawArguments {
    /// Draws and writes.
    ///
    /// # Errors
    /// When the subject is invalid, has no such picture, or the file cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let Self { kind: Kind(kind), output, order } = self;
        let canvas = Canvas::new(&output, kind)?;
        let subject = subject_kind(&order.what);
        options::check_options(&order, kind, subject)?;
        canvas.write(draw(kind, subject, &order, context)?)?;
        if context.format == OutputFormat::Json {
            let drawn = serde_json::json!({ "file": output, "kind": kind.word() });
            context.print_json(Schema::Drawn, &drawn)?;
        }
        Ok(Status::Done)
    }
}

fn subject_kind(what: &str) -> SubjectKind {
    let path = Path::new(what);
    match () {
        () if what.ends_with(".nb") => SubjectKind::Program,
        () if run::is_run(path) => SubjectKind::Run,
        () if what == "shipped" || path.is_dir() => SubjectKind::Library,
        () => SubjectKind::Robot,
    }
}

fn draw(kind: &dyn PictureKind, subject: SubjectKind, order: &Order, context: &Context) -> Result<Drawing, Failure> {
    match subject {
        SubjectKind::Program => kind.of_program(order),
        SubjectKind::Run => {
            let results = run::read(Path::new(&order.what), context)?;
            let Some(behavior) = order.behavior else { return kind.of_run(&results, order) };
            let robot = run::champion(&results, behavior).ok_or_else(|| order.none_of(behavior))?;
            kind.of_robot(&robot, order)
        }
        SubjectKind::Library => draw_library(kind, order),
        SubjectKind::Robot => kind.of_robot(&robot(&order.what)?, order),
    }
}

fn draw_library(kind: &dyn PictureKind, order: &Order) -> Result<Drawing, Failure> {
    let what = &order.what;
    let library = if what == "shipped" { store::shipped_library() } else { robots::robots_of(Path::new(what))? };
    let Some(behavior) = order.behavior else {
        return kind.of_library(&several::of_library(what, &library), order);
    };
    let robot = library.robots_for(behavior.function()).next();
    kind.of_robot(&TitledBody::of(robot.ok_or_else(|| order.none_of(behavior))?), order)
}

fn robot(what: &str) -> Result<TitledBody, Failure> {
    let body = robots::read_body(what)?;
    match robots::find(&store::shipped_library(), what) {
        Ok(robot) => Ok(TitledBody::of(robot)),
        Err(_) => {
            let title = Path::new(what).file_stem().map(|stem| stem.to_string_lossy().into_owned());
            Ok(TitledBody { title: title.unwrap_or_default(), body })
        }
    }
}
