//! `nbc draw`: one picture, film, waveform or page of a robot, a library, an evolution run or a circuit's swarm.

mod arguments;
mod canvas;
mod kind;
mod options;
mod robot;
mod run;
mod several;
mod swarm;

use std::path::Path;

use crate::cli::{Context, Failure, OutputFormat, Status, robots, schedule};
use crate::model::{Behavior, Schedule};
use crate::report::{Schema, Scheme};
use crate::source::Sources;
use crate::store;

use crate::cli::wording::DrawError;
use canvas::Canvas;
use options::Drawn;
use robot::Subject;

pub(super) use arguments::DrawArguments;
pub(super) use run::{is_run, page as run_page, read as read_run};

/// The default schedule of robots: every pattern as long as in the paper.
const SCHEDULE: &str = "00*10 01*10 10*10 11*10";

impl DrawArguments {
    /// Draws and writes.
    ///
    /// # Errors
    /// When the subject is invalid, has no such picture, or the file cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let canvas = Canvas::new(&self.output, self.kind)?;
        let drawn = self.drawn();
        self.check_options(drawn)?;
        match drawn {
            Drawn::Program => self.draw_program(&canvas)?,
            Drawn::Run => {
                let results = run::read(Path::new(&self.what), context)?;
                match self.behavior {
                    Some(behavior) => self.draw_robot(&canvas, &self.champion(&results, behavior)?)?,
                    None => self.draw_run(&canvas, &results)?,
                }
            }
            Drawn::Library => self.draw_library(&canvas)?,
            Drawn::Robot => self.draw_robot(&canvas, &self.robot()?)?,
        }
        if context.format == OutputFormat::Json {
            let drawn = serde_json::json!({ "file": self.output, "kind": self.kind.word() });
            context.print_json(Schema::Drawn, &drawn)?;
        }
        Ok(Status::Done)
    }

    fn drawn(&self) -> Drawn {
        let path = Path::new(&self.what);
        match () {
            () if self.what.ends_with(".nb") => Drawn::Program,
            () if run::is_run(path) => Drawn::Run,
            () if self.what == "shipped" || path.is_dir() => Drawn::Library,
            () => Drawn::Robot,
        }
    }

    fn draw_library(&self, canvas: &Canvas) -> Result<(), Failure> {
        let folder = Path::new(&self.what);
        let library = if self.what == "shipped" { store::shipped_library() } else { robots::robots(folder)? };
        match self.behavior {
            None => self.draw_several(canvas, &several::of_library(&self.what, &library)),
            Some(behavior) => {
                let robot = library.robots_for(behavior.function()).next();
                let robot = robot.ok_or_else(|| self.none_of(behavior))?;
                self.draw_robot(canvas, &Subject::of(robot))
            }
        }
    }

    fn robot(&self) -> Result<Subject, Failure> {
        let body = robots::read_body(&self.what)?;
        match robots::find(&store::shipped_library(), &self.what) {
            Ok(robot) => Ok(Subject::of(robot)),
            Err(_) => {
                let title = Path::new(&self.what).file_stem().map(|stem| stem.to_string_lossy().into_owned());
                Ok(Subject { title: title.unwrap_or_default(), body })
            }
        }
    }

    fn none_of(&self, behavior: Behavior) -> Failure {
        DrawError::UnknownBehavior { what: self.what.clone(), behavior }.into()
    }

    fn scheme(&self) -> Scheme {
        if self.safe_colors { Scheme::Safe } else { Scheme::Paper }
    }

    fn schedule(&self) -> Result<Schedule, Failure> {
        let mut sources = Sources::default();
        let id = sources.add("--schedule", self.schedule.as_deref().unwrap_or(SCHEDULE));
        schedule::parse(sources.file(id)).map_err(|faults| Failure::input(faults, sources))
    }

    /// The error for a picture that this subject does not have.
    fn not_of(&self, given: &'static str, wanted: &'static str) -> Failure {
        DrawError::Kind { what: self.what.clone(), given, expected: wanted, kind: self.kind.word() }.into()
    }
}
