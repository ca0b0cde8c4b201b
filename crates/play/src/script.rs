//! A test that gives the inputs of a live swarm, and what its environment does meanwhile.

use crate::jobs::Job;
use crate::message::{ShownEnvironment, ShownMemory, ShownScript};
use crate::refusal::Refused;
use nbc_base::model::CircuitTest;
use nbc_session::{Checked, Compiled, EnvironmentRow, EnvironmentRun, TestCase, TestOptions};
use nbc_swarm::Level;

/// The most rows that a swarm is given beyond those before it is shown.
const MOST_ROWS: usize = 4096;

#[derive(Default)]
pub(super) struct GivenInputs {
    pub(super) inputs: Vec<Vec<bool>>,
    pub(super) before: usize,
    pub(super) shown: Option<ShownScript>,
}

/// A test by its index, or the last one, up to the end of a row. Rows count from 1, and 0 is the start.
pub(super) struct TestMoment<'a> {
    pub(super) test: Option<usize>,
    pub(super) swarm: Option<&'a str>,
    pub(super) world: Option<&'a str>,
    pub(super) row: usize,
}

/// The test of a number, or else the last one.
pub(super) fn chosen_test(checked: &Checked, number: Option<usize>) -> Result<&CircuitTest, Refused> {
    let tests = &checked.program.tests;
    number.map_or_else(|| tests.last(), |number| tests.get(number)).ok_or(Refused::NoTest)
}

pub(super) fn begin(
    checked: &Checked,
    TestMoment { test, swarm, world, row }: TestMoment<'_>,
    job: &Job,
) -> Result<(Compiled, GivenInputs), Refused> {
    let test = chosen_test(checked, test)?;
    let options = TestOptions { level: Some(Level::Physics), compile: job.options_for(checked, &test.circuit) };
    let cases = checked.cases(test, &options)?;
    let is_meant =
        |case: &TestCase| (swarm.is_none() || case.swarm() == swarm) && (world.is_none() || case.world_name() == world);
    let meant = cases.into_iter().find(is_meant).ok_or(Refused::NoTest)?;
    if row > meant.rows().last().map_or(0, |last| last.row) {
        return Err(Refused::NoTest);
    }
    let rows = meant.rows().iter().take_while(|one| one.row <= row).count();
    let all = meant.rows().len().min(rows.saturating_add(MOST_ROWS));
    let driven = meant.into_physics(all).ok_or(Refused::NoTest)?;
    let before = rows.checked_sub(1).map_or(0, |last| driven.ends[last]);
    let begins = std::iter::once(0).chain(driven.ends.iter().copied());
    // The rows of a wave machine are steps of several threads at once.
    let environment = match driven.compiled.mapping.waves {
        Some(_) => None,
        None => checked.environment(test, all, &options.compile)?,
    };
    let environment = environment.map(|run| shown(run, &begins.take(all).collect::<Vec<_>>()));
    let shown = ShownScript { title: test.title.clone(), cycles: driven.inputs.len(), environment };
    Ok((driven.compiled, GivenInputs { inputs: driven.inputs, before, shown: Some(shown) }))
}

/// `begins` are the cycles before each row.
fn shown(run: EnvironmentRun, begins: &[usize]) -> ShownEnvironment {
    let rows = || run.rows.iter().zip(begins.iter().copied());
    let printed = |(row, begin): (&EnvironmentRow, usize)| Some((begin, row.printed?.to_string()));
    let screen = run.has_text.then(|| rows().filter_map(printed).collect());
    let memories = run.memories.iter().enumerate().map(|(at, memory)| {
        let accesses = || rows().map(|(row, begin)| (&row.accesses[at], begin));
        let ports = run.rows.first().map_or(0, |row| row.accesses[at].reads.len());
        let read = |port: usize| {
            let mut places: Vec<(usize, usize)> =
                accesses().map(|(access, begin)| (begin, access.reads[port])).collect();
            places.dedup_by_key(|(_, address)| *address);
            places
        };
        let written = accesses().flat_map(|(access, begin)| {
            access.writes.iter().map(move |(address, word)| (begin, *address, format!("{word:x}")))
        });
        let used = memory.words.iter().rposition(|word| *word != 0).map_or(0, |last| last + 1);
        ShownMemory {
            name: memory.name.clone(),
            width: memory.width,
            size: memory.words.len(),
            words: memory.words[..used].iter().map(|word| format!("{word:x}")).collect(),
            reads: (0..ports).map(read).collect(),
            writes: written.collect(),
        }
    });
    ShownEnvironment { name: run.name.clone(), screen, memories: memories.collect() }
}
