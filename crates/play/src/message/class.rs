//! A class, as the teacher's page shows it.

use serde::{Deserialize, Serialize};
#[cfg(test)]
use ts_rs::TS;

/// Where a learner is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ClassPlace {
    /// The name of the lesson.
    pub(crate) lesson: String,
    /// The steps of it that are done.
    pub(crate) done: u32,
    /// The size of their smallest circuit in it.
    pub(crate) size: Option<u32>,
}

/// The answer to `join`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ClassName {
    /// With it, the page can join by this name again.
    pub(crate) key: String,
}

/// The answer to `lessons` of the teacher's page.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ClassCourse {
    pub(crate) lessons: Vec<ClassLesson>,
}

/// A lesson of the course.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ClassLesson {
    pub(crate) name: String,
    pub(crate) title: String,
    /// The tasks of its steps.
    pub(crate) steps: Vec<String>,
}

/// The answer to `members` of the teacher's page.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ClassRoll {
    /// The members, in the order of their names.
    pub(crate) members: Vec<ClassMember>,
    /// The most members.
    pub(crate) most: usize,
}

/// A member of the class.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ClassMember {
    /// The name that the learner has chosen.
    pub(crate) name: String,
    /// Where the learner is; none outside of lessons.
    pub(crate) place: Option<ClassPlace>,
    /// The lessons that are finished.
    pub(crate) finished: u32,
    /// Seconds since the place has changed.
    pub(crate) seconds: u64,
}
