//! What a test came to, as plain data that text, JSON and pages read: at the level of logic and in physics alike.

use serde::Serialize;

use crate::model::{Column, Value};
use crate::swarm::WeakRobot;

/// What a test is run on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// Gates.
    Logic,
    /// Robots.
    Physics,
}

impl Level {
    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Logic => "logic",
            Self::Physics => "physics",
        }
    }
}

/// What a test came to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TestVerdict {
    /// The file of the test.
    pub file: String,
    /// The line at which the test is declared.
    pub line: usize,
    /// The circuit under test.
    pub circuit: String,
    /// The test's title; empty where it has none.
    pub title: String,
    /// The declared swarm, if it is one.
    pub swarm: Option<String>,
    /// What it was run on.
    pub level: Level,
    /// Whether all rows passed.
    pub passed: bool,
    /// The input ports.
    pub inputs: Vec<Column>,
    /// The output ports.
    pub outputs: Vec<Column>,
    /// Robots of the swarm that make errors or have a thin margin.
    pub weak_robots: Vec<WeakRobot>,
    /// The rows in order.
    pub rows: Vec<RowVerdict>,
}

/// What a test's row came to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct RowVerdict {
    /// Its number among the rows of the source, from 1; both halves of a pulse have the same.
    pub row: usize,
    /// Its line in the source.
    pub line: usize,
    /// The values of the input ports.
    pub inputs: Vec<Value>,
    /// The values of the output ports that the row asks for.
    pub expected: Vec<Value>,
    /// The values of the output ports at the end of the row.
    pub observed: Vec<Value>,
    /// For each output port whether it had that value for good: over the last two cycles, or for ever at the level of logic.
    pub steady: Vec<bool>,
    /// Cycles for which the row was held; none at the level of logic.
    pub cycles: Option<usize>,
    /// Cycles for which static timing would have it held; none at the level of logic.
    pub needed: Option<usize>,
    /// Whether every output that is asked for had its value for good.
    pub passed: bool,
    /// Robots that were wrong in the row although their stimuli had not changed for as long as their clock, where it failed.
    pub lapses: Vec<Lapse>,
    /// Robots that were wrong in the row's last cycle and had not had as long as their clock, where it failed.
    pub late: Vec<Lapse>,
}

/// A robot that gave another output than its function does of its stimuli.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Lapse {
    /// The net whose bit was wrong.
    pub net: String,
    /// The robot's name.
    pub robot: String,
    /// The cycle, from 0 at the test's start.
    pub cycle: usize,
    /// What it sensed.
    pub sensed: [bool; 2],
    /// What it output.
    pub output: bool,
}
