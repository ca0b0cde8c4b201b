//! Robots that are advanced step by step. They keep their lanes from advance to advance.

use std::cmp::Reverse;

use crate::model::{Body, Fault, Pattern, Schedule, Setting};
use crate::sim::backend::lanes::run::{Run, runs};
use crate::sim::backend::lanes::squad::Squad;
use crate::sim::backend::lanes::threads;
use crate::sim::backend::lanes::world::World;
use crate::sim::backend::{Flock, Snapshot};
use crate::sim::lattice::Lattice;

/// Robots in the lanes of this processor.
#[derive(Debug)]
pub struct LaneFlock {
    world: World,
    squads: Vec<Squad>,
    /// The squad of each robot, and its place there.
    places: Vec<(usize, usize)>,
}

impl LaneFlock {
    /// A robot for each body, at its start.
    pub fn new(world: World, setting: &Setting, bodies: &[Body]) -> Self {
        let runs = runs(&world.constants, setting, bodies);
        let mut flock = Self { world, squads: Vec::new(), places: Vec::new() };
        flock.form(runs);
        flock
    }

    /// Forms squads of these runs, in this order: runs of one box together, of one body side by side, as many in each squad.
    fn form(&mut self, runs: Vec<Run>) {
        let mut waiting: Vec<(usize, Run)> = runs.into_iter().enumerate().collect();
        waiting.sort_by_key(|(robot, run)| (Reverse(run.lattice.size()), run.body, *robot));
        self.places = vec![(0, 0); waiting.len()];
        self.squads.clear();
        for same_box in waiting.chunk_by_mut(|(_, a), (_, b)| a.lattice.size() == b.lattice.size()) {
            let squads = same_box.len().div_ceil(threads::lanes_for(same_box.len(), self.world.kernel.lanes()));
            for n in 0..squads {
                let share = same_box.len() * n / squads..same_box.len() * (n + 1) / squads;
                for (place, (robot, _)) in same_box[share.clone()].iter().enumerate() {
                    self.places[*robot] = (self.squads.len(), place);
                }
                self.squads.push(Squad::new(same_box[share].iter().map(|(_, run)| run.clone()).collect()));
            }
        }
    }

    fn run(&self, i: usize) -> &Run {
        let (squad, place) = self.places[i];
        &self.squads[squad].runs()[place]
    }

    fn run_mut(&mut self, i: usize) -> &mut Run {
        let (squad, place) = self.places[i];
        &mut self.squads[squad].runs_mut()[place]
    }

    /// Takes the runs out of their squads, in order of the robots.
    fn dissolve(&mut self) -> Vec<Run> {
        let mut runs: Vec<Vec<Option<Run>>> =
            self.squads.iter_mut().map(|squad| squad.take().into_iter().map(Some).collect()).collect();
        let take =
            |&(squad, place): &(usize, usize)| runs[squad][place].take().expect("a robot has a place of its own");
        self.places.iter().map(take).collect()
    }

    /// The lanes that would be computed in each env step for robots of the given boxes.
    fn lanes_for(&self, boxes: impl Iterator<Item = (usize, usize)>) -> usize {
        let mut boxes: Vec<_> = boxes.collect();
        boxes.sort_unstable();
        let lanes = self.world.kernel.lanes();
        boxes.chunk_by(|a, b| a == b).map(|same| same.len().div_ceil(lanes) * lanes).sum()
    }
}

impl Flock for LaneFlock {
    fn len(&self) -> usize {
        self.places.len()
    }

    fn advance(&mut self, patterns: &[Pattern], env_steps: u32) {
        assert_eq!(patterns.len(), self.len(), "each robot has a pattern");
        for (i, &pattern) in patterns.iter().enumerate() {
            self.run_mut(i).assign(&Schedule::constant(pattern, env_steps));
        }
        let world = &self.world;
        threads::for_each(&mut self.squads, |squad| squad.finish(world));
    }

    fn retain(&mut self, keep: &[bool]) {
        assert_eq!(keep.len(), self.len(), "each robot is kept or not");
        let sizes: Vec<_> = (0..self.len()).map(|i| self.lattice(i).size()).collect();
        let kept = sizes.iter().zip(keep).filter(|(_, keep)| **keep).map(|(size, _)| *size);
        let (now, then) = (self.lanes_for(sizes.iter().copied()), self.lanes_for(kept));
        let mut keep = keep.iter();
        if then < now {
            let mut runs = self.dissolve();
            runs.retain(|_| keep.next().is_some_and(|&keep| keep));
            self.form(runs);
        } else {
            self.places.retain(|_| keep.next().is_some_and(|&keep| keep));
        }
    }

    fn center(&self, i: usize) -> [f64; 2] {
        self.run(i).center
    }

    fn fault(&self, i: usize) -> Option<Fault> {
        self.run(i).fault
    }

    fn clock(&self, i: usize) -> u32 {
        self.run(i).clock
    }

    fn lattice(&self, i: usize) -> &Lattice {
        &self.run(i).lattice
    }

    fn points(&self, i: usize) -> Vec<[f64; 2]> {
        let (squad, place) = self.places[i];
        let cell = self.world.constants.cell;
        self.squads[squad].state(place).position.into_iter().map(|at| at.map(|axis| axis / cell)).collect()
    }

    fn snapshot(&self, i: usize) -> Snapshot {
        let (squad, place) = self.places[i];
        let run = self.run(i);
        Snapshot { state: self.squads[squad].state(place), center: run.center, clock: run.clock, fault: run.fault }
    }

    fn restore(&mut self, i: usize, snapshot: &Snapshot) {
        let (squad, place) = self.places[i];
        self.squads[squad].unload();
        self.squads[squad].runs_mut()[place].restore(snapshot);
    }
}
