//! A swarm in full physics that is simulated cycle by cycle. Every robot has its own simulation and senses the last
//! outputs of the others.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::hearing::{Heard, Hearing};
use crate::sensing::Sensing;
use crate::{
    Assembly, CyclePart, CycleTrace, Flip, KeptSwarm, OwnClock, PartStates, Recording, RobotFault, Room, SwarmTrace,
};
use nbc_base::model::{CYCLE_STEPS, Pattern};
use nbc_sim::{Flock, Simulator, Snapshot};

const SAMPLE_STRIDE: u32 = CYCLE_STEPS / SwarmTrace::SAMPLES_PER_CYCLE as u32;

#[derive(Debug)]
pub struct LiveSwarm {
    flock: Box<dyn Flock>,
    hearing: Hearing,
    sensing: Sensing,
    /// Env steps of a cycle at whose end something is recorded, in order.
    stops: BTreeSet<u32>,
    stride: u32,
    trace: SwarmTrace,
    forgotten: usize,
}

#[derive(Clone, Debug)]
pub struct SwarmSnapshot {
    robots: Vec<Snapshot>,
    hearing: Hearing,
    sensing: Sensing,
    trace: SwarmTrace,
    forgotten: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub struct BegunCycle {
    inputs: Vec<bool>,
    sensing: Sensing,
}

impl SwarmSnapshot {
    pub fn robots(&self) -> &[Snapshot] {
        &self.robots
    }
}

impl LiveSwarm {
    /// Starts a swarm in a world wide enough for `cycles`. An output is the sign of the displacement over the last
    /// `window` cycles. Poses are recorded if there is room for them. Panics when the window is empty.
    pub fn new(simulator: &Simulator, assembly: &Assembly, cycles: usize, window: usize, poses: Option<Room>) -> Self {
        assert!(window > 0, "an output is read over one cycle at least");
        let mut flock = assembly.flock(simulator, cycles);
        let hearing = Hearing::new(assembly, window, &mut *flock);
        let mut trace = SwarmTrace::begin(assembly);
        trace.robots.iter_mut().enumerate().for_each(|(i, robot)| robot.com_x.push(flock.center(i)[0]));
        let stride = match poses {
            Some(room) => begin_recording(&mut trace, room, &*flock, cycles),
            None => CYCLE_STEPS,
        };
        Self { flock, hearing, sensing: Sensing::of(assembly), stops: stops(stride), stride, trace, forgotten: 0 }
    }

    pub fn cycles(&self) -> usize {
        self.forgotten + self.trace.cycles.len()
    }

    /// Forgets all cycles but the last one, so that a swarm may run for any time in the same memory.
    pub fn forget(&mut self) {
        let past = self.trace.cycles.len().saturating_sub(1);
        self.trace.forget_first(past);
        self.forgotten += past;
        self.trace.recording.restart(&*self.flock);
    }

    /// As [`LiveSwarm::forget`], and records poses from here on for `cycles`, if there is room for them.
    pub fn record(&mut self, room: Room, cycles: usize) {
        self.forget();
        self.stride = begin_recording(&mut self.trace, room, &*self.flock, cycles);
        self.stops = stops(self.stride);
    }

    /// At the end of each of its cycles a robot outputs 1 if its center of mass moved in +x over the window, else 0.
    /// From the end of [`Assembly::start_cycles`] on, this bit is the stimulus of its receivers until the end of its
    /// next cycle (paper, section 4). In most worlds all have the cycles of the world.
    /// Panics when there are not as many bits as the input ports have.
    pub fn step(&mut self, inputs: &[bool]) -> Result<&CycleTrace, RobotFault> {
        let begun = self.begin(inputs)?;
        let mut done = 0;
        self.go_through(begun, |flock, _, stop, sensed| {
            flock.advance(sensed, stop - done);
            done = stop;
        })
    }

    /// Whether the cycles of the swarm can be divided among machines: no stimulus changes within one.
    pub fn is_divisible(&self) -> bool {
        self.hearing.is_common()
    }

    /// One for each robot.
    pub fn own_clocks(&self) -> &[OwnClock] {
        self.hearing.clocks()
    }

    /// Begins a cycle as [`LiveSwarm::step`] does. Until it has ended, the swarm is as it was before.
    pub fn begin(&self, inputs: &[bool]) -> Result<BegunCycle, RobotFault> {
        let bits_in: usize = self.trace.inputs.iter().map(|port| port.width).sum();
        assert_eq!(inputs.len(), bits_in, "a bit for each bit of the input ports");
        let mut sensing = self.sensing.clone();
        sensing.sense(&self.trace, self.cycles(), inputs);
        self.trace.fault().map_or(Ok(BegunCycle { inputs: inputs.to_vec(), sensing }), Err)
    }

    pub fn part(&self, begun: &BegunCycle, assembly: &Assembly, cycles: usize, robots: Range<usize>) -> CyclePart {
        CyclePart {
            setting: assembly.setting(cycles),
            bodies: assembly.members[robots.clone()].iter().map(|member| member.robot.body.clone()).collect(),
            starts: robots.clone().map(|robot| self.flock.snapshot(robot)).collect(),
            patterns: begun.sensing.sensed[robots].to_vec(),
            stops: self.stops.iter().copied().collect(),
        }
    }

    /// Ends a begun cycle with the states of all robots, part by part in order, as [`LiveSwarm::step`] would.
    pub fn end(&mut self, begun: BegunCycle, parts: &[PartStates]) -> Result<&CycleTrace, RobotFault> {
        let robots: usize = parts.iter().map(|part| part[0].len()).sum();
        assert_eq!(robots, self.flock.len(), "a state for each robot");
        self.go_through(begun, |flock, at, _, _| {
            parts.iter().flat_map(|part| &part[at]).enumerate().for_each(|(i, state)| flock.restore(i, state));
        })
    }

    pub fn trace(&self) -> &SwarmTrace {
        &self.trace
    }

    pub fn into_trace(self) -> SwarmTrace {
        self.trace
    }

    pub fn snapshot(&self) -> SwarmSnapshot {
        let robots = (0..self.flock.len()).map(|robot| self.flock.snapshot(robot)).collect();
        let (hearing, sensing) = (self.hearing.clone(), self.sensing.clone());
        SwarmSnapshot { robots, hearing, sensing, trace: self.trace.clone(), forgotten: self.forgotten }
    }

    /// Sets the swarm to a snapshot of it or of a swarm of the same assembly, trace and recording included.
    pub fn restore(&mut self, snapshot: &SwarmSnapshot) {
        assert_eq!(snapshot.robots.len(), self.flock.len(), "a snapshot is of the same swarm");
        for (i, robot) in snapshot.robots.iter().enumerate() {
            self.flock.restore(i, robot);
        }
        self.hearing.clone_from(&snapshot.hearing);
        self.sensing.clone_from(&snapshot.sensing);
        self.trace.clone_from(&snapshot.trace);
        self.forgotten = snapshot.forgotten;
    }

    /// The swarm as plain data, from which it goes on with the same bits.
    pub fn keep(&self) -> KeptSwarm {
        assert_eq!(self.forgotten, 0, "the outputs of all cycles are kept");
        let robot = |robot: usize| (self.flock.snapshot(robot), self.hearing.heard[robot].clone());
        let bits = self.trace.cycles.iter().map(|cycle| &cycle.bits[..]);
        KeptSwarm::new(bits, self.trace.flips.clone(), (0..self.flock.len()).map(robot))
    }

    /// Continues from a kept swarm with these inputs; returns whether it fits. In earlier paths, which are unknown, it
    /// stands still.
    pub fn go_on(&mut self, kept: &KeptSwarm, assembly: &Assembly, inputs: &[Vec<bool>]) -> bool {
        let outputs = kept.outputs(assembly.members.len()).filter(|cycles| cycles.len() <= inputs.len());
        let Some(outputs) = outputs else { return false };
        let points = |robot: usize| self.flock.snapshot(robot).state.position.len();
        let fits = |(at, (snapshot, heard)): (usize, (Snapshot, Heard))| {
            let state = &snapshot.state;
            let sizes = [state.position.len(), state.previous.len(), state.velocity.len()];
            sizes == [points(at); 3] && !heard.places.is_empty()
        };
        let are_there = kept.flips.iter().all(|flip| flip.robot < assembly.members.len());
        if !are_there || !kept.robots().enumerate().all(fits) {
            return false;
        }
        let recording = std::mem::take(&mut self.trace.recording);
        (self.sensing, self.trace) = Sensing::replayed(assembly, &outputs, &kept.flips, inputs);
        self.trace.recording = recording;
        for (i, (snapshot, heard)) in kept.robots().enumerate() {
            self.flock.restore(i, &snapshot);
            let robot = &mut self.trace.robots[i];
            robot.com_x = vec![snapshot.center[0]; outputs.len() * SwarmTrace::SAMPLES_PER_CYCLE + 1];
            let ends = robot.com_x.iter_mut().rev().step_by(SwarmTrace::SAMPLES_PER_CYCLE);
            ends.zip(heard.places.iter().rev()).for_each(|(end, place)| *end = *place);
            robot.fault = snapshot.fault;
            self.hearing.heard[i] = heard;
        }
        true
    }

    /// Calls `reach` to bring the robots to each stop of a cycle, under what they sense until then.
    fn go_through(
        &mut self,
        BegunCycle { inputs, sensing }: BegunCycle,
        mut reach: impl FnMut(&mut dyn Flock, usize, u32, &[Pattern]),
    ) -> Result<&CycleTrace, RobotFault> {
        let (sensed, start) = (sensing.sensed.clone(), self.cycles() as u32 * CYCLE_STEPS);
        let before = std::mem::replace(&mut self.sensing, sensing);
        let mut stops = self.stops.clone();
        stops.extend(self.hearing.stops(start));
        for (at, &stop) in stops.iter().enumerate() {
            reach(&mut *self.flock, at, stop, &self.sensing.sensed);
            self.hearing.wind(&mut *self.flock, start + stop);
            let changed = self.hearing.hear(&*self.flock, start + stop);
            if stop == CYCLE_STEPS || !changed.is_empty() {
                self.sensing.take(start + stop, &self.hearing.bits());
            }
            if stop < CYCLE_STEPS && !changed.is_empty() {
                self.sensing.sense(&self.trace, self.cycles(), &inputs);
                let flip = |robot| Flip { env_step: start + stop, robot };
                self.trace.flips.extend(changed.into_iter().map(flip));
            }
            self.record_stop(stop);
        }
        for (i, robot) in self.trace.robots.iter_mut().enumerate() {
            robot.fault = self.flock.fault(i).map(|fault| self.hearing.in_world_time(i, fault, start));
        }
        if let Some(fault) = self.trace.fault() {
            self.sensing = before;
            self.trace.forget_unfinished(start);
            return Err(fault);
        }
        let bits = self.hearing.bits();
        let outputs = self.trace.shown.iter().map(|&signal| signal.bit(&inputs, &bits)).collect();
        self.trace.cycles.push(CycleTrace { inputs, sensed, bits, outputs });
        Ok(&self.trace.cycles[self.trace.cycles.len() - 1])
    }

    fn record_stop(&mut self, stop: u32) {
        if stop.is_multiple_of(SAMPLE_STRIDE) {
            for (i, robot) in self.trace.robots.iter_mut().enumerate() {
                robot.com_x.push(self.flock.center(i)[0]);
            }
        }
        if stop.is_multiple_of(self.stride) {
            self.trace.recording.record(&*self.flock);
        }
    }
}

fn stops(stride: u32) -> BTreeSet<u32> {
    let steps = |stride: u32| (1..=CYCLE_STEPS / stride).map(move |stop| stop * stride);
    steps(SAMPLE_STRIDE).chain(steps(stride)).collect()
}

/// Starts a recording of the robots for which there is room, the most interesting first. Returns its stride.
fn begin_recording(trace: &mut SwarmTrace, room: Room, flock: &dyn Flock, cycles: usize) -> u32 {
    let order = trace.by_interest();
    let points: Vec<usize> = order.iter().map(|&robot| flock.lattice(robot).points().len()).collect();
    let (stride, count) = room.fit(&points, cycles);
    let robots: BTreeSet<usize> = order.into_iter().take(count).collect();
    trace.recording = Recording::new(flock, robots, stride);
    trace.recording.record(flock);
    stride
}

#[cfg(test)]
mod tests {
    use nbc_base::model::{Body, Hears, Palette, PhysicsWorld, WorldNoise};
    use nbc_sim::{InstructionSet, Kernel, LaneBackend};

    use super::*;
    use crate::{PlainMember, StimulusSource, SwarmTask};

    /// Bodies of the library: an inverter and a NAND.
    fn ring(robots: usize, world: PhysicsWorld) -> Assembly {
        let rows = [["37150", "77735", "02543", "00253", "33333"], ["37555", "77755", "02562", "00263", "33333"]];
        let member = |i: usize| PlainMember {
            body: Body::parse(&rows[i % 2], &Palette::paper()).unwrap(),
            clock: 1,
            senses: vec![StimulusSource::Robot((i + robots - 1) % robots), StimulusSource::Input(0)],
            start: i.is_multiple_of(3),
            held: vec![Vec::new(); 2],
        };
        SwarmTask::new((0..robots).map(member).collect(), world, vec![vec![true]], 1).assembly.in_world(world)
    }

    fn simulators() -> impl Iterator<Item = Simulator> {
        let kernels = InstructionSet::available().into_iter();
        let kernels =
            kernels.flat_map(|set| Kernel::WIDTHS.into_iter().filter_map(move |lanes| Kernel::new(set, lanes)));
        kernels.map(|kernel| Simulator::new(LaneBackend { kernel, ..LaneBackend::default() }))
    }

    fn run(swarm: &mut LiveSwarm, cycles: std::ops::Range<usize>) {
        cycles.for_each(|cycle| drop(swarm.step(&[cycle % 4 < 2]).unwrap().clone()));
    }

    #[test]
    fn robots_that_are_read_one_by_one_have_the_bits_of_those_that_are_read_together() {
        for simulator in simulators() {
            let assembly = ring(4, PhysicsWorld::default());
            let trace = |clocks_agree: bool| {
                let mut swarm = LiveSwarm::new(&simulator, &assembly, 6, 1, None);
                swarm.hearing.clocks_agree &= clocks_agree;
                run(&mut swarm, 0..6);
                swarm.into_trace()
            };
            assert_eq!(trace(true), trace(false));
        }
    }

    #[test]
    fn robots_with_clocks_of_their_own_have_the_same_bits_for_all_kernels_and_after_a_pause() {
        let noise = WorldNoise { phase: 1.0, drift: 0.02, missed: 0.1, seed: 4, ..WorldNoise::default() };
        for hears in [Hears::Cycle, Hears::Always] {
            let assembly = ring(4, PhysicsWorld { noise, hears, ..PhysicsWorld::default() });
            let whole = |simulator: &Simulator| {
                let mut swarm = LiveSwarm::new(simulator, &assembly, 6, 1, None);
                run(&mut swarm, 0..6);
                swarm.into_trace()
            };
            let traces: Vec<SwarmTrace> = simulators().map(|simulator| whole(&simulator)).collect();
            assert!(!traces[0].flips.is_empty());
            assert!(traces.iter().all(|trace| *trace == traces[0]));

            let simulator = Simulator::default();
            let mut first = LiveSwarm::new(&simulator, &assembly, 6, 1, None);
            run(&mut first, 0..4);
            let mut second = LiveSwarm::new(&simulator, &assembly, 6, 1, None);
            let inputs: Vec<Vec<bool>> = (0..6).map(|cycle| vec![cycle % 4 < 2]).collect();
            assert!(second.go_on(&first.keep(), &assembly, &inputs));
            run(&mut second, 4..6);
            let bits = |trace: &SwarmTrace| trace.cycles.iter().map(|cycle| cycle.bits.clone()).collect::<Vec<_>>();
            assert_eq!((bits(second.trace()), &second.trace().flips), (bits(&traces[0]), &traces[0].flips));
        }
    }
}
