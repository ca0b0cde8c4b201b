//! The same bits for any neighbors in a batch, any kernel and any number of threads.

use std::sync::Arc;

use nbc_base::model::{
    Body, Drive, Fault, FaultKind, GroundProfile, Material, MaterialKind, Palette, Pattern, Response, Schedule,
    Setting, Spell, Trajectory, Trial,
};
use nbc_sim::{Constants, Flock, InstructionSet, Kernel, LaneBackend, Monitor, Simulator};
use proptest::prelude::*;

fn kernels() -> impl Iterator<Item = Kernel> {
    InstructionSet::available()
        .into_iter()
        .flat_map(|set| Kernel::WIDTHS.into_iter().filter_map(move |lanes| Kernel::new(set, lanes)))
}

fn simulate(kernel: Kernel, setting: &Setting, trials: &[Trial]) -> Vec<Trajectory> {
    Simulator::new(LaneBackend { kernel, ..LaneBackend::default() }).run_trials(setting, trials)
}

/// A trajectory as bits, so that not even zeros of different sign are alike.
pub fn bits(trajectory: &Trajectory) -> Vec<u64> {
    let fault = trajectory.fault.map_or(0, |fault| u64::from(fault.env_step));
    let numbers = trajectory.com_x.iter().chain(&trajectory.com_y);
    numbers.map(|number| number.to_bits()).chain([fault]).collect()
}

/// A body of this box and one of two palettes. `digits` are drawn over the codes; 9 is another active voxel, so that
/// most bodies move.
fn body(width: usize, height: usize) -> impl Strategy<Value = Body> {
    let cells = proptest::collection::vec(0u8..10, width * height).prop_map(move |digits| {
        let mut codes: Vec<u8> = digits.iter().map(|&digit| if digit == 9 { 3 } else { digit }).collect();
        codes[width * height - 1] = 3;
        (width, height, codes)
    });
    (cells, any::<bool>()).prop_map(|((width, height, codes), own)| {
        Body::new(width, height, codes, if own { own_palette() } else { Palette::paper() })
    })
}

/// Nine materials whose codes all differ from the paper's.
pub fn own_palette() -> Arc<Palette> {
    let named = |(i, kind): (usize, MaterialKind)| Material { name: format!("own_{i}"), kind };
    let drive = |period, phase, low, high| MaterialKind::Actuator(Drive { period, phase, low, high });
    let sensor = |stimulus, absent, present| MaterialKind::Sensor(Response::of(stimulus, absent, present));
    let kinds = vec![
        MaterialKind::Soft,
        drive(30, 45.0, 0.7, 1.5),
        drive(84, 0.0, 0.9, 1.4),
        drive(50, 90.0, 0.6, 1.6),
        sensor(1, 1.2, 0.8),
        sensor(0, 0.7, 1.3),
        MaterialKind::Rigid,
        sensor(1, 1.0, 1.5),
        drive(84, 270.0, 0.6, 1.2),
    ];
    Arc::new(Palette::new(kinds.into_iter().enumerate().map(named).collect()))
}

fn schedule(cycles: u32) -> impl Strategy<Value = Schedule> {
    (1..84 * cycles, 0usize..4, 0usize..4).prop_map(move |(first, a, b)| Schedule {
        spells: vec![Spell::of(Pattern::PAIRS[a], first), Spell::of(Pattern::PAIRS[b], 84 * cycles - first)],
    })
}

fn trials() -> impl Strategy<Value = Vec<Trial>> {
    let side = 1..5usize;
    (side.clone(), side).prop_flat_map(|(width, height)| {
        let trial = (body(width, height), schedule(2)).prop_map(|(body, schedule)| Trial { body, schedule });
        proptest::collection::vec(trial, 1..11)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    #[test]
    fn a_lane_is_the_scalar_run(trials in trials(), heights in proptest::collection::vec(0u8..3, 1..4)) {
        let setting = Setting { ground: GroundProfile::new(&heights).unwrap(), ..Setting::default() };
        let alone: Vec<_> = simulate(Kernel::SCALAR, &setting, &trials).iter().map(bits).collect();
        for kernel in kernels() {
            let beside: Vec<_> = simulate(kernel, &setting, &trials).iter().map(bits).collect();
            prop_assert!(alone == beside, "{kernel:?} gives other bits than the scalar run");
        }
    }
}

/// The paper's materials and one with an extreme width, which makes a body unstable unless targets are clipped.
pub fn broken_palette() -> Arc<Palette> {
    let mut materials = Palette::paper().materials().to_vec();
    let kind = MaterialKind::Sensor(Response::of(0, 0.6, f64::MAX));
    materials.push(Material { name: "broken".to_owned(), kind });
    Arc::new(Palette::new(materials))
}

#[test]
fn a_faulting_lane_does_not_change_its_neighbors() {
    let (setting, palette) = (Setting::default(), broken_palette());
    let constants = Constants { greatest_target: f64::MAX, ..Constants::default() };
    let simulate = |kernel, trials: &[Trial]| {
        Simulator::new(LaneBackend { constants, kernel, ..LaneBackend::default() }).run_trials(&setting, trials)
    };
    let sound = Body::parse(&["343", "363", "507"], &palette).unwrap();
    let broken = Body::parse(&["349", "363", "507"], &palette).unwrap();
    let trial = |body: &Body, pattern: usize| Trial {
        body: body.clone(),
        schedule: Schedule { spells: vec![Spell::of(Pattern::PAIRS[1], 40), Spell::of(Pattern::PAIRS[pattern], 80)] },
    };
    let trials: Vec<Trial> = (0..8).map(|i| trial(if i == 3 { &broken } else { &sound }, 2 + i % 2)).collect();
    let alone: Vec<_> =
        trials.iter().map(|trial| simulate(Kernel::SCALAR, std::slice::from_ref(trial)).remove(0)).collect();
    assert_eq!(alone[3].fault.map(|fault| (fault.env_step, fault.kind)), Some((41, FaultKind::NonFinite)));
    assert_eq!(alone[3].com_x.len(), 41);
    for kernel in kernels() {
        let found = simulate(kernel, &trials);
        for (alone, found) in alone.iter().zip(&found) {
            assert_eq!(bits(alone), bits(found), "{kernel:?}");
        }
    }
}

#[test]
fn a_stopped_simulation_has_the_same_bits_up_to_its_end() {
    let body = |rows: &[&str]| Body::parse(rows, &Palette::paper()).unwrap();
    let bodies = [body(&["343", "563"]), body(&["33333"]), body(&["343", "363", "507"])];
    let trial = |body: &Body| Trial { body: body.clone(), schedule: Schedule::constant(Pattern::PAIRS[1], 4000) };
    let trials: Vec<Trial> = bodies.iter().map(trial).collect();
    let whole = Simulator::default().run_trials(&Setting::default(), &trials);
    let monitor = Arc::new(Monitor::default());
    let cut = std::thread::scope(|scope| {
        scope.spawn(|| {
            while monitor.env_steps() < 500 {
                std::thread::yield_now();
            }
            monitor.stop();
        });
        Simulator::monitored(monitor.clone()).run_trials(&Setting::default(), &trials)
    });
    assert!(monitor.env_steps() < 12_000, "the end came early");
    for (cut, whole) in cut.iter().zip(&whole) {
        let steps = cut.com_x.len();
        assert_eq!(cut.fault, Some(Fault { env_step: steps as u32, kind: FaultKind::Stopped }));
        assert_eq!((&cut.com_x[..], &cut.com_y[..]), (&whole.com_x[..steps], &whole.com_y[..steps]));
    }
}

#[test]
fn a_stopped_flock_can_be_restored() {
    let body = Body::parse(&["343", "563"], &Palette::paper()).unwrap();
    let bodies = vec![body; 3];
    let monitor = Arc::new(Monitor::default());
    let mut flock = Simulator::monitored(monitor.clone()).flock(&Setting::default(), &bodies);
    flock.advance(&[Pattern::PAIRS[2]; 3], 50);
    let states: Vec<_> = (0..3).map(|robot| flock.snapshot(robot)).collect();
    monitor.stop();
    flock.advance(&[Pattern::PAIRS[1]; 3], 50);
    assert_eq!(flock.fault(2), Some(Fault { env_step: 51, kind: FaultKind::Stopped }));
    let mut other = Simulator::default().flock(&Setting::default(), &bodies);
    for (robot, state) in states.iter().enumerate() {
        other.restore(robot, state);
    }
    other.advance(&[Pattern::PAIRS[1]; 3], 50);
    let schedule = nbc::read_schedule("schedule", "10*50steps 01*50steps", 2).unwrap();
    let trial = Trial { body: bodies[0].clone(), schedule };
    let whole = Simulator::default().run_trials(&Setting::default(), &[trial]).remove(0);
    assert_eq!(other.center(2).map(f64::to_bits), [whole.com_x[100], whole.com_y[100]].map(f64::to_bits));
}

/// Trials of different lengths in the paper's smaller boxes, so that lanes are refilled at different times.
pub fn patchwork() -> Vec<Trial> {
    let trial = |i: usize| Trial {
        body: Body::patchwork(if i < 10 { 5 } else { 7 }, i / 2),
        schedule: Schedule::constant(Pattern::PAIRS[i % 4], 20 + 7 * (i as u32 % 5)),
    };
    (0..16).map(trial).collect()
}

/// FNV-1a over all bits of some trajectories.
pub fn hash(trajectories: &[Trajectory]) -> u64 {
    let bytes = trajectories.iter().flat_map(bits).flat_map(u64::to_le_bytes);
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}

/// The hash of the trajectories of `patchwork`, the same on every machine.
pub const GOLDEN: u64 = 0xe925_c4e3_f4fa_23dd;

#[test]
fn golden_hash_on_every_kernel_and_number_of_threads() {
    let (setting, trials) = (Setting::default(), patchwork());
    for kernel in kernels() {
        assert_eq!(hash(&simulate(kernel, &setting, &trials)), GOLDEN, "{kernel:?}");
    }
    for threads in [1, 2, 3, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let found = pool.install(|| simulate(Kernel::default(), &setting, &trials));
        assert_eq!(hash(&found), GOLDEN, "{threads} threads");
    }
}

pub fn swarm_of_bodies() -> Vec<Body> {
    let flat = Body::parse(&["34343", "33333"], &Palette::paper()).unwrap();
    let body = |robot: usize| match robot % 7 {
        3 => Body::patchwork(7, robot / 14),
        5 => flat.clone(),
        _ => Body::patchwork(5, robot / 10),
    };
    (0..21).map(body).collect()
}

#[test]
fn robots_of_a_swarm_advance_as_they_do_alone() {
    let (setting, bodies) = (Setting::default(), swarm_of_bodies());
    let patterns = |turn: usize| (0..bodies.len()).map(|robot| Pattern::PAIRS[(robot + turn) % 4]).collect::<Vec<_>>();
    let alone = Simulator::new(LaneBackend { kernel: Kernel::SCALAR, ..LaneBackend::default() });
    let mut robots: Vec<_> = bodies.iter().map(|body| alone.flock(&setting, std::slice::from_ref(body))).collect();
    for turn in 0..3 {
        for (robot, pattern) in robots.iter_mut().zip(patterns(turn)) {
            robot.advance(&[pattern], 15);
        }
    }
    for kernel in kernels() {
        let mut swarm = Simulator::new(LaneBackend { kernel, ..LaneBackend::default() }).flock(&setting, &bodies);
        (0..3).for_each(|turn| swarm.advance(&patterns(turn), 15));
        for (i, robot) in robots.iter().enumerate() {
            assert_eq!(point_bits(&*swarm, i), point_bits(&**robot, 0), "robot {i} on {kernel:?}");
        }
    }
}

pub fn point_bits(flock: &dyn Flock, robot: usize) -> Vec<[u64; 2]> {
    flock.points(robot).into_iter().map(|at| at.map(f64::to_bits)).collect()
}

#[test]
fn robots_that_are_left_walk_on_as_if_nothing_had_happened() {
    let setting = Setting::default();
    let bodies: Vec<Body> = (0..19).map(|robot| Body::patchwork(4 + robot % 2, robot / 4)).collect();
    let patterns = |robots: &[usize]| robots.iter().map(|robot| Pattern::PAIRS[robot % 4]).collect::<Vec<_>>();
    let mut left: Vec<usize> = (0..bodies.len()).collect();
    let [mut whole, mut thinned] = [(); 2].map(|()| Simulator::default().flock(&setting, &bodies));
    for divisor in [7, 5, 2] {
        whole.advance(&patterns(&(0..bodies.len()).collect::<Vec<_>>()), 9);
        thinned.advance(&patterns(&left), 9);
        thinned.retain(&left.iter().map(|robot| robot % divisor != 0).collect::<Vec<_>>());
        left.retain(|robot| robot % divisor != 0);
    }
    assert_eq!(thinned.len(), left.len());
    for (place, &robot) in left.iter().enumerate() {
        assert_eq!(point_bits(&*thinned, place), point_bits(&*whole, robot), "robot {robot}");
    }
}

#[test]
fn a_restored_robot_walks_the_same_way_again() {
    let setting = Setting::default();
    let bodies: Vec<Body> = (0..5).map(|robot| Body::patchwork(5, robot)).collect();
    let mut flock = Simulator::default().flock(&setting, &bodies);
    let all = |flock: &dyn Flock| (0..5).map(|robot| point_bits(flock, robot)).collect::<Vec<_>>();
    flock.advance(&[Pattern::PAIRS[1]; 5], 20);
    let snapshots: Vec<_> = (0..5).map(|robot| flock.snapshot(robot)).collect();
    flock.advance(&[Pattern::PAIRS[2]; 5], 20);
    let first = all(&*flock);
    for (robot, snapshot) in snapshots.iter().enumerate() {
        flock.restore(robot, snapshot);
    }
    assert_eq!(flock.snapshot(3), snapshots[3]);
    flock.advance(&[Pattern::PAIRS[2]; 5], 20);
    assert_eq!(all(&*flock), first);
}
