//! `nbc draw`: one picture of a robot.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use crate::cli::{Context, Failure, Progress, Status, schedule, simulate};
use crate::diag::{Code, Diagnostic};
use crate::model::{Body, Palette, Schedule, Setting, Trial};
use crate::report::{self, Film, STRIDE, Scheme, Stage, Svg};
use crate::sim;
use crate::source::Sources;
use crate::store;

/// Draw a robot as a picture or a film
#[derive(Args)]
#[command(after_help = "Examples:
  nbc draw nand --as gif --schedule '00*4 11*4' -o nand.gif
  nbc draw body.yaml --as strip -o gait.svg")]
pub struct Arguments {
    /// A file with a body, or the name of a robot of the library
    robot: String,
    /// What to draw
    #[arg(long = "as", value_enum)]
    kind: Kind,
    /// The file to write: `.svg` or `.png` for pictures, `.gif`, or `.png` for an APNG
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The stimuli over time, as for `nbc simulate`
    #[arg(long, default_value = "00*10 01*10 10*10 11*10")]
    schedule: String,
    /// Colors that people with any color vision can tell apart
    #[arg(long)]
    safe_colors: bool,
}

/// Kinds of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// A film that moves in PNG viewers
    Apng,
    /// A film
    Gif,
    /// The path over time
    Spacetime,
    /// The body with its materials
    Sprite,
    /// Snapshots of the gait under each pattern
    Strip,
}

/// Kinds of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Gif,
    Png,
    Svg,
}

impl Arguments {
    /// Draws and writes.
    ///
    /// # Errors
    /// When the robot, the schedule or the file's extension makes no sense, or the file cannot be written.
    pub fn run(self, _context: &mut Context) -> Result<Status, Failure> {
        let format = file_format(self.kind, &self.output).map_err(Failure::plain)?;
        let schedule = read_schedule(&self.schedule)?;
        let body = simulate::read_body(&self.robot, Palette::paper().materials().len())?;
        let scheme = if self.safe_colors { Scheme::Safe } else { Scheme::Paper };
        let name = Path::new(&self.robot).file_stem().map_or(self.robot.clone(), |stem| stem.to_string_lossy().into_owned());
        match self.kind {
            Kind::Apng | Kind::Gif => self.write_film(&name, &body, &schedule, scheme)?,
            Kind::Spacetime => {
                let trial = Trial { body, schedule };
                let trajectory = sim::run_trials(&Setting::paper(), std::slice::from_ref(&trial)).remove(0);
                write_picture(&self.output, format, &report::draw_robot(&name, &trial.schedule, &trajectory))?;
            }
            Kind::Sprite => write_picture(&self.output, format, &report::draw_portrait(&name, &body, scheme))?,
            Kind::Strip => write_picture(&self.output, format, &report::draw_strip(&name, &body, &schedule, scheme))?,
        }
        Ok(Status::Done)
    }

    fn write_film(&self, name: &str, body: &Body, schedule: &Schedule, scheme: Scheme) -> Result<(), Failure> {
        let largest = body.width().max(body.height());
        let film = Film { title: name.to_owned(), lanes: vec![String::new()], scheme, largest };
        let stage = Stage::of_trial(&Setting::paper(), body, schedule, STRIDE);
        let progress = Progress::new("drawing", stage.moments() as u64);
        let stage = stage.watched(|done| progress.set(done as u64));
        let write = |out: &mut dyn Write| match self.kind {
            Kind::Apng => report::write_apng(&film, stage, out),
            _ => report::write_gif(&film, stage, out),
        };
        store::write_with(&self.output, write).map_err(|error| Failure::unwritable(&self.output, &error))
    }
}

fn read_schedule(text: &str) -> Result<Schedule, Failure> {
    let mut sources = Sources::default();
    let id = sources.add("--schedule", text);
    schedule::parse(sources.file(id)).map_err(|faults| Failure::input(faults, sources))
}

/// The kind of file that a path asks for, if the picture can be one.
fn file_format(kind: Kind, path: &Path) -> Result<Format, Diagnostic> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    let (wanted, format) = match (kind, extension.as_str()) {
        (Kind::Gif, "gif") => ("", Some(Format::Gif)),
        (Kind::Gif, _) => ("`.gif`", None),
        (Kind::Apng, "png" | "apng") => ("", Some(Format::Png)),
        (Kind::Apng, _) => ("`.png` or `.apng`", None),
        (_, "svg") => ("", Some(Format::Svg)),
        (_, "png") => ("", Some(Format::Png)),
        _ => ("`.svg` or `.png`", None),
    };
    format.ok_or_else(|| {
        let message = format!("`{}` does not say which kind of file, expected a name that ends in {wanted}", path.display());
        Diagnostic::without_place(Code::BadValue, message)
    })
}

fn write_picture(path: &Path, format: Format, svg: &Svg) -> Result<(), Failure> {
    let bytes = if format == Format::Svg { svg.finish().into_bytes() } else { report::png(svg) };
    store::write(path, &bytes).map_err(|error| Failure::unwritable(path, &error))
}
