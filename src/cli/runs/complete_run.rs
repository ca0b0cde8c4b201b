//! Runs of tests and simulations in physics.

use crate::cli::{Failure, Interrupt, Progress};
use nbc_base::diag::Diagnostic;
use nbc_session::report::{Scheme, SwarmOutcome};
use nbc_session::{
    Checked, CompileOptions, RunEnd, RunList, RunReport, Session, SimulationRun, SwarmRun, TestOptions, TestRun,
};
use nbc_swarm::Level;

pub(in crate::cli) enum CompleteRun {
    Test(TestRun),
    Simulation(SimulationRun),
}

impl CompleteRun {
    pub(in crate::cli) fn complete(report: RunReport) -> Vec<Self> {
        let tests = report.tests.into_iter().filter(|run| run.end == RunEnd::Complete).map(Self::Test);
        let simulations = report.simulations.into_iter().filter(|run| run.end == RunEnd::Complete);
        tests.chain(simulations.map(Self::Simulation)).collect()
    }

    pub(in crate::cli) fn swarm(&self) -> &SwarmRun {
        match self {
            Self::Test(run) => run.swarm.as_ref().expect("the test was run in physics"),
            Self::Simulation(run) => &run.swarm,
        }
    }

    pub(in crate::cli) fn passed(&self) -> bool {
        match self {
            Self::Test(run) => run.verdict.passed,
            Self::Simulation(run) => run.passed(),
        }
    }

    pub(in crate::cli) fn outcome(&self) -> SwarmOutcome<'_> {
        match self {
            Self::Test(run) => SwarmOutcome::Test(&run.verdict),
            Self::Simulation(run) => SwarmOutcome::Simulation(&run.result),
        }
    }

    pub(in crate::cli) fn warnings(&self) -> &[Diagnostic] {
        match self {
            Self::Test(run) => &run.warnings,
            Self::Simulation(run) => &run.warnings,
        }
    }
}

pub(in crate::cli) fn run_list(
    session: &Session,
    file: &Checked,
    list: &RunList<'_>,
    compile: CompileOptions,
    interrupt: &Interrupt,
) -> Result<RunReport, Failure> {
    let bar = Progress::new("simulating", 0);
    let options = TestOptions { level: Some(Level::Physics), compile };
    Ok(session.run_list(file, list, &options, &mut interrupt.observe(bar.whole()))?)
}

pub(in crate::cli) fn run_page(source: &str, ran: &CompleteRun, scheme: Scheme) -> String {
    nbc_session::run_page(source, &[(ran.outcome(), ran.swarm())], scheme)
}
