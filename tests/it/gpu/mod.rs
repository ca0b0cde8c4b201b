//! The back end for OpenCL devices: the bits of the lanes, on the first device of this machine.

mod program;

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use nbc::{Search, evaluate, evaluate_bodies};
use nbc_base::model::{
    Body, CYCLE_STEPS, Evolution, FaultKind, Image, ImageSize, Material, MaterialKind, Palette, Pattern, Response,
    Schedule, Setting, Spell, Trajectory, Trial,
};
use nbc_sim::{
    Constants, DeviceError, Flock, LaneBackend, Meter, Monitor, OpenClBackend, OpenClDevice, SelfTest, Simulator,
    Snapshot,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::determinism::{GOLDEN, bits, broken_palette, hash, own_palette, patchwork, point_bits, swarm_of_bodies};
use crate::support::*;

/// Work-items of a group on a processor, and a number at which groups wait for each other.
const GROUPS: [usize; 2] = [1, 8];

/// One test at a time uses the device: PoCL 3.1 crashes if two threads list devices at once.
static TURN: Mutex<()> = Mutex::new(());

fn first_device() -> Option<(OpenClDevice, MutexGuard<'static, ()>)> {
    let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let devices = OpenClDevice::all().unwrap_or_default();
    devices.into_iter().next().map(|device| (device, turn))
}

fn device() -> Option<(OpenClDevice, MutexGuard<'static, ()>)> {
    let found = first_device();
    if found.is_none() {
        skip("there is no OpenCL device", "apt-get install ocl-icd-libopencl1 pocl-opencl-icd");
    }
    found
}

fn backend(device: &OpenClDevice, group: usize) -> OpenClBackend {
    OpenClBackend::unchecked(device, LaneBackend::default(), Some(group)).unwrap()
}

#[track_caller]
fn check(backend: &OpenClBackend, setting: &Setting, trials: &[Trial]) -> Vec<Trajectory> {
    let found = Simulator::new(backend.clone()).run_trials(setting, trials);
    assert_eq!(backend.failure(), None);
    let expected = Simulator::new(backend.processor().clone()).run_trials(setting, trials);
    for ((found, expected), trial) in found.iter().zip(&expected).zip(trials) {
        assert!(found.fault == expected.fault && bits(found) == bits(expected), "{}", trial.body.rows().join("\n"));
    }
    expected
}

fn trial(body: Body, spells: &[(usize, u32)]) -> Trial {
    let spell = |&(pattern, steps): &(usize, u32)| Spell::of(Pattern::PAIRS[pattern], steps);
    Trial { body, schedule: Schedule { spells: spells.iter().map(spell).collect() } }
}

/// Random bodies of a box: a fifth of the voxels is empty, and one voxel is active.
fn random_bodies(side: usize, count: usize) -> Vec<Body> {
    let mut rng = ChaCha8Rng::seed_from_u64(side as u64);
    let body = |_| {
        let mut codes: Vec<u8> = (0..side * side).map(|_| rng.random_range(0u8..10) % 10).collect();
        codes.iter_mut().filter(|code| **code == 9).for_each(|code| *code = 0);
        codes[side * side - 1] = 3;
        Body::new(side, side, codes, Palette::paper())
    };
    (0..count).map(body).collect()
}

#[test]
fn the_golden_hash() {
    let Some((device, _turn)) = device() else { return };
    for group in GROUPS {
        let backend = backend(&device, group);
        let found = Simulator::new(backend.clone()).run_trials(&Setting::default(), &patchwork());
        assert_eq!((hash(&found), backend.failure()), (GOLDEN, None), "{group} work-items");
    }
}

#[test]
fn random_bodies_of_every_box() {
    let Some((device, _turn)) = device() else { return };
    let backend = backend(&device, 1);
    for (side, count) in [(1, 1), (2, 4), (5, 12), (7, 4), (10, 2)] {
        let bodies = random_bodies(side, count).into_iter().enumerate();
        let trials: Vec<Trial> = bodies.map(|(i, body)| trial(body, &[(i % 4, 20), ((i + 1) % 4, 15)])).collect();
        check(&backend, &Setting::default(), &trials);
    }
}

#[test]
#[ignore = "minutes; .ci/full runs it"]
fn two_hundred_bodies_of_5x5_by_the_papers_protocol() {
    agrees_on_two_hundred(5);
}

fn agrees_on_two_hundred(side: usize) {
    let Some((device, _turn)) = device() else { return };
    let backend = backend(&device, 1);
    let evolution = declared("evolution whole { from: gates, objective: distance, fixed: 10 cycles }", "whole");
    assert_eq!((evolution.fixed_steps, evolution.variable.steps()), (10 * CYCLE_STEPS, 40 * CYCLE_STEPS));
    let bodies = random_bodies(side, 200);
    let found = evaluate_bodies(&Simulator::new(backend.clone()), &evolution, bodies.clone());
    assert_eq!(backend.failure(), None);
    assert_eq!(found, evaluate_bodies(&Simulator::default(), &evolution, bodies));
}

fn declared(source: &str, name: &str) -> Evolution {
    session_of(source).1.program.evolution(name).unwrap().clone()
}

#[test]
fn generations_of_both_objectives() {
    let Some((device, _turn)) = device() else { return };
    let simulator = Simulator::new(backend(&device, 1));
    for objective in ["distance, fixed: 2 cycles", "gate"] {
        let source = format!("evolution mine {{ from: gates, objective: {objective}, box: 3 x 3, batch: 3, seed: 4 }}");
        let mut search = Search::new(&declared(&source, "mine"), 4);
        for _ in 0..2 {
            let candidates = search.ask();
            let (expected, work) = evaluate(&Simulator::default(), &search, &candidates);
            assert_eq!(evaluate(&simulator, &search, &candidates), (expected.clone(), work), "{objective}");
            search.tell(&candidates, &expected);
        }
    }
}

#[test]
fn faults() {
    let Some((device, _turn)) = device() else { return };
    let wild = Body::parse(&["57070", "73873", "00304", "00001", "00861"], &Palette::paper()).unwrap();
    let narrow = Setting { world_width: 60, start_x: Some(28), ..Setting::default() };
    let constants = Constants { greatest_target: f64::MAX, ..Constants::default() };
    let processor = LaneBackend { constants, ..LaneBackend::default() };
    let sound = Body::parse(&["343", "363", "507"], &broken_palette()).unwrap();
    let broken = Body::parse(&["349", "363", "507"], &broken_palette()).unwrap();
    for group in GROUPS {
        let trials = [trial(wild.clone(), &[(3, 60), (0, 60)]), trial(sound.clone(), &[(3, 90)])];
        let found = check(&backend(&device, group), &narrow, &trials);
        assert_eq!(found[0].fault.map(|fault| (fault.env_step, fault.kind)), Some((72, FaultKind::Unstable)));
        let unclipped = OpenClBackend::unchecked(&device, processor.clone(), Some(group)).unwrap();
        let trials = [&sound, &broken].map(|body| trial(body.clone(), &[(1, 4), (2, 4)]));
        let found = check(&unclipped, &Setting::default(), &trials);
        assert_eq!(found[1].fault.map(|fault| (fault.env_step, fault.kind)), Some((5, FaultKind::NonFinite)));
    }
}

#[test]
fn a_faulty_robot_stays_in_its_last_state() {
    let Some((device, _turn)) = device() else { return };
    let wild = Body::parse(&["57070", "73873", "00304", "00001", "00861"], &Palette::paper()).unwrap();
    let setting = Setting { world_width: 60, start_x: Some(28), ..Setting::default() };
    let bodies = [wild, Body::patchwork(5, 0)];
    let mut lanes = Simulator::default().flock(&setting, &bodies);
    let mut found = Simulator::new(backend(&device, 1)).flock(&setting, &bodies);
    for (pattern, steps) in [(3, 60), (0, 20), (1, 5)] {
        lanes.advance(&[Pattern::PAIRS[pattern]; 2], steps);
        found.advance(&[Pattern::PAIRS[pattern]; 2], steps);
        assert_alike(&*found, &*lanes);
    }
    assert_eq!((found.fault(0).map(|fault| fault.env_step), found.clock(1)), (Some(72), 85));
}

#[test]
fn beyond_the_ground_and_at_its_ends() {
    let Some((device, _turn)) = device() else { return };
    let body = Body::parse(&["333", "303"], &Palette::paper()).unwrap();
    let own = Body::parse(&["234", "101", "739"], &own_palette()).unwrap();
    for group in GROUPS {
        let backend = backend(&device, group);
        for (start, width) in [(20, 10), (8, 10), (0, 3)] {
            let setting = Setting { world_width: width, start_x: Some(start), ..Setting::default() };
            let trials = [trial(body.clone(), &[(0, 60), (1, 30)]), trial(own.clone(), &[(2, 90)])];
            check(&backend, &setting, &trials);
        }
    }
}

#[test]
fn robots_of_a_swarm() {
    let Some((device, _turn)) = device() else { return };
    let (setting, bodies) = (Setting::default(), swarm_of_bodies());
    let patterns = |turn: usize| (0..bodies.len()).map(|robot| Pattern::PAIRS[(robot + turn) % 4]).collect::<Vec<_>>();
    let mut lanes = Simulator::default().flock(&setting, &bodies);
    let mut swarm = Simulator::new(backend(&device, 1)).flock(&setting, &bodies);
    for turn in 0..3 {
        lanes.advance(&patterns(turn), 15);
        swarm.advance(&patterns(turn), 15);
        assert_alike(&*swarm, &*lanes);
    }
}

#[track_caller]
fn assert_alike(found: &dyn Flock, expected: &dyn Flock) {
    assert_eq!(found.len(), expected.len());
    for robot in 0..found.len() {
        assert_eq!(found.snapshot(robot), expected.snapshot(robot), "robot {robot}");
        assert_eq!(point_bits(found, robot), point_bits(expected, robot), "robot {robot}");
        assert_eq!((found.clock(robot), found.fault(robot)), (expected.clock(robot), expected.fault(robot)));
    }
}

#[test]
fn robots_are_kept_dropped_and_restored() {
    let Some((device, _turn)) = device() else { return };
    let setting = Setting::default();
    let bodies: Vec<Body> = (0..7).map(|robot| Body::patchwork(4 + robot % 2, robot / 2)).collect();
    let mut flocks =
        [Simulator::new(backend(&device, 1)), Simulator::default()].map(|simulator| simulator.flock(&setting, &bodies));
    for flock in &mut flocks {
        flock.advance(&[Pattern::PAIRS[1]; 7], 9);
        let snapshots: Vec<Snapshot> = (0..7).map(|robot| flock.snapshot(robot)).collect();
        flock.retain(&[true, false, true, true, false, true, true]);
        flock.advance(&[Pattern::PAIRS[2]; 5], 5);
        flock.restore(3, &snapshots[5]);
        flock.advance(&[Pattern::PAIRS[0]; 5], 5);
    }
    let [found, expected] = &flocks;
    assert_alike(&**found, &**expected);
    assert_eq!(found.clock(3), 14);
}

#[test]
fn a_stopped_flock_has_the_bits_of_its_last_env_step() {
    let Some((device, _turn)) = device() else { return };
    let monitor = Arc::new(Monitor::default());
    let processor = LaneBackend { monitor: Some(monitor.clone()), ..LaneBackend::default() };
    let backend = OpenClBackend::unchecked(&device, processor, Some(1)).unwrap();
    let bodies = [Body::patchwork(3, 0), Body::patchwork(3, 1)];
    let mut flock = Simulator::new(backend).flock(&Setting::default(), &bodies);
    let mut expected = Simulator::default().flock(&Setting::default(), &bodies);
    for flock in [&mut flock, &mut expected] {
        flock.advance(&[Pattern::PAIRS[1]; 2], 12);
    }
    assert_eq!(monitor.env_steps(), 24);
    monitor.stop();
    flock.advance(&[Pattern::PAIRS[1]; 2], 12);
    assert_eq!(flock.fault(1).map(|fault| (fault.env_step, fault.kind)), Some((13, FaultKind::Stopped)));
    assert_eq!(flock.snapshot(1).state, expected.snapshot(1).state);
}

#[test]
fn robots_for_which_there_is_no_room_together_follow_each_other() {
    let Some((mut device, _turn)) = device() else { return };
    // Room for two robots at a time.
    device.global_bytes = 2 * 2 * 16 * (3 * 36 + 840 + 2);
    let trials: Vec<Trial> = (0..5).map(|robot| trial(Body::patchwork(5, robot), &[(robot % 4, 5)])).collect();
    check(&backend(&device, 1), &Setting::default(), &trials);
}

#[test]
fn the_time_of_a_device_is_counted() {
    let Some((device, _turn)) = device() else { return };
    let ticks = AtomicU64::new(0);
    let meter = Arc::new(Meter::new(move || ticks.fetch_add(1, Ordering::Relaxed)));
    let processor = LaneBackend { meter: Some(meter.clone()), ..LaneBackend::default() };
    let backend = OpenClBackend::unchecked(&device, processor, Some(1)).unwrap();
    let trials = [0, 1].map(|robot| trial(Body::patchwork(3, robot), &[(1, 4)]));
    Simulator::new(backend).run_trials(&Setting::default(), &trials);
    let times = meter.times();
    assert_eq!((times.nanoseconds, times.lane_substeps), ([0, 0, 0, 0, 1], 2 * 4 * 30));
}

#[test]
fn this_processor_takes_over() {
    let Some((device, _turn)) = device() else { return };
    let backend = backend(&device, 1);
    let bodies = [Body::patchwork(3, 0), Body::patchwork(100, 1)];
    let mut flock = Simulator::new(backend.clone()).flock(&Setting::default(), &bodies);
    let mut expected = Simulator::default().flock(&Setting::default(), &bodies);
    for (turn, pattern) in [1, 2].into_iter().enumerate() {
        // A body of 10,000 voxels has no room in a group's memory, and later the device fails.
        flock.advance(&[Pattern::PAIRS[pattern]; 2], 1);
        expected.advance(&[Pattern::PAIRS[pattern]; 2], 1);
        assert_alike(&*flock, &*expected);
        if turn == 0 {
            assert_eq!(backend.failure(), None);
            backend.give_up(DeviceError::NoDevice);
        }
    }
    assert_eq!(backend.failure(), Some(DeviceError::NoDevice));
    let trials = [trial(bodies[0].clone(), &[(1, 10)])];
    let found = Simulator::new(backend).run_trials(&Setting::default(), &trials);
    let expected = Simulator::default().run_trials(&Setting::default(), &trials);
    assert_eq!(bits(&found[0]), bits(&expected[0]));
}

#[test]
fn the_self_test_passes_and_detects_other_physics() {
    let Some((device, _turn)) = device() else { return };
    assert!(OpenClBackend::open(&device, LaneBackend::default()).is_ok());
    let backend = backend(&device, 1);
    let (sentences, problem) = backend.test(SelfTest::QUICK).unwrap();
    assert!(problem.is_none() && sentences.iter().all(|sentence| sentence.trials > 4 && sentence.different == 0));
    let mut other = LaneBackend::default();
    other.constants.gravity *= 1.0 + f64::EPSILON;
    assert!(SelfTest::QUICK.compare(&backend, &other).iter().all(|sentence| sentence.different > 0));
}

#[test]
fn a_device_shows_images_as_the_lanes_do() {
    let Some((device, _turn)) = self::device() else { return };
    let sensor = |name: &str, absent, present| {
        let response = Response { image: Some(ImageSize::new(3, 2)), ..Response::of(0, absent, present) };
        Material { name: name.to_owned(), kind: MaterialKind::Sensor(response) }
    };
    let mut materials = Palette::paper().materials().to_vec();
    materials.extend([sensor("dark", 1.6, 0.6), sensor("light", 0.6, 1.6)]);
    let palette = Arc::new(Palette::new(materials));
    let image = |turn: usize| {
        let pixels = (0..6).map(|at| ((at * 5 + turn) % 6) as f64 / 5.0).collect();
        Some(Arc::new(Image::new(ImageSize::new(3, 2), pixels).unwrap()))
    };
    let bodies = [&["94", "39", "3a"][..], &["aa9", "343", "999"], &["343", "454", "363"], &["94", "39", "3a"]];
    let trial = |(n, rows): (usize, &&[&str])| {
        let spell = |turn| Spell { image: image(turn), ..Spell::of(Pattern::PAIRS[1], 20) };
        let schedule = Schedule { spells: vec![spell(n), Spell::of(Pattern::PAIRS[2], 10), spell(n + 1)] };
        Trial { body: Body::parse(rows, &palette).unwrap(), schedule }
    };
    let trials: Vec<Trial> = bodies.iter().enumerate().map(trial).collect();
    check(&backend(&device, GROUPS[0]), &Setting::default(), &trials);
}
