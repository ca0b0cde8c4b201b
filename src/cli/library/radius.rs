//! `nbc library verify --vary`: how far worlds may differ before robots make errors.

use std::path::Path;

use clap::Args;
use rayon::prelude::*;

use crate::cli::documents::RobotList;
use crate::cli::options::number::number;
use crate::cli::robots::{robot_paths, robots};
use crate::cli::{Context, Failure, OutputFormat, Progress, Status};
use nbc_base::diag::counted;
use nbc_base::model::{Character, Library, SafeRadius, Variation};
use nbc_session::Reach;
use nbc_session::report::Schema;
use nbc_session::store;
use nbc_sim::Simulator;

#[derive(Args)]
pub(super) struct RadiusArguments {
    /// Measure instead how far worlds may differ: the changes at radius 1, such as `friction=10%` or `all=10%`
    #[cfg_attr(feature = "cluster", arg(conflicts_with = "nats"))]
    #[cfg_attr(feature = "gpu", arg(conflicts_with = "device"))]
    #[arg(long, value_name = "CHANGES")]
    vary: Option<Variation>,
    /// The number of worlds for each radius
    #[arg(long, value_name = "N", requires = "vary", default_value_t = 20)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100_000))]
    worlds: u32,
    /// The seed of the worlds
    #[arg(long, value_name = "SEED", requires = "vary", default_value_t = 1, value_parser = number::<u64>)]
    seed: u64,
    /// Write the radius into the robot files
    #[arg(long, requires_all = ["vary", "path"])]
    write: bool,
}

impl RadiusArguments {
    pub(super) fn changes(&self) -> Option<Variation> {
        self.vary
    }

    /// A robot fails if its file has another radius for the same worlds.
    pub(super) fn run(
        &self,
        library: &Library,
        path: Option<&Path>,
        changes: Variation,
        context: &mut Context,
    ) -> Result<Status, Failure> {
        let (simulator, bar) = (Simulator::default(), Progress::new("trying", library.robots.len() as u64));
        let reach = |robot| {
            let reach = Reach::of(&simulator, robot, changes, self.worlds, self.seed);
            bar.add(1);
            reach
        };
        let found: Vec<Reach<'_>> = library.robots.par_iter().map(reach).collect();
        drop(bar);
        if let Some(path) = path.filter(|_| self.write) {
            write(path, &found)?;
        }
        let failed = found.iter().filter(|reach| !reach.verified && !self.write).count();
        match context.format {
            OutputFormat::Json => context.print_json(Schema::Radii, &RobotList { robots: found })?,
            OutputFormat::Text => {
                for Reach { name, found: SafeRadius { radius, error_rate, .. }, verified } in &found {
                    let differs = if *verified { "" } else { ", unlike its file" };
                    let errors = error_rate
                        .filter(|rate| *rate > 0.0)
                        .map_or(String::new(), |rate| format!(", {:.2} % of switches wrong at radius 1", 100.0 * rate));
                    context.print(format_args!("{name:<24} radius {radius}{errors}{differs}\n"))?;
                }
                let (robots, worlds) = (counted(found.len(), "robot"), counted(self.worlds as usize, "world"));
                context.print(format_args!("{robots}, radius 1 is {changes} in {worlds}\n"))?;
            }
        }
        Ok(if failed == 0 { Status::Done } else { Status::TestFailed })
    }
}

fn write(path: &Path, found: &[Reach<'_>]) -> Result<(), Failure> {
    for path in robot_paths(path)? {
        for mut robot in robots(&path)?.robots {
            let Some(reach) = found.iter().find(|reach| reach.name == robot.name) else { continue };
            robot.character = Character { radius: Some(reach.found.clone()), ..robot.character };
            let text = store::print_robot(&robot);
            store::write(&path, text.as_bytes()).map_err(|error| Failure::unwritable(&path, &error))?;
        }
    }
    Ok(())
}
