//! `nbc draw`: one picture, film, waveform or page of a robot, a library, an evolution run or a circuit's swarm.

mod canvas;
mod kind;
mod options;
mod robot;
mod run;
mod several;
mod swarm;

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::program::{CircuitArguments, RunsArguments};
use crate::cli::{Context, Failure, Format, Status, library, schedule, simulate};
use crate::diag::{Code, Diagnostic};
use crate::model::{Behavior, Schedule};
use crate::report::{Schema, Scheme};
use crate::source::Sources;
use crate::store;

use canvas::Canvas;
use kind::Kind;
use options::Drawn;
use robot::Subject;

pub(super) use run::{is_run, page as run_page, read as read_run};

/// The stimuli of robots where none are given: every pattern as long as in the paper.
const SCHEDULE: &str = "00*10 01*10 10*10 11*10";

/// Draw a robot, a library, an evolution run, or a circuit and its swarm
#[derive(Args)]
#[command(after_help = "\
Examples:
  nbc draw nand --as gif --schedule '00*4 11*4' -o nand.gif
  nbc draw body.yaml --as strip -o gait.svg
  nbc draw shipped --as sprite -o library.png          the built-in library
  nbc draw circuits/latch.nb --as schematic -o latch.svg
  nbc draw out/gates --as heatmap --axes voxels,active -o archive.png
  nbc draw out/gates --behavior RRRL --as strip -o nand.png

docs/pictures.md shows every kind.")]
pub struct Arguments {
    /// A file with a body, a robot of the library, a folder of robot files, `shipped`, the folder of a run, or a source
    /// file (.nb)
    what: String,
    /// The kind of picture
    #[arg(long = "as", value_enum)]
    kind: Kind,
    /// The file to write: `.svg` or `.png` for pictures, `.gif`, `.png` or `.apng` for films, `.vcd`, `.dot`, `.html`
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The schedule of a robot's stimuli, as in `nbc simulate` [default: 00*10 01*10 10*10 11*10]
    #[arg(long)]
    schedule: Option<String>,
    /// The cycle of a pose [default: the end of the schedule]
    #[arg(long, value_name = "CYCLE", value_parser = cycle, allow_negative_numbers = true)]
    at: Option<f64>,
    /// The best robot with this behavior, from a library or a run
    #[arg(long, value_name = "BEHAVIOR")]
    behavior: Option<Behavior>,
    /// The two axes of a heat map: `voxels`, `active`, `sensory`, `behavior` [default: the first two]
    #[arg(long, value_name = "X,Y", value_delimiter = ',')]
    axes: Vec<String>,
    /// Show only these robots of a swarm, by the nets they drive, with the inputs of the swarm; `count*` selects every
    /// net that begins with `count`
    #[arg(long, value_name = "NET,…", value_delimiter = ',')]
    robots: Vec<String>,
    #[command(flatten)]
    circuit: CircuitArguments,
    /// A test of a source file, by its title or its circuit [default: the first]
    #[arg(long, value_name = "NAME")]
    test: Option<String>,
    #[command(flatten)]
    runs: RunsArguments,
    /// Colors that people with any color vision can tell apart
    #[arg(long)]
    safe_colors: bool,
}

impl Arguments {
    /// Draws and writes.
    ///
    /// # Errors
    /// When the subject is invalid, has no such picture, or the file cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let canvas = Canvas::new(&self.output, self.kind).map_err(Failure::plain)?;
        let drawn = self.drawn();
        self.check_options(drawn).map_err(Failure::plain)?;
        match drawn {
            Drawn::Program => self.draw_program(&canvas)?,
            Drawn::Run => {
                let harvest = run::read(Path::new(&self.what), context)?;
                match self.behavior {
                    Some(behavior) => self.draw_robot(&canvas, &self.champion(&harvest, behavior)?)?,
                    None => self.draw_run(&canvas, &harvest)?,
                }
            }
            Drawn::Library => self.draw_library(&canvas)?,
            Drawn::Robot => self.draw_robot(&canvas, &self.robot()?)?,
        }
        if context.format == Format::Json {
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
        let library = if self.what == "shipped" { store::shipped_library() } else { library::robots(folder)? };
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
        let body = simulate::read_body(&self.what)?;
        match library::find(&store::shipped_library(), &self.what) {
            Ok(robot) => Ok(Subject::of(robot)),
            Err(_) => {
                let title = Path::new(&self.what).file_stem().map(|stem| stem.to_string_lossy().into_owned());
                Ok(Subject { title: title.unwrap_or_default(), body })
            }
        }
    }

    fn none_of(&self, behavior: Behavior) -> Failure {
        let message = format!("`{}` has no robot of the behavior `{behavior}`", self.what);
        Failure::plain(Diagnostic::without_place(Code::Unknown, message))
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
    fn not_of(&self, given: &str, wanted: &str) -> Failure {
        let message = format!("`{}` is {given}, expected {wanted} for `--as {}`", self.what, self.kind.word());
        Failure::plain(Diagnostic::without_place(Code::BadValue, message))
    }
}

/// A moment in cycles from the start.
fn cycle(text: &str) -> Result<f64, String> {
    let cycle = text.parse().ok().filter(|cycle: &f64| cycle.is_finite() && *cycle >= 0.0);
    cycle.ok_or_else(|| "expected a number of cycles, 0 or more".to_owned())
}
