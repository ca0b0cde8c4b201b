//! Bodies with their materials.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, Drawn, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::titled_body::TitledBody;
use crate::cli::draw::titled_robots::{NamedBody, TitledRobots, of_swarm};
use nbc_session::report::{self, Portrait};

pub(super) struct SpritePicture;

impl PictureKind for SpritePicture {
    fn description(&self) -> KindDescription {
        let options = &["--safe-colors"];
        KindDescription {
            options,
            ..KindDescription::new("sprite", "Bodies with their materials", SubjectKind::Library)
        }
    }

    fn of_robot(&self, robot: &TitledBody, request: &DrawRequest) -> Result<Drawn, Failure> {
        Ok(Drawing::Picture(report::draw_portrait(&robot.title, &robot.body, request.scheme())).into())
    }

    fn of_library(&self, robots: &TitledRobots, request: &DrawRequest) -> Result<Drawn, Failure> {
        let portrait = |one: &NamedBody| Portrait {
            title: one.behavior.function().to_string(),
            subtitle: format!("{}, {}", one.behavior, one.name),
            body: one.body.clone(),
        };
        let portraits: Vec<Portrait> = robots.robots.iter().map(portrait).collect();
        Ok(Drawing::Picture(report::draw_portraits(&robots.title, &portraits, request.scheme())).into())
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawn, Failure> {
        self.of_library(&of_swarm(&request.compiled()?.assembly), request)
    }
}
