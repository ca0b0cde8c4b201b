//! What robots hear of each other: the sign of a robot's motion over its last cycles, read in its own time.

use std::collections::VecDeque;

use crate::Assembly;
use crate::noise::RobotNoise;
use crate::own_clock::{OwnClock, WIND_STRIDE};
use nbc_base::model::{CYCLE_STEPS, Fault, Hears};
use nbc_sim::Flock;

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Hearing {
    clocks: Vec<OwnClock>,
    /// Whether no clock is ahead or drifts.
    pub clocks_agree: bool,
    hears: Hears,
    /// Cycles over which a displacement is measured.
    window: usize,
    pub heard: Vec<Heard>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Heard {
    pub output: bool,
    /// The places where it was read, in voxels, as far back as the next reading needs them, and the present one last.
    pub places: VecDeque<f64>,
}

impl Hearing {
    pub fn new(assembly: &Assembly, window: usize, flock: &mut dyn Flock) -> Self {
        let clock = |robot| RobotNoise::new(&assembly.world.noise, robot).clock();
        let clocks: Vec<OwnClock> = (0..flock.len()).map(clock).collect();
        let place = |robot| Heard { output: false, places: [flock.center(robot)[0]].into() };
        let heard = (0..flock.len()).map(place).collect();
        let clocks_agree = clocks.iter().all(|clock| *clock == OwnClock::default());
        let hearing = Self { clocks, clocks_agree, hears: assembly.world.hears, window, heard };
        hearing.wind(flock, 0);
        hearing
    }

    pub fn clocks(&self) -> &[OwnClock] {
        &self.clocks
    }

    /// Whether outputs change only where a cycle of the world ends.
    pub fn is_common(&self) -> bool {
        self.clocks_agree && self.hears == Hears::Cycle
    }

    /// The env steps of the cycle that begins at `start` at whose end an output is read or a clock is set.
    pub fn stops(&self, start: u32) -> Vec<u32> {
        if self.is_common() {
            return vec![CYCLE_STEPS];
        }
        let is_stop = |&step: &u32| {
            self.hears == Hears::Always
                || step % WIND_STRIDE == 0
                || self.clocks.iter().any(|clock| clock.ends_at(start + step))
        };
        (1..=CYCLE_STEPS).filter(is_stop).collect()
    }

    pub fn wind(&self, flock: &mut dyn Flock, env_step: u32) {
        if self.clocks_agree {
            return;
        }
        for (robot, clock) in self.clocks.iter().enumerate().filter(|(_, clock)| clock.rate != 0 || env_step == 0) {
            if flock.fault(robot).is_none() {
                flock.set_clock(robot, clock.at(env_step));
            }
        }
    }

    /// Reads the outputs that are to be read at an env step. Returns the robots whose output changed.
    pub fn hear(&mut self, flock: &dyn Flock, env_step: u32) -> Vec<usize> {
        let mut changed = Vec::new();
        for (robot, (clock, heard)) in self.clocks.iter().zip(&mut self.heard).enumerate() {
            let (room, dead_zone) = match self.hears {
                Hears::Cycle if !clock.ends_at(env_step) => continue,
                Hears::Cycle => (self.window, 0.0),
                Hears::Always => (clock.world_steps(self.window), Hears::DEAD_ZONE),
            };
            heard.places.push_back(flock.center(robot)[0]);
            if heard.places.len() > room + 1 {
                heard.places.pop_front();
            }
            let moved = heard.places[heard.places.len() - 1] - heard.places[0];
            let output = if moved.abs() < dead_zone { heard.output } else { moved > 0.0 };
            if output != heard.output {
                heard.output = output;
                changed.push(robot);
            }
        }
        changed
    }

    pub fn bits(&self) -> Vec<bool> {
        self.heard.iter().map(|heard| heard.output).collect()
    }

    /// A fault of a robot in the time of the world.
    pub fn in_world_time(&self, robot: usize, fault: Fault, env_step: u32) -> Fault {
        let ahead = self.clocks[robot].at(env_step) - env_step;
        Fault { env_step: fault.env_step.saturating_sub(ahead), ..fault }
    }
}
