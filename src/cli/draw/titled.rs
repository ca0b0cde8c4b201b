//! Robots to be drawn, with their titles.

use nbc_base::model::{Behavior, Body, Library, Robot};
use nbc_swarm::Assembly;

pub(super) struct TitledBody {
    pub(super) title: String,
    pub(super) body: Body,
}

impl TitledBody {
    pub(super) fn of(robot: &Robot) -> Self {
        Self { title: format!("{}: {}, {}", robot.name, robot.function(), robot.behavior), body: robot.body.clone() }
    }
}

pub(super) struct TitledRobots {
    pub(super) title: String,
    pub(super) robots: Vec<NamedBody>,
}

pub(super) struct NamedBody {
    pub(super) behavior: Behavior,
    pub(super) name: String,
    pub(super) body: Body,
}

pub(super) fn of_library(name: &str, library: &Library) -> TitledRobots {
    let robots = library.robots.iter().map(|robot| NamedBody {
        behavior: robot.behavior,
        name: robot.name.clone(),
        body: robot.body.clone(),
    });
    let title = if name == "shipped" { "the robots that come with nbc".to_owned() } else { name.to_owned() };
    TitledRobots { title, robots: robots.collect() }
}

pub(super) fn of_swarm(assembly: &Assembly) -> TitledRobots {
    let mut robots: Vec<NamedBody> = Vec::new();
    for member in &assembly.members {
        let robot = &member.robot;
        if robots.iter().all(|one| one.name != robot.name) {
            robots.push(NamedBody { behavior: robot.behavior, name: robot.name.clone(), body: robot.body.clone() });
        }
    }
    TitledRobots { title: format!("the robots of {}", assembly.circuit), robots }
}
