//! A cycle of a swarm of which workers simulate parts.

use core::task::Poll;
use std::ops::Range;
use std::sync::Arc;

use crate::crew_part::{CrewPart, CrewResult, GivenParts};
use crate::shell::{Crew, Shell};
use nbc_session::CycleRunner;
use nbc_sim::Simulator;
use nbc_swarm::{Assembly, BegunCycle, LiveSwarm, PartStates, RobotFault};

const LEAST_ROBOTS: usize = 4;

pub(super) struct SharedCycle {
    begun: BegunCycle,
    own: PartStates,
    others: Arc<GivenParts>,
}

impl SharedCycle {
    pub(super) fn is_worth_it(crew: &dyn Crew, robots: usize) -> bool {
        parts(crew.size(), robots) > 1
    }

    /// Begins a cycle of a swarm made for `cycles`, gives its parts to a crew, and simulates one of them.
    pub(super) fn begin(
        crew: &dyn Crew,
        swarm: &LiveSwarm,
        (assembly, cycles): (&Assembly, usize),
        inputs: &[bool],
    ) -> Result<Self, RobotFault> {
        let begun = swarm.begin(inputs)?;
        let part = |robots: Range<usize>| swarm.part(&begun, assembly, cycles, robots);
        let mut ranges = ranges(parts(crew.size(), assembly.members.len()), assembly.members.len());
        let own = part(ranges.next().expect("there is a part"));
        let others = crew.give(ranges.map(|robots| CrewPart::Cycle(Box::new(part(robots)))).collect());
        Ok(Self { own: own.simulate(&Simulator::default()), begun, others })
    }

    /// Gives the cycle back if results are missing. The error is that of a robot that has failed in it.
    pub(super) fn end(self, swarm: &mut LiveSwarm) -> Result<Result<(), RobotFault>, Self> {
        let Some(others) = self.others.take() else { return Err(self) };
        let mut parts = vec![self.own];
        parts.extend(others.into_iter().map(CrewResult::states));
        Ok(swarm.end(self.begun, &parts).map(drop))
    }
}

pub(super) struct SharedCycles {
    shell: Arc<dyn Shell>,
    present: Option<SharedCycle>,
}

impl SharedCycles {
    pub(super) fn new(shell: Arc<dyn Shell>) -> Self {
        Self { shell, present: None }
    }

    pub(super) fn waits(&self) -> bool {
        self.present.is_some()
    }
}

impl CycleRunner for SharedCycles {
    fn step(
        &mut self,
        swarm: &mut LiveSwarm,
        assembly: &Assembly,
        cycles: usize,
        inputs: &[bool],
    ) -> Poll<Result<(), RobotFault>> {
        let present = self.present.take();
        let is_worth_it = |crew: &&dyn Crew| SharedCycle::is_worth_it(*crew, assembly.members.len());
        let crew = self.shell.crew().filter(is_worth_it);
        let Some(crew) = crew.filter(|_| swarm.is_divisible()) else {
            return Poll::Ready(swarm.step(inputs).map(drop));
        };
        let next = match present {
            Some(present) => match present.end(swarm) {
                Ok(ended) => return Poll::Ready(ended),
                Err(present) => present,
            },
            None => match SharedCycle::begin(crew, swarm, (assembly, cycles), inputs) {
                Ok(begun) => begun,
                Err(fault) => return Poll::Ready(Err(fault)),
            },
        };
        self.present = Some(next);
        Poll::Pending
    }
}

fn parts(crew: usize, robots: usize) -> usize {
    (robots / LEAST_ROBOTS).clamp(1, crew + 1)
}

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
