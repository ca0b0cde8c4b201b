//! `nbc prove`: properties of all steps of circuits, and of models in AIGER's format.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use clap::Args;
use serde::Serialize;

use crate::cli::options::new_path::new_path;
use crate::cli::options::number::number;
use crate::cli::source_path::source_path;
use crate::cli::{Context, Failure, Interrupt, OutputFormat, Progress, Status, runs, wording};
use nbc_base::diag::counted;
use nbc_base::model::Claim;
use nbc_circuit::CancelFlag;
use nbc_circuit::formats::{AigerModel, CircuitSource};
use nbc_circuit::properties::{PropertySearch, SearchBudget};
use nbc_session::report::Schema;
use nbc_session::store;
use nbc_session::{Checked, DecidedClaim, ModelSearch, Session, TestOptions};
use nbc_swarm::Level;

/// How often the time is checked while the solver works.
const WATCH: Duration = Duration::from_millis(20);

/// Prove that circuits have their properties, for all inputs and for ever
#[derive(Args)]
#[command(after_help = "Examples:
  nbc prove circuits/traffic_light.nb
  nbc prove lights.nb --only 'never both green' --physics
  nbc prove model.aig --witness model.wit

A step is a row of a test: the first one, and then one for each rise of the clock. A circuit without a clock has a \
step whenever its inputs change and all has settled.
Each property of a `prove` declaration is proved, refuted with a test that shows it, or undecided when the time or the \
work ends. A proof is checked by other code than that of the search. A result depends on the machine only if the time \
ends.
A model is an AIGER file, .aig or .aag, with bad states and constraints, or with outputs in the place of bad states.
Exit status: 0 all proved, 1 a property is refuted or undecided, 2 the file has errors, 4 interrupted.")]
pub struct ProveArguments {
    /// The source files, or models: .nb, .aig or .aag
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Prove only what has this name: a title or a circuit
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// The most steps that are looked at one after the other
    #[arg(long, value_name = "STEPS", default_value_t = SearchBudget::default().steps, value_parser = number::<usize>)]
    steps: usize,
    /// The most work for each declaration or model, in calls of the solver, clauses that it learns, and hundreds of
    /// values that it derives
    #[arg(long, value_name = "WORK", default_value_t = SearchBudget::default().work, value_parser = number::<u64>)]
    work: u64,
    /// The most time for each declaration or model
    #[arg(long, value_name = "SECONDS", default_value_t = 60, value_parser = number::<u64>)]
    seconds: u64,
    /// Run each test that refutes a property with robots, in full physics
    #[arg(long)]
    physics: bool,
    /// Write the witnesses of a model in AIGER's format
    #[arg(long, value_name = "FILE", value_parser = new_path())]
    witness: Option<PathBuf>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct ProofResults<'a> {
    /// Whether every property is proved.
    proved: bool,
    claims: &'a [DecidedClaim],
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    interrupted: bool,
}

impl ProveArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let interrupt = Interrupt::watch()?;
        let mut session = Session::new(interrupt.world());
        let mut subjects = Vec::new();
        for path in &self.files {
            subjects.push(match is_model(path) {
                true => Subject::Model(path, Box::new(store::read_model(path)?)),
                false => Subject::Source(load(&mut session, path)?),
            });
        }
        if self.witness.is_some() && !matches!(subjects[..], [Subject::Model(..)]) {
            return Err(wording::witness_of_source().into());
        }
        let chosen = self.chosen(&subjects)?;
        for subject in &subjects {
            if let Subject::Source(file) = subject {
                context.warn(file, &file.diagnostics);
                context.origins(file);
            }
        }
        let mut reports = Vec::new();
        for (subject, claim) in chosen {
            let report = match (subject, claim) {
                (Subject::Source(file), Some(claim)) => self.claim(&session, file, claim, &interrupt)?,
                (Subject::Model(path, model), _) => self.model(path, (**model).clone(), &interrupt),
                (Subject::Source(_), None) => unreachable!("a source is chosen with a claim"),
            };
            if interrupt.is_raised() {
                break;
            }
            if context.format == OutputFormat::Text {
                context.print_verdicts(&report.text())?;
                context.flush()?;
            }
            reports.push(report);
        }
        self.end(&reports, &interrupt, context)
    }

    fn end(&self, reports: &[DecidedClaim], interrupt: &Interrupt, context: &mut Context) -> Result<Status, Failure> {
        let [proved, refuted, undecided] = ["proved", "refuted", "undecided"]
            .map(|verdict| reports.iter().map(|report| report.count(verdict)).sum::<usize>());
        let all = refuted + undecided == 0 && !interrupt.is_raised();
        match context.format {
            OutputFormat::Json => {
                let results = ProofResults { proved: all, claims: reports, interrupted: interrupt.is_raised() };
                context.print_json(Schema::Prove, &results)?;
            }
            OutputFormat::Text => {
                let left = if interrupt.is_raised() { ", interrupted" } else { "" };
                context.print(format_args!("{proved} proved, {refuted} refuted, {undecided} undecided{left}\n"))?;
            }
        }
        if let (Some(path), [report]) = (&self.witness, reports) {
            context.write(path, report.witnesses().as_bytes())?;
        }
        Ok(match (interrupt.is_raised(), all) {
            (true, _) => Status::Interrupted,
            (false, true) => Status::Done,
            (false, false) => Status::TestFailed,
        })
    }

    fn chosen<'s>(&self, subjects: &'s [Subject<'s>]) -> Result<Vec<(&'s Subject<'s>, Option<&'s Claim>)>, Failure> {
        let mut chosen = Vec::new();
        for subject in subjects {
            match subject {
                Subject::Model(..) => chosen.push((subject, None)),
                Subject::Source(file) => {
                    let is_named = |claim: &&Claim| {
                        self.only.as_ref().is_none_or(|name| *name == claim.title || *name == claim.circuit.to_string())
                    };
                    chosen.extend(file.program.claims.iter().filter(is_named).map(|claim| (subject, Some(claim))));
                }
            }
        }
        match (&self.only, subjects) {
            (Some(name), [Subject::Source(first), ..]) if chosen.is_empty() => {
                let claims = &first.program.claims;
                let mut known: Vec<String> = claims.iter().map(|claim| claim.circuit.to_string()).collect();
                known.extend(claims.iter().map(|claim| claim.title.clone()).filter(|title| !title.is_empty()));
                known.dedup();
                Err(runs::wording::unknown_claim(&first.path, name, &known).into())
            }
            _ => Ok(chosen),
        }
    }

    fn budget(&self) -> SearchBudget {
        SearchBudget { steps: self.steps, work: self.work }
    }

    fn claim(
        &self,
        session: &Session,
        file: &Checked,
        claim: &Claim,
        interrupt: &Interrupt,
    ) -> Result<DecidedClaim, Failure> {
        let timer = Timer::start(self.seconds, interrupt);
        let mut search = file.prove(claim, self.budget(), timer.flag())?;
        decide(search.search());
        drop(timer);
        let mut decided = search.finish();
        if self.physics && !interrupt.is_raised() {
            in_physics(session, file, &mut decided, interrupt)?;
        }
        Ok(decided)
    }

    fn model(&self, path: &Path, model: AigerModel, interrupt: &Interrupt) -> DecidedClaim {
        let timer = Timer::start(self.seconds, interrupt);
        let mut search = ModelSearch::new(path.display().to_string(), model, self.budget(), timer.flag());
        decide(search.search());
        search.finish()
    }
}

fn decide(search: &mut PropertySearch) {
    let bar = Progress::new("proving", search.system().bad.len() as u64);
    while !search.is_done() {
        search.advance();
        bar.set_with_note(search.decided() as u64, format!(", {}", counted(search.steps(), "step")));
    }
}

fn in_physics(
    session: &Session,
    file: &Checked,
    decided: &mut DecidedClaim,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let options = TestOptions { level: Some(Level::Physics), ..TestOptions::default() };
    let tests: Vec<_> = decided.refuted().map(|(property, test)| (property, test.clone())).collect();
    for (property, test) in tests {
        let mut runs = Vec::new();
        for case in file.cases(&test, &options)? {
            let bar = Progress::new("simulating", case.work());
            runs.push(session.run_case(case, &mut interrupt.observe(bar.whole())));
        }
        if !interrupt.is_raised() {
            decided.note_runs(property, &runs);
        }
    }
    Ok(())
}

enum Subject<'a> {
    Source(Arc<Checked>),
    Model(&'a Path, Box<AigerModel>),
}

fn is_model(path: &Path) -> bool {
    CircuitSource::of_path(&path.to_string_lossy()) == Some(CircuitSource::Aiger)
}

fn load(session: &mut Session, path: &Path) -> Result<Arc<Checked>, Failure> {
    let file = session.open(source_path(path)?)?;
    if file.program.claims.is_empty() {
        return Err(runs::wording::no_claim(&file.path).into());
    }
    Ok(file)
}

/// Raises a flag when the time has ended, or a signal has arrived.
struct Timer {
    flag: CancelFlag,
    ended: Arc<AtomicBool>,
}

impl Timer {
    fn start(seconds: u64, interrupt: &Interrupt) -> Self {
        let (flag, ended) = (CancelFlag::default(), Arc::new(AtomicBool::new(false)));
        let timer = Self { flag: flag.clone(), ended: ended.clone() };
        let (interrupt, started) = (interrupt.clone(), Instant::now());
        thread::spawn(move || {
            while !ended.load(Ordering::Relaxed) {
                if interrupt.is_raised() || started.elapsed() >= Duration::from_secs(seconds) {
                    flag.raise();
                    return;
                }
                thread::sleep(WATCH);
            }
        });
        timer
    }

    fn flag(&self) -> CancelFlag {
        self.flag.clone()
    }
}

impl Drop for Timer {
    fn drop(&mut self) {
        self.ended.store(true, Ordering::Relaxed);
    }
}
