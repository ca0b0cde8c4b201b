//! A source file without errors, and the arguments that say which of its circuits is meant.

use std::path::Path;

use clap::Args;

use crate::cli::{Context, Failure};
use crate::diag::Diagnostic;
use crate::model::Program;
use crate::pipeline::{self, Choice, Loaded, Options};
use crate::store::DiskWorld;

/// The choice of a circuit in a file.
#[derive(Args)]
pub(super) struct CircuitArguments {
    /// The circuit, with parameters such as `adder[8]` or `adder[n = 8]` [default: the last one in the file]
    #[arg(long, value_name = "NAME")]
    circuit: Option<String>,
    /// The swarm, if several are declared for the circuit
    #[arg(long, value_name = "NAME")]
    swarm: Option<String>,
}

impl CircuitArguments {
    pub(super) fn choice(&self) -> Choice {
        Choice { circuit: self.circuit.clone(), swarm: self.swarm.clone() }
    }
}

/// The place of evolution runs.
#[derive(Args)]
pub(super) struct RunsArguments {
    /// The folder of evolution runs; `library { from: NAME }` reads robots from `NAME/robots` in it
    #[arg(long, value_name = "DIR", default_value = pipeline::RUNS)]
    runs: String,
}

impl RunsArguments {
    pub(super) fn options(&self) -> Options {
        Options { runs: self.runs.clone(), ..Options::default() }
    }
}

/// A source file without errors.
pub(super) struct SourceProgram {
    /// The path as the user wrote it.
    pub(super) path: String,
    pub(super) loaded: Loaded,
}

impl SourceProgram {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// When it has errors.
    pub(super) fn load(path: &Path) -> Result<Self, Failure> {
        let path = path.to_string_lossy().into_owned();
        let loaded = pipeline::load(&DiskWorld, &path);
        if loaded.checked.has_errors() {
            return Err(Failure::input(loaded.checked.diagnostics, loaded.sources));
        }
        Ok(Self { path, loaded })
    }

    pub(super) fn program(&self) -> &Program {
        &self.loaded.checked.program
    }

    /// A failure with diagnostics that point into the file.
    pub(super) fn failure(&self, faults: Vec<Diagnostic>) -> Failure {
        Failure::input(faults, self.loaded.sources.clone())
    }

    /// Logs the warnings of the file, each one once.
    pub(super) fn warn<'d>(&self, warnings: impl IntoIterator<Item = &'d Diagnostic>, context: &Context) {
        let mut told: Vec<Diagnostic> = Vec::new();
        for warning in warnings {
            let is_new = told.iter().all(|known| (known.code, &known.message) != (warning.code, &warning.message));
            told.extend(is_new.then(|| warning.clone()));
        }
        context.tell(&told, &self.loaded.sources);
    }
}
