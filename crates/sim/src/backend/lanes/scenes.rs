//! Scenes that are advanced env step by env step, with targets from outside. They keep their lanes.

use crate::backend::lanes::batch::{Floor, Ground};
use crate::backend::lanes::grouping::{LaneGrouping, LaneRequest};
use crate::backend::lanes::kernel::Kernel;
use crate::backend::lanes::lane_batch::LaneBatch;
use crate::backend::lanes::threads;
use crate::constants::Constants;
use crate::scene::Scene;
use crate::state::State;
use nbc_base::model::{Fault, FaultKind};

#[derive(Debug)]
pub struct Scenes {
    constants: Constants,
    scenes: Vec<Scene>,
    groups: Vec<SceneGroup>,
    places: Vec<(usize, usize)>,
}

/// A scene at the end of an env step; [`Scenes::restore`] takes it back.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneState {
    pub state: State,
    pub clock: u32,
    pub fault: Option<Fault>,
}

#[derive(Debug)]
struct SceneGroup {
    batch: Box<dyn LaneBatch>,
    lanes: Vec<Lane>,
}

#[derive(Debug)]
struct Lane {
    start: State,
    /// Its state, if `is_stale` is false; that in the batch is the newer one otherwise.
    now: State,
    is_stale: bool,
    clock: u32,
    /// The fault that ended it. `now` is then its state before.
    ended: Option<Fault>,
}

impl Scenes {
    /// Actuators keep their rest length until they are given targets.
    pub fn new(scenes: Vec<Scene>) -> Self {
        Self::with_kernel(scenes, Kernel::default())
    }

    pub fn with_kernel(scenes: Vec<Scene>, kernel: Kernel) -> Self {
        let constants = Constants::default();
        let mut alike: Vec<Vec<usize>> = Vec::new();
        for n in 0..scenes.len() {
            let shares = |other: &Vec<usize>| {
                let (one, other) = (&scenes[n], &scenes[other[0]]);
                one.terrain == other.terrain && one.tops() == other.tops()
            };
            match alike.iter_mut().find(|others| shares(others)) {
                Some(others) => others.push(n),
                None => alike.push(vec![n]),
            }
        }
        let mut all = Self { constants, places: vec![(0, 0); scenes.len()], scenes, groups: Vec::new() };
        for members in alike {
            let request = |&n: &usize| {
                let is_same = |other: &&usize| all.scenes[**other].lattice == all.scenes[n].lattice;
                let body = *members.iter().find(is_same).expect("a scene is like itself");
                LaneRequest { lattice: &all.scenes[n].lattice, body }
            };
            let requests: Vec<LaneRequest> = members.iter().map(request).collect();
            let most = threads::lanes_for(requests.len(), kernel.lanes());
            let groups = LaneGrouping::of(&requests, kernel, most).groups.into_iter().map(|group| {
                let is_alike = group.iter().all(|&at| requests[at].body == requests[group[0]].body);
                (group.iter().map(|&at| members[at]).collect(), is_alike)
            });
            let groups: Vec<(Vec<usize>, bool)> = groups.collect();
            for (group, is_alike) in groups {
                all.open(&group, is_alike, kernel);
            }
        }
        all
    }

    fn open(&mut self, members: &[usize], is_alike: bool, kernel: Kernel) {
        let robots: Vec<_> = members.iter().map(|&n| (&*self.scenes[n].lattice, &self.scenes[n].start)).collect();
        let floor = Floor::Terrain(self.scenes[members[0]].terrain.clone());
        let ground = Ground { constants: &self.constants, floor: &floor, meter: None };
        let batch = kernel.batch(&robots, is_alike, ground);
        let lane = |&n: &usize| {
            let start = &self.scenes[n].start;
            Lane { start: start.clone(), now: start.clone(), is_stale: false, clock: 0, ended: None }
        };
        for (lane, &n) in members.iter().enumerate() {
            self.places[n] = (self.groups.len(), lane);
        }
        self.groups.push(SceneGroup { batch, lanes: members.iter().map(lane).collect() });
    }

    pub fn len(&self) -> usize {
        self.scenes.len()
    }

    pub fn is_empty(&self) -> bool {
        self.scenes.is_empty()
    }

    pub fn scene(&self, n: usize) -> &Scene {
        &self.scenes[n]
    }

    /// Sets the targets of a scene's actuators, as fractions of their rest length, until the next call.
    /// Panics when there is not one target for each channel.
    pub fn set_targets(&mut self, n: usize, targets: &[f64]) {
        assert_eq!(targets.len(), self.scenes[n].targets(), "each actuator has a target");
        let (group, lane) = self.places[n];
        self.groups[group].batch.set_targets(lane, targets);
    }

    /// Simulates more env steps. A scene with a fault stays as it was after its last complete env step.
    pub fn advance(&mut self, env_steps: u32) {
        threads::for_each(&mut self.groups, |group| (0..env_steps).for_each(|_| group.env_step()));
    }

    /// Puts a scene back to its start. Its targets stay.
    pub fn reset(&mut self, n: usize) {
        let (group, lane) = self.places[n];
        self.groups[group].reset(lane);
    }

    pub fn look(&mut self, n: usize) -> (&Scene, &State) {
        let (group, lane) = self.places[n];
        (&self.scenes[n], self.groups[group].now(lane))
    }

    pub fn state(&mut self, n: usize) -> SceneState {
        let state = self.look(n).1.clone();
        let &Lane { clock, ended, .. } = self.lane(n);
        SceneState { state, clock, fault: ended }
    }

    fn lane(&self, n: usize) -> &Lane {
        let (group, lane) = self.places[n];
        &self.groups[group].lanes[lane]
    }

    /// Panics when the state is of other objects.
    pub fn restore(&mut self, n: usize, state: &SceneState) {
        let (group, lane) = self.places[n];
        self.groups[group].restore(lane, state);
    }

    pub fn fault(&self, n: usize) -> Option<Fault> {
        self.lane(n).ended
    }

    pub fn clock(&self, n: usize) -> u32 {
        self.lane(n).clock
    }

    /// The positions of the points of a scene's object, in voxels; see [`Scene::positions`].
    pub fn positions(&mut self, n: usize, object: usize) -> Vec<[f64; 2]> {
        let constants = self.constants;
        let (scene, state) = self.look(n);
        scene.positions(object, state, &constants)
    }
}

impl SceneGroup {
    fn env_step(&mut self) {
        self.batch.save();
        self.batch.env_step();
        for lane in 0..self.lanes.len() {
            if self.lanes[lane].ended.is_some() {
                continue;
            }
            let is_unstable = self.batch.unstable() >> lane & 1 == 1;
            if is_unstable || !self.batch.center(lane).iter().all(|axis| axis.is_finite()) {
                let kind = if is_unstable { FaultKind::Unstable } else { FaultKind::NonFinite };
                let fault = Fault { env_step: self.lanes[lane].clock + 1, kind };
                let own = &mut self.lanes[lane];
                self.batch.unload_saved(lane, &mut own.now);
                self.batch.load(lane, &own.start);
                (own.ended, own.is_stale) = (Some(fault), false);
            } else {
                self.lanes[lane].clock += 1;
                self.lanes[lane].is_stale = true;
            }
        }
    }

    fn reset(&mut self, lane: usize) {
        let own = &mut self.lanes[lane];
        self.batch.load(lane, &own.start);
        own.now.clone_from(&own.start);
        (own.clock, own.ended, own.is_stale) = (0, None, false);
    }

    fn now(&mut self, lane: usize) -> &State {
        let own = &mut self.lanes[lane];
        if own.is_stale {
            self.batch.unload(lane, &mut own.now);
            own.is_stale = false;
        }
        &own.now
    }

    fn restore(&mut self, lane: usize, state: &SceneState) {
        let own = &mut self.lanes[lane];
        assert_eq!(state.state.position.len(), own.start.position.len(), "a state is of the same objects");
        own.now.clone_from(&state.state);
        (own.clock, own.ended, own.is_stale) = (state.clock, state.fault, false);
        self.batch.load(lane, if own.ended.is_some() { &own.start } else { &own.now });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::lanes::LaneBackend;
    use crate::backend::lanes::kernel::InstructionSet;
    use crate::backend::{Backend, Snapshot};
    use crate::grid::Grid;
    use crate::scene::SceneObject;
    use crate::signal::Signals;
    use nbc_base::model::{
        Body, GroundProfile, Image, ImageSize, Material, MaterialKind, Palette, Pattern, Response, Schedule, Setting,
        Spell, Trial,
    };
    use std::sync::Arc;

    const WIDTH: usize = 60;

    fn object(rows: &[&str], at: [usize; 2]) -> SceneObject {
        let codes: Vec<u8> = rows.concat().bytes().map(|digit| digit - b'0').collect();
        SceneObject { grid: Grid::structure(rows[0].len(), rows.len(), &codes), at }
    }

    fn scene((robot, apart): (&[&str], &[[usize; 2]])) -> Scene {
        let placed = object(robot, [5, 1]);
        let objects = [
            SceneObject { grid: placed.grid.with_apart(apart.iter().copied()), at: placed.at },
            object(&["222", "222"], [5, 1 + robot.len()]),
            object(&["11", "11"], [20, 3]),
            object(&["5222225", "5000005"], [12, 1]),
            object(&["0005", "0055", "5555"], [0, 0]),
            object(&["55555555555555555555"], [4, 0]),
        ];
        Scene::new(&objects, &Constants::default())
    }

    /// The slits from above have sides not between the corners of their voxels, the first one that of a rigid voxel.
    const ROBOTS: [(&[&str], &[[usize; 2]]); 5] = [
        (&["333", "434", "303"], &[]),
        (&["11", "34"], &[[0, 1]]),
        (&["33", "33"], &[[0, 1]]),
        (&["13331", "40004"], &[]),
        (&["343", "434", "313"], &[[6, 7], [3, 4]]),
    ];

    fn targets(scene: &Scene, n: usize, env_step: usize) -> Vec<f64> {
        (0..scene.targets()).map(|at| 0.6 + ((at * 37 + n * 11 + env_step * 29) % 101) as f64 / 100.0).collect()
    }

    fn simulated(kernel: Kernel, count: usize) -> Vec<SceneState> {
        let mut scenes = Scenes::with_kernel((0..count).map(|n| scene(ROBOTS[n % ROBOTS.len()])).collect(), kernel);
        for env_step in 0..40 {
            for n in 0..scenes.len() {
                scenes.set_targets(n, &targets(&scenes.scenes[n], n, env_step));
            }
            scenes.advance(1);
        }
        (0..count).map(|n| scenes.state(n)).collect()
    }

    #[test]
    fn kernels_and_company_do_not_affect_scenes() {
        let alone = simulated(Kernel::SCALAR, 5);
        assert!(alone.iter().filter(|state| state.clock == 40 && state.fault.is_none()).count() >= 4);
        for set in InstructionSet::available() {
            for kernel in Kernel::WIDTHS.into_iter().filter_map(|lanes| Kernel::new(set, lanes)) {
                for count in [5, 9] {
                    let states = simulated(kernel, count);
                    assert_eq!(states[..5], alone[..], "{kernel:?}, {count} scenes");
                }
            }
        }
    }

    #[test]
    fn a_robot_on_terrain_walks_as_on_the_ground() {
        let stairs: Vec<usize> = (0..WIDTH).map(|column| [0, 0, 1, 2, 1][column % 5]).collect();
        let heights = |heights: &[u8]| GroundProfile::new(heights).unwrap();
        walks_alike(heights(&[0]), &[5; WIDTH], 1);
        let codes: Vec<u8> =
            (0..3).flat_map(|row| stairs.iter().map(move |&high| if 2 - row <= high { 5 } else { 0 })).collect();
        walks_alike(heights(&[0, 0, 1, 2, 1]), &codes, 3);
        // Gaps in the floor, and voxels above nothing.
        let cells: Vec<u32> =
            (0..WIDTH as u32).map(|column| [0b001, 0b101, 0b100, 0b111, 0b000][column as usize % 5]).collect();
        let codes: Vec<u8> = (0..3)
            .rev()
            .flat_map(|row| cells.iter().map(move |rows| if rows >> row & 1 == 1 { 5 } else { 0 }))
            .collect();
        walks_alike(GroundProfile::of_cells(&cells).unwrap().on(12), &codes, 3);
    }

    fn walks_alike(ground: GroundProfile, codes: &[u8], rows: usize) {
        let body = Body::parse(&["343", "434", "313"], &Palette::paper()).unwrap();
        let setting = Setting { world_width: WIDTH, ground, ..Setting::default() };
        let (constants, pattern) = (Constants::default(), Pattern::PAIRS[0]);
        let spell = Spell::of(pattern, 1);
        let mut flock = LaneBackend::default().flock(&setting, std::slice::from_ref(&body));
        let still = SceneObject { grid: Grid::structure(WIDTH, rows, codes), at: [0, 0] };
        let at = setting.start(3).map(|axis| axis as usize);
        let robot = SceneObject { grid: Grid::structure(3, 3, &[3, 3, 3, 3, 3, 3, 3, 1, 3]), at };
        let mut scenes = Scenes::new(vec![Scene::new(&[still, robot], &constants)]);
        let signals = Signals::new(body.palette(), &constants);
        let driven: Vec<u8> = body.codes().iter().copied().filter(|&code| code > 2).collect();
        for env_step in 0..100 {
            flock.advance(&[pattern], 1);
            let targets: Vec<f64> = driven.iter().map(|&code| signals.target(code.into(), env_step, &spell)).collect();
            scenes.set_targets(0, &targets);
            scenes.advance(1);
            let Snapshot { state, .. } = flock.snapshot(0);
            assert_eq!(scenes.state(0).state, state, "env step {env_step}");
        }
    }

    fn seeing() -> Arc<Palette> {
        let mut materials = Palette::paper().materials().to_vec();
        let sensor = |name: &str, absent, present| {
            let response = Response { image: Some(ImageSize::new(3, 3)), ..Response::of(0, absent, present) };
            Material { name: name.to_owned(), kind: MaterialKind::Sensor(response) }
        };
        materials.extend([sensor("dark", 1.6, 0.6), sensor("light", 0.6, 1.6)]);
        Arc::new(Palette::new(materials))
    }

    #[test]
    fn a_robot_that_sees_is_one_with_a_target_for_each_voxel() {
        let image = |turn: usize| {
            let pixels = (0..9).map(|at| ((at * 5 + turn) % 9) as f64 / 8.0).collect();
            Some(Arc::new(Image::new(ImageSize::new(3, 3), pixels).unwrap()))
        };
        let spells = [0, 4].map(|turn| Spell { image: image(turn), ..Spell::of(Pattern::PAIRS[3], 30) });
        let body = Body::parse(&["a49", "3a4", "393"], &seeing()).unwrap();
        let (constants, setting) = (Constants::default(), Setting { world_width: WIDTH, ..Setting::default() });
        let signals = Signals::new(body.palette(), &constants).of(&body, &constants);
        // The targets of a scene are in reading order; those of image sensors follow those of the ten materials.
        let channels = [11, 4, 12, 3, 13, 4, 3, 14, 3];
        let at = setting.start(3).map(|axis| axis as usize);
        let robot = SceneObject { grid: Grid::structure(3, 3, &[3; 9]), at };
        let floor = SceneObject { grid: Grid::structure(WIDTH, 1, &[5; WIDTH]), at: [0, 0] };
        let mut scenes = Scenes::new(vec![Scene::new(&[floor, robot], &constants)]);
        for env_step in 0..60 {
            let spell = &spells[env_step as usize / 30];
            let targets: Vec<f64> = channels.iter().map(|&one| signals.target(one, env_step, spell)).collect();
            scenes.set_targets(0, &targets);
            scenes.advance(1);
        }
        let expected = scenes.state(0);
        let others = [&["343", "454", "363"], &["999", "343", "aaa"]].map(|rows| Body::parse(rows, &seeing()).unwrap());
        for set in InstructionSet::available() {
            for kernel in Kernel::WIDTHS.into_iter().filter_map(|lanes| Kernel::new(set, lanes)) {
                let backend = LaneBackend { kernel, ..LaneBackend::default() };
                let mut flock = backend.flock(&setting, &[others[0].clone(), body.clone(), others[1].clone()]);
                spells.iter().for_each(|spell| flock.advance_under(&vec![spell.clone(); 3]));
                assert_eq!(flock.snapshot(1).state, expected.state, "{kernel:?}");
                let schedule = Schedule { spells: spells.to_vec() };
                let trials = [Trial { body: body.clone(), schedule }];
                assert_eq!(backend.run_trials(&setting, &trials)[0].com_x[60], flock.center(1)[0]);
            }
        }
    }

    #[test]
    fn scenes_go_back_in_time() {
        let mut scenes = Scenes::new(vec![scene(ROBOTS[0]), scene(ROBOTS[1])]);
        let start = scenes.state(0);
        scenes.set_targets(0, &[1.6; 8]);
        scenes.advance(5);
        let middle = scenes.state(0);
        scenes.advance(5);
        let end = scenes.state(0);
        scenes.restore(0, &middle);
        scenes.advance(5);
        assert_eq!(scenes.state(0), end);
        assert_eq!(scenes.clock(1), 15);
        scenes.reset(0);
        assert_eq!(scenes.state(0), start);
        let (scene, state) = scenes.look(0);
        assert!(scene.turn(0, state) < 0.01);
        assert_eq!(scenes.positions(0, 4)[0].map(f64::round), [3.0; 2]);
    }

    #[test]
    fn a_scene_with_a_fault_stays_as_it_was_and_the_others_go_on() {
        let mut scenes = Scenes::new(vec![scene(ROBOTS[0]), scene(ROBOTS[0])]);
        let mut broken = scenes.state(1);
        for point in &mut broken.state.velocity {
            point[0] = f64::NAN;
        }
        scenes.restore(1, &broken);
        let before = scenes.state(1);
        scenes.advance(3);
        assert_eq!(scenes.fault(1).map(|fault| (fault.env_step, fault.kind)), Some((1, FaultKind::NonFinite)));
        assert_eq!(format!("{:?}", scenes.state(1).state), format!("{:?}", before.state));
        assert_eq!((scenes.clock(0), scenes.fault(0)), (3, None));
        scenes.reset(1);
        scenes.advance(1);
        assert_eq!((scenes.clock(1), scenes.fault(1)), (1, None));
    }
}
