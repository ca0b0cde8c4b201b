//! `nbc test --worlds`: tests in samples of worlds.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use crate::cli::documents::Interrupted;
use crate::cli::options::new_path::picture_path;
use crate::cli::options::number::number;
use crate::cli::wording;
use crate::cli::world_runs::world_runs;
use crate::cli::{Context, Failure, Interrupt, OutputFormat, Status};
use nbc_base::diag::counted;
use nbc_base::model::Variation;
use nbc_session::report::{self, Schema, YieldCurve};
use nbc_session::{Session, TestCase, Yields};
use nbc_swarm::{Proportion, Robustness};

const WORLDS: u32 = 100;

#[derive(Args)]
pub(super) struct WorldsArguments {
    /// The number of worlds in which each test runs [default: 100]
    #[arg(long, value_name = "N", requires = "vary", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    worlds: Option<u32>,
    /// The largest changes of the worlds, such as `friction=10%,gravity=5%`, or `10%` of all factors; may be given
    /// several times
    #[cfg_attr(feature = "cluster", arg(conflicts_with = "nats"))]
    #[arg(long, value_name = "CHANGES", conflicts_with = "logic")]
    vary: Vec<Variation>,
    /// Repeat with the changes times each of these numbers
    #[arg(long, value_name = "NUMBERS", requires = "vary", value_delimiter = ',', value_parser = scale)]
    times: Vec<f64>,
    /// The seed of the worlds
    #[arg(long, value_name = "SEED", requires = "vary", default_value_t = 1, value_parser = number::<u64>)]
    seed: u64,
    /// Fail if a test passes in a smaller share of the worlds, such as `95%`
    #[arg(long, value_name = "SHARE", requires = "vary", value_parser = share)]
    least_yield: Option<f64>,
    /// Draw the yields into this file, `.svg` or `.png`
    #[arg(long, value_name = "FILE", requires = "vary", value_parser = picture_path())]
    picture: Option<PathBuf>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(in crate::cli) struct WorldResults<'a> {
    /// The number of worlds of each sample.
    worlds: usize,
    seed: u64,
    /// Those that are complete.
    tests: &'a [Robustness],
    #[serde(skip_serializing_if = "Option::is_none")]
    interrupted: Option<Interrupted>,
}

impl WorldsArguments {
    pub(super) fn is_used(&self) -> bool {
        !self.vary.is_empty()
    }

    /// Runs the cases in all worlds, and prints each result as soon as those before it are done.
    pub(super) fn test(
        &self,
        session: &Session,
        cases: &[TestCase],
        interrupt: &Interrupt,
        context: &mut Context,
    ) -> Result<Status, Failure> {
        let times = if self.times.is_empty() { &[1.0][..] } else { &self.times };
        let yields = Yields::of(cases, &self.vary, times, self.count(), self.seed);
        if yields.experiments.is_empty() {
            return Err(wording::no_worlds().into());
        }
        let found = world_runs(session, &yields, interrupt, |robustness| {
            if context.format == OutputFormat::Text {
                context.print(report::describe_robustness(robustness))?;
                context.flush()?;
            }
            Ok(())
        })?;
        let left = yields.experiments.len() - found.len();
        if context.format == OutputFormat::Json {
            let interrupted = (left > 0).then_some(Interrupted { left });
            let results = WorldResults { worlds: self.count(), seed: self.seed, tests: &found, interrupted };
            context.print_json(Schema::Robustness, &results)?;
        }
        if let Some(path) = self.picture.as_ref().filter(|_| left == 0) {
            context.write_picture(path, &self.draw(&found))?;
        }
        let is_low = |one: &Robustness| self.least_yield.is_some_and(|least| one.passed.share() < least);
        Ok(match (left, found.iter().any(is_low)) {
            (1.., _) => Status::Interrupted,
            (0, true) => Status::TestFailed,
            (0, false) => Status::Done,
        })
    }

    fn count(&self) -> usize {
        self.worlds.unwrap_or(WORLDS) as usize
    }

    /// The yields against the size of the change: a curve for each test and variation.
    fn draw(&self, found: &[Robustness]) -> report::Svg {
        let common = self.vary.iter().map(Variation::common).collect::<Option<Vec<f64>>>();
        let scales = self.times.len().max(1);
        let curve = |(i, group): (usize, &[Robustness])| {
            let unit = common.as_ref().map_or(1.0, |sizes| sizes[i % self.vary.len()] * 100.0);
            let point = |one: &Robustness| (one.scale * unit, one.passed);
            let mut points: Vec<(f64, Proportion)> = group.iter().map(point).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            YieldCurve { label: self.label(&group[0], i), points }
        };
        let curves: Vec<YieldCurve> = found.chunks(scales).enumerate().map(curve).collect();
        let change = if common.is_some() { "largest change in %" } else { "times the given changes" };
        let title = format!("Yield in {}", counted(self.count(), "world"));
        report::draw_yields(&title, change, &curves)
    }

    /// The test, and the quantities that vary if there are several choices.
    fn label(&self, one: &Robustness, curve: usize) -> String {
        let swarm = one.swarm.as_ref().map_or(String::new(), |swarm| format!(" as {swarm}"));
        let robots = nbc_base::diag::counted(one.robots, "robot");
        match self.vary.len() {
            1 => format!("{}{swarm}, {robots}", one.circuit),
            several => format!("{}{swarm}, {robots}: {}", one.circuit, self.vary[curve % several].quantities()),
        }
    }
}

fn scale(text: &str) -> Result<f64, String> {
    let scale = text.parse().ok().filter(|scale| (0.0..=1000.0).contains(scale));
    scale.ok_or_else(|| "expected numbers from 0 to 1000, such as `0.5,1,2`".to_owned())
}

/// A share, also in percent.
pub(in crate::cli) fn share(text: &str) -> Result<f64, String> {
    let share = match text.strip_suffix('%') {
        Some(percent) => percent.parse::<f64>().map(|percent| percent / 100.0),
        None => text.parse(),
    };
    share.ok().filter(|share| (0.0..=1.0).contains(share)).ok_or_else(|| "expected a share such as `95%`".to_owned())
}
