//! A deformed body at one moment.

use crate::cli::Failure;
use crate::cli::draw::faults;
use crate::cli::draw::picture::{Drawing, Drawn, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::titled_body::TitledBody;
use nbc_session::report;

pub(super) struct PosePicture;

impl PictureKind for PosePicture {
    fn description(&self) -> KindDescription {
        let options = &["--at", "--safe-colors", "--schedule"];
        KindDescription {
            options,
            ..KindDescription::new("pose", "The deformed body of a robot at one moment", SubjectKind::Robot)
        }
    }

    fn of_robot(&self, robot: &TitledBody, request: &DrawRequest) -> Result<Drawn, Failure> {
        let schedule = request.schedule([&robot.body])?;
        let step = request.step(&schedule)?;
        let pose = report::draw_pose(&robot.title, &robot.body, &schedule, step, request.scheme());
        Ok(Drawn { drawing: Drawing::Picture(pose), faults: faults::until(&robot.title, &robot.body, &schedule, step) })
    }
}
