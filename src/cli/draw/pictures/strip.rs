//! Snapshots of a gait.

use crate::cli::Failure;
use crate::cli::draw::faults;
use crate::cli::draw::picture::{Drawing, Drawn, KindDescription, PictureKind, SubjectKind};
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

    fn of_robot(&self, robot: &TitledBody, request: &DrawRequest) -> Result<Drawn, Failure> {
        let schedule = request.schedule([&robot.body])?;
        let strip = report::draw_strip(&robot.title, &robot.body, &schedule, request.scheme());
        let faults = faults::until(&robot.title, &robot.body, &schedule, schedule.steps());
        Ok(Drawn { drawing: Drawing::Picture(strip), faults })
    }
}
