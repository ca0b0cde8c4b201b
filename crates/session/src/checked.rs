//! A parsed and checked source.

use std::sync::Arc;

use crate::contents;
use crate::context::{CheckContext, lock};
use nbc_base::diag::{Diagnostic, Diagnostics, Finding, findings};
use nbc_base::model::{Instance, Program};
use nbc_base::source::{FileId, ForeignCircuit, MemoryWorld, Sources, Span};
use nbc_circuit::{NetWidths, Netlist, elaborate};
use nbc_lang::check::{self, Analysis, LastChecks, NameUses};
use nbc_lang::syntax::tree::Tree;

/// A source with its program and its diagnostics, and all with which it is compiled, tested and proved.
#[derive(Clone, Debug)]
pub struct Checked {
    pub path: String,
    /// 0 for the world's text.
    pub revision: u64,
    /// The texts that spans point into: the source, the prelude and the files it uses.
    pub sources: Sources,
    /// `None` if it could not be read.
    pub file: Option<FileId>,
    /// Complete only if there are no errors.
    pub program: Program,
    /// In order of place.
    pub diagnostics: Vec<Diagnostic>,
    pub uses: NameUses,
    pub widths: NetWidths,
    pub(super) trees: Vec<Tree>,
    /// Built circuits with their parameters, including those of the prelude.
    pub instances: Vec<Instance>,
    /// Circuits of other tools' files, with the origin of their proofs.
    pub foreign: Vec<ForeignCircuit>,
    /// The check was cancelled, so a part of the result is missing.
    pub(super) is_cancelled: bool,
    pub(super) context: Arc<CheckContext>,
}

impl Checked {
    pub(super) fn read(context: Arc<CheckContext>, path: &str, revision: u64, last: &mut LastChecks) -> Self {
        let world = &context.world;
        let mut sources = Sources::default();
        let (file, analysis) = match check::open(world, path, &mut sources) {
            Ok(file) => (Some(file), check::check_again(world, &mut sources, file, last)),
            Err(fault) => (None, Analysis { diagnostics: vec![fault], ..Analysis::default() }),
        };
        let Analysis { program, diagnostics, uses, widths, trees, instances, foreign, is_cancelled } = analysis;
        let path = path.to_owned();
        Self {
            path,
            revision,
            sources,
            file,
            program,
            diagnostics,
            uses,
            widths,
            trees,
            instances,
            foreign,
            is_cancelled,
            context,
        }
    }

    /// The gates of a circuit as it is written; 0 if it has faults.
    pub fn gates(&self, circuit: &Instance) -> usize {
        elaborate(&self.program, circuit).map_or(0, |source| source.cells().count())
    }

    /// `None` if nothing could be parsed.
    pub fn tree(&self, file: FileId) -> Option<&Tree> {
        self.trees.iter().find(|tree| tree.declarations.first().is_some_and(|first| first.span.file == file))
    }

    /// Checks that the source declares a file of this name, and that a memory begins with it.
    pub fn declares_file(&self, name: &str) -> Result<(), Diagnostic> {
        contents::declared_file(&self.program, name)
    }

    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }

    pub fn fail(&self, list: Vec<Diagnostic>) -> Diagnostics {
        Diagnostics { list, sources: self.sources.clone() }
    }

    pub fn findings(&self) -> Vec<Finding> {
        findings(&self.diagnostics, &self.sources)
    }

    pub(super) fn diagnosed<T>(&self, result: Result<T, Vec<Diagnostic>>) -> Result<T, Diagnostics> {
        result.map_err(|list| self.fail(list))
    }

    /// Elaborated once.
    pub(super) fn netlist(&self, circuit: &Instance) -> Result<Arc<Netlist>, Vec<Diagnostic>> {
        if let Some(known) = lock(&self.context.netlists).get(circuit) {
            return Ok(known.clone());
        }
        let netlist = Arc::new(elaborate(&self.program, circuit)?);
        lock(&self.context.netlists).insert(circuit.clone(), netlist.clone());
        Ok(netlist)
    }

    pub(super) fn place(&self, circuit: &Instance) -> Span {
        self.program.circuit(&circuit.circuit).expect("the circuit is of this program").span
    }
}

pub fn prelude() -> Program {
    let mut sources = Sources::default();
    let nothing = sources.add("nothing", "");
    check::check(&MemoryWorld::default(), &mut sources, nothing).program
}
