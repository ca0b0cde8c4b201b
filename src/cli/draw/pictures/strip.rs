//! Snapshots of a gait.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::titled_body::TitledBody;
use nbc_session::report;

pub(super) struct StripPicture;

impl PictureKind for StripPicture {
    fn description(&self) -> KindDescription {
        let options = &["--safe-colors", "--schedule"];
        KindDescription {
            options,
            ..KindDescription::new("strip", "Snapshots of a robot's gait under each pattern", SubjectKind::Robot)
        }
    }

    fn of_robot(&self, robot: &TitledBody, request: &DrawRequest) -> Result<Drawing, Failure> {
        let schedule = request.schedule([&robot.body])?;
        Ok(Drawing::Picture(report::draw_strip(&robot.title, &robot.body, &schedule, request.scheme())))
    }
}
