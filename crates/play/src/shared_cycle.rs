//! A cycle of a swarm of which others simulate parts.

use std::ops::Range;

use crate::shell::Crew;
use nbc_session::Session;
use nbc_sim::Simulator;
use nbc_swarm::{Assembly, BegunCycle, CycleTrace, LiveSwarm, PartStates, RobotFault};

/// The fewest robots that are worth the way to others and back.
const LEAST_ROBOTS: usize = 4;

/// A cycle of which one part has been simulated here.
pub(super) struct SharedCycle {
    begun: BegunCycle,
    own: PartStates,
}

impl SharedCycle {
    /// Whether a crew can take a part of so many robots.
    pub(super) fn is_worth_it(crew: &dyn Crew, robots: usize) -> bool {
        parts(crew.size(), robots) > 1
    }

    /// Begins a cycle, gives its parts to a crew, and simulates one of them.
    ///
    /// # Errors
    /// When a robot has failed before.
    pub(super) fn begin(
        crew: &dyn Crew,
        swarm: &LiveSwarm,
        assembly: &Assembly,
        inputs: &[bool],
    ) -> Result<Self, RobotFault> {
        let begun = swarm.begin(inputs)?;
        let part = |robots: Range<usize>| swarm.part(&begun, assembly, Session::LIVE_CYCLES, robots);
        let mut ranges = ranges(parts(crew.size(), assembly.members.len()), assembly.members.len());
        let own = part(ranges.next().expect("there is a part"));
        crew.give(ranges.map(part).collect());
        Ok(Self { own: own.simulate(&Simulator::default()), begun })
    }

    /// Ends the cycle with what the others have simulated.
    ///
    /// # Errors
    /// When a robot has failed in it.
    pub(super) fn end(self, mut others: Vec<PartStates>, swarm: &mut LiveSwarm) -> Result<&CycleTrace, RobotFault> {
        others.insert(0, self.own);
        swarm.end(self.begun, &others)
    }
}

/// The number of parts for a crew of this size and oneself.
fn parts(crew: usize, robots: usize) -> usize {
    (robots / LEAST_ROBOTS).clamp(1, crew + 1)
}

/// The robots in parts of almost the same number.
fn ranges(parts: usize, robots: usize) -> impl Iterator<Item = Range<usize>> {
    (0..parts).map(move |part| part * robots / parts..(part + 1) * robots / parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_robot_is_in_one_part() {
        for (crew, robots, expected) in [(3, 17, 4), (3, 9, 2), (1, 5, 1), (0, 100, 1), (7, 0, 1)] {
            let ranges: Vec<_> = ranges(parts(crew, robots), robots).collect();
            assert_eq!(ranges.len(), expected, "{robots} robots");
            assert!(ranges.iter().cloned().flatten().eq(0..robots), "{ranges:?}");
        }
    }
}
