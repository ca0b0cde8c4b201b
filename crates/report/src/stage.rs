//! Robots simulated again, step by step, for films: their poses at even intervals.

use std::sync::Arc;

use crate::sprite::Pose;
use nbc_base::model::{Body, CYCLE_STEPS, GroundProfile, Palette, Pattern, Schedule, Setting, Spell};
use nbc_sim::{Flock, Simulator, Snapshot};
use nbc_swarm::{Assembly, Recording, SwarmTrace};

pub struct Stage {
    flock: Box<dyn Flock>,
    /// The ground of each robot, as columns that repeat from its left end.
    pub ground: GroundProfile,
    pub(super) palettes: Vec<Arc<Palette>>,
    /// Consecutive spells: env steps, and each robot's spell of that length.
    spells: Vec<(u32, Vec<Spell>)>,
    spell: usize,
    left: u32,
    stride: u32,
    step: u32,
    started: bool,
}

#[derive(Clone, Debug)]
pub struct Moment {
    pub step: u32,
    pub poses: Vec<Pose>,
    pub centers: Vec<[f64; 2]>,
    pub spells: Vec<Spell>,
    pub faults: Vec<bool>,
}

impl Stage {
    pub fn of_trial(setting: &Setting, body: &Body, schedule: &Schedule, stride: u32) -> Self {
        Self::of_trials(setting, std::slice::from_ref(body), schedule, stride)
    }

    pub fn of_trials(setting: &Setting, bodies: &[Body], schedule: &Schedule, stride: u32) -> Self {
        let spells = schedule.spells.iter().map(|spell| (spell.steps, vec![spell.clone(); bodies.len()])).collect();
        let palettes = bodies.iter().map(|body| Arc::clone(body.palette())).collect();
        Self::new((Simulator::default().flock(setting, bodies), setting.ground), palettes, spells, stride)
    }

    pub fn of_swarm(assembly: &Assembly, trace: &SwarmTrace, stride: u32) -> Self {
        Self::in_world(assembly, trace, trace.cycles.len(), stride)
    }

    pub fn of_running_swarm(
        assembly: &Assembly,
        trace: &SwarmTrace,
        (states, cycles): (&[Snapshot], usize),
        stride: u32,
    ) -> Self {
        let mut stage = Self::in_world(assembly, trace, cycles, stride);
        assert_eq!(states.len(), stage.robots(), "a state for each robot");
        for (i, state) in states.iter().enumerate() {
            stage.flock.restore(i, state);
        }
        stage
    }

    fn in_world(assembly: &Assembly, trace: &SwarmTrace, cycles: usize, stride: u32) -> Self {
        let palettes = assembly.members.iter().map(|member| Arc::clone(member.robot.body.palette())).collect();
        let sensed = |sensed: &[Pattern]| sensed.iter().map(|&pattern| Spell::of(pattern, CYCLE_STEPS)).collect();
        let spells = trace.cycles.iter().map(|cycle| (CYCLE_STEPS, sensed(&cycle.sensed))).collect();
        let ground = assembly.setting(cycles).ground;
        Self::new((assembly.flock(&Simulator::default(), cycles), ground), palettes, spells, stride)
    }

    fn new(
        (flock, ground): (Box<dyn Flock>, GroundProfile),
        palettes: Vec<Arc<Palette>>,
        spells: Vec<(u32, Vec<Spell>)>,
        stride: u32,
    ) -> Self {
        assert!(stride > 0, "frames are some steps apart");
        let left = spells.first().map_or(0, |spell| spell.0);
        Self { flock, ground, palettes, spells, spell: 0, left, stride, step: 0, started: false }
    }

    pub fn robots(&self) -> usize {
        self.flock.len()
    }

    pub fn steps(&self) -> u32 {
        self.spells.iter().map(|spell| spell.0).sum()
    }

    pub fn moments(&self) -> usize {
        (self.steps() / self.stride) as usize + 1
    }

    pub fn points(&self, i: usize) -> usize {
        self.flock.lattice(i).points().len()
    }

    pub fn record(mut self, robots: usize) -> Recording {
        let mut recording = Recording::new(&*self.flock, 0..robots.min(self.robots()), self.stride);
        while self.turn() {
            recording.record(&*self.flock);
        }
        recording
    }

    /// Advances to the next moment; the first call gives the start. Returns false at the end.
    fn turn(&mut self) -> bool {
        let first = !self.started;
        self.started = true;
        first || self.advance()
    }

    fn moment(&self) -> Moment {
        let robots = 0..self.robots();
        let none = vec![Spell::of(Pattern::default(), 0); self.robots()];
        let spells = |(_, spells): &(u32, Vec<Spell>)| spells.clone();
        Moment {
            step: self.step,
            poses: robots.clone().map(|i| self.pose(i)).collect(),
            centers: robots.clone().map(|i| self.flock.center(i)).collect(),
            spells: self.spells.get(self.spell).or(self.spells.last()).map_or(none, spells),
            faults: robots.map(|i| self.flock.fault(i).is_some()).collect(),
        }
    }

    fn pose(&self, i: usize) -> Pose {
        let points = self.flock.points(i);
        let corner = |point: usize| (points[point][0], points[point][1]);
        let voxels =
            self.flock.lattice(i).voxels().iter().map(|voxel| (voxel.corners.map(corner), voxel.code)).collect();
        Pose { voxels, palette: Arc::clone(&self.palettes[i]) }
    }

    fn advance(&mut self) -> bool {
        if self.steps() - self.step < self.stride {
            return false;
        }
        let mut wanted = self.stride;
        while wanted > 0 {
            let steps = wanted.min(self.left);
            if steps > 0 {
                let spells = self.spells[self.spell].1.iter().map(|spell| Spell { steps, ..spell.clone() });
                self.flock.advance_under(&spells.collect::<Vec<_>>());
            }
            (wanted, self.left) = (wanted - steps, self.left - steps);
            if self.left == 0 && self.spell + 1 < self.spells.len() {
                self.spell += 1;
                self.left = self.spells[self.spell].0;
            }
        }
        self.step += self.stride;
        true
    }
}

impl Iterator for Stage {
    type Item = Moment;

    fn next(&mut self) -> Option<Moment> {
        self.turn().then(|| self.moment())
    }
}
