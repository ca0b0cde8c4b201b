//! `nbc synth`: circuits of other tools, made of few robots' cells and proved.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use clap::{Args, ValueEnum};
use serde::Serialize;

use crate::circuit::formats::{Design, aiger, bench, blif, dot, nb, verilog};
use crate::circuit::{Netlist, levels, registers};
use crate::cli::mapping::{MappingArguments, functions, synthesize};
use crate::cli::{Context, Failure, Format, Status};
use crate::diag::{Code, Diagnostic};
use crate::source::Sources;
use crate::store;

const EXAMPLES: &str = "\
Examples:
  nbc synth adder.blif -o adder_nand.blif --cells nand,not
  nbc synth c880.aig -o c880.nb --effort high
  nbc synth adder.blif --cells nand,not --what-if xor,and";

/// Make a circuit of another tool out of few robots, and prove the result
///
/// Reads BLIF, AIGER, .bench and, where Yosys is installed, Verilog; writes BLIF, AIGER, Verilog, DOT and .nb by the name's ending.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The circuit: .blif, .aig, .aag, .bench or .v
    input: PathBuf,
    /// Where to write the result: .blif, .aig, .aag, .v, .dot or .nb
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[command(flatten)]
    mapping: MappingArguments,
    /// The clock of latches for which the file names none
    #[arg(long, value_name = "NAME")]
    clock: Option<String>,
    /// Registers as registers, or made of cells; by default as the output needs it
    #[arg(long, value_enum)]
    registers: Option<RegisterWord>,
    /// Say how many cells each of these functions would save, were there a robot for it
    #[arg(long, value_name = "FUNCTIONS", value_delimiter = ',')]
    what_if: Vec<String>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum RegisterWord {
    /// As registers of the output's format
    Keep,
    /// As latches and flip-flops made of cells
    Expand,
}

/// What came of it, for programs.
#[derive(Serialize)]
struct Report {
    cells: usize,
    by_function: BTreeMap<&'static str, usize>,
    depth: u32,
    inputs: usize,
    outputs: usize,
    latches: usize,
    proved: bool,
    seconds: f64,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    what_if: BTreeMap<String, i64>,
}

/// The formats that can be written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Target {
    Blif,
    AigerBinary,
    AigerText,
    Verilog,
    Dot,
    Nb,
}

impl Arguments {
    /// Reads, synthesizes, proves and writes.
    ///
    /// # Errors
    /// Input that cannot be read or mapped, and output that cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let started = Instant::now();
        let target = self.output.as_deref().map(target).transpose()?;
        let library = self.mapping.library()?;
        let what_if = functions(&self.what_if)?;
        let design = read(&self.input, self.clock.as_deref())?;
        let expand = match self.registers {
            Some(word) => word == RegisterWord::Expand,
            None => matches!(target, Some(Target::Nb | Target::Dot)),
        };
        let source = if expand { registers::expand(&design) } else { design.logic.clone() };
        let options = self.mapping.options();
        let mapped = synthesize(&source, &library, options)?;
        let result = Design { logic: mapped, registers: if expand { Vec::new() } else { design.registers.clone() } };
        if let (Some(path), Some(target)) = (&self.output, target) {
            let bytes = write(&result, target)
                .map_err(|message| Failure::plain(Diagnostic::without_place(Code::BadValue, message)))?;
            store::write(path, &bytes).map_err(|error| Failure::unwritable(path, &error))?;
        }
        let mut report = Report::of(&design, &result.logic, started);
        for function in what_if {
            let mut more = library.clone();
            more.insert(function, crate::circuit::CellKind::uniform(1, 1.0));
            let cells = synthesize(&source, &more, options)?.cells().count();
            report.what_if.insert(function.name().to_owned(), report.cells as i64 - cells as i64);
        }
        match context.format {
            Format::Json => context.print_json(&report)?,
            Format::Text => context.print(report.text())?,
        }
        Ok(Status::Done)
    }
}

impl Report {
    fn of(design: &Design, mapped: &Netlist, started: Instant) -> Self {
        Self {
            cells: mapped.cells().count(),
            by_function: mapped.by_function(),
            depth: levels::depth(mapped),
            inputs: design.inputs(),
            outputs: design.outputs(),
            latches: design.registers.len(),
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
        for (name, saved) in &self.what_if {
            text.push_str(&format!("with `{name}`: {saved} cells fewer\n"));
        }
        text
    }
}

pub(super) fn unreadable(path: &Path, error: &std::io::Error) -> Failure {
    let message = format!("cannot read `{}`: {}", path.display(), error.to_string().to_lowercase());
    Failure::plain(Diagnostic::without_place(Code::Unreadable, message))
}

fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    const MOST: u64 = 1 << 30;
    let size = std::fs::metadata(path).map_err(|error| unreadable(path, &error))?.len();
    if size > MOST {
        let message = format!("`{}` has {size} bytes, and at most {MOST} are read", path.display());
        return Err(Failure::plain(Diagnostic::without_place(Code::Unreadable, message)));
    }
    std::fs::read(path).map_err(|error| unreadable(path, &error))
}

/// Reads a circuit by the ending of its name.
fn read(path: &Path, clock: Option<&str>) -> Result<Design, Failure> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    match ending.as_str() {
        "aig" | "aag" => aiger::read(&bytes(path)?, clock).map_err(Failure::plain),
        "blif" | "bench" => read_text(path.display().to_string(), bytes(path)?, &ending, clock),
        "v" | "sv" => read_verilog(path, clock),
        _ => {
            let message = format!("`{}` is of no format that can be read", path.display());
            let fault = Diagnostic::without_place(Code::BadValue, message);
            Err(Failure::plain(fault.with_help("expected a name that ends in .blif, .aig, .aag, .bench or .v")))
        }
    }
}

fn read_text(name: String, bytes: Vec<u8>, ending: &str, clock: Option<&str>) -> Result<Design, Failure> {
    let text = match String::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => {
            let at = error.utf8_error().valid_up_to();
            let message = format!("`{name}` is no text: byte {at} is not UTF-8");
            return Err(Failure::plain(Diagnostic::without_place(Code::Unreadable, message)));
        }
    };
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let text = &sources.file(file).text;
    let read = if ending == "bench" { bench::read(text, file, clock) } else { blif::read(text, file, clock) };
    read.map_err(|diagnostics| Failure::input(diagnostics, sources))
}

/// Reads Verilog through Yosys, which flattens it to gates, latches and flip-flops.
fn read_verilog(path: &Path, clock: Option<&str>) -> Result<Design, Failure> {
    bytes(path)?;
    let folder = tempfile::tempdir().map_err(|error| unreadable(Path::new("a temporary folder"), &error))?;
    let flat = folder.path().join("flat.blif");
    let script = format!(
        "read_verilog -sv \"{}\"; hierarchy -check -auto-top; proc; flatten; opt; memory; opt; techmap; \
         dfflegalize -cell $_DFF_P_ 01 -cell $_DFF_N_ 01 -cell $_DLATCH_P_ 01 -cell $_DLATCH_N_ 01; simplemap; \
         opt_clean; write_blif \"{}\"",
        path.display(),
        flat.display()
    );
    let message = |text: String| Failure::plain(Diagnostic::without_place(Code::CircuitFile, text));
    match Command::new("yosys").args(["-q", "-p", &script]).output() {
        Err(_) => {
            let fault =
                Diagnostic::without_place(Code::Unreadable, "Verilog is read through Yosys, which is not installed");
            Err(Failure::plain(
                fault.with_help("install it, on Debian with `apt-get install yosys`, or give a BLIF file"),
            ))
        }
        Ok(output) if !output.status.success() => {
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            let error = said.lines().find(|line| line.contains("ERROR")).unwrap_or("no reason given");
            Err(message(format!("yosys cannot read `{}`: {}", path.display(), error.trim())))
        }
        Ok(_) => read_text(format!("{} (as BLIF)", path.display()), bytes(&flat)?, "blif", clock),
    }
}

fn target(path: &Path) -> Result<Target, Failure> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    Ok(match ending.as_str() {
        "blif" => Target::Blif,
        "aig" => Target::AigerBinary,
        "aag" => Target::AigerText,
        "v" | "sv" => Target::Verilog,
        "dot" | "gv" => Target::Dot,
        "nb" => Target::Nb,
        _ => {
            let message = format!("`{}` is of no format that can be written", path.display());
            let fault = Diagnostic::without_place(Code::BadValue, message);
            return Err(Failure::plain(
                fault.with_help("expected a name that ends in .blif, .aig, .aag, .v, .dot or .nb"),
            ));
        }
    })
}

/// A design in a format, or why it has no form in it.
fn write(design: &Design, target: Target) -> Result<Vec<u8>, &'static str> {
    let looped = !crate::circuit::Loops::of(&design.logic).cores().is_empty();
    if looped && matches!(target, Target::AigerBinary | Target::AigerText) {
        return Err("AIGER has no feedback loops: keep the registers with `--registers keep`");
    }
    if !design.registers.is_empty() && matches!(target, Target::Nb) {
        return Err("a .nb file is written with its registers made of cells: leave out `--registers keep`");
    }
    Ok(match target {
        Target::Blif => blif::write(design).into_bytes(),
        Target::AigerBinary => aiger::write(design, true),
        Target::AigerText => aiger::write(design, false),
        Target::Verilog => verilog::write(design).into_bytes(),
        Target::Dot => dot::write(&design.logic).into_bytes(),
        Target::Nb => nb::write(&design.logic).into_bytes(),
    })
}
