//! Compares searches for gates: prints a table for the given runs, each a folder of one seed, and draws the QD-score
//! of each over the bodies it tried.
//!
//!     cargo run --release --example strategies docs/evolution/strategies.svg out/crossed/seed-1 out/waves/seed-1

use std::error::Error;
use std::path::Path;

use nbc_base::model::Behavior;
use nbc_session::report::{self, Course};
use nbc_session::store::Checkpoint;
use serde::Deserialize;

type Fallible<T> = Result<T, Box<dyn Error>>;

/// A gate of each class that others follow from by symmetry: NOT, AND and XOR.
const CLASSES: [&str; 3] = ["RRLL", "LLLR", "LRRL"];
/// The margin that has the score three quarters (docs/strategies.md).
const HALF_MARGIN: f64 = 0.05;

/// Fields of a line of a run's `progress.jsonl`.
#[derive(Deserialize)]
struct Line {
    generation: u32,
    evaluations: u64,
    filled: usize,
    qd_score: f64,
    env_steps: u64,
}

fn main() -> Fallible<()> {
    let mut arguments = std::env::args().skip(1);
    let picture = arguments.next().ok_or("expected the file of the picture, then folders of runs")?;
    println!("| search | bodies | million env steps | niches | NOT | AND | XOR |");
    println!("|---|---|---|---|---|---|---|");
    let mut courses = Vec::new();
    for folder in arguments {
        let checkpoint = Checkpoint::open(&Path::new(&folder).join("checkpoint.nbc")).map_err(|fault| fault.message)?;
        let checkpoint = checkpoint.ok_or("the folder has no run")?;
        let text = std::fs::read_to_string(Path::new(&folder).join("progress.jsonl"))?;
        let mut lines: Vec<Line> = text.lines().map(serde_json::from_str).collect::<Result<_, _>>()?;
        // Later lines were written after the checkpoint.
        lines.retain(|line| line.generation <= checkpoint.state.generation);
        let Line { evaluations, filled, env_steps, .. } = lines.last().ok_or("the run has no generation")?;
        let found = CLASSES.map(|word| best(&checkpoint, word.parse().expect("a behavior")));
        let (name, steps) = (&checkpoint.declared.name, *env_steps as f64 / 1e6);
        println!("| `{name}` | {evaluations} | {steps:.0} | {filled} | {} |", found.join(" | "));
        let points = lines.iter().map(|line| (line.evaluations as f64, line.qd_score)).collect();
        courses.push(Course::of(name, "QD-score", vec![points]));
    }
    std::fs::write(picture, report::draw_progress("Searches for gates", "bodies", &courses).finish())?;
    Ok(())
}

/// The elite with the highest second fitness: in how many worlds it is right, and its margin in the worst cycle of all
/// that were tried, in voxels.
fn best(checkpoint: &Checkpoint, behavior: Behavior) -> String {
    let elites = checkpoint.state.niches.iter().flat_map(|(_, elites)| elites);
    let scores = elites.filter(|elite| elite.behavior == behavior).map(|elite| elite.fitness[1]);
    let Some(score) = scores.reduce(f64::max) else { return "–".to_owned() };
    let worlds = 1 + checkpoint.declared.sample.map_or(0, |sample| sample.worlds as usize);
    let passed = ((score * worlds as f64).floor() as usize).min(worlds - 1);
    let own = 2.0 * (score * worlds as f64 - passed as f64) - 1.0;
    let margin = HALF_MARGIN * own / (1.0 - own.abs());
    match (worlds, margin > 0.0) {
        (1, _) => format!("{margin:.3}"),
        (_, true) => format!("{margin:.3} in {worlds} of {worlds} worlds"),
        (_, false) => format!("right in {passed} of {worlds} worlds"),
    }
}
