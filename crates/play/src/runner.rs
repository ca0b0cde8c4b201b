//! The swarm of a page: it is simulated at the chosen speed, its last cycles are recorded, and frames of it are sent.

use std::collections::VecDeque;
use std::sync::Arc;

use core::task::Poll;
use core::time::Duration;

use crate::frame::SwarmFrame;
use crate::history::{FRAMES, LoggedCycle, MEMORY, Poses, SwarmHistory};
use crate::jobs::{Job, PortionEnd};
use crate::message::{PlayEvent, RequestResult, SettledOutputs};
use crate::outbox::Outbox;
use crate::refusal::Refused;
use crate::shared_cycle::SharedCycles;
use crate::shell::Shell;
use nbc_circuit::{Settled, SettledRow};
use nbc_session::{Compiled, CycleRunner, Excerpt, Observer, Session};
use nbc_swarm::{LiveSwarm, RobotFault, RobotTrace, SwarmSnapshot};

/// The least time between two frames: screens show no more.
const FRAME_TIME: Duration = Duration::from_millis(15);
/// A swarm that is later than this does not catch up.
const LATE: Duration = Duration::from_millis(250);
/// A swarm stops when this many voxels of ground are left.
const GROUND_LEFT: f64 = 64.0;
const PACE_CYCLES: usize = 64;
const PORTION: usize = 8;

pub(super) struct LoadingSwarm {
    running: RunningSwarm,
    cycles: u32,
    fault: Option<String>,
    request: u64,
    answer: RequestResult,
}

impl LoadingSwarm {
    pub(super) fn new(running: RunningSwarm, cycles: usize, (request, answer): (u64, RequestResult)) -> Self {
        Self { running, cycles: cycles as u32, fault: None, request, answer }
    }

    pub(super) fn advance(&mut self, job: &mut Job) -> Result<PortionEnd, Refused> {
        for _ in 0..PORTION {
            job.check()?;
            if self.running.now() == self.cycles || self.fault.is_some() {
                return Ok(PortionEnd::Done(None));
            }
            match self.running.cycle() {
                Poll::Ready(fault) => self.fault = fault,
                Poll::Pending => return Ok(PortionEnd::Waits),
            }
        }
        job.progress(self.running.now().into(), self.cycles.into());
        Ok(PortionEnd::More)
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Change {
    Inputs(Vec<bool>),
    Clock { bit: usize, half: Option<u32> },
    Run { speed: Option<f64> },
    Pause,
    Step { cycles: u32 },
    Reset,
    Seek { cycle: u32 },
    View { robots: Vec<usize> },
}

pub(super) fn bits_of(digits: &str) -> Vec<bool> {
    digits.bytes().map(|digit| digit == b'1').collect()
}

pub(super) struct Runner {
    outbox: Outbox,
    shown: Option<RunningSwarm>,
}

struct Pace {
    /// Cycles a second; none for as many as possible.
    speed: Option<f64>,
    /// Cycles after which it pauses.
    left: Option<u32>,
    next: Duration,
}

pub(super) struct RunningSwarm {
    number: u32,
    compiled: Compiled,
    settled: Settled,
    swarm: LiveSwarm,
    history: SwarmHistory,
    start: SwarmSnapshot,
    inputs: Vec<bool>,
    script: Vec<Vec<bool>>,
    /// An input bit that changes by itself, the cycles from change to change, and the cycle of the last one.
    clock: Option<(usize, u32, u32)>,
    pace: Option<Pace>,
    cycles: SharedCycles,
    shell: Arc<dyn Shell>,
    times: VecDeque<Duration>,
    starts: Vec<[f64; 2]>,
    poses: Vec<Poses>,
    view: Vec<usize>,
    sent: u32,
    /// The last cycle that the page knew before the newest frame.
    sent_before: u32,
    is_new: bool,
    last_frame: Option<Duration>,
    /// In voxels.
    world: f64,
}

impl Runner {
    pub(super) fn new(outbox: Outbox) -> Self {
        Self { outbox, shown: None }
    }

    /// The time until there is something to do; `None` until a request or a part of a cycle comes.
    pub(super) fn due(&self, now: Duration) -> Option<Duration> {
        self.shown.as_ref().and_then(|shown| shown.due(now))
    }

    pub(super) fn advance(&mut self, now: Duration) {
        let Some(shown) = &mut self.shown else { return };
        if shown.is_due(now)
            && let Some(reason) = shown.go_on(now)
        {
            self.outbox.event(PlayEvent::Stopped { reason });
        }
        shown.show(&self.outbox, now);
    }

    pub(super) fn change(&mut self, id: u64, change: Change, now: Duration) {
        // An older frame would come after the answer, and the page would take it for a newer one.
        if let Some(shown) = self.shown.as_mut().filter(|_| self.outbox.line().remove_frame()) {
            shown.take_back();
        }
        let done = self.shown.as_mut().ok_or(Refused::NoSwarm).and_then(|shown| shown.change(change, now));
        self.outbox.done(id, done);
    }

    pub(super) fn settle(&mut self, rows: &[String]) -> Result<SettledOutputs, Refused> {
        self.shown.as_mut().ok_or(Refused::NoSwarm)?.settle(rows)
    }

    pub(super) fn excerpt(&self, cycles: u32) -> Result<Excerpt, Refused> {
        self.shown.as_ref().map(|shown| shown.excerpt(cycles)).ok_or(Refused::NoSwarm)
    }

    pub(super) fn show(&mut self, loaded: LoadingSwarm) {
        // A frame of the swarm before would come after the answer.
        self.outbox.line().remove_frame();
        self.outbox.answer(loaded.request, Ok(loaded.answer));
        if let Some(reason) = loaded.fault {
            self.outbox.event(PlayEvent::Stopped { reason });
        }
        self.shown = Some(loaded.running);
    }
}

impl RunningSwarm {
    pub(super) fn new(
        number: u32,
        compiled: Compiled,
        swarm: LiveSwarm,
        (script, shell): (Vec<Vec<bool>>, Arc<dyn Shell>),
    ) -> Self {
        let trace = swarm.trace();
        let lefts = trace.recording.robots.iter().map(|robot| robot.origin());
        let starts = trace.robots.iter().zip(lefts).map(|(robot, left)| [robot.com_x[0], left]).collect();
        let robots = trace.robots.len();
        Self {
            number,
            history: SwarmHistory::new(&swarm, MEMORY),
            start: swarm.snapshot(),
            inputs: vec![false; trace.inputs.iter().map(|port| port.width).sum()],
            script,
            clock: None,
            pace: None,
            cycles: SharedCycles::new(shell.clone()),
            shell,
            times: VecDeque::new(),
            starts,
            poses: Poses::of(&swarm),
            view: (0..robots).collect(),
            sent: 0,
            sent_before: 0,
            is_new: true,
            last_frame: None,
            settled: Settled::new(&compiled.mapping.source),
            world: compiled.assembly.setting(Session::LIVE_CYCLES).world_width as f64,
            compiled,
            swarm,
        }
    }

    fn now(&self) -> u32 {
        self.swarm.cycles() as u32
    }

    fn due(&self, now: Duration) -> Option<Duration> {
        let pace = self.pace.as_ref().filter(|_| !self.cycles.waits());
        let until_cycle = pace.map(|pace| pace.next.saturating_sub(now));
        let until_frame = self.is_new.then_some(FRAME_TIME);
        until_cycle.into_iter().chain(until_frame).min()
    }

    fn is_due(&self, now: Duration) -> bool {
        self.pace.as_ref().is_some_and(|pace| pace.next <= now)
    }

    /// Simulates the next cycle unless workers still do. Returns the reason if the swarm cannot continue.
    fn go_on(&mut self, now: Duration) -> Option<String> {
        let Poll::Ready(fault) = self.cycle() else { return None };
        let fault = fault.or_else(|| self.ground_ends());
        if fault.is_some() {
            self.pace = None;
        }
        self.times.push_back(now);
        if self.times.len() > PACE_CYCLES {
            self.times.pop_front();
        }
        let Some(pace) = &mut self.pace else { return fault };
        pace.next = match pace.speed {
            Some(speed) => (pace.next + Duration::from_secs_f64(1.0 / speed)).max(now.saturating_sub(LATE)),
            None => now,
        };
        pace.left = pace.left.map(|left| left - 1);
        if pace.left == Some(0) {
            self.pace = None;
        }
        None
    }

    fn cycle(&mut self) -> Poll<Option<String>> {
        if !self.cycles.waits() {
            self.set_next_inputs();
        }
        let step = self.cycles.step(&mut self.swarm, &self.compiled.assembly, Session::LIVE_CYCLES, &self.inputs);
        step.map(|step| self.note(step.err()))
    }

    fn set_next_inputs(&mut self) {
        let now = self.now();
        if let Some(bits) = self.script.get(now as usize) {
            self.inputs.clone_from(bits);
        }
        if let Some((bit, half, last)) = &mut self.clock
            && now >= last.saturating_add(*half)
        {
            self.inputs[*bit] = !self.inputs[*bit];
            *last = now;
        }
    }

    fn note(&mut self, fault: Option<RobotFault>) -> Option<String> {
        self.is_new = true;
        if let Some(fault) = fault {
            return Some(fault.to_string());
        }
        let now = self.now();
        let logged = LoggedCycle::last_of(&self.swarm);
        self.poses = Poses::of(&self.swarm);
        self.swarm.forget();
        self.sent = self.sent.min(now - 1);
        self.history.push(now, logged, &self.swarm);
        None
    }

    fn ground_ends(&self) -> Option<String> {
        let at_end = |robot: &RobotTrace| {
            let x = robot.com_x[robot.com_x.len() - 1];
            x < GROUND_LEFT || x > self.world - GROUND_LEFT
        };
        self.swarm.trace().robots.iter().any(at_end).then(|| "a robot has reached the end of its ground".to_owned())
    }

    fn change(&mut self, change: Change, now: Duration) -> Result<(), Refused> {
        // Nobody has seen a cycle that workers still simulate: it is simulated again, with the change.
        self.cycles = SharedCycles::new(self.shell.clone());
        match change {
            Change::Inputs(bits) if bits.len() != self.inputs.len() => {
                return Err(Refused::Bits { expected: self.inputs.len() });
            }
            Change::Inputs(bits) => {
                self.script.clear();
                self.set_inputs(bits);
            }
            Change::Clock { bit, .. } if bit >= self.inputs.len() => {
                return Err(Refused::Bits { expected: self.inputs.len() });
            }
            Change::Clock { bit, half } => {
                if half.is_some() {
                    self.script.clear();
                }
                self.clock = half.map(|half| (bit, half.max(1), self.now()));
            }
            Change::Run { speed } => self.set_pace(speed, None, now),
            Change::Pause => self.set_paused(),
            Change::Step { cycles } => self.set_pace(None, Some(cycles.clamp(1, 1000)), now),
            Change::Reset => self.reset(),
            Change::Seek { cycle } => self.seek(cycle)?,
            Change::View { robots } => {
                let count = self.starts.len();
                self.view = robots.into_iter().filter(|&robot| robot < count).collect();
                self.view.sort_unstable();
                self.view.dedup();
                self.is_new = true;
            }
        }
        Ok(())
    }

    fn set_inputs(&mut self, bits: Vec<bool>) {
        let kept = self.clock.map(|(bit, ..)| (bit, self.inputs[bit]));
        self.inputs = bits;
        if let Some((bit, value)) = kept {
            self.inputs[bit] = value;
        }
    }

    fn set_pace(&mut self, speed: Option<f64>, left: Option<u32>, now: Duration) {
        let speed = speed.filter(|speed| speed.is_finite()).map(|speed| speed.clamp(0.01, 10_000.0));
        self.pace = Some(Pace { speed, left, next: now });
        self.times.clear();
        self.is_new = true;
    }

    fn set_paused(&mut self) {
        self.pace = None;
        self.is_new = true;
    }

    fn reset(&mut self) {
        self.set_paused();
        self.swarm.restore(&self.start);
        self.history = SwarmHistory::new(&self.swarm, MEMORY);
        self.poses = Poses::of(&self.swarm);
        self.clock = self.clock.map(|(bit, half, _)| (bit, half, 0));
        self.sent = 0;
    }

    fn seek(&mut self, cycle: u32) -> Result<(), Refused> {
        let (first, last) = (self.history.earliest(), self.history.last());
        if !(first..=last).contains(&cycle) {
            return Err(Refused::Cycle { first, last });
        }
        self.set_paused();
        // One cycle earlier, because the poses are those of the last cycle.
        let (from, mark) = self.history.mark(cycle.saturating_sub(1));
        let inputs = self.history.inputs(from, cycle);
        self.swarm.restore(mark);
        for bits in &inputs {
            self.swarm.forget();
            // A cycle of the log has no fault.
            let _ = self.swarm.step(bits);
        }
        self.poses = Poses::of(&self.swarm);
        if from > 0 || !inputs.is_empty() {
            self.swarm.forget();
        }
        if let Some(bits) = inputs.last() {
            self.inputs.clone_from(bits);
        }
        self.clock = self.clock.map(|(bit, half, _)| (bit, half, cycle));
        Ok(())
    }

    /// What the outputs are once all robots have settled.
    fn settle(&mut self, rows: &[String]) -> Result<SettledOutputs, Refused> {
        let rows: Vec<Vec<bool>> = rows.iter().map(|row| bits_of(row)).collect();
        if rows.iter().any(|row| row.len() != self.inputs.len()) {
            return Err(Refused::Bits { expected: self.inputs.len() });
        }
        if self.settled.has_state() {
            return Ok(SettledOutputs { outputs: None });
        }
        let mut outputs = Vec::new();
        for rows in rows.chunks(Settled::ROWS) {
            let rows: Vec<&[bool]> = rows.iter().map(Vec::as_slice).collect();
            let digits = |row: &SettledRow| row.outputs.iter().map(|&bit| if bit { '1' } else { '0' }).collect();
            outputs.extend(self.settled.apply(&rows).iter().map(digits));
        }
        Ok(SettledOutputs { outputs: Some(outputs) })
    }

    fn excerpt(&self, cycles: u32) -> Excerpt {
        let now = self.now();
        let (from, start) = self.history.mark(now.saturating_sub(cycles));
        Excerpt { compiled: self.compiled.clone(), start: start.clone(), inputs: self.history.inputs(from, now) }
    }

    fn take_back(&mut self) {
        self.sent = self.sent.min(self.sent_before);
        self.is_new = true;
    }

    fn show(&mut self, outbox: &Outbox, now: Duration) {
        let too_soon = self.last_frame.is_some_and(|last| now.saturating_sub(last) < FRAME_TIME);
        if !self.is_new || too_soon || !outbox.line().has_room() {
            return;
        }
        let frame = SwarmFrame {
            number: self.number,
            frames: FRAMES,
            now: self.now(),
            first: self.history.earliest(),
            last: self.history.last(),
            pace: self.measured(),
            runs: self.pace.is_some(),
            logged: self.history.after(self.sent),
            starts: &self.starts,
            poses: &self.poses,
            view: &self.view,
        };
        outbox.line().frame(frame.encode());
        self.sent_before = self.sent;
        self.sent = self.history.last();
        self.is_new = false;
        self.last_frame = Some(now);
    }

    fn measured(&self) -> f32 {
        let (Some(first), Some(last), true) = (self.times.front(), self.times.back(), self.pace.is_some()) else {
            return 0.0;
        };
        let seconds = last.saturating_sub(*first).as_secs_f64();
        if seconds > 0.0 { ((self.times.len() - 1) as f64 / seconds) as f32 } else { 0.0 }
    }
}
