//! A swarm at the end of a cycle as plain data, from which it goes on with the same bits.

use serde::{Deserialize, Serialize};

use crate::Flip;
use crate::hearing::Heard;
use nbc_base::model::{Fault, FaultKind};
use nbc_sim::{Snapshot, State};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeptSwarm {
    /// For each cycle, the outputs of the robots as hexadecimal digits of four each.
    bits: Vec<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) flips: Vec<Flip>,
    robots: Vec<KeptRobot>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct KeptRobot {
    position: Vec<[f64; 2]>,
    previous: Vec<[f64; 2]>,
    velocity: Vec<[f64; 2]>,
    center: [f64; 2],
    clock: u32,
    fault: Option<(u32, u8)>,
    output: bool,
    places: Vec<f64>,
}

const FAULTS: [FaultKind; 3] = [FaultKind::Unstable, FaultKind::NonFinite, FaultKind::Stopped];

impl KeptSwarm {
    pub(super) fn new<'a>(
        cycles: impl Iterator<Item = &'a [bool]>,
        flips: Vec<Flip>,
        robots: impl Iterator<Item = (Snapshot, Heard)>,
    ) -> Self {
        let robot = |(snapshot, Heard { output, places }): (Snapshot, Heard)| {
            let Snapshot { state: State { position, previous, velocity }, center, clock, fault } = snapshot;
            let number = |kind| FAULTS.iter().position(|known| *known == kind).expect("every fault has a number") as u8;
            let fault = fault.map(|fault| (fault.env_step, number(fault.kind)));
            KeptRobot { position, previous, velocity, center, clock, fault, output, places: places.into() }
        };
        Self { bits: cycles.map(digits).collect(), flips, robots: robots.map(robot).collect() }
    }

    pub fn cycles(&self) -> usize {
        self.bits.len()
    }

    pub fn outputs(&self, robots: usize) -> Option<Vec<Vec<bool>>> {
        let fits =
            |text: &String| text.len() == robots.div_ceil(4) && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let is_whole = self.robots.len() == robots && self.bits.iter().all(fits);
        is_whole.then(|| self.bits.iter().map(|text| outputs(text, robots)).collect())
    }

    pub(super) fn robots(&self) -> impl Iterator<Item = (Snapshot, Heard)> + '_ {
        self.robots.iter().map(|robot| {
            let KeptRobot { position, previous, velocity, center, clock, fault, output, places } = robot.clone();
            let kind = |number: u8| FAULTS.get(usize::from(number)).copied().unwrap_or(FaultKind::Stopped);
            let fault = fault.map(|(env_step, number)| Fault { env_step, kind: kind(number) });
            let state = State { position, previous, velocity };
            (Snapshot { state, center, clock, fault }, Heard { output, places: places.into() })
        })
    }
}

fn digits(bits: &[bool]) -> String {
    let digit = |bits: &[bool]| bits.iter().zip(0..).fold(0, |digit, (&bit, at)| digit | u32::from(bit) << at);
    bits.chunks(4).map(|bits| char::from_digit(digit(bits), 16).expect("four bits")).collect()
}

fn outputs(text: &str, robots: usize) -> Vec<bool> {
    let bits = text.chars().flat_map(|digit| (0..4).map(move |at| digit.to_digit(16).unwrap_or(0) >> at & 1 == 1));
    bits.take(robots).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outputs_are_digits_of_four() {
        let bits = [true, false, false, true, true];
        assert_eq!(digits(&bits), "91");
        assert_eq!(outputs("91", 5), bits);
    }
}
