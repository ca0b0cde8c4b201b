//! Lessons, as the page shows them and checks them.

use std::collections::BTreeMap;

use serde::Serialize;
#[cfg(test)]
use ts_rs::TS;

use super::finding::Finding;
use super::written::WrittenProgram;

/// The answer to `lessons`.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct LessonList {
    /// The lessons in their order.
    pub(crate) lessons: Vec<LessonEntry>,
    /// What is wrong with the files of an author; such a file gives no lesson.
    pub(crate) findings: Vec<Finding>,
}

/// A lesson.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct LessonEntry {
    /// The name of its file without the number and the ending.
    pub(crate) name: String,
    pub(crate) title: String,
    /// Its paragraphs; code is between backticks.
    pub(crate) text: Vec<String>,
    /// The program that it begins with.
    pub(crate) program: Option<String>,
    /// The same as checks look at it.
    pub(crate) written: Option<WrittenProgram>,
    /// The tab in which it begins.
    pub(crate) tab: LessonTab,
    /// Hints for all of its steps.
    pub(crate) hints: Vec<String>,
    /// The size of the best known circuit, where the learner makes one.
    pub(crate) best: Option<LessonGoal>,
    pub(crate) steps: Vec<LessonStep>,
}

/// The size of a circuit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct LessonGoal {
    pub(crate) number: u32,
    pub(crate) of: LessonMeasure,
}

/// How a circuit is measured: by its robots, or by the gates of what is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
#[serde(rename_all = "lowercase")]
pub(crate) enum LessonMeasure {
    Robots,
    Gates,
}

/// A step of a lesson.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct LessonStep {
    pub(crate) task: String,
    /// It is done when all of these hold at once.
    pub(crate) checks: Vec<LessonCheck>,
    /// Hints for this step alone.
    pub(crate) hints: Vec<String>,
}

/// A tab of the page in which a lesson can begin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
#[serde(rename_all = "lowercase")]
pub(crate) enum LessonTab {
    #[default]
    Swarm,
    Tests,
    Robots,
}

/// The values of ports.
pub(crate) type PortValues = BTreeMap<String, u32>;

/// A condition of a step.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
#[serde(tag = "is", rename_all = "kebab-case")]
pub(crate) enum LessonCheck {
    /// The ports have these values now.
    Shows { values: PortValues },
    /// The ports have had these values for as long as a change needs to settle.
    Keeps { values: PortValues },
    /// None of these patterns is there now.
    Hides { patterns: Vec<PortValues> },
    /// Each of these patterns has been there lately.
    HasShown { patterns: Vec<PortValues> },
    /// The body in the designer is this gate, or another one.
    Designs { gate: String, except: bool },
    /// A number of the page compares so with another one.
    Counts { what: LessonCount, than: LessonComparison, number: u32 },
    /// All robots of the swarm are gates of these functions.
    RobotsOnly { gates: Vec<String> },
    /// The circuits of the program are written without these words.
    Without { words: Vec<String> },
    /// The swarm is that of this circuit.
    Circuit { name: String },
    /// The program has tests, and all of them pass.
    TestsPass,
    /// A test has run, and does not pass.
    TestsFail,
    /// The program claims something, and all that it claims is proved.
    ClaimsProved,
    /// A property of a claim is refuted.
    ClaimsRefuted,
    /// The program still has all lines of the lesson's tests and claims.
    TestsKept,
    /// The program has no errors, a circuit and a test, and is another than that of the lesson.
    ProgramChanged,
    /// An output is not 0.
    OutputsLit,
    /// An evolution runs.
    Evolving,
    /// The body of a niche of the archive is in the designer.
    NicheChosen,
}

/// What a check counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
#[serde(rename_all = "lowercase")]
pub(crate) enum LessonCount {
    Robots,
    Cycles,
    Niches,
    Threads,
}

/// How a check compares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) enum LessonComparison {
    #[serde(rename = "<=")]
    AtMost,
    #[serde(rename = ">=")]
    AtLeast,
    #[serde(rename = "=")]
    Equal,
}
