//! `nbc synth`: circuits of other tools, mapped to cells of few robots and proved.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, ValueEnum};
use serde::Serialize;

use crate::circuit::correspondence::{self, Removed};
use crate::circuit::formats::Design;
use crate::circuit::{self, Netlist, levels, registers};
use crate::cli::mapping::{MappingArguments, functions};
use crate::cli::wording::UsageError;
use crate::cli::{Context, Failure, OutputFormat, Status};
use crate::report::Schema;
use crate::session::synthesize;
use crate::store;

const EXAMPLES: &str = "\
Examples:
  nbc synth adder.blif -o adder_nand.blif --cells nand,not
  nbc synth c880.aig -o c880.nb --effort high
  nbc synth adder.blif --cells nand,not --what-if xor,and";

/// Map another tool's circuit to few robots, and prove the result
///
/// Reads BLIF, AIGER, .bench and, if Yosys is installed, Verilog. Writes BLIF, AIGER, Verilog, DOT and .nb. The file's
/// extension selects the format.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct SynthArguments {
    /// The circuit: .blif, .aig, .aag, .bench, .v or .sv
    input: PathBuf,
    /// The file to write: .blif, .aig, .aag, .v, .dot or .nb
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[command(flatten)]
    mapping: MappingArguments,
    /// The clock of latches without a clock in the file
    #[arg(long, value_name = "NAME")]
    clock: Option<String>,
    /// Keep registers or expand them to cells [default: depends on the output format]
    #[arg(long, value_enum)]
    registers: Option<RegisterWord>,
    /// Report how many cells a robot for each of these functions would save
    #[arg(long, value_name = "FUNCTIONS", value_delimiter = ',')]
    what_if: Vec<String>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum RegisterWord {
    /// Registers of the output format
    Keep,
    /// Latches and flip-flops made of cells
    Expand,
}

/// The most registers that are named in a line.
const SHOWN: usize = 8;

/// The result for programs.
#[derive(Serialize)]
struct Report {
    cells: usize,
    by_function: BTreeMap<&'static str, usize>,
    depth: u32,
    inputs: usize,
    outputs: usize,
    latches: usize,
    removed: RemovedReport,
    proved: bool,
    seconds: f64,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    what_if: BTreeMap<String, i64>,
}

/// Registers that the circuit does not need.
#[derive(Serialize)]
struct RemovedReport {
    constant: BTreeMap<String, u8>,
    equal: BTreeMap<String, String>,
    unused: Vec<String>,
}

impl From<Removed> for RemovedReport {
    fn from(removed: Removed) -> Self {
        Self {
            constant: removed.constant.into_iter().map(|(name, value)| (name, value.into())).collect(),
            equal: removed.equal.into_iter().collect(),
            unused: removed.unused,
        }
    }
}

impl RemovedReport {
    /// A line for each reason that applies.
    fn text(&self) -> String {
        let constant: Vec<_> = self.constant.iter().map(|(name, value)| format!("{name} = {value}")).collect();
        let equal: Vec<_> = self.equal.iter().map(|(name, other)| format!("{name} = {other}")).collect();
        let line = |(what, names): (&str, &[String])| match names.len() {
            0 => String::new(),
            _ => format!("{what}: {}\n", listed(names)),
        };
        [
            ("registers that never change", &constant[..]),
            ("registers that equal another", &equal),
            ("registers that no output needs", &self.unused),
        ]
        .map(line)
        .concat()
    }
}

/// The first of these names, and how many more there are.
fn listed(names: &[String]) -> String {
    let shown = names[..names.len().min(SHOWN)].join(", ");
    if names.len() > SHOWN { format!("{shown} and {} more", names.len() - SHOWN) } else { shown }
}

impl SynthArguments {
    /// Reads, synthesizes, proves and writes.
    ///
    /// # Errors
    /// When the input cannot be read or mapped, or the output cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let started = Instant::now();
        let target = self.output.as_deref().map(format).transpose()?;
        let library = self.mapping.library()?;
        let what_if = functions(&self.what_if)?;
        let read = store::read_circuit(&self.input, self.clock.as_deref())?;
        let (design, removed) = correspondence::reduce(&read);
        let expand = match self.registers {
            Some(word) => word == RegisterWord::Expand,
            None => target == Some(circuit::formats::CircuitFormat::Dot),
        };
        let source = if expand { registers::expand(&design) } else { design.logic.clone() };
        let options = self.mapping.options();
        let mapped = synthesize(source.clone(), &library, &options).map_err(Failure::plain)?.netlist;
        let result = Design { logic: mapped, registers: if expand { Vec::new() } else { design.registers.clone() } };
        if let (Some(path), Some(target)) = (&self.output, target) {
            let bytes = store::encode_circuit(&result, target).map_err(Failure::plain)?;
            store::write(path, &bytes).map_err(|error| Failure::unwritable(path, &error))?;
        }
        let mut report = Report::of(&design, removed, &result.logic, started);
        for function in what_if {
            let mut more = library.clone();
            more.insert(function, crate::circuit::CellKind::uniform(1, 1.0));
            let found = synthesize(source.clone(), &more, &options).map_err(Failure::plain)?;
            let cells = found.netlist.cells().count();
            report.what_if.insert(function.name().to_owned(), report.cells as i64 - cells as i64);
        }
        match context.format {
            OutputFormat::Json => context.print_json(Schema::Synth, &report)?,
            OutputFormat::Text => context.print(report.text())?,
        }
        Ok(Status::Done)
    }
}

impl Report {
    fn of(design: &Design, removed: Removed, mapped: &Netlist, started: Instant) -> Self {
        Self {
            cells: mapped.cells().count(),
            by_function: mapped.by_function(),
            depth: levels::depth(mapped),
            inputs: design.inputs(),
            outputs: design.outputs(),
            latches: design.registers.len(),
            removed: removed.into(),
            // A circuit that is not proved is never reported.
            proved: true,
            seconds: started.elapsed().as_secs_f64(),
            what_if: BTreeMap::new(),
        }
    }

    fn text(&self) -> String {
        let parts: Vec<_> = self.by_function.iter().map(|(name, count)| format!("{count} {name}")).collect();
        let latches = if self.latches > 0 { format!(", {} registers", self.latches) } else { String::new() };
        let mut text = format!(
            "{} cells ({}), {} levels{latches}, proved, {:.2} s\n",
            self.cells,
            parts.join(", "),
            self.depth,
            self.seconds
        );
        text.push_str(&self.removed.text());
        for (name, saved) in &self.what_if {
            text.push_str(&format!("with `{name}`: {saved} cells fewer\n"));
        }
        text
    }
}

/// The format for a file's extension.
fn format(path: &Path) -> Result<circuit::formats::CircuitFormat, Failure> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    circuit::formats::CircuitFormat::of_ending(&ending)
        .ok_or_else(|| UsageError::CircuitFormat { path: path.display().to_string() }.into())
}
