//! The result of `library add` for a behavior: a robot, or the reason why there is none.

use std::fmt;

use serde::Serialize;

use crate::Listing;
use nbc_base::model::{Behavior, Robot};
use nbc_swarm::Selected;

#[derive(Clone, Debug, Serialize)]
pub struct Answer {
    /// Its four letters.
    pub behavior: String,
    pub function: &'static str,
    pub outcome: Outcome,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub robot: Option<Listing>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    Added,
    LeftOut,
    Missing,
}

impl Answer {
    pub fn of(behavior: Behavior, selected: &Selected, max_error: f64) -> Self {
        let listing = |robot: &Robot| Some(Listing::of(robot));
        let (outcome, reason, robot) = match selected {
            Selected::Robot(robot) => (Outcome::Added, None, listing(robot)),
            Selected::Erring(robot) => (Outcome::LeftOut, Some(errors(robot, max_error)), listing(robot)),
            Selected::Other(other) => {
                let reason = format!("its best elite walks {other} when it is measured");
                (Outcome::LeftOut, Some(reason), None)
            }
            Selected::Faulty(fault) => {
                let reason = format!("its best elite {} in env step {}", fault.kind, fault.env_step);
                (Outcome::LeftOut, Some(reason), None)
            }
            Selected::Missing => (Outcome::Missing, Some("no elite of this behavior".to_owned()), None),
        };
        Self { behavior: behavior.to_string(), function: behavior.function().name(), outcome, reason, robot }
    }

    pub fn is_added(&self) -> bool {
        self.outcome == Outcome::Added
    }
}

fn errors(robot: &Robot, max_error: f64) -> String {
    let character = &robot.character;
    let wrong = (character.error_rate * f64::from(character.switches)).round();
    let (rate, most) = (100.0 * character.error_rate, 100.0 * max_error);
    format!("{wrong} of {} switches wrong ({rate:.2} %), at most {most} % accepted", character.switches)
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}  {:<10}  ", self.behavior, self.function)?;
        match (self.outcome, &self.robot) {
            (Outcome::Added, Some(Listing { name, clock, margin, error_rate, .. })) => {
                write!(f, "added     {name}, clock {clock}, margin {margin:.3}")?;
                if *error_rate > 0.0 {
                    write!(f, ", {:.2} % of the switches wrong", 100.0 * error_rate)?;
                }
            }
            (Outcome::Missing, _) => f.write_str("none")?,
            _ => f.write_str("left out")?,
        }
        match &self.reason {
            Some(reason) => writeln!(f, ": {reason}"),
            None => writeln!(f),
        }
    }
}
