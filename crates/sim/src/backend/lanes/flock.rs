//! Robots that are advanced step by step. They keep their lanes from advance to advance.

use crate::backend::lanes::group::LaneGroup;
use crate::backend::lanes::grouping::{LaneGrouping, LaneRequest};
use crate::backend::lanes::threads;
use crate::backend::lanes::world::World;
use crate::backend::run::{Run, runs};
use crate::backend::{Flock, Snapshot};
use crate::lattice::Lattice;
use nbc_base::model::{Body, Fault, Schedule, Setting, Spell};

#[derive(Debug)]
pub struct LaneFlock {
    world: World,
    groups: Vec<LaneGroup>,
    /// The group of each robot, and its index there.
    places: Vec<(usize, usize)>,
    /// The cost of a substep of all groups, in the unit of [`LaneGrouping::cost`].
    cost: u64,
}

impl LaneFlock {
    pub fn new(world: World, setting: &Setting, bodies: &[Body]) -> Self {
        let runs = runs(&world.constants, setting, bodies);
        let mut flock = Self { world, groups: Vec::new(), places: Vec::new(), cost: 0 };
        let grouping = flock.grouping(runs.iter());
        flock.form(runs, grouping);
        flock
    }

    fn grouping<'a>(&self, runs: impl Iterator<Item = &'a Run>) -> LaneGrouping {
        let candidates: Vec<LaneRequest> =
            runs.map(|run| LaneRequest { lattice: &run.lattice, body: run.body }).collect();
        let kernel = self.world.kernel;
        LaneGrouping::of(&candidates, kernel, threads::lanes_for(candidates.len(), kernel.lanes()))
    }

    fn form(&mut self, runs: Vec<Run>, grouping: LaneGrouping) {
        self.places = vec![(0, 0); runs.len()];
        for (group, robots) in grouping.groups.iter().enumerate() {
            for (place, &robot) in robots.iter().enumerate() {
                self.places[robot] = (group, place);
            }
        }
        let group = |robots: &Vec<usize>| LaneGroup::new(robots.iter().map(|&robot| runs[robot].clone()).collect());
        self.groups = grouping.groups.iter().map(group).collect();
        self.cost = grouping.cost;
    }

    fn run(&self, i: usize) -> &Run {
        let (group, place) = self.places[i];
        &self.groups[group].runs[place]
    }

    fn run_mut(&mut self, i: usize) -> &mut Run {
        let (group, place) = self.places[i];
        &mut self.groups[group].runs[place]
    }

    fn dissolve(&mut self) -> Vec<Run> {
        let mut runs: Vec<Vec<Option<Run>>> =
            self.groups.iter_mut().map(|group| group.take().into_iter().map(Some).collect()).collect();
        let take =
            |&(group, place): &(usize, usize)| runs[group][place].take().expect("a robot has a place of its own");
        self.places.iter().map(take).collect()
    }
}

impl Flock for LaneFlock {
    fn len(&self) -> usize {
        self.places.len()
    }

    fn advance_under(&mut self, spells: &[Spell]) {
        assert_eq!(spells.len(), self.len(), "each robot has a spell");
        for (i, spell) in spells.iter().enumerate() {
            self.run_mut(i).assign(&Schedule { spells: vec![spell.clone()] });
        }
        let world = &self.world;
        threads::for_each(&mut self.groups, |group| group.finish(world));
    }

    fn retain(&mut self, keep: &[bool]) {
        assert_eq!(keep.len(), self.len(), "each robot is kept or not");
        let kept = (0..self.len()).filter(|&i| keep[i]).map(|i| self.run(i));
        let grouping = self.grouping(kept);
        let mut keep = keep.iter();
        if grouping.cost < self.cost {
            let mut runs = self.dissolve();
            runs.retain(|_| keep.next().is_some_and(|&keep| keep));
            self.form(runs, grouping);
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

    fn set_clock(&mut self, i: usize, clock: u32) {
        self.run_mut(i).clock = clock;
    }

    fn lattice(&self, i: usize) -> &Lattice {
        &self.run(i).lattice
    }

    fn points(&self, i: usize) -> Vec<[f64; 2]> {
        let (group, place) = self.places[i];
        let cell = self.world.constants.cell;
        self.groups[group].state(place).position.into_iter().map(|at| at.map(|axis| axis / cell)).collect()
    }

    fn snapshot(&self, i: usize) -> Snapshot {
        let (group, place) = self.places[i];
        let run = self.run(i);
        Snapshot { state: self.groups[group].state(place), center: run.center, clock: run.clock, fault: run.fault }
    }

    fn restore(&mut self, i: usize, snapshot: &Snapshot) {
        let (group, place) = self.places[i];
        self.groups[group].unload();
        self.groups[group].runs[place].restore(snapshot);
    }
}
