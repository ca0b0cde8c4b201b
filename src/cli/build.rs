//! `nbc build`: a circuit of a .nb file as a netlist of robots' cells, in one of several forms.

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::json;

use crate::circuit::elaborate::elaborate;
use crate::circuit::formats::{Design, blif, dot, verilog};
use crate::circuit::timing::fan_out;
use crate::circuit::{CellLibrary, Delays, Memory, NetId, Netlist, Race, Timing, levels, races};
use crate::cli::mapping::{MappingArguments, synthesize};
use crate::cli::{Context, Failure, Status};
use crate::diag::{Code, Diagnostic};
use crate::model::{Circuit, Instance};
use crate::pipeline::{self, Loaded};
use crate::source::Sources;
use crate::store::{self, DiskWorld};

const EXAMPLES: &str = "\
Examples:
  nbc build circuits/latch.nb                    the netlist as text
  nbc build circuits/latch.nb --emit blif -o latch.blif
  nbc build adder.nb --circuit adder --cells nand,not --emit json";

/// Compile a circuit to a netlist of robots' cells, prove it, and print it
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The .nb file
    file: PathBuf,
    /// The circuit; by default the last one of the file
    #[arg(long, value_name = "NAME")]
    circuit: Option<String>,
    /// What to print
    #[arg(long, value_enum, default_value_t)]
    emit: Emit,
    /// Where to write it instead of printing it
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[command(flatten)]
    mapping: MappingArguments,
}

/// What to print.
#[derive(Clone, Copy, Default, ValueEnum)]
enum Emit {
    /// A line for each cell, for people
    #[default]
    Netlist,
    /// BLIF, for other tools
    Blif,
    /// Structural Verilog
    Verilog,
    /// A drawing for Graphviz
    Dot,
    /// Cells, levels, hold and the critical path, for programs
    Json,
}

impl Arguments {
    /// Compiles, proves and prints.
    ///
    /// # Errors
    /// When the file has errors, the library lacks a function, or the output cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let library = self.mapping.library()?;
        let Loaded { sources, checked } = pipeline::load(&DiskWorld, &self.file.to_string_lossy());
        if checked.has_errors() {
            return Err(Failure::input(checked.diagnostics, sources));
        }
        let own = |circuit: &&Circuit| sources.file(circuit.span.file).name == self.file.to_string_lossy();
        let own: Vec<_> = checked.program.circuits.iter().filter(own).collect();
        let circuit = self.choose(&own)?;
        let instance = Instance::from(circuit.name.as_str());
        let source = elaborate(&checked.program, &instance)
            .map_err(|faults| Failure::input(faults, Sources::clone(&sources)))?;
        let mapped = synthesize(&source, &library, self.mapping.options())?;
        let text = emit(self.emit, mapped, &library);
        match &self.output {
            Some(path) => store::write(path, text.as_bytes()).map_err(|error| Failure::unwritable(path, &error))?,
            None => context.print(text)?,
        }
        Ok(Status::Done)
    }

    fn choose<'c>(&self, circuits: &[&'c Circuit]) -> Result<&'c Circuit, Failure> {
        let found = match &self.circuit {
            Some(name) => circuits.iter().find(|circuit| circuit.name == *name),
            None => circuits.last(),
        };
        found.copied().ok_or_else(|| {
            let message = match &self.circuit {
                Some(name) => format!("`{}` declares no circuit `{name}`", self.file.display()),
                None => format!("`{}` declares no circuit", self.file.display()),
            };
            let names: Vec<_> = circuits.iter().map(|circuit| format!("`{}`", circuit.name)).collect();
            let fault = Diagnostic::without_place(Code::BadValue, message);
            Failure::plain(if names.is_empty() {
                fault
            } else {
                fault.with_help(format!("it declares {}", names.join(", ")))
            })
        })
    }
}

fn emit(emit: Emit, mapped: Netlist, library: &CellLibrary) -> String {
    match emit {
        Emit::Netlist => mapped.to_string(),
        Emit::Blif => blif::write(&Design { logic: mapped, registers: Vec::new() }),
        Emit::Verilog => verilog::write(&Design { logic: mapped, registers: Vec::new() }),
        Emit::Dot => dot::write(&mapped),
        Emit::Json => format!("{}\n", describe(&mapped, library)),
    }
}

fn describe(mapped: &Netlist, library: &CellLibrary) -> serde_json::Value {
    let timing = Timing::of(mapped, library, Delays::Clock);
    let name = |id: &NetId| mapped.net_name(*id);
    let fan_out: BTreeMap<NetId, usize> = fan_out(mapped).into_iter().collect();
    let cells: Vec<_> = mapped
        .cells()
        .map(|(id, cell)| {
            let pins: Vec<_> = mapped.pins(id).iter().map(name).collect();
            json!({ "name": name(&id), "function": cell.function.name(), "pins": pins, "start": cell.start,
                "arrival": timing.arrival(id), "required": timing.required(id), "slack": timing.slack(id),
                "fan_out": fan_out[&id] })
        })
        .collect();
    let outputs: BTreeMap<_, _> = mapped.outputs().iter().map(|id| (name(id), name(&mapped.pins(*id)[0]))).collect();
    let race = |race: Race| json!({ "net": name(&race.net), "input": name(&race.input), "rises": race.rises });
    let clock = |id| mapped.cell(id).and_then(|cell| library.get(cell.function)).map_or(0, |kind| kind.clock);
    let memory = Memory::all(mapped, &timing, clock).into_iter().map(|Memory { nets, pulse, setup, hold }| {
        let nets: Vec<_> = nets.iter().map(name).collect();
        json!({ "nets": nets, "pulse": pulse, "setup": setup, "hold": hold })
    });
    json!({
        "circuit": mapped.name,
        "inputs": mapped.inputs().iter().map(name).collect::<Vec<_>>(),
        "outputs": outputs,
        "cells": cells,
        "by_function": mapped.by_function(),
        "depth": levels::depth(mapped),
        "hold": timing.hold,
        "critical_path": timing.critical_path.iter().map(name).collect::<Vec<_>>(),
        "memory": memory.collect::<Vec<_>>(),
        "proved": true,
        "races": races(mapped).map(|races| races.into_iter().map(race).collect::<Vec<_>>()),
    })
}
