//! Many runs on a device. They are copied to the device once; then each launch of the kernel simulates all of them for
//! some env steps.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::backend::opencl::capacity::Capacity;
use crate::backend::opencl::card::{Arguments, Card, CardMemory, CardQueue};
use crate::backend::opencl::error::DeviceError;
use crate::backend::opencl::plan::BodyPlan;
use crate::backend::run::Run;
use crate::constants::Constants;
use crate::monitor::Monitor;
use crate::signal::Signals;
use nbc_base::model::Spell;

const WINDOW: u32 = 840;
const FIRST_WINDOW: u32 = 4;
/// The time that a launch should take, in nanoseconds. Drivers of cards that also show a screen stop programs after
/// some seconds, and a simulation can be stopped only between launches.
const PATIENCE: u64 = 200_000_000;

/// The most robots at once if some of them sense images, because each of these has targets of its own.
const MOST_SEEING: usize = 1024;

/// Robots that a multiprocessor simulates side by side.
pub const AT_ONCE: usize = 4;

const UNSTABLE: u32 = 1;
const SOUND: u32 = 0;

#[derive(Clone, Debug)]
pub struct DeviceWorld {
    pub card: Arc<Card>,
    pub constants: Constants,
    pub width: usize,
    pub monitor: Option<Arc<Monitor>>,
}

struct Member {
    run: usize,
    plan: Arc<BodyPlan>,
}

struct DeviceRuns<'a> {
    world: &'a DeviceWorld,
    queue: CardQueue<'a>,
    capacity: Capacity,
    members: &'a [Member],
    /// The body and the first mass of each run.
    places: Vec<[u32; 2]>,
    bodies: CardMemory<u32>,
    plan: CardMemory<u16>,
    stiffness: CardMemory<f64>,
    state: [CardMemory<[f64; 2]>; 3],
    centers: CardMemory<[f64; 2]>,
    outcomes: CardMemory<[u32; 2]>,
    window: u32,
}

impl DeviceWorld {
    fn plans(&self, runs: &[Run]) -> Vec<Arc<BodyPlan>> {
        let mut plans: BTreeMap<usize, Arc<BodyPlan>> = BTreeMap::new();
        let plan = |run: &Run| {
            let plan = plans.entry(run.body);
            Arc::clone(plan.or_insert_with(|| Arc::new(BodyPlan::new(&run.lattice, &self.constants))))
        };
        runs.iter().map(plan).collect()
    }

    /// Calls `record` with the center of mass after each env step. Returns untouched the runs without room in a group.
    pub fn finish(&self, runs: &mut [Run], record: &mut dyn FnMut(usize, [f64; 2])) -> Result<Vec<usize>, DeviceError> {
        let mut groups: BTreeMap<Capacity, Vec<Member>> = BTreeMap::new();
        let mut too_large = Vec::new();
        for (run, plan) in self.plans(runs).into_iter().enumerate().filter(|(run, _)| !runs[*run].is_done()) {
            let capacity = Capacity::of(&plan);
            if self.card.fits(capacity) {
                groups.entry(capacity).or_default().push(Member { run, plan });
            } else {
                too_large.push(run);
            }
        }
        for (capacity, mut members) in self.side_by_side(groups) {
            members.sort_by_key(|member| (std::cmp::Reverse(runs[member.run].remaining()), member.run));
            let sees = members.iter().any(|member| runs[member.run].signals.is_of_body());
            let most = if sees { MOST_SEEING } else { usize::MAX };
            for members in members.chunks(self.most_robots(capacity).min(most)) {
                self.finish_some(capacity, members, runs, record)?;
            }
        }
        Ok(too_large)
    }

    /// Robots side by side are one group with room for the largest: each group takes as long as its longest run.
    fn side_by_side(&self, groups: BTreeMap<Capacity, Vec<Member>>) -> BTreeMap<Capacity, Vec<Member>> {
        let robots: usize = groups.values().map(Vec::len).sum();
        let largest = groups.keys().copied().reduce(Capacity::max);
        let have_room =
            |&largest: &Capacity| robots <= AT_ONCE * self.card.device.multiprocessors && self.card.fits(largest);
        match largest.filter(have_room) {
            Some(largest) => BTreeMap::from([(largest, groups.into_values().flatten().collect())]),
            None => groups,
        }
    }

    /// The most robots for which the device has room. Half of its memory is left for other programs.
    fn most_robots(&self, capacity: Capacity) -> usize {
        let device = &self.card.device;
        let state = (device.global_bytes / 2) as usize / capacity.global_bytes(WINDOW as usize);
        let buffer = device.buffer_bytes as usize / (16 * capacity.masses.max(WINDOW as usize));
        state.min(buffer).max(1)
    }

    fn finish_some(
        &self,
        capacity: Capacity,
        members: &[Member],
        runs: &mut [Run],
        record: &mut dyn FnMut(usize, [f64; 2]),
    ) -> Result<(), DeviceError> {
        match DeviceRuns::new(self, capacity, members, runs) {
            Ok(device_runs) => device_runs.finish(runs, record),
            Err(DeviceError::OutOfMemory { .. }) if members.len() > 1 => {
                let (first, second) = members.split_at(members.len() / 2);
                self.finish_some(capacity, first, runs, record)?;
                self.finish_some(capacity, second, runs, record)
            }
            Err(error) => Err(error),
        }
    }
}

impl<'a> DeviceRuns<'a> {
    fn new(
        world: &'a DeviceWorld,
        capacity: Capacity,
        members: &'a [Member],
        runs: &[Run],
    ) -> Result<Self, DeviceError> {
        let (mut headers, mut words, mut stiffness) = (Vec::new(), Vec::new(), Vec::new());
        let mut bodies: BTreeMap<usize, u32> = BTreeMap::new();
        let (mut places, mut state) = (Vec::new(), [(); 3].map(|()| Vec::new()));
        for Member { run, plan } in members {
            let run = &runs[*run];
            let next = bodies.len() as u32;
            let body = *bodies.entry(run.body).or_insert_with(|| {
                headers.extend(plan.header(words.len(), stiffness.len()));
                words.extend_from_slice(&plan.words);
                stiffness.extend_from_slice(&plan.stiffness);
                next
            });
            places.push([body, state[0].len() as u32]);
            let vectors = [&run.state.position, &run.state.previous, &run.state.velocity];
            for (all, own) in state.iter_mut().zip(vectors) {
                all.extend(by_mass(plan, own));
            }
        }
        let longest = members.iter().map(|member| runs[member.run].remaining()).max().unwrap_or(0);
        let window = longest.clamp(1, WINDOW);
        let queue = world.card.queue()?;
        let [position, previous, velocity] = state;
        Ok(Self {
            world,
            capacity,
            members,
            places,
            bodies: queue.upload(&headers)?,
            plan: queue.upload(&words)?,
            stiffness: queue.upload(&stiffness)?,
            state: [queue.upload(&position)?, queue.upload(&previous)?, queue.upload(&velocity)?],
            centers: queue.room(members.len() * window as usize)?,
            outcomes: queue.room(members.len())?,
            window,
            queue,
        })
    }

    fn finish(mut self, runs: &mut [Run], record: &mut dyn FnMut(usize, [f64; 2])) -> Result<(), DeviceError> {
        let mut live: Vec<usize> = (0..self.members.len()).collect();
        let mut window = FIRST_WINDOW;
        while !live.is_empty() {
            if self.world.monitor.as_ref().is_some_and(|monitor| monitor.is_stopped()) {
                live.iter().for_each(|&place| runs[self.members[place].run].stop());
                break;
            }
            let longest = live.iter().map(|&place| runs[self.members[place].run].remaining()).max().unwrap_or(0);
            let steps = window.min(self.window).min(longest);
            let spent = self.advance(steps, &live, runs, record)?;
            window = next_window(steps, spent);
            live.retain(|&place| !runs[self.members[place].run].is_done());
        }
        self.read_states(runs)
    }

    /// Simulates `steps` env steps of each run, or what is left of it. Returns the time in nanoseconds.
    fn advance(
        &mut self,
        steps: u32,
        live: &[usize],
        runs: &mut [Run],
        record: &mut dyn FnMut(usize, [f64; 2]),
    ) -> Result<u64, DeviceError> {
        let mut signals = SignalTable::new(live.iter().map(|&place| &runs[self.members[place].run]));
        let mut robots = Vec::with_capacity(4 * live.len());
        for &place in live {
            let [body, state] = self.places[place];
            let run = &runs[self.members[place].run];
            robots.extend([body, state, signals.add(run, steps), run.remaining().min(steps)]);
        }
        let arguments = Arguments {
            robots: &self.queue.upload(&robots)?,
            bodies: &self.bodies,
            plan: &self.plan,
            stiffness: &self.stiffness,
            targets: &self.queue.upload(&signals.targets)?,
            channels: signals.channels as u32,
            world_width: self.world.width as u32,
            window: steps,
            state: self.state.each_ref(),
            centers: &self.centers,
            outcomes: &self.outcomes,
        };
        let spent = self.queue.launch(self.capacity, &self.world.constants, live.len(), &arguments)?;
        let centers = self.queue.read(&self.centers, live.len() * steps as usize)?;
        let outcomes = self.queue.read(&self.outcomes, live.len())?;
        for ((&place, centers), [done, fault]) in live.iter().zip(centers.chunks(steps as usize)).zip(outcomes) {
            let member = self.members[place].run;
            let run = &mut runs[member];
            for &center in &centers[..done as usize] {
                run.finish_env_step(center, false);
                record(member, center);
            }
            if fault != SOUND {
                run.finish_env_step([f64::NAN; 2], fault == UNSTABLE);
            }
            if let Some(monitor) = &self.world.monitor {
                monitor.count(done as usize);
            }
        }
        Ok(spent)
    }

    fn read_states(&self, runs: &mut [Run]) -> Result<(), DeviceError> {
        let [position, previous, velocity] = self.state.each_ref();
        let read = |memory: &CardMemory<[f64; 2]>| self.queue.read(memory, memory.count());
        let (position, previous, velocity) = (read(position)?, read(previous)?, read(velocity)?);
        for (Member { run, plan }, [_, first]) in self.members.iter().zip(&self.places) {
            let state = &mut runs[*run].state;
            for (point, &mass) in plan.masses.iter().enumerate() {
                let place = *first as usize + mass;
                state.position[point] = position[place];
                state.previous[point] = previous[place];
                state.velocity[point] = velocity[place];
            }
        }
        Ok(())
    }
}

fn by_mass(plan: &BodyPlan, of_points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut of_masses = vec![[0.0; 2]; of_points.len()];
    for (&mass, &vector) in plan.masses.iter().zip(of_points) {
        of_masses[mass] = vector;
    }
    of_masses
}

fn next_window(steps: u32, spent: u64) -> u32 {
    let fitting = u64::from(steps) * PATIENCE / spent.max(1);
    (fitting as u32).clamp(1, steps.saturating_mul(4))
}

/// What the targets of a run depend on: its signals, clock and spells.
type SignalKey = (usize, u32, Vec<Spell>);

/// Runs with the same signals, clock and stimuli share targets.
struct SignalTable<'a> {
    /// Rows of `channels` numbers, one for each env step.
    targets: Vec<f64>,
    channels: usize,
    signals: Vec<&'a Arc<Signals>>,
    rows: BTreeMap<SignalKey, u32>,
}

impl<'a> SignalTable<'a> {
    fn new(runs: impl Iterator<Item = &'a Run>) -> Self {
        let mut different: Vec<&Arc<Signals>> = Vec::new();
        for run in runs {
            if !different.iter().any(|known| Arc::ptr_eq(known, &run.signals)) {
                different.push(&run.signals);
            }
        }
        let channels = different.iter().map(|signals| signals.channels()).max().unwrap_or(0);
        Self { targets: Vec::new(), channels, signals: different, rows: BTreeMap::new() }
    }

    fn add(&mut self, run: &Run, steps: u32) -> u32 {
        let signals = self.signals.iter().position(|known| Arc::ptr_eq(known, &run.signals));
        let signals = signals.expect("the signals of all runs are listed");
        let spells = run.spells_ahead(steps);
        let (targets, channels) = (&mut self.targets, self.channels);
        *self.rows.entry((signals, run.clock, spells)).or_insert_with_key(|(_, clock, spells)| {
            let first = targets.len() as u32;
            let each = spells.iter().flat_map(|spell| std::iter::repeat_n(spell, spell.steps as usize));
            for (env_step, spell) in (*clock..).zip(each) {
                let row = targets.len();
                targets.extend(run.signals.targets(env_step, spell));
                targets.resize(row + channels, 1.0);
            }
            first
        })
    }
}
