//! Lessons, as the page shows them and checks them, and a class, as the teacher's page shows it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::written::WrittenProgram;
use nbc_base::diag::Finding;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct LessonList {
    pub(crate) lessons: Vec<LessonEntry>,
    /// What is wrong with the files of an author; such a file gives no lesson.
    pub(crate) findings: Vec<Finding>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct LessonEntry {
    /// The name of its file without the number and the ending.
    pub(crate) name: String,
    pub(crate) title: String,
    /// The chapter that begins with it.
    pub(crate) chapter: Option<String>,
    /// Its paragraphs; code is between backticks.
    pub(crate) text: Vec<String>,
    /// The program that it begins with.
    pub(crate) program: Option<String>,
    /// The same as checks look at it.
    pub(crate) written: Option<WrittenProgram>,
    pub(crate) tab: LessonTab,
    pub(crate) hints: Vec<String>,
    /// The size of the best known circuit, where the learner makes one.
    pub(crate) best: Option<LessonGoal>,
    pub(crate) steps: Vec<LessonStep>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct LessonGoal {
    pub(crate) number: u32,
    pub(crate) of: LessonMeasure,
}

/// How a circuit is measured: by its robots, or by the gates of its source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub(crate) enum LessonMeasure {
    Robots,
    Gates,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct LessonStep {
    pub(crate) task: String,
    /// The step is done when all of these hold at once.
    pub(crate) checks: Vec<LessonCheck>,
    /// Hints for this step alone.
    pub(crate) hints: Vec<String>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub(crate) enum LessonTab {
    #[default]
    Swarm,
    Tests,
    Robots,
}

pub(crate) type PortValues = BTreeMap<String, u32>;

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(tag = "is", rename_all = "kebab-case")]
pub(crate) enum LessonCheck {
    /// The ports have these values now.
    Shows {
        values: PortValues,
    },
    /// The ports have had these values for as long as a change needs to settle.
    Keeps {
        values: PortValues,
    },
    /// None of these patterns is there now.
    Hides {
        patterns: Vec<PortValues>,
    },
    /// Each of these patterns has been there lately.
    HasShown {
        patterns: Vec<PortValues>,
    },
    /// The body in the designer is this gate, or another one.
    Designs {
        gate: String,
        except: bool,
    },
    Counts {
        what: LessonCount,
        than: LessonComparison,
        number: u32,
    },
    /// All robots of the swarm are gates of these functions.
    RobotsOnly {
        gates: Vec<String>,
    },
    /// The circuits of the program are written without these words.
    Without {
        words: Vec<String>,
    },
    Circuit {
        name: String,
    },
    TestsPass,
    TestsFail,
    /// The program passes this test, which the learner does not see.
    Passes {
        test: String,
    },
    /// The program claims something, and everything that it claims is proved.
    ClaimsProved,
    ClaimsRefuted,
    /// The program still has all lines of the lesson's tests and claims.
    TestsKept,
    /// The program has no errors, a circuit and a test, and differs from that of the lesson.
    ProgramChanged,
    /// An output is not 0.
    OutputsLit,
    Evolving,
    /// The body of a niche of the archive is in the designer.
    NicheChosen,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub(crate) enum LessonCount {
    Robots,
    Cycles,
    Niches,
    Threads,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) enum LessonComparison {
    #[serde(rename = "<=")]
    AtMost,
    #[serde(rename = ">=")]
    AtLeast,
    #[serde(rename = "=")]
    Equal,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ClassPlace {
    /// The name of the lesson.
    pub lesson: String,
    /// The steps of it that are done.
    pub done: u32,
    /// The size of their smallest circuit in it.
    pub size: Option<u32>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ClassName {
    /// With it, the page can join by this name again.
    pub(crate) key: String,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ClassCourse {
    pub lessons: Vec<ClassLesson>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ClassLesson {
    pub name: String,
    pub title: String,
    /// The tasks of its steps.
    pub steps: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ClassRoll {
    pub members: Vec<ClassMember>,
    pub most: usize,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ClassMember {
    pub name: String,
    /// Where the learner is; none outside of lessons.
    pub place: Option<ClassPlace>,
    /// The number of finished lessons.
    pub finished: u32,
    /// Seconds since the place has changed.
    pub seconds: u64,
}
