//! The arguments of `nbc draw`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::draw::kind::Kind;
use crate::cli::program::{CircuitArguments, RunsArguments};
use crate::model::Behavior;

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
pub struct DrawArguments {
    /// A file with a body, a robot of the library, a folder of robot files, `shipped`, the folder of a run, or a source
    /// file (.nb)
    pub(super) what: String,
    /// The kind of picture
    #[arg(long = "as", value_enum)]
    pub(super) kind: Kind,
    /// The file to write: `.svg` or `.png` for pictures, `.gif`, `.png` or `.apng` for films, `.vcd`, `.dot`, `.html`
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: PathBuf,
    /// The schedule of a robot's stimuli, as in `nbc simulate` [default: 00*10 01*10 10*10 11*10]
    #[arg(long)]
    pub(super) schedule: Option<String>,
    /// The cycle of a pose [default: the end of the schedule]
    #[arg(long, value_name = "CYCLE", value_parser = cycle, allow_negative_numbers = true)]
    pub(super) at: Option<f64>,
    /// The best robot with this behavior, from a library or a run
    #[arg(long, value_name = "BEHAVIOR")]
    pub(super) behavior: Option<Behavior>,
    /// The two axes of a heat map: `voxels`, `active`, `sensory`, `behavior` [default: the first two]
    #[arg(long, value_name = "X,Y", value_delimiter = ',')]
    pub(super) axes: Vec<String>,
    /// Show only these robots of a swarm, by the nets they drive, with the inputs of the swarm; `count*` selects every
    /// net that begins with `count`
    #[arg(long, value_name = "NET,…", value_delimiter = ',')]
    pub(super) robots: Vec<String>,
    #[command(flatten)]
    pub(super) circuit: CircuitArguments,
    /// A test of a source file, by its title or its circuit [default: the first]
    #[arg(long, value_name = "NAME")]
    pub(super) test: Option<String>,
    #[command(flatten)]
    pub(super) runs: RunsArguments,
    /// Colors that people with any color vision can tell apart
    #[arg(long)]
    pub(super) safe_colors: bool,
}

/// A moment in cycles from the start.
fn cycle(text: &str) -> Result<f64, String> {
    let cycle = text.parse().ok().filter(|cycle: &f64| cycle.is_finite() && *cycle >= 0.0);
    cycle.ok_or_else(|| "expected a number of cycles, 0 or more".to_owned())
}
