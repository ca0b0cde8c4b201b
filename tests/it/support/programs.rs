//! Programs of the language: those of the repository, and texts that are checked and tested.

use std::sync::Arc;

use nbc_base::diag::render;
use nbc_base::model::{CircuitTest, Program, Stimulation};
use nbc_base::source::{MemoryWorld, Sources};
use nbc_circuit::{Logic, elaborate, elaborate_reference};
use nbc_lang::check::{self, Analysis};
use nbc_session::{Checked, Session, TestOptions, TestRun};
use nbc_swarm::Level;

use crate::support::*;

pub fn programs(folder: &str) -> Vec<PathBuf> {
    let mut paths: Vec<_> = fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "nb"));
    paths.sort();
    assert!(!paths.is_empty(), "{folder} holds programs");
    paths
}

/// Checks a text that uses no files, and fails on any diagnostic.
pub fn sound(name: &str, text: &str) -> Program {
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let Analysis { program, diagnostics, .. } = check::check(&MemoryWorld::default(), &mut sources, file);
    assert!(diagnostics.is_empty(), "{}", render::text(&diagnostics, &sources, false));
    program
}

/// Runs a program's test at the level of logic, and fails at the first wrong row.
pub fn passes(program: &Program, test: &CircuitTest) {
    if depends(test) {
        // `performs` runs it.
        return;
    }
    let mut logic = Logic::new(&elaborate(program, &test.circuit).unwrap());
    match &test.stimulation {
        Stimulation::Rows(rows) => {
            for (at, row) in rows.iter().enumerate() {
                let settled = logic.settle(&row.inputs);
                let found = settled.unwrap_or_else(|_| logic.outputs());
                let fits =
                    row.expected.iter().zip(&found).all(|(expected, found)| expected.is_none_or(|e| e == *found));
                assert!(
                    fits,
                    "{} {:?}, row {at}: expected {:?}, found {found:?}",
                    test.circuit, test.title, row.expected
                );
            }
        }
        Stimulation::Script(_) | Stimulation::Ever { .. } => unreachable!("it depends on its circuit"),
        Stimulation::All { reference } => {
            let mut expected = Logic::new(&elaborate_reference(program, reference).unwrap());
            let bits = test.inputs.iter().map(|column| column.width).sum::<usize>();
            for pattern in 0..1u32 << bits {
                let inputs: Vec<_> = (0..bits).map(|bit| pattern >> bit & 1 == 1).collect();
                assert_eq!(
                    logic.settle(&inputs),
                    expected.settle(&inputs),
                    "{} {:?} at {inputs:?}",
                    test.circuit,
                    test.title
                );
            }
        }
    }
}

/// A session with a text called `a.nb`, which has no errors.
pub fn session_of(text: impl Into<String>) -> (Session, Arc<Checked>) {
    let mut session = Session::new(MemoryWorld::default());
    session.update("a.nb", 1, text);
    let checked = session.open("a.nb").unwrap_or_else(|error| panic!("{error}"));
    (session, checked)
}

/// A checked text called `a.nb`, which may have errors.
pub fn checked(text: impl Into<String>) -> Arc<Checked> {
    let mut session = Session::new(MemoryWorld::default());
    session.update("a.nb", 1, text);
    session.checked("a.nb")
}

pub fn in_physics() -> TestOptions {
    TestOptions { level: Some(Level::Physics), ..TestOptions::default() }
}

/// The runs of the first test of a program in physics.
pub fn tested(text: &str) -> Vec<TestRun> {
    let (session, checked) = session_of(text);
    session.test(&checked, &checked.program.tests[0], &in_physics(), &mut ()).unwrap()
}

fn depends(test: &CircuitTest) -> bool {
    matches!(test.stimulation, Stimulation::Script(_) | Stimulation::Ever { .. })
        || test.rows_from.as_ref().is_some_and(|from| from.at_least.is_some())
}

pub fn performs(session: &mut Session, path: &str) {
    let checked = session.open(path).unwrap_or_else(|error| panic!("{error:?}"));
    let options = TestOptions { level: Some(Level::Logic), ..TestOptions::default() };
    for test in checked.program.tests.iter().filter(|test| depends(test)) {
        let case = checked.cases(test, &options).unwrap().remove(0);
        let run = session.run_case(case, &mut ());
        assert!(run.verdict.passed, "{} {:?}", test.circuit, run.verdict.rows);
    }
}
