//! Bodies with their materials.

use crate::cli::Failure;
use crate::cli::draw::order::Order;
use crate::cli::draw::picture::{Drawing, PictureKind, SubjectKind};
use crate::cli::draw::robot::TitledBody;
use crate::cli::draw::several::{One, Several, cast};
use nbc_session::report::{self, Portrait};

pub(super) struct SpritePicture;

impl PictureKind for SpritePicture {
    fn word(&self) -> &'static str {
        "sprite"
    }

    fn about(&self) -> &'static str {
        "Bodies with their materials"
    }

    fn options(&self) -> &'static [&'static str] {
        &["--safe-colors"]
    }

    fn subject(&self) -> SubjectKind {
        SubjectKind::Library
    }

    fn of_robot(&self, robot: &TitledBody, order: &Order) -> Result<Drawing, Failure> {
        Ok(Drawing::Picture(report::draw_portrait(&robot.title, &robot.body, order.scheme())))
    }

    fn of_library(&self, robots: &Several, order: &Order) -> Result<Drawing, Failure> {
        let portrait = |one: &One| Portrait {
            title: one.behavior.function().to_string(),
            subtitle: format!("{}, {}", one.behavior, one.name),
            body: one.body.clone(),
        };
        let portraits: Vec<Portrait> = robots.robots.iter().map(portrait).collect();
        Ok(Drawing::Picture(report::draw_portraits(&robots.title, &portraits, order.scheme())))
    }

    fn of_program(&self, order: &Order) -> Result<Drawing, Failure> {
        self.of_library(&cast(&order.compiled()?.assembly), order)
    }
}
