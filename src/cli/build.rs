//! `nbc build`: a circuit of a .nb file as a netlist of robots' cells, in one of several forms.

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde::Serialize;

use crate::cli::harden::HardenArguments;
use crate::cli::options::making::MakingArguments;
use crate::cli::options::mapping::CellsArguments;
use crate::cli::options::new_path::new_path;
use crate::cli::source_path::source_path;
use crate::cli::wording;
use crate::cli::{Context, Failure, OutputFormat, Status};
use nbc_base::diag::counted;
use nbc_base::model::Column;
use nbc_circuit::formats::{Design, blif, dot, verilog};
use nbc_circuit::passes;
use nbc_circuit::timing::{PhaseTiming, fan_out};
use nbc_circuit::waves::WaveTiming;
use nbc_circuit::{CellLibrary, Memory, NetId, Netlist, levels, rings};
use nbc_session::report::{self, Document, Schema};
use nbc_session::store::DiskWorld;
use nbc_session::{CompileOptions, Hardened, Mapping, Session};

const EXAMPLES: &str = "\
Examples:
  nbc build circuits/latch.nb                    the netlist as text
  nbc build circuits/latch.nb --emit blif -o latch.blif
  nbc build circuits/counter.nb --emit timing    the times of its clock
  nbc build circuits/counter.nb --harden 20%     without the robots that fail in other worlds
  nbc build adder.nb --circuit 'adder[8]' --cells nand,not --emit json";

/// Compile a circuit to robots, prove the result, and print its netlist
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct BuildArguments {
    /// The .nb file
    file: PathBuf,
    /// The output [default: netlist, with `--format json` json]
    #[arg(long, value_enum)]
    emit: Option<Emit>,
    /// The file to write instead of standard output
    #[arg(short, long, value_name = "OUT", value_parser = new_path())]
    output: Option<PathBuf>,
    #[command(flatten)]
    making: MakingArguments,
    #[command(flatten)]
    cells: CellsArguments,
    #[command(flatten)]
    harden: HardenArguments,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Emit {
    /// Text with a line for each cell
    Netlist,
    /// The circuit as written after each pass before mapping
    Passes,
    /// BLIF
    Blif,
    /// Structural Verilog
    Verilog,
    /// A graph for Graphviz
    Dot,
    /// The slowest path, the times of clocks, inputs and memory, and the largest fan-out
    Timing,
    /// JSON with cells, levels, hold, critical path and clocks
    Json,
}

impl BuildArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let (kind, chosen) = (self.emit(context.format)?, self.cells.chosen()?);
        let mut session = Session::new(DiskWorld);
        let checked = session.open(source_path(&self.file)?)?;
        let circuit = checked.circuit(&self.making.choice())?;
        let options = self.making.options()?;
        let Some(hardened) = self.harden.find(&session, &checked, &circuit, &options, context)? else {
            return Ok(Status::Interrupted);
        };
        let options = CompileOptions { without: hardened.without.clone(), ..options };
        let mapping = match chosen {
            Some(cells) => checked.map_onto(&circuit, &cells, &options)?,
            None => checked.map(&circuit, &options)?,
        };
        context.origins(&checked);
        let is_short = !hardened.tried.is_empty() && !hardened.reached;
        let text = emit(kind, mapping, hardened);
        match &self.output {
            Some(path) => context.write(path, text.as_bytes())?,
            None => context.print(text)?,
        }
        Ok(if is_short { Status::TestFailed } else { Status::Done })
    }

    fn emit(&self, format: OutputFormat) -> Result<Emit, Failure> {
        match (self.emit, format) {
            (None, OutputFormat::Text) => Ok(Emit::Netlist),
            (None | Some(Emit::Json), OutputFormat::Json) => Ok(Emit::Json),
            (Some(emit), OutputFormat::Text) => Ok(emit),
            (Some(_), OutputFormat::Json) => Err(wording::two_formats("--emit").into()),
        }
    }
}

fn emit(emit: Emit, mapping: Mapping, hardened: Hardened) -> String {
    match emit {
        Emit::Netlist => mapping.netlist.to_string(),
        Emit::Passes => describe_passes(mapping.source),
        Emit::Blif => blif::write(&Design::new(mapping.netlist)),
        Emit::Verilog => verilog::write(&Design::new(mapping.netlist)),
        Emit::Dot => dot::write(&mapping.netlist),
        Emit::Timing => describe_timing(&mapping),
        Emit::Json => {
            let document = Document::new(Schema::Build, BuiltCircuit::of(&mapping, hardened));
            serde_json::to_string(&document).expect("a netlist has nothing that JSON cannot say") + "\n"
        }
    }
}

fn describe_passes(source: Netlist) -> String {
    let cells = |netlist: &Netlist| counted(netlist.cells().count(), "cell");
    let mut before = source.to_string();
    let mut text = format!("as written: {}\n{before}", cells(&source));
    for (pass, netlist) in passes::after_each(source).expect("the circuit was mapped") {
        let after = netlist.to_string();
        let (left, shown) = match after == before {
            true => ("no change".to_owned(), ""),
            false => (cells(&netlist), after.as_str()),
        };
        text += &format!("\n{} ({}): {left}\n{shown}", pass.name, pass.about);
        before = after;
    }
    text
}

fn describe_timing(mapping: &Mapping) -> String {
    let Mapping { netlist: mapped, cells: library, kept, waves, .. } = mapping;
    let timing = mapping.timing();
    let loads = fan_out(mapped).into_iter().filter(|(id, _)| mapped.cell(*id).is_some());
    let loads = report::describe_fan_out(loads.map(|(id, load)| (mapped.net_name(id), load)));
    if let Some(machine) = waves {
        return WaveTiming::of(machine).describe() + &loads;
    }
    let path = mapped.net_names(&timing.critical_path);
    let settles = report::describe_settling(timing.hold, &path, &mapped.net_names(&rings(mapped)));
    let phases = PhaseTiming::of(mapped, &timing, library.kinds_of(mapped), kept).describe();
    let memory = report::describe_memory(&Memory::all(mapped, &timing, clocks(mapped, library)));
    settles + &phases + &memory + &loads
}

fn clocks<'a>(mapped: &'a Netlist, library: &'a CellLibrary) -> impl Fn(NetId) -> u32 + 'a {
    |id| mapped.cell(id).and_then(|cell| library.get(cell.function)).map_or(0, |kind| kind.clock)
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct BuiltCircuit<'a> {
    circuit: &'a str,
    ports: BuiltPorts,
    /// The bits of the input ports: those of a port `a` of width 2 are `a[1]` and `a[0]`.
    inputs: Vec<String>,
    /// The net of each bit of the output ports.
    outputs: BTreeMap<String, String>,
    cells: Vec<BuiltCell>,
    by_function: BTreeMap<&'static str, usize>,
    /// Cells on the longest path.
    depth: u32,
    /// Cycles after which every net is correct.
    hold: u32,
    critical_path: Vec<String>,
    /// The nets of rings of inverters, which keep changing.
    rings: Vec<String>,
    memory: Vec<Memory>,
    phases: PhaseTiming,
    /// The steps and phases of a wave machine.
    waves: Option<WaveTiming>,
    /// Always true: a circuit whose logic is not proved is an error.
    proved: bool,
    /// The robots that `--harden` left out.
    hardened: Option<Hardened>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct BuiltPorts {
    inputs: Vec<Column>,
    outputs: Vec<Column>,
}

/// Its times are in cycles.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct BuiltCell {
    name: String,
    /// The gate, such as `nand`.
    function: &'static str,
    pins: Vec<String>,
    /// The bit at the start, if it is declared.
    start: Option<bool>,
    arrival: u32,
    /// Cycles after which it must be correct so that the hold suffices.
    required: u32,
    slack: u32,
    fan_out: usize,
}

impl<'a> BuiltCircuit<'a> {
    fn of(mapping: &'a Mapping, hardened: Hardened) -> Self {
        let Mapping { netlist: mapped, cells: library, kept, waves, .. } = mapping;
        let timing = mapping.timing();
        // The rings of a wave machine are its waves.
        let rings = if waves.is_none() { mapped.net_names(&rings(mapped)) } else { Vec::new() };
        let name = |id: &NetId| mapped.net_name(*id);
        let fan_out: BTreeMap<NetId, usize> = fan_out(mapped).into_iter().collect();
        let cells = mapped.cells().map(|(id, cell)| BuiltCell {
            name: name(&id),
            function: cell.function.name(),
            pins: mapped.net_names(&mapped.pins(id)),
            start: cell.start,
            arrival: timing.arrival(id),
            required: timing.required(id),
            slack: timing.slack(id),
            fan_out: fan_out[&id],
        });
        let ports = |ids: &[NetId]| Column::group(&mapped.net_names(ids));
        Self {
            circuit: &mapped.name,
            ports: BuiltPorts { inputs: ports(mapped.inputs()), outputs: ports(mapped.outputs()) },
            inputs: mapped.net_names(mapped.inputs()),
            outputs: mapped.outputs().iter().map(|id| (name(id), name(&mapped.pins(*id)[0]))).collect(),
            cells: cells.collect(),
            by_function: mapped.by_function(),
            depth: levels::depth(mapped),
            hold: timing.hold,
            critical_path: mapped.net_names(&timing.critical_path),
            rings,
            memory: Memory::all(mapped, &timing, clocks(mapped, library)),
            phases: PhaseTiming::of(mapped, &timing, library.kinds_of(mapped), kept),
            waves: waves.as_ref().map(WaveTiming::of),
            proved: true,
            hardened: (!hardened.tried.is_empty()).then_some(hardened),
        }
    }
}
