//! `nbc learn`: circuits that are learned from rows of values.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;

use crate::cli::options::new_path::{new_path, picture_path};
use crate::cli::{Context, Failure, Interrupt, Progress, Status};
use nbc_circuit::formats::CircuitFormat;
use nbc_session::report::Schema;
use nbc_session::store;
use nbc_session::{LearnOptions, Learning, LearningReport, LearningRequest};

const EXAMPLES: &str = "\
Examples:
  nbc learn digits.csv -o read.nb
  nbc learn adder.pla -o adder.blif --gates 1000
  nbc learn flowers.csv --target species --hold-out 30 --seed 2";

/// Learn a circuit from the rows of a file
///
/// Reads CSV, whose columns are ports, and PLA. Tries decision trees, small forests, two-level logic, parities,
/// functions of the number of ones, arithmetic and chains of majorities on each output bit, and takes what is best on
/// rows that the method has not seen. Writes .nb, BLIF, Verilog, AIGER, PLA and DOT; the file's extension selects the
/// format. The rows that are held out are used for nothing but the report.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct LearnArguments {
    /// The rows: .csv or .pla
    rows: PathBuf,
    /// The file to write: .nb, .blif, .pla, .aig, .aag, .v or .dot; the circuit has its name
    #[arg(short, long, value_name = "OUT", value_parser = new_path())]
    output: Option<PathBuf>,
    /// Write a picture (.svg or .png) of which values are taken for which
    #[arg(long, value_name = "FILE", value_parser = picture_path())]
    confusion: Option<PathBuf>,
    /// A port that is an output; may be repeated [default: those of a PLA, or the last port]
    #[arg(long, value_name = "PORT")]
    target: Vec<String>,
    /// The most AND gates of the circuit, inverters not counted
    #[arg(long, value_name = "GATES", default_value_t = LearnOptions::default().gates)]
    gates: usize,
    /// The share of the rows in percent that the learner does not see
    #[arg(long, value_name = "PERCENT", default_value_t = LearnOptions::default().hold_out, value_parser = percent)]
    hold_out: f64,
    /// So many rows after each other belong together, such as views of one thing: all are held out, or none
    #[arg(long, value_name = "ROWS", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    group: u32,
    /// The seed of all random choices, such as which rows are held out
    #[arg(long, default_value_t = LearnOptions::default().seed)]
    seed: u64,
}

impl LearnArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let started = Instant::now();
        let format = |path: &PathBuf| CircuitFormat::of_path(&path.to_string_lossy());
        let format = self.output.as_ref().map(format).transpose()?;
        let interrupt = Interrupt::watch()?;
        let (sources, file) = store::read_rows(&self.rows)?;
        let named = self.output.as_ref().unwrap_or(&self.rows).file_stem();
        let circuit = named.map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let options =
            LearnOptions { gates: self.gates, hold_out: self.hold_out, seed: self.seed, group: self.group as usize };
        let request = LearningRequest { circuit: &circuit, rows: sources.file(file), outputs: &self.target, options };
        let command = request.command();
        let mut learning = Learning::new(&request).map_err(|faults| Failure::input(faults, sources.clone()))?;
        // A format that the circuit does not fit is refused before it is learned.
        if let Some(format) = format {
            store::encode_circuit(&learning.outline(), format)?;
        }
        let bar = Progress::new("learning", learning.progress().1);
        while learning.advance() {
            if interrupt.is_raised() {
                return Ok(Status::Interrupted);
            }
            bar.set(learning.progress().0);
        }
        drop(bar);
        let learned = learning.finish();
        let report = LearningReport::of(&learned, started.elapsed().as_secs_f64());
        if let (Some(path), Some(format)) = (&self.output, format) {
            let bytes = store::encode_circuit(&learned.design, format)?;
            let comment = report.provenance(&command);
            context.write(path, &store::with_comment(bytes, format, &comment))?;
        }
        context.print_result(Schema::Learn, &report, || report.text())?;
        if let Some(path) = &self.confusion {
            context.write_picture(path, &report.draw_confusion()?)?;
        }
        Ok(Status::Done)
    }
}

fn percent(text: &str) -> Result<f64, String> {
    let percent = text.parse().ok().filter(|percent| (0.0..100.0).contains(percent));
    percent.ok_or_else(|| "expected a number from 0 to less than 100".to_owned())
}
