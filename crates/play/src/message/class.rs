//! A class, as the teacher's page shows it.

use serde::{Deserialize, Serialize};
#[cfg(test)]
use ts_rs::TS;

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

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ClassName {
    /// With it, the page can join by this name again.
    pub(crate) key: String,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub struct ClassCourse {
    pub lessons: Vec<ClassLesson>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub struct ClassLesson {
    pub name: String,
    pub title: String,
    /// The tasks of its steps.
    pub steps: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub struct ClassRoll {
    pub members: Vec<ClassMember>,
    pub most: usize,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub struct ClassMember {
    pub name: String,
    /// Where the learner is; none outside of lessons.
    pub place: Option<ClassPlace>,
    /// The number of finished lessons.
    pub finished: u32,
    /// Seconds since the place has changed.
    pub seconds: u64,
}
