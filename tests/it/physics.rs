//! The physics against reference trajectories, published figures and laws.

use std::collections::BTreeMap;

use nbc_base::model::{Behavior, Body, FaultKind, Palette, Pattern, Schedule, Setting, Spell, Trajectory, Trial};
use nbc_sim::{Constants, LaneBackend, Simulator};
use serde::Deserialize;

/// Largest difference from a reference, in voxels (docs/physics.md 12).
const TOLERANCE: f64 = 1e-9;

/// Largest difference over ten cycles, which amplify rounding in some motions (docs/physics.md 12).
const TEN_CYCLE_TOLERANCE: f64 = 1e-6;

const CYCLE: u32 = 84;

#[derive(Deserialize)]
struct Reference {
    cases: Vec<Case>,
}

#[derive(Clone, Deserialize)]
struct Case {
    name: String,
    world_width: usize,
    start_x: usize,
    body: Vec<String>,
    #[serde(default)]
    schedule: Vec<(String, u32)>,
    unstable_at: Option<u32>,
    rounding_sensitive_from: Option<usize>,
    #[serde(default)]
    com_x: Vec<f64>,
    #[serde(default)]
    com_y: Vec<f64>,
    #[serde(default)]
    points: BTreeMap<usize, Vec<[f64; 2]>>,
    #[serde(default)]
    fixed: BTreeMap<String, Fixed>,
}

#[derive(Clone, Deserialize)]
struct Fixed {
    com_x: Vec<f64>,
    com_y: Vec<f64>,
}

fn reference() -> Vec<Case> {
    serde_json::from_str::<Reference>(include_str!("../golden/trajectories.json")).unwrap().cases
}

fn traces() -> Vec<Case> {
    reference().into_iter().filter(|case| case.fixed.is_empty()).collect()
}

fn pattern(digits: &str) -> Pattern {
    Pattern::PAIRS.into_iter().find(|pattern| pattern.to_string() == digits).unwrap()
}

fn setting(start_x: usize, world_width: usize) -> Setting {
    Setting { world_width, start_x: Some(start_x), ..Setting::default() }
}

impl Case {
    fn setting(&self) -> Setting {
        setting(self.start_x, self.world_width)
    }

    fn body(&self) -> Body {
        Body::parse(&self.body, &Palette::paper()).unwrap()
    }

    fn schedule(&self) -> Schedule {
        let spell = |(digits, steps): &(String, u32)| Spell::of(pattern(digits), *steps);
        Schedule { spells: self.schedule.iter().map(spell).collect() }
    }

    /// The number of env steps that are compared strictly.
    fn strict(&self) -> usize {
        self.rounding_sensitive_from.unwrap_or(self.com_x.len())
    }

    /// The largest difference of the center of mass from the reference, in voxels; infinite if the fault differs.
    fn difference(&self, found: &Trajectory) -> f64 {
        let fault = found.fault.map(|fault| (fault.env_step, fault.kind));
        if fault != self.unstable_at.map(|step| (step, FaultKind::Unstable)) || found.com_x.len() != self.com_x.len() {
            return f64::INFINITY;
        }
        let x = greatest_difference(&self.com_x[..self.strict()], &found.com_x);
        x.max(greatest_difference(&self.com_y[..self.strict()], &found.com_y))
    }
}

fn greatest_difference(expected: &[f64], found: &[f64]) -> f64 {
    expected.iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, |a, b| if b <= a { a } else { b })
}

fn simulate(case: &Case, constants: &Constants) -> Trajectory {
    let trial = Trial { body: case.body(), schedule: case.schedule() };
    Simulator::new(LaneBackend { constants: *constants, ..LaneBackend::default() })
        .run_trials(&case.setting(), &[trial])
        .remove(0)
}

#[test]
fn reference_trajectories() {
    for case in traces() {
        let difference = case.difference(&simulate(&case, &Constants::default()));
        assert!(difference < TOLERANCE, "{}: {difference:e} voxels from the reference", case.name);
    }
}

/// The positions of points after 1, 2, 3 and 30 substeps of the first env step.
#[test]
fn reference_substeps() {
    let check = |rows: &[&str], start_x: usize, digits: &str, expected: &[(u32, usize, [f64; 2])]| {
        for &(substeps, point, at) in expected {
            let simulator = Simulator::new(LaneBackend {
                constants: Constants { substeps, ..Constants::default() },
                ..LaneBackend::default()
            });
            let mut flock = simulator.flock(&setting(start_x, 60), &[Body::parse(rows, &Palette::paper()).unwrap()]);
            flock.advance(&[pattern(digits)], 1);
            let found = flock.points(0)[point];
            let difference = greatest_difference(&at, &found);
            assert!(difference < TOLERANCE, "{rows:?} substep {substeps} point {point}: {found:?} is not {at:?}");
        }
    };
    let voxel = [
        (1, 0, [29.99978999603999, 2.000094989240108]),
        (1, 3, [30.999685005710003, 1.0014690055465718]),
        (2, 1, [30.999343116055353, 2.000774029620233]),
        (2, 2, [29.99908189619458, 1.0039069339232953]),
        (3, 0, [29.998087652732995, 2.0019914065850792]),
        (3, 3, [30.999287380516716, 1.0057844946557664]),
        (30, 1, [30.996388239344416, 2.0376011711408233]),
        (30, 2, [29.972641329456213, 1.0454111123830192]),
    ];
    check(&["3"], 30, "00", &voxel);
    let square = [
        (1, 0, [28.999831625806706, 2.999991875087243]),
        (1, 3, [30.000023057830205, 1.9999986204544502]),
        (1, 7, [29.99999756679128, 0.9999984954764491]),
        (2, 3, [30.00005213130207, 2.0001066600362396]),
        (3, 7, [30.0000135717383, 1.0046127776464613]),
        (30, 0, [28.970043608558587, 3.0087258245297144]),
        (30, 3, [29.996344832069408, 2.0237153360680744]),
        (30, 7, [29.99837360009688, 1.0337428029240585]),
    ];
    check(&["34", "12"], 29, "01", &square);
}

#[test]
fn reference_points() {
    for case in traces().iter().filter(|case| !case.points.is_empty()) {
        let mut flock = Simulator::default().flock(&case.setting(), &[case.body()]);
        let patterns: Vec<_> = case.schedule().patterns().collect();
        for step in 0..case.strict() {
            if let Some(expected) = case.points.get(&step) {
                let found = flock.points(0);
                assert_eq!(found.len(), expected.len(), "{}", case.name);
                for (point, (a, b)) in expected.iter().zip(&found).enumerate() {
                    let difference = (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
                    assert!(difference < TOLERANCE, "{} step {step} point {point}: {a:?} {b:?}", case.name);
                }
            }
            if let Some(&pattern) = patterns.get(step) {
                flock.advance(&[pattern], 1);
            }
        }
    }
}

#[test]
fn ten_cycles_of_each_pattern() {
    for case in reference().iter().filter(|case| !case.fixed.is_empty()) {
        let trial = |pattern| Trial { body: case.body(), schedule: Schedule::constant(pattern, 10 * CYCLE) };
        let found = Simulator::default().run_trials(&case.setting(), &Pattern::PAIRS.map(trial));
        for (pattern, found) in Pattern::PAIRS.iter().zip(found) {
            assert_eq!(found.fault, None);
            let expected = &case.fixed[&pattern.to_string()];
            let ends = |com: &[f64]| com.iter().step_by(CYCLE as usize).copied().collect::<Vec<_>>();
            let x = greatest_difference(&expected.com_x, &ends(&found.com_x));
            let difference = x.max(greatest_difference(&expected.com_y, &ends(&found.com_y)));
            assert!(difference < TEN_CYCLE_TOLERANCE, "{} {pattern}: {difference:e} voxels", case.name);
        }
    }
}

#[derive(Deserialize)]
struct Published {
    robots: Vec<PublishedRobot>,
}

#[derive(Deserialize)]
struct PublishedRobot {
    name: String,
    behavior: String,
    start_x: usize,
    world_width: usize,
    min_displacement: f64,
    body: Vec<String>,
}

#[test]
fn published_robots_walk_as_published() {
    let published: Published = serde_json::from_str(include_str!("../golden/paper_robots.json")).unwrap();
    for robot in published.robots {
        let body = Body::parse(&robot.body, &Palette::paper()).unwrap();
        let trial = |pattern| Trial { body: body.clone(), schedule: Schedule::constant(pattern, 10 * CYCLE) };
        let found =
            Simulator::default().run_trials(&setting(robot.start_x, robot.world_width), &Pattern::PAIRS.map(trial));
        let displacement = |i: usize| found[i].com_x.last().unwrap() - found[i].com_x[0];
        let displacements = [0, 1, 2, 3].map(displacement);
        assert_eq!(Behavior::of(&displacements).to_string(), robot.behavior, "{}", robot.name);
        let least = displacements.iter().fold(f64::INFINITY, |least, d| d.abs().min(least));
        assert!((least - robot.min_displacement).abs() < 1e-5, "{}: {least}", robot.name);
    }
}

type NamedConstant = (&'static str, fn(&mut Constants) -> &mut f64);

/// Every constant except thresholds for degenerate shapes (`parallel`, `shortest`, `nowhere`) and integers
/// (`substeps`).
const CONSTANTS: &[NamedConstant] = &[
    ("cell", |c| &mut c.cell),
    ("substep", |c| &mut c.substep),
    ("gravity", |c| &mut c.gravity),
    ("drag", |c| &mut c.drag),
    ("rigid_stiffness", |c| &mut c.rigid_stiffness),
    ("active_stiffness", |c| &mut c.active_stiffness),
    ("soft_stiffness", |c| &mut c.soft_stiffness),
    ("rigid_diagonal", |c| &mut c.rigid_diagonal),
    ("active_diagonal", |c| &mut c.active_diagonal),
    ("soft_diagonal", |c| &mut c.soft_diagonal),
    ("least_target", |c| &mut c.least_target),
    ("greatest_target", |c| &mut c.greatest_target),
    ("approach", |c| &mut c.approach),
    ("contact_stiffness", |c| &mut c.contact_stiffness),
    ("contact_depth", |c| &mut c.contact_depth),
    ("point_damping", |c| &mut c.point_damping),
    ("edge_damping", |c| &mut c.edge_damping),
    ("friction", |c| &mut c.friction),
    ("friction_range", |c| &mut c.friction_range),
    ("longest", |c| &mut c.longest),
    ("tightest", |c| &mut c.tightest),
    ("correction", |c| &mut c.correction),
    ("rigid_longest", |c| &mut c.rigid_longest),
    ("rigid_tightest", |c| &mut c.rigid_tightest),
    ("rigid_correction", |c| &mut c.rigid_correction),
];

/// Constants that matter only to a robot below the ground.
const PLANE_CONSTANTS: &[NamedConstant] = &[
    ("plane_stiffness", |c| &mut c.plane_stiffness),
    ("plane_friction", |c| &mut c.plane_friction),
    ("plane_slope", |c| &mut c.plane_slope),
];

fn changed(constant: &NamedConstant, factor: f64) -> Constants {
    let mut constants = Constants::default();
    *constant.1(&mut constants) *= factor;
    constants
}

#[test]
fn a_change_of_any_constant_by_one_percent_is_detected() {
    let cases = traces();
    for constant in CONSTANTS {
        for factor in [0.99, 1.01] {
            let constants = changed(constant, factor);
            let seen = cases.iter().any(|case| case.difference(&simulate(case, &constants)) > TOLERANCE);
            assert!(
                seen || is_clipped(constant, factor),
                "{} times {factor} changes no reference trajectory",
                constant.0
            );
        }
    }
}

/// A wider range of targets has no effect, because no material exceeds the range.
fn is_clipped(constant: &NamedConstant, factor: f64) -> bool {
    matches!((constant.0, factor < 1.0), ("least_target", true) | ("greatest_target", false))
}

#[test]
fn a_robot_beyond_the_ground_comes_to_rest_on_the_plane() {
    let body = Body::parse(&["333", "303"], &Palette::paper()).unwrap();
    let case = Trial { body, schedule: Schedule::constant(Pattern::PAIRS[0], 3 * CYCLE) };
    let fall = |constants: Constants| {
        let simulator = Simulator::new(LaneBackend { constants, ..LaneBackend::default() });
        simulator.run_trials(&setting(20, 10), std::slice::from_ref(&case)).remove(0)
    };
    let usual = fall(Constants::default());
    assert_eq!(usual.fault, None);
    let last = *usual.com_y.last().unwrap();
    assert!((0.5..2.0).contains(&last), "it stands on the plane y = 0, and its center is {last} voxels high");
    for constant in PLANE_CONSTANTS {
        let other = fall(changed(constant, 1.01));
        assert!(
            other.com_x != usual.com_x || other.com_y != usual.com_y,
            "{} changes nothing on the plane",
            constant.0
        );
    }
}
