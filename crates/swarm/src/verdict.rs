//! The verdict of a test as plain data for text, JSON and pages, at the level of logic and in physics.

use serde::{Deserialize, Serialize};

use crate::{RobotFault, WeakRobot};
use nbc_base::model::{CircuitTest, Column, RowSource, Value};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// Gates without physics, each of which takes one time step.
    #[default]
    Logic,
    Physics,
}

impl Level {
    pub fn word(self) -> &'static str {
        match self {
            Self::Logic => "logic",
            Self::Physics => "physics",
        }
    }
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TestVerdict {
    pub file: String,
    pub line: usize,
    pub circuit: String,
    pub title: String,
    /// The declared swarm, if it is one.
    pub swarm: Option<String>,
    /// The world of the swarm; none at the level of logic, which has no worlds.
    pub world: Option<String>,
    /// Whether the test names its world, so that texts name it, too.
    #[serde(skip)]
    pub is_world_named: bool,
    pub level: Level,
    /// Whether all rows passed, or as many as the test asks for.
    pub passed: bool,
    /// The file of its rows, if the source does not have them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows_from: Option<RowSource>,
    pub inputs: Vec<Column>,
    pub outputs: Vec<Column>,
    /// Robots that make errors or have a thin margin.
    pub weak_robots: Vec<WeakRobot>,
    pub rows: Vec<RowVerdict>,
    /// What the environment of the test wrote as text.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub printed: Option<String>,
    /// How a test for ever was decided, in words: `proved by induction over 1 step`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proof: Option<String>,
    /// How a robot failed, in words: `robot nand_5x5 on net q became unstable in cycle 3`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault: Option<String>,
}

impl TestVerdict {
    /// Of rows that were judged, without a swarm.
    pub fn of(test: &CircuitTest, level: Level, mut rows: Vec<RowVerdict>) -> Self {
        for row in rows.iter_mut().filter(|row| !row.passed) {
            row.words = Some(row.describe(&test.inputs, &test.outputs));
        }
        let passed = rows.iter().filter(|row| row.passed).count();
        Self {
            file: test.file.clone(),
            line: test.line,
            circuit: test.circuit.to_string(),
            title: test.title.clone(),
            is_world_named: !test.worlds.is_empty(),
            level,
            passed: match test.rows_from.as_ref().and_then(|from| from.at_least) {
                Some(percent) => passed as f64 * 100.0 >= percent * rows.len() as f64,
                None => passed == rows.len(),
            },
            rows_from: test.rows_from.clone(),
            inputs: test.inputs.clone(),
            outputs: test.outputs.clone(),
            fault: rows.iter().find_map(|row| row.fault.as_ref()).map(ToString::to_string),
            rows,
            ..Self::default()
        }
    }

    /// The number of rows: a pulse is one, and so is a step of all threads of a wave machine.
    pub fn row_count(&self) -> usize {
        self.rows.iter().filter(|row| !row.is_half && row.thread.unwrap_or(0) == 0).count()
    }

    /// The share of rows in percent that suffices, if not all must pass.
    pub fn at_least(&self) -> Option<f64> {
        self.rows_from.as_ref().and_then(|from| from.at_least)
    }
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RowVerdict {
    /// Its number among the rows of the source, from 1; both halves of a pulse have the same.
    pub row: usize,
    pub line: usize,
    /// The thread of a wave machine, from 0; none in other swarms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thread: Option<usize>,
    pub inputs: Vec<Value>,
    pub expected: Vec<Value>,
    /// The values of the output ports at the end of the row; none where a robot failed.
    pub observed: Vec<Value>,
    /// For each output port, whether it was steady: over the last two cycles in physics, forever at the level of logic.
    pub steady: Vec<bool>,
    /// Cycles for which the row was held; none at the level of logic.
    pub cycles: Option<usize>,
    /// Cycles for which `hold: auto` would hold it; none at the level of logic.
    pub needed: Option<usize>,
    /// Whether every checked output had its expected value and kept it.
    pub passed: bool,
    /// If the row failed: robots that were wrong although their stimuli had been stable for at least their clock.
    #[serde(rename = "lapses")]
    pub wrong_outputs: Vec<WrongOutput>,
    /// If the row failed: robots that were wrong in its last cycle and whose stimuli had been stable for less than
    /// their clock.
    pub late: Vec<WrongOutput>,
    /// Whether it is the first half of a pulse, which is not checked.
    #[serde(skip)]
    pub is_half: bool,
    /// How often it was repeated, if that is as often as its `until` permits and it still waited for its value.
    #[serde(rename = "until", skip_serializing_if = "Option::is_none")]
    pub given_up: Option<usize>,
    /// The robot that failed in the row or before it, so that the swarm had no outputs at its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault: Option<RobotFault>,
    /// How it failed, in lines; none if it passed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub words: Option<String>,
}

/// A robot whose output was not its function of its stimuli.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WrongOutput {
    pub net: String,
    pub robot: String,
    /// The cycle, from 0 at the test's start.
    pub cycle: usize,
    pub sensed: Vec<bool>,
    pub output: bool,
}
