//! A parsed and checked source.

use serde_json::Value;

use crate::contents;
use nbc_base::diag::{Diagnostic, Diagnostics, json};
use nbc_base::model::{Instance, Program};
use nbc_base::source::{FileId, ForeignCircuit, MemoryWorld, SourceWorld, Sources, Span};
use nbc_circuit::NetWidths;
use nbc_lang::check::{self, Analysis, NameUses};
use nbc_lang::syntax::tree::Tree;

/// A source with its program and its diagnostics.
#[derive(Clone, Debug)]
pub struct Checked {
    /// The path that was requested.
    pub path: String,
    /// The revision of its text; 0 for the world's text.
    pub revision: u64,
    /// The texts that spans point into: the source, the prelude, and the files it uses.
    pub sources: Sources,
    /// The source itself, if it could be read.
    pub file: Option<FileId>,
    /// The program, complete only if there are no errors.
    pub program: Program,
    /// Errors and warnings, in order of place.
    pub diagnostics: Vec<Diagnostic>,
    /// Each use of a declared name, with the place of its declaration.
    pub uses: NameUses,
    /// The widths of the nets that were built.
    pub widths: NetWidths,
    /// The trees of its files.
    pub(super) trees: Vec<Tree>,
    /// The circuits that were built, with the values of their parameters, those of the prelude included.
    pub instances: Vec<Instance>,
    /// The circuits of other tools' files, and what their proofs begin with.
    pub foreign: Vec<ForeignCircuit>,
    /// Whether nobody waited for the result any more, so that a part of it is missing.
    pub(super) is_cancelled: bool,
}

impl Checked {
    /// Reads, parses and checks a source. A file that cannot be read is a diagnostic like any other.
    pub(super) fn read(world: &dyn SourceWorld, path: &str, revision: u64) -> Self {
        let mut sources = Sources::default();
        let (file, analysis) = match check::open(world, path, &mut sources) {
            Ok(file) => (Some(file), check::check(world, &mut sources, file)),
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
        }
    }

    /// The tree of a file; `None` if nothing could be parsed.
    pub fn tree(&self, file: FileId) -> Option<&Tree> {
        self.trees.iter().find(|tree| tree.declarations.first().is_some_and(|first| first.span.file == file))
    }

    /// Checks that the source declares a file of this name, and that a memory begins with it.
    pub fn declares_file(&self, name: &str) -> Result<(), Diagnostic> {
        contents::declared_file(&self.program, name)
    }

    /// Whether there are errors.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// Diagnostics with this source's texts.
    pub fn fail(&self, list: Vec<Diagnostic>) -> Diagnostics {
        Diagnostics { list, sources: self.sources.clone() }
    }

    /// Its diagnostics as data for programs.
    pub fn json(&self) -> Vec<Value> {
        json(&self.diagnostics, &self.sources)
    }

    /// The place of a circuit's declaration.
    ///
    /// # Panics
    /// When the program has no such circuit.
    pub(super) fn place(&self, circuit: &Instance) -> Span {
        self.program.circuit(&circuit.circuit).expect("the circuit is of this program").span
    }
}

/// The program of the prelude alone.
pub fn prelude() -> Program {
    let mut sources = Sources::default();
    let nothing = sources.add("nothing", "");
    check::check(&MemoryWorld::default(), &mut sources, nothing).program
}
