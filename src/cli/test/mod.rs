//! `nbc test`: files' tests, at the level of logic or in full physics.

mod case;
mod outcome;

use std::path::PathBuf;

use clap::Args;

use crate::cli::test::case::{Case, Level};
use crate::cli::test::outcome::Outcome;
use crate::cli::{Context, Failure, Format, Progress, Status, workers};
use crate::diag::{Code, Diagnostic};
use crate::pipeline::{self, Loaded};
use crate::store::DiskWorld;

/// Test the circuits of a file
#[derive(Args)]
#[command(after_help = "Examples:
  nbc test circuits/counter.nb
  nbc test circuits/latch.nb --logic
  nbc test circuits/latch.nb --physics

At the level of logic every cell takes one time step, and a row is held until nothing changes. In physics every robot is simulated voxel \
by voxel. By default circuits of fewer than 40 robots are tested in physics, larger ones at the level of logic.
Exit status: 0 every test passed, 1 a test failed, 2 the file has errors.")]
pub struct Arguments {
    /// The source files
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Test at the level of logic
    #[arg(long, conflicts_with = "physics")]
    logic: bool,
    /// Test in full physics
    #[arg(long)]
    physics: bool,
}

/// A file without errors.
struct File {
    path: String,
    loaded: Loaded,
}

impl Arguments {
    /// Runs the tests side by side, and prints what came of each as soon as those before it are done.
    ///
    /// # Errors
    /// When a file has errors, or declares no test; no test runs then.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let files = self.files.iter().map(|file| File::load(&file.to_string_lossy())).collect::<Result<Vec<_>, _>>()?;
        let cases = self.cases(&files)?;
        for file in &files {
            file.warn(&file.loaded.checked.diagnostics, context);
        }
        let outcomes = run_cases(&cases, &files, context)?;
        let failed = outcomes.iter().filter(|outcome| !outcome.passed).count();
        match context.format {
            Format::Json => context.print_json(&serde_json::json!({ "passed": failed == 0, "tests": outcomes }))?,
            Format::Text => context.print(format_args!("{} passed, {failed} failed\n", outcomes.len() - failed))?,
        }
        Ok(if failed == 0 { Status::Done } else { Status::TestFailed })
    }

    fn level(&self) -> Level {
        match (self.logic, self.physics) {
            (true, _) => Level::Logic,
            (_, true) => Level::Physics,
            _ => Level::Auto,
        }
    }

    /// The tests of the files, in order.
    fn cases<'a>(&self, files: &'a [File]) -> Result<Vec<Case<'a>>, Failure> {
        let mut cases = Vec::new();
        for (number, file) in files.iter().enumerate() {
            let program = &file.loaded.checked.program;
            for test in &program.tests {
                let case = Case::new(number, program, test, self.level());
                cases.push(case.map_err(|faults| Failure::input(faults, file.loaded.sources.clone()))?);
            }
        }
        Ok(cases)
    }
}

impl File {
    fn load(path: &str) -> Result<Self, Failure> {
        let loaded = pipeline::load(&DiskWorld, path);
        if loaded.checked.has_errors() {
            return Err(Failure::input(loaded.checked.diagnostics, loaded.sources));
        }
        if loaded.checked.program.tests.is_empty() {
            let fault = Diagnostic::without_place(Code::Empty, format!("`{path}` declares no test"));
            let help = "declare one: `test my_circuit { a b | q` and a row for each input pattern";
            return Err(Failure::plain(fault.with_help(help)));
        }
        Ok(Self { path: path.to_owned(), loaded })
    }

    /// Tells what is legal in it and surely not meant.
    fn warn(&self, warnings: &[Diagnostic], context: &Context) {
        context.tell(warnings, &self.loaded.sources);
    }
}

/// Runs the tests; in text each outcome is printed as it comes.
fn run_cases(cases: &[Case<'_>], files: &[File], context: &mut Context) -> Result<Vec<Outcome>, Failure> {
    let bar = Progress::new("testing", cases.iter().map(Case::work).sum());
    let run = |case: &Case<'_>| (case.file, case.run(&files[case.file].path, &|done| bar.add(done)));
    let mut outcomes = Vec::new();
    let mut tell = |(file, outcome): (usize, Outcome)| -> Result<(), Failure> {
        files[file].warn(&outcome.warnings, context);
        if context.format == Format::Text {
            context.print(&outcome)?;
            context.flush()?;
        }
        outcomes.push(outcome);
        Ok(())
    };
    workers::in_order(cases, run, |told| bar.suspend(|| tell(told)))?;
    Ok(outcomes)
}
