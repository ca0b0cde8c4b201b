//! Designs of other tools' files, without the registers that they do not need.

use crate::check::verilog_files::verilog_files;
use crate::check::wording::{self, at_use};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::source::{ForeignCircuit, SourceFile, SourceWorld, Span, VerilogModule};
use nbc_circuit::correspondence;
use nbc_circuit::formats::{CircuitSource, Design, aiger, bench, blif, is_word, pla, verilog_module};

pub(super) struct Foreign<'a> {
    pub(super) world: &'a dyn SourceWorld,
    pub(super) format: CircuitSource,
    pub(super) name: &'a str,
    pub(super) place: Span,
}

pub(super) struct ForeignDesign {
    pub(super) designs: Vec<Design>,
    pub(super) warnings: Vec<Diagnostic>,
    pub(super) circuits: Vec<ForeignCircuit>,
}

impl Foreign<'_> {
    /// The design of a file of any format but Verilog, and warnings; `source` is its text, if it is one.
    pub(super) fn design(&self, source: Option<&SourceFile>) -> Result<(Design, Vec<Diagnostic>), Vec<Diagnostic>> {
        let Some(SourceFile { text, id, .. }) = source else { return Ok((self.aiger()?, Vec::new())) };
        let clock = Some(Design::CLOCK);
        let (design, warnings) = match self.format {
            CircuitSource::Pla => (self.titled(pla::read(text, *id)?), pla::opened(text, *id)),
            CircuitSource::Bench => (self.titled(bench::read(text, *id, clock)?), Vec::new()),
            _ => (blif::read(text, *id, clock)?, blif::ignored(text, *id)),
        };
        Ok((self.circuit(&design)?, warnings))
    }

    pub(super) fn verilog(&self, files: &[&SourceFile]) -> Result<ForeignDesign, Vec<Diagnostic>> {
        let here = |faults: Vec<Diagnostic>| faults.into_iter().map(|fault| at_use(fault, self.place)).collect();
        let modules = self.world.read_verilog(&verilog_files(self.world, files));
        let modules = modules.map_err(|error| here(Diagnostic::unread_verilog(files, &error)))?;
        let circuit = |module: &VerilogModule| self.circuit(&self.module(module, files)?);
        let origin = |(at, module): (usize, &VerilogModule)| ForeignCircuit {
            file: self.name.to_owned(),
            circuit: module.name.clone(),
            origin: modules.origin(at),
        };
        Ok(ForeignDesign {
            designs: modules.modules.iter().map(circuit).collect::<Result<_, _>>()?,
            warnings: here(modules.notes.iter().map(|note| Diagnostic::of_verilog(files, note)).collect()),
            circuits: modules.modules.iter().enumerate().map(origin).collect(),
        })
    }

    fn aiger(&self) -> Result<Design, Vec<Diagnostic>> {
        let unreadable = |error| vec![wording::unreadable_use(self.name, &error, &Suggestion::None, self.place)];
        let bytes = self.world.read_bytes(self.name).map_err(unreadable)?;
        let design = aiger::read(&bytes, Some(Design::CLOCK)).map_err(|fault| vec![at_use(fault, self.place)])?;
        self.circuit(&self.titled(design))
    }

    /// For formats without names of circuits.
    fn titled(&self, mut design: Design) -> Design {
        let file = self.name.rsplit('/').next().unwrap_or(self.name);
        design.netlist.name = file.rsplit_once('.').map_or(file, |(stem, _)| stem).to_owned();
        design
    }

    fn module(&self, module: &VerilogModule, files: &[&SourceFile]) -> Result<Design, Vec<Diagnostic>> {
        self.legal(&module.name)?;
        let design = verilog_module(module, files, Some(Design::CLOCK));
        design.map_err(|faults| faults.into_iter().map(|fault| at_use(fault, self.place)).collect())
    }

    fn circuit(&self, design: &Design) -> Result<Design, Vec<Diagnostic>> {
        let name = &design.netlist.name;
        self.legal(name)?;
        if design.netlist.outputs().is_empty() {
            return Err(vec![wording::no_outputs(name, self.place)]);
        }
        Ok(correspondence::reduce(design).0)
    }

    fn legal(&self, circuit: &str) -> Result<(), Vec<Diagnostic>> {
        if is_word(circuit) {
            return Ok(());
        }
        let rename = match self.format {
            CircuitSource::Aiger | CircuitSource::Bench | CircuitSource::Pla => {
                "rename the file: the circuit has its name"
            }
            CircuitSource::Blif => "write another name after `.model`",
            CircuitSource::Verilog => "rename the module",
        };
        Err(vec![wording::circuit_name(circuit, rename, self.place)])
    }
}
