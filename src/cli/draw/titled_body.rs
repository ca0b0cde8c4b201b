//! A body to be drawn, with a title.

use nbc_base::model::{Body, Robot};

pub(super) struct TitledBody {
    pub(super) title: String,
    pub(super) body: Body,
}

impl TitledBody {
    pub(super) fn of(robot: &Robot) -> Self {
        Self { title: format!("{}: {}, {}", robot.name, robot.function(), robot.behavior), body: robot.body.clone() }
    }
}
