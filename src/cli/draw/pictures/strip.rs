//! Snapshots of a gait.

use crate::cli::Failure;
use crate::cli::draw::order::Order;
use crate::cli::draw::picture::{Drawing, PictureKind, SubjectKind};
use crate::cli::draw::robot::TitledBody;
use nbc_session::report;

pub(super) struct StripPicture;

impl PictureKind for StripPicture {
    fn word(&self) -> &'static str {
        "strip"
    }

    fn about(&self) -> &'static str {
        "Snapshots of a robot's gait under each pattern"
    }

    fn options(&self) -> &'static [&'static str] {
        &["--safe-colors", "--schedule"]
    }

    fn subject(&self) -> SubjectKind {
        SubjectKind::Robot
    }

    fn of_robot(&self, robot: &TitledBody, order: &Order) -> Result<Drawing, Failure> {
        let schedule = order.schedule()?;
        Ok(Drawing::Picture(report::draw_strip(&robot.title, &robot.body, &schedule, order.scheme())))
    }
}
