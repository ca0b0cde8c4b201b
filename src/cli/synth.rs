//! `nbc synth`: circuits of other tools, mapped to cells of few robots and proved.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, ValueEnum};
use serde::Serialize;

use crate::cli::options::mapping::{MappingArguments, functions};
use crate::cli::options::new_path::new_path;
use crate::cli::wording::UsageError;
use crate::cli::{Context, Failure, Status};
use nbc_base::diag::counted;
use nbc_base::diag::suggest::alternatives;
use nbc_base::source::{ProofOrigin, Simulated};
use nbc_circuit::correspondence::{self, Removed};
use nbc_circuit::formats::buses::renumbered;
use nbc_circuit::formats::{CircuitFormat, Design};
use nbc_circuit::reachable::{self, Reachable, WhyEveryState};
use nbc_circuit::{CellLibrary, MapOptions, Netlist, levels, registers};
use nbc_session::report::Schema;
use nbc_session::store::{self, CircuitFile, CircuitRead, ParameterValue, TopModule};
use nbc_session::synthesize;

const EXAMPLES: &str = "\
Examples:
  nbc synth adder.blif -o adder_nand.blif --cells nand,not
  nbc synth c880.aig -o c880.nb --effort high
  nbc synth fifo.v ram.v --top fifo --param WIDTH=4 -o fifo.nb
  nbc synth adder.blif --cells nand,not --what-if xor,and";

/// Map another tool's circuit to few robots, and prove the result
///
/// Reads BLIF, AIGER, .bench and, if Yosys is installed, Verilog. Writes BLIF, AIGER, Verilog, DOT and .nb. The file's
/// extension selects the format.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct SynthArguments {
    /// The circuit: .blif, .aig, .aag, .bench, or one or more files of Verilog, .v or .sv
    #[arg(required = true)]
    input: Vec<PathBuf>,
    /// The file to write: .blif, .aig, .aag, .v, .dot or .nb
    #[arg(short, long, value_name = "OUT", value_parser = new_path())]
    output: Option<PathBuf>,
    #[command(flatten)]
    mapping: MappingArguments,
    /// The module of Verilog or model of BLIF [default: the module that contains most, or the first model]
    #[arg(long, value_name = "NAME")]
    top: Option<String>,
    /// A parameter of the Verilog module, such as `N=8`; may be repeated
    ///
    /// The value stands in the place of the default: `N=-2` has a sign and 32 bits, `N=4'b0101` is as it is written.
    #[arg(long, value_name = "NAME=NUMBER", value_parser = parameter)]
    param: Vec<(String, ParameterValue)>,
    /// The clock of latches without a clock in the file
    #[arg(long, value_name = "NAME")]
    clock: Option<String>,
    /// Keep registers or expand them to cells [default: depends on the output format]
    #[arg(long, value_enum)]
    registers: Option<RegisterWord>,
    /// Allow any outputs and next states in unreachable states
    ///
    /// The result is then correct only if every register begins with its start value. The set of reachable states is
    /// proved and reported. All registers of the design must be flip-flops.
    #[arg(long)]
    reachable_only: bool,
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
    #[serde(skip_serializing_if = "Option::is_none")]
    unreachable: Option<UnreachableReport>,
    proved: bool,
    proof: ProofReport,
    seconds: f64,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    what_if: BTreeMap<String, i64>,
}

/// What the proof begins with.
#[derive(Serialize)]
struct ProofReport {
    /// `file`, or `yosys` for its netlist.
    from: &'static str,
    /// The version of Yosys.
    #[serde(skip_serializing_if = "Option::is_none")]
    version: Option<String>,
    /// The simulator that compared the netlist with the file, and the steps that were equal.
    #[serde(skip_serializing_if = "Option::is_none")]
    simulator: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    steps: Option<usize>,
    /// Why it compared nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    not_simulated: Option<&'static str>,
    /// All this in words.
    #[serde(skip)]
    words: String,
}

impl From<ProofOrigin> for ProofReport {
    fn from(origin: ProofOrigin) -> Self {
        let words = origin.to_string();
        let ProofOrigin::Yosys { version, simulated } = origin else {
            return Self { from: "file", version: None, simulator: None, steps: None, not_simulated: None, words };
        };
        let steps = match simulated {
            Simulated::Equal { steps } => Some(steps),
            _ => None,
        };
        let (simulator, not_simulated) = (steps.map(|_| "iverilog"), simulated.why_not());
        Self { from: "yosys", version: Some(version), simulator, steps, not_simulated, words }
    }
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

/// What was assumed of the states of a design.
#[derive(Serialize)]
struct UnreachableReport {
    /// Why nothing is assumed.
    #[serde(skip_serializing_if = "Option::is_none")]
    unused: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reachable_states: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    states: Option<u64>,
    relations: Vec<BTreeMap<String, u8>>,
    cells_saved: usize,
}

impl UnreachableReport {
    fn unused(why: &WhyEveryState) -> Self {
        let why = Some(why.to_string());
        Self { unused: why, reachable_states: None, states: None, relations: Vec::new(), cells_saved: 0 }
    }

    fn of(reachable: &Reachable, cells_saved: usize) -> Self {
        let relation = |relation: &Vec<(String, bool)>| {
            relation.iter().map(|(name, value)| (name.clone(), u8::from(*value))).collect()
        };
        Self {
            unused: None,
            reachable_states: reachable.states.map(|(reached, _)| reached),
            states: reachable.states.map(|(_, all)| all),
            relations: reachable.relations.iter().map(relation).collect(),
            cells_saved,
        }
    }

    fn text(&self) -> String {
        if let Some(why) = &self.unused {
            return format!("every state counts: {why}\n");
        }
        let known = match (self.reachable_states, self.states) {
            (Some(reached), Some(all)) => format!("{reached} of {all} states are reachable"),
            _ => format!("{} relations between registers hold in every reachable state", self.relations.len()),
        };
        let limit = if self.cells_saved > 0 { "; the result is right in reachable states only" } else { "" };
        format!("{known}: {} fewer{limit}\n", counted(self.cells_saved, "cell"))
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
        let top = TopModule { name: self.top, parameters: self.param.into_iter().collect() };
        let (path, others) = self.input.split_first().expect("a file is required");
        let file = CircuitFile { path, others, clock: self.clock.as_deref(), top: &top };
        let CircuitRead { design: read, warnings, origin } = store::read_circuit(&file)?;
        context.tell(&warnings.list, &warnings.sources);
        let (design, removed) = correspondence::reduce(&read);
        let expand = match self.registers {
            Some(word) => word == RegisterWord::Expand,
            None => target == Some(CircuitFormat::Dot),
        };
        let options = self.mapping.options();
        let whole = Made::of(design, expand, &library, &options)?;
        // The result with its registers is proved to be what was read, too. For registers made of cells, the design
        // without needless registers was proved, and then its cells.
        if !expand {
            whole.is_what_was_read(&read, &removed);
        }
        let (made, unreachable) = match self.reachable_only {
            true => whole.within_reach(expand, &library, &options)?,
            false => (whole, None),
        };
        let Made { design, source, result } = made;
        if let (Some(path), Some(target)) = (&self.output, target) {
            let bytes = store::encode_circuit(&result, target).map_err(Failure::plain)?;
            context.write(path, &bytes)?;
            let others = if target == CircuitFormat::Nb { renumbered(&result) } else { Vec::new() };
            if !others.is_empty() {
                let them = alternatives(&others, "and");
                context.log(&format!("the bits of {them} are numbered from 0 at the right in .nb\n"));
            }
        }
        let proof = origin.into();
        let mut report = Report { unreachable, proof, ..Report::of(&design, removed, &result.logic, started) };
        for function in what_if {
            let mut more = library.clone();
            more.insert(function, nbc_circuit::CellKind::uniform(1, 1.0));
            let found = synthesize(source.clone(), &more, &options).map_err(Failure::plain)?;
            let cells = found.netlist.cells().count();
            report.what_if.insert(function.name().to_owned(), report.cells as i64 - cells as i64);
        }
        context.print_result(Schema::Synth, &report, || report.text())?;
        Ok(Status::Done)
    }
}

/// A design and what it became.
struct Made {
    design: Design,
    /// Its logic, with its registers if they are expanded.
    source: Netlist,
    result: Design,
}

impl Made {
    fn of(design: Design, expand: bool, library: &CellLibrary, options: &MapOptions) -> Result<Self, Failure> {
        let source = if expand { registers::expand(&design) } else { design.logic.clone() };
        let logic = synthesize(source.clone(), library, options).map_err(Failure::plain)?.netlist;
        let registers = if expand { Vec::new() } else { design.registers.clone() };
        let ascending = design.ascending.clone();
        Ok(Self { design, source, result: Design { logic, registers, ascending } })
    }

    /// Proves the result equal to the design that was read, before any pass.
    ///
    /// # Panics
    /// When they differ, which is a fault of the compiler.
    fn is_what_was_read(&self, read: &Design, removed: &Removed) {
        if let Err(error) = correspondence::prove(read, &self.result, removed) {
            panic!("the circuit `{}` differs from its file: {error}", read.logic.name);
        }
    }

    fn cells(&self) -> usize {
        self.result.logic.cells().count()
    }

    /// The same design where only reachable states count, if that saves cells.
    fn within_reach(
        self,
        expand: bool,
        library: &CellLibrary,
        options: &MapOptions,
    ) -> Result<(Self, Option<UnreachableReport>), Failure> {
        let (simpler, reachable) = match reachable::simplify(&self.design, library, options) {
            Ok(found) => found,
            Err(why) => return Ok((self, Some(UnreachableReport::unused(&why)))),
        };
        let other = Self::of(simpler, expand, library, options)?;
        let saved = self.cells().saturating_sub(other.cells());
        let report = UnreachableReport::of(&reachable, saved);
        Ok((if saved > 0 { other } else { self }, Some(report)))
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
            unreachable: None,
            // A circuit that is not proved is never reported.
            proved: true,
            proof: ProofOrigin::File.into(),
            seconds: started.elapsed().as_secs_f64(),
            what_if: BTreeMap::new(),
        }
    }

    fn text(&self) -> String {
        let parts: Vec<_> = self.by_function.iter().map(|(name, count)| format!("{count} {name}")).collect();
        let latches = if self.latches > 0 { format!(", {}", counted(self.latches, "register")) } else { String::new() };
        let mut text = format!(
            "{} ({}), {}{latches}, proved from {}, {:.2} s\n",
            counted(self.cells, "cell"),
            parts.join(", "),
            counted(self.depth as usize, "level"),
            self.proof.words,
            self.seconds
        );
        text.extend(self.proof.version.iter().map(|version| format!("read by Yosys {version}\n")));
        text.push_str(&self.removed.text());
        text.extend(self.unreachable.iter().map(UnreachableReport::text));
        for (name, saved) in &self.what_if {
            let cells = counted(saved.unsigned_abs() as usize, "cell");
            text.push_str(&format!("with `{name}`: {cells} {}\n", if *saved < 0 { "more" } else { "fewer" }));
        }
        text
    }
}

/// A parameter with its value.
fn parameter(text: &str) -> Result<(String, ParameterValue), String> {
    let (name, value) = text.split_once('=').unwrap_or((text, ""));
    let value = value.parse().map_err(|expected| format!("expected a name and a number: {expected}"))?;
    Ok((name.to_owned(), value))
}

/// The format for a file's extension.
fn format(path: &Path) -> Result<CircuitFormat, Failure> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    CircuitFormat::of_ending(&ending)
        .ok_or_else(|| UsageError::CircuitFormat { path: path.display().to_string() }.into())
}
