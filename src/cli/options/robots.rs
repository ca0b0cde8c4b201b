//! `--library`: other robots than the declared ones, or than the built-in ones.

use std::path::PathBuf;

use clap::Args;

#[derive(Args)]
pub(in crate::cli) struct RobotsArguments {
    /// The robots: a robot file, a folder of them, `shipped` or `three` [default: those that the file declares, or
    /// `shipped`]
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) library: Option<PathBuf>,
}
