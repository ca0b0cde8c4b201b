//! A class, as the teacher's page shows it.

use serde::{Deserialize, Serialize};
#[cfg(test)]
use ts_rs::TS;

/// Where a learner is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(TS))]
pub struct ClassPlace {
    /// The name of the lesson.
    pub lesson: String,
    /// The steps of it that are done.
    pub done: u32,
    /// The size of their smallest circuit in it.
    pub size: Option<u32>,
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
pub struct ClassCourse {
    /// The lessons, in order.
    pub lessons: Vec<ClassLesson>,
}

/// A lesson of the course.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub struct ClassLesson {
    /// The name, which is unique.
    pub name: String,
    /// The title, for people.
    pub title: String,
    /// The tasks of its steps.
    pub steps: Vec<String>,
}

/// The answer to `members` of the teacher's page.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub struct ClassRoll {
    /// The members, in the order of their names.
    pub members: Vec<ClassMember>,
    /// The most members.
    pub most: usize,
}

/// A member of the class.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub struct ClassMember {
    /// The name that the learner has chosen.
    pub name: String,
    /// Where the learner is; none outside of lessons.
    pub place: Option<ClassPlace>,
    /// The lessons that are finished.
    pub finished: u32,
    /// Seconds since the place has changed.
    pub seconds: u64,
}
