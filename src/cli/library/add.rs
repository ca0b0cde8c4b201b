//! `nbc library add`: the best gates of evolution runs as robot files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::evolve::read_checkpoint;
use crate::cli::{Context, Failure, Format, Progress, Status};
use crate::diag::{Code, Diagnostic};
use crate::evolve::Elite;
use crate::model::{Behavior, Provenance, Robot};
use crate::report::Listing;
use crate::store::{self, Checkpoint};
use crate::swarm::{self, Measurement};

/// The longest clock that makes a gate worth a long measurement, in cycles.
const LONGEST_CLOCK: u32 = 4;

/// Measure the best gates of evolution runs and write them as robot files
#[derive(Args)]
#[command(
    after_help = "Example:\n  nbc library add out/gates5/seed-1 --into library/robots --behavior RRRL --behavior RRLL"
)]
pub struct Arguments {
    /// Folders of runs, each with its checkpoint
    #[arg(required = true)]
    runs: Vec<PathBuf>,
    /// The folder for robot files
    #[arg(long, value_name = "DIR")]
    into: PathBuf,
    /// Only this behavior; may be given several times
    #[arg(long, value_name = "BEHAVIOR")]
    behavior: Vec<Behavior>,
    /// Elites of each behavior that are tried
    #[arg(long, value_name = "N", default_value_t = 8)]
    tries: usize,
    /// Of these, how many are measured at length
    #[arg(long, value_name = "N", default_value_t = 2)]
    finalists: usize,
}

/// An elite with the run it comes from.
struct Entry {
    elite: Elite,
    provenance: Provenance,
}

impl Arguments {
    /// Chooses, measures and writes.
    ///
    /// # Errors
    /// When a run has no checkpoint, or a file cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        store::create_folder(&self.into).map_err(|error| Failure::unwritable(&self.into, &error))?;
        let entries = self.entries()?;
        let bar = Progress::new("measuring", entries.len() as u64);
        let mut robots = Vec::new();
        for (behavior, entries) in entries {
            bar.set_message(behavior.to_string());
            if let Some(robot) = self.best(behavior, &entries) {
                write(&self.into, &robot)?;
                robots.push(robot);
            }
            bar.add(1);
        }
        drop(bar);
        let list = Listing::all(&store::best_first(robots));
        match context.format {
            Format::Json => context.print_json(&list)?,
            Format::Text => context.print(Listing::table(&list))?,
        }
        Ok(Status::Done)
    }

    /// The elites of the wanted behaviors, the fittest first.
    fn entries(&self) -> Result<BTreeMap<Behavior, Vec<Entry>>, Failure> {
        let mut entries: BTreeMap<Behavior, Vec<Entry>> = BTreeMap::new();
        for folder in &self.runs {
            let path = folder.join(crate::cli::evolve::CHECKPOINT);
            let checkpoint = read_checkpoint(&path)?.ok_or_else(|| missing(&path))?;
            let provenance = |elite: &Elite| provenance(&checkpoint, elite);
            let elites = checkpoint.state.niches.iter().flat_map(|(_, elites)| elites);
            for elite in elites.filter(|elite| self.behavior.is_empty() || self.behavior.contains(&elite.behavior)) {
                let entry = Entry { elite: elite.clone(), provenance: provenance(elite) };
                entries.entry(elite.behavior).or_default().push(entry);
            }
        }
        for found in entries.values_mut() {
            found.sort_by(|a, b| worth(&b.elite).total_cmp(&worth(&a.elite)));
            found.truncate(self.tries);
        }
        Ok(entries)
    }

    /// The best of some elites: the shortest clock in cheap sequences and the widest margin go on to the long measurement.
    fn best(&self, behavior: Behavior, entries: &[Entry]) -> Option<Robot> {
        let screened = entries.iter().map(|entry| swarm::screen(&entry.elite.body, behavior, LONGEST_CLOCK));
        let mut ranked: Vec<(u32, f64, &Entry)> = screened
            .zip(entries)
            .map(|(screened, entry)| match screened {
                Ok(Some((clock, margin))) => (clock, margin, entry),
                // A fault or errors at every clock: last, but better than no robot at all.
                Ok(None) | Err(_) => (LONGEST_CLOCK + 1, worth(&entry.elite), entry),
            })
            .collect();
        ranked.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        let finalists = ranked.into_iter().take(self.finalists);
        let measured = finalists.filter_map(|(_, _, entry)| {
            let measurement = swarm::measure(&entry.elite.body).ok()?;
            (measurement.behavior == behavior).then(|| robot(entry, measurement))
        });
        store::best_first(measured.collect()).robots.into_iter().next()
    }
}

/// What elites are ranked by before they are measured: both fitnesses count alike.
fn worth(elite: &Elite) -> f64 {
    elite.fitness[0] + elite.fitness[1]
}

fn robot(entry: &Entry, measurement: Measurement) -> Robot {
    let Measurement { displacement, behavior, character } = measurement;
    let (body, function) = (&entry.elite.body, behavior.function());
    Robot {
        name: format!("{function}_{}x{}", body.width(), body.height()),
        behavior,
        body: body.clone(),
        displacement,
        character,
        provenance: entry.provenance.clone(),
        genotype: Some(entry.elite.genotype.clone()),
    }
}

fn provenance(checkpoint: &Checkpoint, elite: &Elite) -> Provenance {
    Provenance {
        program: env!("CARGO_PKG_NAME").to_owned(),
        version: checkpoint.version.clone(),
        evolution: checkpoint.declared.name.clone(),
        seed: checkpoint.state.seed,
        generation: elite.generation,
        evaluations: elite.evaluations,
    }
}

fn write(folder: &Path, robot: &Robot) -> Result<(), Failure> {
    let path = folder.join(format!("{}.yaml", robot.name));
    store::write(&path, store::print_robot(robot).as_bytes()).map_err(|error| Failure::unwritable(&path, &error))
}

fn missing(path: &Path) -> Failure {
    let message = format!("there is no checkpoint `{}`", path.display());
    let help = "name the folder of a run, such as `out/gates/seed-1`";
    Failure::plain(Diagnostic::without_place(Code::Checkpoint, message).with_help(help))
}
