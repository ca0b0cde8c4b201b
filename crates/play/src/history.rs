//! The last cycles of a live swarm, which can be shown again.

use std::collections::VecDeque;

use nbc_base::model::CYCLE_STEPS;
use nbc_swarm::{LiveSwarm, SwarmSnapshot};

pub(super) const MEMORY: u32 = 1000;
/// The most bytes of snapshots. A swarm with larger ones keeps one every few cycles.
const ROOM: usize = 64 << 20;
/// The least bytes of a point in a snapshot: position and velocity.
const POINT: usize = 32;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct LoggedCycle {
    pub(super) inputs: Vec<bool>,
    pub(super) bits: Vec<bool>,
    pub(super) outputs: Vec<bool>,
    /// The centers of mass at its end, in voxels of the world.
    pub(super) com_x: Vec<f64>,
    /// Robots whose bits changed within the cycle, each with the env step.
    pub(super) flips: Vec<[u16; 2]>,
}

impl LoggedCycle {
    pub(super) fn last_of(swarm: &LiveSwarm) -> Self {
        let trace = swarm.trace();
        let cycle = trace.cycles.last().expect("the swarm has done a cycle");
        let start = (swarm.cycles() as u32 - 1) * CYCLE_STEPS;
        let flips = trace.flips.iter().filter(|flip| flip.env_step > start);
        Self {
            inputs: cycle.inputs.clone(),
            bits: cycle.bits.clone(),
            outputs: cycle.outputs.clone(),
            com_x: trace.robots.iter().map(|robot| robot.com_x[robot.com_x.len() - 1]).collect(),
            flips: flips.map(|flip| [flip.robot as u16, (flip.env_step - start) as u16]).collect(),
        }
    }
}

pub(super) struct SwarmHistory {
    /// Snapshots with their cycles, the earliest first. There is always one.
    marks: VecDeque<(u32, SwarmSnapshot)>,
    log: VecDeque<LoggedCycle>,
    spacing: u32,
    memory: u32,
}

impl SwarmHistory {
    pub(super) fn new(start: &LiveSwarm, memory: u32) -> Self {
        let points: usize = start.trace().recording.robots.iter().map(|robot| robot.points).sum();
        let all = (memory as usize * points * POINT).div_ceil(ROOM);
        Self { marks: [(0, start.snapshot())].into(), log: VecDeque::new(), spacing: all.max(1) as u32, memory }
    }

    fn first(&self) -> u32 {
        self.marks[0].0
    }

    pub(super) fn earliest(&self) -> u32 {
        if self.first() == 0 { 0 } else { self.first() + 1 }
    }

    pub(super) fn last(&self) -> u32 {
        self.first() + self.log.len() as u32
    }

    pub(super) fn after(&self, cycle: u32) -> (u32, impl ExactSizeIterator<Item = &LoggedCycle>) {
        let skipped = cycle.clamp(self.first(), self.last()) - self.first();
        (self.first() + skipped + 1, self.log.range(skipped as usize..))
    }

    pub(super) fn inputs(&self, from: u32, to: u32) -> Vec<Vec<bool>> {
        let range = (from - self.first()) as usize..(to - self.first()) as usize;
        self.log.range(range).map(|cycle| cycle.inputs.clone()).collect()
    }

    /// The latest snapshot at a cycle of at most `cycle`, or else the earliest one.
    pub(super) fn mark(&self, cycle: u32) -> (u32, &SwarmSnapshot) {
        let after = self.marks.partition_point(|(at, _)| *at <= cycle);
        let (at, snapshot) = &self.marks[after.saturating_sub(1)];
        (*at, snapshot)
    }

    /// Records the only cycle of the swarm's trace, in place of all records from `cycle` on.
    pub(super) fn push(&mut self, cycle: u32, logged: LoggedCycle, swarm: &LiveSwarm) {
        self.log.truncate((cycle - 1 - self.first()) as usize);
        self.marks.retain(|(at, _)| *at < cycle);
        self.log.push_back(logged);
        if cycle.is_multiple_of(self.spacing) {
            self.marks.push_back((cycle, swarm.snapshot()));
        }
        while self.marks.len() > 1 && self.marks[1].0 + self.memory <= cycle {
            let past = self.marks[1].0 - self.marks[0].0;
            self.marks.pop_front();
            self.log.drain(..past as usize);
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Poses {
    pub(super) points: usize,
    /// The origin of the numbers, in voxels of the world.
    pub(super) origin: f64,
    /// Frames of x and y of each point, in hundredths of a voxel.
    pub(super) frames: Vec<i16>,
}

impl Poses {
    /// The poses of all robots of a swarm in its last cycle; at the start, the first pose for the whole cycle.
    pub(super) fn of(swarm: &LiveSwarm) -> Vec<Self> {
        let recording = &swarm.trace().recording;
        let frames = recording.frames_per_cycle as usize;
        let poses = recording.robots.iter().map(|robot| {
            let length = 2 * robot.points;
            let have = robot.frames.len() / length.max(1);
            let frames = if have >= frames {
                robot.frames[(have - frames) * length..].to_vec()
            } else {
                robot.frames[..have.min(1) * length].repeat(frames)
            };
            Self { points: robot.points, origin: robot.origin(), frames }
        });
        poses.collect()
    }
}

pub(super) const FRAMES: u32 = CYCLE_STEPS / 7;

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::MemoryWorld;
    use nbc_session::{Choice, CompileOptions, Session};
    use nbc_swarm::Room;

    fn swarm() -> LiveSwarm {
        let mut session = Session::new(MemoryWorld::default()).with_poses(Room::LIVE);
        session.update("n.nb", 1, "circuit n(a) -> (b) { b = not a }");
        let checked = session.open("n.nb").unwrap();
        let circuit = checked.circuit(&Choice::default()).unwrap();
        let compiled = checked.compile(&circuit, &CompileOptions::default()).unwrap();
        session.swarm(&compiled)
    }

    fn step(swarm: &mut LiveSwarm, history: &mut SwarmHistory, input: bool) {
        swarm.step(&[input]).unwrap();
        let logged = LoggedCycle::last_of(swarm);
        swarm.forget();
        history.push(swarm.cycles() as u32, logged, swarm);
    }

    #[test]
    fn the_last_cycles_are_remembered_and_earlier_ones_forgotten() {
        let mut swarm = swarm();
        let mut history = SwarmHistory::new(&swarm, 4);
        for cycle in 0..10 {
            step(&mut swarm, &mut history, cycle % 2 == 0);
        }
        assert_eq!((history.earliest(), history.last()), (7, 10));
        assert_eq!((history.marks.len(), history.log.len()), (5, 4));
        assert_eq!(history.inputs(7, 10), [[false], [true], [false]]);
        let (first, cycles) = history.after(8);
        assert_eq!((first, cycles.len()), (9, 2));
        let (first, cycles) = history.after(0);
        assert_eq!((first, cycles.len()), (7, 4), "what is forgotten is left out");
        assert_eq!(history.mark(8).0, 8);
    }

    #[test]
    fn what_comes_after_a_cycle_that_is_done_again_is_forgotten() {
        let mut swarm = swarm();
        let mut history = SwarmHistory::new(&swarm, 100);
        (0..6).for_each(|_| step(&mut swarm, &mut history, true));
        let (at, mark) = history.mark(3);
        assert_eq!(at, 3);
        swarm.restore(&mark.clone());
        step(&mut swarm, &mut history, false);
        assert_eq!((history.last(), history.marks.len()), (4, 5));
        assert_eq!(history.inputs(2, 4), [[true], [false]]);
    }
}
