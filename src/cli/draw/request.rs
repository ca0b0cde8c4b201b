//! What is to be drawn, and how.

use clap::Args;
use clap::builder::PossibleValuesParser;

use crate::cli::Failure;
use crate::cli::draw::wording;
use crate::cli::options::files::FilesArguments;
use crate::cli::options::images::ImagesArguments;
use crate::cli::options::making::MakingArguments;
use nbc_base::model::{Behavior, Body, CYCLE_STEPS, Pattern, Schedule, Spell};
use nbc_session::behavior;
use nbc_session::report::{FRAMES_PER_CYCLE, Scheme};

/// Cycles of each pattern if no schedule is given, as in the paper.
const CYCLES: u32 = 10;
/// The most patterns that are tried if no schedule is given.
const MOST_PATTERNS: usize = 64;

#[derive(Args)]
pub struct DrawRequest {
    /// A file with a body, a robot of the library, a folder of robot files, `shipped`, the folder of a run, or a source
    /// file (.nb)
    pub(super) what: String,
    /// The schedule of a robot's stimuli, as in `nbc simulate` [default: ten cycles of each pattern]
    #[arg(long)]
    pub(super) schedule: Option<String>,
    #[command(flatten)]
    pub(super) images: ImagesArguments,
    /// The cycle of a pose [default: the end of the schedule]
    #[arg(long, value_name = "CYCLE", value_parser = cycle, allow_negative_numbers = true)]
    pub(super) at: Option<f64>,
    /// The best robot with this behavior, such as `RRRL` or its function `nand`, from a library or a run
    #[arg(long, value_name = "BEHAVIOR", value_parser = behavior)]
    pub(super) behavior: Option<Behavior>,
    /// The two axes of a heat map: `voxels`, `active`, `sensory`, `behavior` [default: the first two]
    #[arg(long, value_name = "X,Y", value_delimiter = ',')]
    pub(super) axes: Vec<String>,
    /// Show only these robots of a swarm, by the nets they drive, with the inputs of the swarm; `count*` selects every
    /// net that begins with `count`
    #[arg(long, value_name = "NET,…", value_delimiter = ',')]
    pub(super) robots: Vec<String>,
    #[command(flatten)]
    pub(super) making: MakingArguments,
    /// A test of a source file, by its title or its circuit [default: the first]
    #[arg(long, value_name = "NAME")]
    pub(super) test: Option<String>,
    #[command(flatten)]
    pub(super) named: FilesArguments,
    /// Frames of a film for each cycle; fewer show a long run in a short time [default: 12]
    #[arg(long, value_name = "N", value_parser = PossibleValuesParser::new(["1", "2", "3", "4", "6", "12"]))]
    pub(super) frames: Option<String>,
    /// Colors that people with any color vision can tell apart
    #[arg(long)]
    pub(super) safe_colors: bool,
}

impl DrawRequest {
    pub(super) fn scheme(&self) -> Scheme {
        if self.safe_colors { Scheme::Safe } else { Scheme::Paper }
    }

    /// Env steps from frame to frame.
    pub(super) fn stride(&self) -> u32 {
        let frames = self.frames.as_deref().and_then(|frames| frames.parse().ok()).unwrap_or(FRAMES_PER_CYCLE);
        CYCLE_STEPS / frames
    }

    /// By default all patterns of the stimuli that the bodies sense.
    pub(super) fn schedule<'a>(&self, bodies: impl IntoIterator<Item = &'a Body> + Clone) -> Result<Schedule, Failure> {
        let given = self.images.schedule(self.schedule.as_deref(), bodies.clone())?;
        Ok(given.map(|given| given.schedule).unwrap_or_else(|| {
            let stimuli = bodies.into_iter().map(|body| body.palette().stimuli()).fold(2, usize::max);
            let spell = |pattern| Spell::of(pattern, CYCLES * CYCLE_STEPS);
            Schedule { spells: Pattern::all(stimuli).take(MOST_PATTERNS).map(spell).collect() }
        }))
    }

    /// The end of the schedule, or the cycle of `--at`.
    pub(super) fn step(&self, schedule: &Schedule) -> Result<u32, Failure> {
        let end = schedule.steps();
        let Some(cycle) = self.at else { return Ok(end) };
        let step = (cycle * f64::from(CYCLE_STEPS)).round();
        if step <= f64::from(end) {
            return Ok(step as u32);
        }
        Err(wording::after_end(cycle, f64::from(end) / f64::from(CYCLE_STEPS)).into())
    }

    pub(super) fn none_of(&self, behavior: Behavior) -> Failure {
        wording::unknown_behavior(&self.what, behavior).into()
    }
}

/// In cycles from the start.
fn cycle(text: &str) -> Result<f64, String> {
    let cycle = text.parse().ok().filter(|cycle: &f64| cycle.is_finite() && *cycle >= 0.0);
    cycle.ok_or_else(|| "expected a number of cycles, 0 or more".to_owned())
}
