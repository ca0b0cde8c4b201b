//! Trials: bodies under a schedule, from a fresh start.

use std::ops::Range;
use std::sync::Arc;

use nbc::{Body, Fault, FaultKind, Image, Palette, Pattern, Schedule, Setting, Simulator, Spell, Trajectory, Trial};
use numpy::{IntoPyArray, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use crate::bodies::{Batch, palette};
use crate::errors::{bad_value, diagnosed};
use crate::memory::{self, reserved, too_large};
use crate::work::{self, Watch, at_once};

/// The most env steps of trials that are simulated in one go; their trajectories are in memory at the same time.
const GROUP_STEPS: u64 = 5_000_000;

/// Robots whose poses are recorded on one thread.
const TOGETHER: usize = 32;

/// The most memory of recorded paths and poses.
const MOST_BYTES: u64 = 1 << 33;

/// What a call without room for its results can do.
const LESS: &str = "simulate fewer bodies at once, or with `record=None`";

/// The fault of a simulation that was not begun.
pub const STOPPED: Fault = Fault { env_step: 1, kind: FaultKind::Stopped };

/// A schedule as Python gives it: text, or what is shown with env steps.
#[derive(FromPyObject)]
pub enum ScheduleWords {
    /// `00*10 01*56steps`
    Text(String),
    /// What is shown, and env steps.
    Spells(Vec<(Shown, u32)>),
}

/// What a spell shows.
#[derive(FromPyObject)]
pub enum Shown {
    Pattern(String),
    Image(Vec<Vec<f64>>),
}

impl ScheduleWords {
    pub fn read(self, py: Python<'_>, palette: &Palette) -> PyResult<Schedule> {
        let spells = match self {
            Self::Text(text) if palette.image().is_none() => {
                return nbc::read_schedule("schedule", &text, palette.stimuli()).map_err(|found| diagnosed(py, &found));
            }
            Self::Text(text) => vec![(Shown::Pattern(text), 1)],
            Self::Spells(spells) => spells,
        };
        let spell = |(shown, steps): (Shown, u32)| shown.spell(steps, palette);
        Ok(Schedule { spells: spells.into_iter().map(spell).collect::<PyResult<_>>()? })
    }
}

impl Shown {
    fn spell(self, steps: u32, palette: &Palette) -> PyResult<Spell> {
        match (self, palette.image()) {
            (Self::Pattern(digits), None) => Ok(Spell::of(pattern(digits, palette.stimuli())?, steps)),
            (Self::Pattern(digits), Some(size)) => Err(bad_value(format!(
                "the schedule has the pattern `{digits}`, but the materials sense images; expected arrays of \
                 {size} pixels"
            ))),
            (Self::Image(_), None) => Err(bad_value("the schedule has an image, but the materials sense none")),
            (Self::Image(rows), Some(size)) => {
                let image = Image::try_from(rows).map_err(|error| bad_value(format!("an image: {error}")))?;
                if image.size() != size {
                    let found = format!("an image of the schedule has {} pixels", image.size());
                    return Err(bad_value(format!("{found}, but the materials sense {size}")));
                }
                Ok(Spell { image: Some(Arc::new(image)), ..Spell::of(Pattern::default(), steps) })
            }
        }
    }
}

/// The spells of a schedule of the paper's two stimuli: patterns as digits, and env steps.
#[pyfunction]
pub fn read_schedule(py: Python<'_>, schedule: ScheduleWords) -> PyResult<Vec<(String, u32)>> {
    at_once(py, || {
        let palette = Palette::paper();
        let spells = schedule.read(py, &palette)?.spells;
        Ok(spells.into_iter().map(|spell| (spell.pattern.digits(palette.stimuli()), spell.steps)).collect())
    })
}

/// A pattern of digits, one for each stimulus.
pub fn pattern(digits: String, stimuli: usize) -> PyResult<Pattern> {
    let count = digits.len();
    let pattern = Pattern::try_from(digits.clone()).map_err(|error| bad_value(error.to_string()))?;
    if count != stimuli {
        let plural = if count == 1 { "" } else { "s" };
        return Err(bad_value(format!("the pattern `{digits}` has {count} digit{plural}, expected {stimuli}")));
    }
    Ok(pattern)
}

/// Why a body cannot stand in the setting, if it cannot.
pub fn check_place(setting: &Setting, body: &Body) -> Result<(), String> {
    setting.check(body).map_err(|error| error.to_string())
}

pub fn setting(world_width: usize, start_x: Option<usize>) -> Setting {
    Setting { world_width, start_x, ..Setting::default() }
}

#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    Done,
    Fault(Fault),
    /// Before it began, because the body is invalid.
    Invalid,
}

impl From<Option<Fault>> for Ending {
    fn from(fault: Option<Fault>) -> Self {
        fault.map_or(Self::Done, Self::Fault)
    }
}

impl Ending {
    /// The env step that was abandoned, and why; 0 and nothing for none.
    pub fn words(&self) -> (u32, &'static str) {
        match self {
            Self::Done => (0, ""),
            Self::Invalid => (1, "invalid"),
            Self::Fault(Fault { env_step, kind: FaultKind::Unstable }) => (*env_step, "unstable"),
            Self::Fault(Fault { env_step, kind: FaultKind::NonFinite }) => (*env_step, "non_finite"),
            Self::Fault(Fault { env_step, kind: FaultKind::Stopped }) => (*env_step, "stopped"),
        }
    }
}

#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct TrialArguments<'py> {
    codes: PyReadonlyArray1<'py, u8>,
    shapes: PyReadonlyArray2<'py, u64>,
    materials: String,
    schedule: ScheduleWords,
    world_width: usize,
    start_x: Option<usize>,
    /// Whether to keep the paths of the centers of mass.
    record_com: bool,
    /// Env steps between poses, if these are kept too.
    stride: Option<u32>,
}

/// Bodies under a schedule, each in a world of its own.
struct Experiment {
    batch: Batch,
    setting: Setting,
    schedule: Schedule,
    record_com: bool,
    stride: Option<u32>,
}

impl TrialArguments<'_> {
    fn read(self, py: Python<'_>) -> PyResult<Experiment> {
        at_once(py, || {
            let palette = palette(&self.materials)?;
            let experiment = Experiment {
                schedule: self.schedule.read(py, &palette)?,
                batch: Batch::read(&self.codes, &self.shapes, &palette)?,
                setting: setting(self.world_width, self.start_x),
                record_com: self.record_com,
                stride: self.stride,
            };
            experiment.check_memory()?;
            Ok(experiment)
        })
    }
}

struct Recorded {
    trajectory: Trajectory,
    poses: Poses,
}

#[derive(Clone, Debug, Default)]
struct Poses {
    /// Its points, frame after frame.
    frames: Vec<f64>,
    points: usize,
    /// The points of each voxel, by their number: top left, top right, bottom right, bottom left.
    voxels: Vec<[usize; 4]>,
}

impl Experiment {
    /// Its env steps, of all bodies together.
    fn env_steps(&self) -> u64 {
        u64::from(self.schedule.steps()) * self.batch.len() as u64
    }

    /// Moments of a whole path.
    fn moments(&self) -> usize {
        self.schedule.steps() as usize + 1
    }

    fn groups(&self) -> Vec<Range<usize>> {
        self.batch.groups((GROUP_STEPS / u64::from(self.schedule.steps()).max(1)).max(1) as usize)
    }

    /// The memory of the recorded paths and poses in bytes.
    fn recorded_bytes(&self) -> u64 {
        let paths = if self.record_com { 16 * (self.env_steps() + self.batch.len() as u64) } else { 0 };
        let frames = self.stride.map_or(0, |stride| u64::from(self.schedule.steps() / stride) + 1);
        let points: u64 = (0..self.batch.len()).map(|i| self.batch.most_points(i) as u64).sum();
        paths + (16 * points).saturating_mul(frames)
    }

    /// Checks that there is room for the results, and for the simulation of the largest group.
    fn check_memory(&self) -> PyResult<()> {
        let recorded = self.recorded_bytes();
        if recorded > MOST_BYTES {
            return Err(too_large(recorded, "the paths", LESS));
        }
        let steps = u64::from(self.schedule.steps());
        let group = |bodies: Range<usize>| 32 * steps * bodies.len() as u64 + self.batch.bytes(bodies);
        let largest = self.groups().into_iter().map(group).max().unwrap_or(0);
        let spells = 8 * self.schedule.spells.len() as u64 * self.batch.len() as u64;
        memory::check(recorded + largest + spells, "the simulation", LESS)
    }

    /// A body that can stand in its place.
    fn body(&self, i: usize) -> Result<Body, String> {
        self.batch.body(i).and_then(|body| check_place(&self.setting, &body).map(|()| body))
    }

    fn simulate(&self, watch: &Watch) -> PyResult<Results> {
        let simulator = watch.simulator();
        let mut results = Results::new(self)?;
        for group in self.groups() {
            let bodies: Vec<Result<Body, String>> = group.clone().map(|i| self.body(i)).collect();
            let valid: Vec<Body> = bodies.iter().flatten().cloned().collect();
            let mut recorded = self.run(&simulator, watch, valid).into_iter();
            for (i, body) in group.zip(bodies) {
                match body {
                    Err(reason) => results.push_invalid(i, reason),
                    Ok(_) => results.push(recorded.next().expect("each valid body is simulated")),
                }
            }
        }
        Ok(results)
    }

    fn run(&self, simulator: &Simulator, watch: &Watch, bodies: Vec<Body>) -> Vec<Recorded> {
        let only = |trajectory| Recorded { trajectory, poses: Poses::default() };
        match self.stride {
            _ if watch.is_stopped() => {
                bodies.iter().map(|_| only(Trajectory { fault: Some(STOPPED), ..Trajectory::default() })).collect()
            }
            None => {
                let trial = |body| Trial { body, schedule: self.schedule.clone() };
                let trials: Vec<Trial> = bodies.into_iter().map(trial).collect();
                simulator.run_trials(&self.setting, &trials).into_iter().map(only).collect()
            }
            Some(stride) => {
                let together = |bodies: &[Body]| self.record(simulator, bodies, stride);
                bodies.par_chunks(TOGETHER).flat_map_iter(together).collect()
            }
        }
    }

    /// Simulates these bodies env step by env step, with a pose every `stride` of them.
    fn record(&self, simulator: &Simulator, bodies: &[Body], stride: u32) -> Vec<Recorded> {
        let mut flock = simulator.flock(&self.setting, bodies);
        let new = |i: usize| {
            let voxels = flock.lattice(i).voxels().iter().map(|voxel| voxel.corners).collect();
            let poses = Poses { points: flock.lattice(i).points().len(), voxels, frames: Vec::new() };
            Recorded { trajectory: Trajectory::default(), poses }
        };
        let mut recorded: Vec<Recorded> = (0..flock.len()).map(new).collect();
        record_moment(&*flock, &mut recorded, true);
        let each_step = |spell: &Spell| {
            let each = vec![Spell { steps: 1, ..spell.clone() }; bodies.len()];
            std::iter::repeat_n(each, spell.steps as usize)
        };
        for (env_step, spells) in (1..).zip(self.schedule.spells.iter().flat_map(each_step)) {
            flock.advance_under(&spells);
            record_moment(&*flock, &mut recorded, u32::is_multiple_of(env_step, stride));
            let is_stopped = |i| flock.fault(i).is_some_and(|fault| fault.kind == FaultKind::Stopped);
            if (0..flock.len()).any(is_stopped) {
                // Robots that had done this env step before the interrupt have no fault yet.
                let next = Fault { env_step: env_step + 1, ..STOPPED };
                for Recorded { trajectory, .. } in recorded.iter_mut().filter(|_| env_step < self.schedule.steps()) {
                    trajectory.fault.get_or_insert(next);
                }
                break;
            }
        }
        recorded
    }
}

/// Records the centers of mass of robots without a fault, and, in a frame, the points of all.
fn record_moment(flock: &dyn nbc::Flock, recorded: &mut [Recorded], is_frame: bool) {
    for (i, Recorded { trajectory, poses }) in recorded.iter_mut().enumerate() {
        trajectory.fault = flock.fault(i);
        if trajectory.fault.is_none() {
            let [x, y] = flock.center(i);
            trajectory.com_x.push(x);
            trajectory.com_y.push(y);
        }
        let is_stopped = trajectory.fault.is_some_and(|fault| fault.kind == FaultKind::Stopped);
        if is_frame && !is_stopped {
            poses.frames.extend(flock.points(i).into_iter().flatten());
        }
    }
}

struct Results {
    schedule: Schedule,
    displacement: Vec<f64>,
    /// The paths, each as long as a whole one.
    com: Option<Vec<f64>>,
    /// Numbers of a whole path.
    row: usize,
    /// Numbers of the longest path.
    longest: usize,
    endings: Vec<Ending>,
    errors: Vec<(usize, String)>,
    /// Numbers of frames of a whole simulation, if poses are kept.
    frames: Option<usize>,
    poses: Vec<Poses>,
}

impl Results {
    fn new(experiment: &Experiment) -> PyResult<Self> {
        let (bodies, row) = (experiment.batch.len(), 2 * experiment.moments());
        Ok(Self {
            displacement: reserved(bodies * experiment.schedule.spells.len())?,
            com: if experiment.record_com { Some(reserved(bodies * row)?) } else { None },
            row,
            longest: 2,
            endings: reserved(bodies)?,
            errors: Vec::new(),
            frames: experiment.stride.map(|stride| (experiment.schedule.steps() / stride) as usize + 1),
            poses: Vec::new(),
            schedule: experiment.schedule.clone(),
        })
    }

    fn push(&mut self, Recorded { trajectory, poses }: Recorded) {
        let Trajectory { com_x, com_y, fault, .. } = &trajectory;
        let moved = trajectory.displacements(&self.schedule);
        self.displacement.extend(moved.into_iter().map(|moved| moved.unwrap_or(f64::NAN)));
        self.longest = self.longest.max(2 * com_x.len());
        if let Some(com) = &mut self.com {
            let path = com_x.iter().zip(com_y).flat_map(|(&x, &y)| [x, y]);
            com.extend(path.chain(std::iter::repeat(f64::NAN)).take(self.row));
        }
        self.endings.push((*fault).into());
        if self.frames.is_some() {
            self.poses.push(poses);
        }
    }

    fn push_invalid(&mut self, body: usize, reason: String) {
        self.push(Recorded { trajectory: Trajectory::default(), poses: Poses::default() });
        *self.endings.last_mut().expect("the body was added") = Ending::Invalid;
        self.errors.push((body, reason));
    }

    /// After an interrupt, shortens the rows of the paths to the longest path.
    fn shorten(&mut self) {
        let is_stopped = |ending: &Ending| ending.words().1 == "stopped";
        if let Some(com) = self.com.as_mut().filter(|_| self.endings.iter().any(is_stopped)) {
            for robot in 0..self.endings.len() {
                com.copy_within(robot * self.row..robot * self.row + self.longest, robot * self.longest);
            }
            com.truncate(self.endings.len() * self.longest);
            self.row = self.longest;
        }
    }

    fn into_python(mut self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        self.shorten();
        let (robots, spells, moments) = (self.endings.len(), self.schedule.spells.len(), self.row / 2);
        let arrays = PyDict::new(py);
        arrays.set_item("displacement", self.displacement.into_pyarray(py).reshape([robots, spells])?)?;
        let com = self.com.map(|com| com.into_pyarray(py).reshape([robots, moments, 2])).transpose()?;
        arrays.set_item("com", com)?;
        set_endings(&arrays, &self.endings)?;
        arrays.set_item("errors", self.errors)?;
        if let Some(frames) = self.frames {
            let array = |poses: &mut Poses| poses_array(py, poses, frames);
            let shown = self.poses.iter_mut().map(array).collect::<PyResult<Vec<_>>>()?;
            arrays.set_item("poses", shown)?;
            arrays.set_item("voxels", self.poses.into_iter().map(|poses| poses.voxels).collect::<Vec<_>>())?;
        }
        Ok(arrays)
    }
}

/// The frames of a robot; of an invalid body all are without points.
fn poses_array<'py>(py: Python<'py>, poses: &mut Poses, whole: usize) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let frames = std::mem::take(&mut poses.frames);
    let count = if poses.points == 0 { whole } else { frames.len() / (2 * poses.points) };
    frames.into_pyarray(py).reshape([count, poses.points, 2])
}

pub fn set_endings(arrays: &Bound<'_, PyDict>, endings: &[Ending]) -> PyResult<()> {
    let (steps, kinds): (Vec<u32>, Vec<&str>) = endings.iter().map(Ending::words).unzip();
    arrays.set_item("fault_step", steps.into_pyarray(arrays.py()))?;
    arrays.set_item("fault_kind", kinds)
}

/// Simulates each body from a fresh start under the schedule.
#[pyfunction]
pub fn simulate<'py>(
    py: Python<'py>,
    trials: TrialArguments<'py>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let experiment = trials.read(py)?;
    let watch = Watch::over(experiment.env_steps());
    let ended = work::run(py, &watch, progress.as_ref(), move |watch| experiment.simulate(watch))?;
    ended.or_partial(py, |results| results?.into_python(py))
}
