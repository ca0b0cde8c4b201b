//! `nbc draw`: one picture, film or waveform of a robot or of a circuit's swarm.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use crate::cli::{Context, Failure, Progress, Status, schedule, simulate};
use crate::diag::{Code, Diagnostic};
use crate::model::{Body, Palette, Robot, Schedule, Setting, Trial};
use crate::pipeline::{self, Loaded, Options, TestRun};
use crate::report::{self, Film, STRIDE, Scheme, Stage, Svg};
use crate::sim;
use crate::source::Sources;
use crate::store::{self, DiskWorld};

/// Draw a robot, or the swarm of a file's first test, as one picture, film or waveform
#[derive(Args)]
#[command(after_help = "\
Examples:
  nbc draw nand --as gif --schedule '00*4 11*4' -o nand.gif
  nbc draw body.yaml --as strip -o gait.svg
  nbc draw circuits/latch.nb --as schematic -o latch.svg")]
pub struct Arguments {
    /// A file with a body, the name of a robot of the library, or a source file (.nb)
    what: String,
    /// What to draw
    #[arg(long = "as", value_enum)]
    kind: Kind,
    /// The file to write: `.svg` or `.png` for pictures, `.gif`, `.png` or `.apng` for films, `.vcd`
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The stimuli of a robot over time, as for `nbc simulate`
    #[arg(long, default_value = "00*10 01*10 10*10 11*10")]
    schedule: String,
    /// Colors that people with any color vision can tell apart
    #[arg(long)]
    safe_colors: bool,
}

/// Kinds of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// A film in a PNG file
    Apng,
    /// A film
    Gif,
    /// A circuit's cells with their robots
    Schematic,
    /// Paths over time
    Spacetime,
    /// A robot's body with its materials
    Sprite,
    /// Snapshots of a robot's gait under each pattern
    Strip,
    /// A swarm's waveforms
    Vcd,
}

impl Kind {
    /// The extensions of the files that hold such a picture.
    fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Apng => &["png", "apng"],
            Self::Gif => &["gif"],
            Self::Vcd => &["vcd"],
            Self::Schematic | Self::Spacetime | Self::Sprite | Self::Strip => &["svg", "png"],
        }
    }
}

impl Arguments {
    /// Draws and writes.
    ///
    /// # Errors
    /// When what is to be drawn makes no sense, is not to be had of a robot or of a swarm, or cannot be written.
    pub fn run(self, _context: &mut Context) -> Result<Status, Failure> {
        self.check_extension().map_err(Failure::plain)?;
        if self.what.ends_with(".nb") {
            self.draw_swarm()?
        } else {
            self.draw_robot()?
        }
        Ok(Status::Done)
    }

    fn scheme(&self) -> Scheme {
        if self.safe_colors { Scheme::Safe } else { Scheme::Paper }
    }

    fn extension(&self) -> String {
        self.output.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
    }

    fn check_extension(&self) -> Result<(), Diagnostic> {
        let known = self.kind.extensions();
        if known.contains(&self.extension().as_str()) {
            return Ok(());
        }
        let wanted: Vec<String> = known.iter().map(|extension| format!("`.{extension}`")).collect();
        let wanted = wanted.join(" or ");
        let message = format!(
            "cannot tell the kind of file of `{}`, expected a name that ends in {wanted}",
            self.output.display()
        );
        Err(Diagnostic::without_place(Code::BadValue, message))
    }

    fn draw_robot(&self) -> Result<(), Failure> {
        let schedule = read_schedule(&self.schedule)?;
        let body = simulate::read_body(&self.what, Palette::paper().materials().len())?;
        let stem = Path::new(&self.what).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let name = stem.unwrap_or_else(|| self.what.clone());
        match self.kind {
            Kind::Apng | Kind::Gif => {
                let largest = body.width().max(body.height());
                let film = Film { title: name, lanes: vec![String::new()], scheme: self.scheme(), largest };
                self.write_film(&film, Stage::of_trial(&Setting::paper(), &body, &schedule, STRIDE))
            }
            Kind::Spacetime => self.write_picture(&robot_diagram(&name, body, schedule)),
            Kind::Sprite => self.write_picture(&report::draw_portrait(&name, &body, self.scheme())),
            Kind::Strip => self.write_picture(&report::draw_strip(&name, &body, &schedule, self.scheme())),
            Kind::Schematic | Kind::Vcd => Err(self.not_of("a robot", "a source file (.nb)")),
        }
    }

    fn draw_swarm(&self) -> Result<(), Failure> {
        match self.kind {
            Kind::Sprite | Kind::Strip => Err(self.not_of("a source file", "a robot")),
            _ => self.draw_run(&self.run_first_test()?),
        }
    }

    fn draw_run(&self, run: &TestRun) -> Result<(), Failure> {
        let assembly = &run.compiled.assembly;
        let robots: Vec<&Robot> = assembly.members.iter().map(|member| &member.robot).collect();
        match self.kind {
            Kind::Schematic => {
                let (netlist, path) = (&run.compiled.mapped, &run.compiled.timing.critical_path);
                self.write_picture(&report::draw_schematic(netlist, &robots, path, self.scheme()))
            }
            Kind::Vcd => self.write_bytes(report::vcd(&run.trace).as_bytes()),
            Kind::Apng | Kind::Gif => {
                let largest = robots.iter().map(|robot| robot.body.width().max(robot.body.height())).max().unwrap_or(1);
                let lanes =
                    assembly.members.iter().map(|member| format!("{} ({})", member.net, member.robot.function()));
                let title = assembly.circuit.clone();
                let film = Film { title, lanes: lanes.collect(), scheme: self.scheme(), largest };
                self.write_film(&film, Stage::of_swarm(&Setting::paper(), assembly, &run.trace, STRIDE))
            }
            _ => self.write_picture(&report::draw_swarm(&run.trace)),
        }
    }

    /// The file's first test, run in full physics.
    fn run_first_test(&self) -> Result<TestRun, Failure> {
        let Loaded { sources, checked } = pipeline::load(&DiskWorld, &self.what);
        if checked.has_errors() {
            return Err(Failure::input(checked.diagnostics, sources));
        }
        let Some(test) = checked.program.tests.first() else {
            let message = format!("`{}` declares no test, so there is no swarm to draw", self.what);
            return Err(Failure::plain(Diagnostic::without_place(Code::Empty, message)));
        };
        let bar = Progress::new("simulating", 0);
        pipeline::run_test(&checked.program, test, &Options::default(), &mut |done, all| {
            bar.set_total(all as u64);
            bar.set(done as u64);
        })
        .map_err(|faults| Failure::input(faults, sources))
    }

    fn not_of(&self, given: &str, wanted: &str) -> Failure {
        let kind = self.kind.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned());
        let message = format!("`{}` is {given}, expected {wanted} for `--as {kind}`", self.what);
        Failure::plain(Diagnostic::without_place(Code::BadValue, message))
    }

    fn write_picture(&self, svg: &Svg) -> Result<(), Failure> {
        let bytes = if self.extension() == "svg" { svg.finish().into_bytes() } else { report::png(svg) };
        self.write_bytes(&bytes)
    }

    fn write_bytes(&self, bytes: &[u8]) -> Result<(), Failure> {
        store::write(&self.output, bytes).map_err(|error| Failure::unwritable(&self.output, &error))
    }

    fn write_film(&self, film: &Film, stage: Stage) -> Result<(), Failure> {
        let bar = Progress::new("drawing", stage.moments() as u64);
        let mut observe = |done| bar.set(done as u64);
        let write = |out: &mut dyn Write| match self.kind {
            Kind::Apng => report::write_apng(film, stage, out, &mut observe),
            _ => report::write_gif(film, stage, out, &mut observe),
        };
        store::write_with(&self.output, write).map_err(|error| Failure::unwritable(&self.output, &error))
    }
}

fn read_schedule(text: &str) -> Result<Schedule, Failure> {
    let mut sources = Sources::default();
    let id = sources.add("--schedule", text);
    schedule::parse(sources.file(id)).map_err(|faults| Failure::input(faults, sources))
}

fn robot_diagram(name: &str, body: Body, schedule: Schedule) -> Svg {
    let trial = Trial { body, schedule };
    let trajectory = sim::run_trials(&Setting::paper(), std::slice::from_ref(&trial)).remove(0);
    report::draw_robot(name, &trial.schedule, &trajectory)
}
