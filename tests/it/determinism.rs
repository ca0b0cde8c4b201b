//! The same bits whatever runs beside, on whatever kernel and threads.

use nbc::model::{
    Body, FaultKind, Material, MaterialKind, Palette, Pattern, Response, Schedule, Setting, Spell, Trajectory, Trial,
};
use nbc::sim::{InstructionSet, Kernel, Simulator};
use proptest::prelude::*;

/// Every kernel of this processor.
fn kernels() -> impl Iterator<Item = Kernel> {
    InstructionSet::available()
        .into_iter()
        .flat_map(|set| Kernel::WIDTHS.into_iter().filter_map(move |lanes| Kernel::new(set, lanes)))
}

fn simulate(kernel: Kernel, setting: &Setting, trials: &[Trial]) -> Vec<Trajectory> {
    Simulator { kernel, ..Simulator::default() }.run_trials(setting, trials)
}

/// A trajectory as bits, so that not even zeros of different sign are alike.
fn bits(trajectory: &Trajectory) -> Vec<u64> {
    let fault = trajectory.fault.map_or(0, |fault| u64::from(fault.env_step));
    let numbers = trajectory.com_x.iter().chain(&trajectory.com_y);
    numbers.map(|number| number.to_bits()).chain([fault]).collect()
}

/// A body of that box; `digits` are drawn over the codes, 9 standing for another active voxel so that most bodies move.
fn body(width: usize, height: usize) -> impl Strategy<Value = Body> {
    proptest::collection::vec(0u8..10, width * height).prop_map(move |digits| {
        let mut codes: Vec<u8> = digits.iter().map(|&digit| if digit == 9 { 3 } else { digit }).collect();
        codes[width * height - 1] = 3;
        Body::new(width, height, codes)
    })
}

fn schedule(cycles: u32) -> impl Strategy<Value = Schedule> {
    (1..84 * cycles, 0usize..4, 0usize..4).prop_map(move |(first, a, b)| Schedule {
        spells: vec![
            Spell { pattern: Pattern::PAIRS[a], steps: first },
            Spell { pattern: Pattern::PAIRS[b], steps: 84 * cycles - first },
        ],
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
    fn a_lane_is_the_scalar_run(trials in trials()) {
        let setting = Setting::paper();
        let alone: Vec<_> = simulate(Kernel::SCALAR, &setting, &trials).iter().map(bits).collect();
        for kernel in kernels() {
            let beside: Vec<_> = simulate(kernel, &setting, &trials).iter().map(bits).collect();
            prop_assert!(alone == beside, "{kernel:?} gives other bits than the scalar run");
        }
    }
}

/// A body of one material that asks for no number at all, which blows it up.
fn broken_setting() -> Setting {
    let mut materials = Palette::paper().materials().to_vec();
    let kind = MaterialKind::Sensor(Response { stimulus: 0, absent: 0.6, present: f64::NAN });
    materials.push(Material { name: "broken".to_owned(), kind });
    Setting { palette: Palette::new(materials), ..Setting::paper() }
}

#[test]
fn a_faulting_lane_leaves_its_neighbors_alone() {
    let setting = broken_setting();
    let sound = Body::parse(&["343", "363", "507"], 9).unwrap();
    let broken = Body::parse(&["349", "363", "507"], 9).unwrap();
    let trial = |body: &Body, pattern: usize| Trial {
        body: body.clone(),
        schedule: Schedule {
            spells: vec![
                Spell { pattern: Pattern::PAIRS[1], steps: 40 },
                Spell { pattern: Pattern::PAIRS[pattern], steps: 80 },
            ],
        },
    };
    let trials: Vec<Trial> = (0..8).map(|i| trial(if i == 3 { &broken } else { &sound }, 2 + i % 2)).collect();
    let alone: Vec<_> =
        trials.iter().map(|trial| simulate(Kernel::SCALAR, &setting, std::slice::from_ref(trial)).remove(0)).collect();
    assert_eq!(alone[3].fault.map(|fault| (fault.env_step, fault.kind)), Some((41, FaultKind::NonFinite)));
    assert_eq!(alone[3].com_x.len(), 41);
    for kernel in kernels() {
        let found = simulate(kernel, &setting, &trials);
        for (alone, found) in alone.iter().zip(&found) {
            assert_eq!(bits(alone), bits(found), "{kernel:?}");
        }
    }
}
