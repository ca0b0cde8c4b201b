//! The circuit of a source file to be drawn, and the run of its swarm.

use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::wording;
use crate::cli::runs::{CompleteRun, names_of_tests, run_list};
use crate::cli::{Failure, Interrupt};
use nbc_base::model::CircuitTest;
use nbc_session::store::DiskWorld;
use nbc_session::{Checked, CompileOptions, Compiled, RunList, Session};
use nbc_swarm::Room;

impl DrawRequest {
    /// The circuit of the chosen test, else the one that `nbc build` would build.
    pub(super) fn compiled(&self) -> Result<Compiled, Failure> {
        let file = Session::new(DiskWorld).open(&self.what)?;
        let mut choice = self.making.choice();
        if let Some(name) = &self.test {
            choice.circuit = Some(test_called(&file, name)?.circuit.to_string());
        }
        let circuit = file.circuit(&choice)?;
        Ok(file.compile(&circuit, &self.making.options()?)?)
    }

    /// The chosen test or the first, or the first simulation if the file has no test. Poses are recorded if there is
    /// room.
    pub(super) fn ran(&self, poses: Option<Room>) -> Result<CompleteRun, Failure> {
        let session = Session::new(DiskWorld).with_files(self.named.files());
        let mut session = match poses {
            Some(room) => session.with_poses(room),
            None => session,
        };
        let file = session.open(&self.what)?;
        self.named.check(std::slice::from_ref(&file))?;
        let choice = self.making.choice();
        let chosen = RunList::chosen(&file, None, &choice)?.in_physics();
        let test = match &self.test {
            Some(name) => Some(test_called(&file, name)?),
            None => chosen.tests.first().copied(),
        };
        let options = self.named.of(&file, self.making.options()?);
        if let Some(test) = test {
            nbc_session::check_swarm_is_clear(&file.program, &test.circuit, options.swarm.as_deref())?;
            return run_one(&session, &file, &RunList { tests: vec![test], ..RunList::default() }, options);
        }
        match chosen.simulations.first() {
            Some(simulation) => {
                let list = RunList { simulations: vec![simulation], ..RunList::default() };
                run_one(&session, &file, &list, options)
            }
            None => {
                Err(wording::no_run(choice.circuit.as_ref().or(choice.swarm.as_ref()).unwrap_or(&self.what)).into())
            }
        }
    }
}

fn run_one(
    session: &Session,
    file: &Checked,
    list: &RunList<'_>,
    options: CompileOptions,
) -> Result<CompleteRun, Failure> {
    let report = run_list(session, file, list, options, &Interrupt::default())?;
    Ok(CompleteRun::complete(report).into_iter().next().expect("nothing interrupts it"))
}

fn test_called<'f>(file: &'f Checked, name: &'f str) -> Result<&'f CircuitTest, Failure> {
    let called = RunList { tests: file.tests(name).collect(), ..RunList::default() }.in_physics();
    called.tests.into_iter().next().ok_or_else(|| {
        let known: Vec<String> = names_of_tests(file).into_iter().collect();
        wording::unknown_test(&file.path, name, &known).into()
    })
}
