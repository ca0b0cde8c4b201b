//! `nbc see`: how well evolved bodies tell images apart.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::draw::read_run;
use crate::cli::options::new_path::picture_path;
use crate::cli::source_path::source_path;
use crate::cli::{Context, Failure, Interrupt, Progress, Status};
use nbc_session::report::{EvolutionResults, Schema, Scheme};
use nbc_session::{Occlusion, Recognition, RecognitionReport, Session};
use nbc_sim::Simulator;
use nbc_swarm::evolve::Elite;

const EXAMPLES: &str = "\
Examples:
  nbc evolve library/seeing.nb --run zeros_and_ones
  nbc see library/seeing.nb held_out out/zeros_and_ones
  nbc see library/seeing.nb held_out out/zeros_and_ones/seed-1 --best 5
  nbc see library/seeing/experiments.nb held_out out/box_5 out/seeds out/box_10 --chart boxes.svg
  nbc see library/seeing.nb some_held_out out/zeros_and_ones --map needed.svg";

/// Show images to evolved bodies and count those that they tell apart
///
/// The bodies are the best of an evolution with `objective: images`: those with the greatest least distance before the
/// images of their search. They are shown the images of a schedule, each from a fresh start, and should walk the way
/// that they walk before the set of their search with the same number.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct SeeArguments {
    /// The file with the evolutions and the schedule
    file: PathBuf,
    /// The schedule of images, with as many sets as those of the evolutions, in the same order
    schedule: String,
    /// Folders of runs such as out/zeros_and_ones, or of one of their seeds
    #[arg(required = true, value_name = "RUN")]
    runs: Vec<PathBuf>,
    /// So many bodies of each seed
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    best: u32,
    /// Write a picture (.svg or .png) of what the first body needs of the images: how much less far it walks the right
    /// way when each pixel is covered by its mean
    #[arg(long, value_name = "FILE", value_parser = picture_path())]
    map: Option<PathBuf>,
    /// Write a chart (.svg or .png) of the shares that the bodies of each run tell apart
    #[arg(long, value_name = "FILE", value_parser = picture_path())]
    chart: Option<PathBuf>,
}

impl SeeArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let interrupt = Interrupt::watch()?;
        let mut session = Session::new(interrupt.world());
        let checked = session.open(source_path(&self.file)?)?;
        let recognition = |run: &PathBuf| {
            let results = read_run(run, context)?;
            let (program, bodies) = (&checked.program, best(&results, self.best as usize));
            Ok(Recognition::new(program, &results.name, &self.schedule, bodies, Simulator::default())?)
        };
        let mut recognitions = self.runs.iter().map(recognition).collect::<Result<Vec<_>, Failure>>()?;
        let bar = Progress::new("seeing", recognitions.iter().map(|one| one.progress().1).sum());
        let mut shown = 0;
        for recognition in &mut recognitions {
            while recognition.advance() {
                if interrupt.is_raised() {
                    return Ok(Status::Interrupted);
                }
                bar.set(shown + recognition.progress().0);
            }
            shown += recognition.progress().1;
        }
        drop(bar);
        if let Some(path) = &self.map
            && !draw_map(path, &recognitions[0], &interrupt, context)?
        {
            return Ok(Status::Interrupted);
        }
        let bodies = recognitions.into_iter().flat_map(Recognition::finish).collect();
        let report = RecognitionReport { schedule: self.schedule, bodies };
        if let Some(path) = &self.chart {
            context.write_picture(path, &report.chart())?;
        }
        context.print_result(Schema::See, &report, || report.text())?;
        Ok(Status::Done)
    }
}

/// Covers each pixel and writes the map; returns whether it was finished.
fn draw_map(
    path: &Path,
    recognition: &Recognition,
    interrupt: &Interrupt,
    context: &mut Context,
) -> Result<bool, Failure> {
    let mut occlusion = Occlusion::of(recognition.clone());
    let bar = Progress::new("covering", occlusion.progress().1);
    while occlusion.advance() {
        if interrupt.is_raised() {
            return Ok(false);
        }
        bar.set(occlusion.progress().0);
    }
    drop(bar);
    context.write_picture(path, &occlusion.draw(Scheme::default()))?;
    Ok(true)
}

/// The fittest elites of each seed, the first of equals first.
fn best(results: &EvolutionResults, count: usize) -> Vec<(u64, Elite)> {
    let of_seed = |(&seed, run): (&u64, &nbc_session::report::SeedRun)| {
        let mut elites: Vec<&Elite> = run.niches.iter().flat_map(|(_, elites)| elites).collect();
        elites.sort_by(|a, b| b.fitness[0].total_cmp(&a.fitness[0]));
        elites.into_iter().take(count).map(move |elite| (seed, elite.clone())).collect::<Vec<_>>()
    };
    results.runs.iter().flat_map(of_seed).collect()
}
