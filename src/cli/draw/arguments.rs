//! The arguments of `nbc draw`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::draw::kinds::{Kind, kinds};
use crate::cli::draw::request::DrawRequest;
use crate::cli::options::new_path::new_path;

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
  nbc draw out/zeros_and_ones --behavior LLRR --as gif --images library/seeing.nb --schedule 'zeros*250steps \
ones*250steps' -o seeing.gif

docs/pictures.md shows every kind.")]
pub struct DrawArguments {
    /// The kind of picture
    #[arg(long = "as", value_parser = kinds())]
    pub(super) kind: Kind,
    /// The file to write: `.svg` or `.png` for pictures, `.gif`, `.png` or `.apng` for films, `.vcd`, `.dot`, `.html`
    #[arg(short, long, value_name = "FILE", value_parser = new_path())]
    pub(super) output: PathBuf,
    #[command(flatten)]
    pub(super) request: DrawRequest,
}
