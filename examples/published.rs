//! The published robots of the paper beside the best of the runs in `out/paper`, as a table for docs/paper.md:
//!
//!     cargo run --release --example published

use std::error::Error;
use std::path::{Path, PathBuf};

use nbc::store::Checkpoint;
use serde::Deserialize;

/// The published robots.
#[derive(Deserialize)]
struct Published {
    robots: Vec<PublishedRobot>,
}

#[derive(Deserialize)]
struct PublishedRobot {
    behavior: String,
    /// The least distance of the four simulations under a constant pattern, in voxels: the paper's second fitness.
    min_displacement: f64,
    body: Vec<String>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let published: Published = serde_json::from_str(include_str!("../tests/golden/paper_robots.json"))?;
    println!("| behavior | box | published | best of a run | median run | runs |\n|---|---|---|---|---|---|");
    for PublishedRobot { behavior, min_displacement, body } in published.robots {
        let side = body.len();
        let mut best = Vec::new();
        for checkpoint in checkpoints(side)? {
            best.extend(least_distance(&checkpoint, &behavior)?);
        }
        best.sort_by(f64::total_cmp);
        let Some(most) = best.last() else { continue };
        let median = (best[(best.len() - 1) / 2] + best[best.len() / 2]) / 2.0;
        println!("| {behavior} | {side}x{side} | {min_displacement:.2} | {most:.2} | {median:.2} | {} |", best.len());
    }
    Ok(())
}

/// The checkpoints of the runs in a box.
fn checkpoints(side: usize) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("out/paper/paper{side}"));
    let Ok(seeds) = std::fs::read_dir(folder) else { return Ok(Vec::new()) };
    let paths: Result<Vec<PathBuf>, _> = seeds.map(|seed| Ok(seed?.path().join("checkpoint.nbc"))).collect();
    paths.map_err(|error: std::io::Error| error.into())
}

/// The best second fitness of a run's robots with a behavior, in voxels; `None` if it has none.
fn least_distance(checkpoint: &Path, behavior: &str) -> Result<Option<f64>, Box<dyn Error>> {
    let run = Checkpoint::open(checkpoint).map_err(|fault| fault.message)?;
    let niches = run.into_iter().flat_map(|run| run.state.niches);
    let elites = niches.flat_map(|(_, elites)| elites).filter(|elite| elite.behavior.to_string() == behavior);
    Ok(elites.map(|elite| elite.fitness[1]).max_by(f64::total_cmp))
}
