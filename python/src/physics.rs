//! Trials: bodies under a schedule, from a fresh start.

use std::collections::BTreeSet;

use nbc::{Body, Fault, FaultKind, Pattern, Schedule, Setting, Spell, Trajectory, Trial};
use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::bodies::{bodies, palette};
use crate::errors::{bad_value, diagnosed};
use crate::work::{self, Watch, at_once};

/// The most env steps of trials that are simulated in one go; their trajectories are in memory at the same time.
const GROUP_STEPS: u64 = 20_000_000;

/// The most memory of recorded paths.
const MOST_BYTES: u64 = 1 << 33;

/// The fault of a simulation that was not begun.
pub const STOPPED: Fault = Fault { env_step: 1, kind: FaultKind::Stopped };

/// A schedule as Python gives it: text, or patterns with env steps.
#[derive(FromPyObject)]
pub enum ScheduleWords {
    /// `00*10 01*56steps`
    Text(String),
    /// Patterns as digits, and env steps.
    Spells(Vec<(String, u32)>),
}

impl ScheduleWords {
    /// The schedule.
    ///
    /// # Errors
    /// When it is invalid.
    pub fn read(self, py: Python<'_>) -> PyResult<Schedule> {
        let spells = match self {
            Self::Text(text) => return nbc::read_schedule("schedule", &text).map_err(|found| diagnosed(py, &found)),
            Self::Spells(spells) => spells,
        };
        let spell = |(digits, steps)| Ok(Spell { pattern: pattern(digits)?, steps });
        Ok(Schedule { spells: spells.into_iter().map(spell).collect::<PyResult<_>>()? })
    }
}

/// A pattern of digits.
pub fn pattern(digits: String) -> PyResult<Pattern> {
    Pattern::try_from(digits).map_err(|error| bad_value(error.to_string()))
}

/// The setting, in which each of the bodies stands on the ground.
pub fn setting(world_width: usize, start_x: Option<usize>, bodies: &[Body]) -> PyResult<Setting> {
    let setting = Setting { world_width, start_x, ..Setting::default() };
    for (i, body) in bodies.iter().enumerate() {
        setting.check(body).map_err(|error| bad_value(format!("bodies[{i}]: {error}")))?;
    }
    Ok(setting)
}

/// Env step and kind of a fault; 0 and nothing for none.
pub fn fault_words(fault: Option<Fault>) -> (u32, &'static str) {
    let word = |kind| match kind {
        FaultKind::Unstable => "unstable",
        FaultKind::NonFinite => "non_finite",
        FaultKind::Stopped => "stopped",
    };
    fault.map_or((0, ""), |fault| (fault.env_step, word(fault.kind)))
}

/// The trials of a call, as Python gives them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct TrialArguments<'py> {
    codes: PyReadonlyArray1<'py, u8>,
    shapes: PyReadonlyArray2<'py, u64>,
    materials: Option<String>,
    schedule: ScheduleWords,
    world_width: usize,
    start_x: Option<usize>,
}

/// Bodies under a schedule, each in a world of its own.
struct Experiment {
    bodies: Vec<Body>,
    setting: Setting,
    schedule: Schedule,
}

impl TrialArguments<'_> {
    /// The experiment.
    ///
    /// # Errors
    /// When a body, a material, the schedule or the world is invalid.
    fn read(self, py: Python<'_>) -> PyResult<Experiment> {
        at_once(py, || {
            let bodies = bodies(&self.codes, &self.shapes, &palette(self.materials.as_deref())?)?;
            let setting = setting(self.world_width, self.start_x, &bodies)?;
            Ok(Experiment { bodies, setting, schedule: self.schedule.read(py)? })
        })
    }
}

impl Experiment {
    /// Its env steps, of all bodies together.
    fn env_steps(&self) -> u64 {
        u64::from(self.schedule.steps()) * self.bodies.len() as u64
    }

    /// The memory of the paths in bytes.
    fn path_bytes(&self) -> u64 {
        16 * (self.env_steps() + self.bodies.len() as u64)
    }

    /// Simulates the bodies, some at a time, until the end or an interrupt.
    fn simulate(&self, watch: &Watch, record_com: bool) -> Results {
        let (simulator, mut results) = (watch.simulator(), Results::default());
        let group = (GROUP_STEPS / u64::from(self.schedule.steps()).max(1)).max(1) as usize;
        for bodies in self.bodies.chunks(group) {
            if watch.is_stopped() {
                let stopped = Trajectory { fault: Some(STOPPED), ..Trajectory::default() };
                bodies.iter().for_each(|_| results.push(&stopped, &self.schedule, record_com));
                continue;
            }
            let trial = |body: &Body| Trial { body: body.clone(), schedule: self.schedule.clone() };
            let trials: Vec<Trial> = bodies.iter().map(trial).collect();
            let trajectories = simulator.run_trials(&self.setting, &trials);
            trajectories.iter().for_each(|trajectory| results.push(trajectory, &self.schedule, record_com));
        }
        results
    }

    /// The frames of each robot, and the four points of each of its voxels.
    fn record(&self, watch: &Watch, stride: u32) -> (Vec<Frames>, Vec<Vec<[usize; 4]>>) {
        let mut flock = watch.simulator().flock(&self.setting, &self.bodies);
        let mut frames: Vec<Frames> = vec![Vec::new(); self.bodies.len()];
        let mut record = |flock: &dyn nbc::Flock| {
            for (robot, frames) in frames.iter_mut().enumerate() {
                frames.extend(flock.points(robot).into_iter().flatten());
            }
        };
        record(&*flock);
        for (pattern, steps, is_frame) in stretches(&self.schedule, stride) {
            flock.advance(&vec![pattern; self.bodies.len()], steps);
            if is_frame {
                record(&*flock);
            }
        }
        let corners = |robot| flock.lattice(robot).voxels().iter().map(|voxel| voxel.corners).collect();
        let voxels = (0..flock.len()).map(corners).collect();
        (frames, voxels)
    }
}

/// The results of trials, row after row.
#[derive(Default)]
struct Results {
    displacement: Vec<f64>,
    paths: Vec<Vec<f64>>,
    faults: Vec<Option<Fault>>,
}

impl Results {
    fn push(&mut self, trajectory: &Trajectory, schedule: &Schedule, record_com: bool) {
        self.displacement.extend(trajectory.displacements(schedule).into_iter().map(|moved| moved.unwrap_or(f64::NAN)));
        self.faults.push(trajectory.fault);
        if record_com {
            self.paths.push(trajectory.com_x.iter().zip(&trajectory.com_y).flat_map(|(&x, &y)| [x, y]).collect());
        }
    }

    /// The paths side by side, and the moments of each. After an interrupt these are as many as the longest path has.
    fn com(&mut self, schedule: &Schedule) -> (Vec<f64>, usize) {
        let whole = 2 * (schedule.steps() as usize + 1);
        let is_stopped = |fault: &Option<Fault>| fault.is_some_and(|fault| fault.kind == FaultKind::Stopped);
        let longest = self.paths.iter().map(Vec::len).max().unwrap_or(whole);
        let row = if self.faults.iter().any(is_stopped) { longest } else { whole };
        let mut com = Vec::with_capacity(row * self.paths.len());
        for path in std::mem::take(&mut self.paths) {
            com.extend(path.into_iter().chain(std::iter::repeat(f64::NAN)).take(row));
        }
        (com, row / 2)
    }
}

/// Results as arrays.
fn arrays<'py>(
    py: Python<'py>,
    spells: usize,
    (results, com): (Results, Option<(Vec<f64>, usize)>),
) -> PyResult<Bound<'py, PyDict>> {
    let robots = results.faults.len();
    let arrays = PyDict::new(py);
    arrays.set_item("displacement", results.displacement.into_pyarray(py).reshape([robots, spells])?)?;
    let com = com.map(|(com, moments)| com.into_pyarray(py).reshape([robots, moments, 2])).transpose()?;
    arrays.set_item("com", com)?;
    set_faults(&arrays, results.faults.into_iter())?;
    Ok(arrays)
}

/// Adds the env step and the kind of each fault.
pub fn set_faults(arrays: &Bound<'_, PyDict>, faults: impl Iterator<Item = Option<Fault>>) -> PyResult<()> {
    let (steps, kinds): (Vec<u32>, Vec<&str>) = faults.map(fault_words).unzip();
    arrays.set_item("fault_step", steps.into_pyarray(arrays.py()))?;
    arrays.set_item("fault_kind", kinds)
}

/// Simulates each body from a fresh start under the schedule.
#[pyfunction]
pub fn simulate<'py>(
    py: Python<'py>,
    trials: TrialArguments<'py>,
    record_com: bool,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let experiment = trials.read(py)?;
    if record_com && experiment.path_bytes() > MOST_BYTES {
        let size = experiment.path_bytes() >> 30;
        let message = format!("the paths would need {size} GiB; simulate fewer bodies at once, or with `record=None`");
        return Err(PyMemoryError::new_err(message));
    }
    let watch = Watch::over(experiment.env_steps());
    let spells = experiment.schedule.spells.len();
    let ended = work::run(py, &watch, progress.as_ref(), move |watch| {
        let mut results = experiment.simulate(watch, record_com);
        let com = record_com.then(|| results.com(&experiment.schedule));
        (results, com)
    })?;
    ended.or_partial(py, |results| arrays(py, spells, results))
}

/// The frames of a robot: its points in each, frame after frame.
type Frames = Vec<f64>;
/// The frames of each robot, and the four points of each of its voxels.
type Poses<'py> = (Vec<Bound<'py, PyArray1<f64>>>, Vec<Vec<[usize; 4]>>);

/// The poses of each body under the schedule, every `stride` env steps: a flat array for each, and the four points of
/// each voxel.
#[pyfunction]
pub fn record_poses<'py>(
    py: Python<'py>,
    trials: TrialArguments<'py>,
    stride: u32,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Poses<'py>> {
    let experiment = trials.read(py)?;
    let watch = Watch::over(experiment.env_steps());
    let ended = work::run(py, &watch, progress.as_ref(), move |watch| experiment.record(watch, stride))?;
    let (frames, voxels) = ended.finished()?;
    Ok((frames.into_iter().map(|frames| frames.into_pyarray(py)).collect(), voxels))
}

/// The stretches of env steps between frames and changes of the pattern, and whether a frame ends each.
fn stretches(schedule: &Schedule, stride: u32) -> Vec<(Pattern, u32, bool)> {
    let all = schedule.steps();
    let mut ends: BTreeSet<u32> = (1..=all / stride).map(|frame| frame * stride).collect();
    let changes = schedule.spells.iter().scan(0, |at, spell| {
        *at += spell.steps;
        Some(*at)
    });
    let changes: Vec<u32> = changes.collect();
    ends.extend(&changes);
    let mut before = 0;
    let stretch = |end: u32| {
        let spell = changes.iter().position(|&change| before < change).unwrap_or_default();
        let steps = end - before;
        before = end;
        (schedule.spells[spell].pattern, steps, end.is_multiple_of(stride))
    };
    ends.into_iter().map(stretch).filter(|&(_, steps, _)| steps > 0).collect()
}
