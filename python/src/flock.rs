//! Robots that are advanced step by step.

use nbc::{Flock as Robots, Pattern, Snapshot};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::bodies::{Batch, palette};
use crate::errors::bad_value;
use crate::memory;
use crate::physics::{Ending, check_place, pattern, setting};
use crate::slot::Slot;
use crate::work::{self, Watch, at_once};

/// Robots, each alone in its own simulation.
#[pyclass(frozen)]
pub struct Flock {
    robots: Slot<Setup>,
    size: usize,
}

/// Bodies with their simulation. A simulator that was stopped stays so, and with it its robots: after an interrupt they
/// are made again.
struct Setup {
    bodies: Vec<nbc::Body>,
    setting: nbc::Setting,
    watch: std::sync::Arc<Watch>,
    robots: Box<dyn Robots>,
}

impl Setup {
    fn new(bodies: Vec<nbc::Body>, setting: nbc::Setting) -> Self {
        let watch = Watch::over(0);
        let robots = watch.simulator().flock(&setting, &bodies);
        Self { bodies, setting, watch, robots }
    }

    fn snapshots(&self) -> Vec<Snapshot> {
        (0..self.robots.len()).map(|robot| self.robots.snapshot(robot)).collect()
    }

    fn restore(&mut self, snapshots: &[Snapshot]) {
        for (robot, snapshot) in snapshots.iter().enumerate() {
            self.robots.restore(robot, snapshot);
        }
    }

    /// Simulates, or, if this is interrupted, leaves everything as it was.
    fn advance(&mut self, patterns: &[Pattern], env_steps: u32) {
        let before = self.snapshots();
        self.robots.advance(patterns, env_steps);
        if self.watch.is_stopped() {
            *self = Self::new(std::mem::take(&mut self.bodies), self.setting);
            self.restore(&before);
        }
    }
}

#[pyclass(frozen)]
pub struct FlockState(Vec<Snapshot>);

#[pymethods]
impl Flock {
    #[new]
    fn new(
        py: Python<'_>,
        codes: PyReadonlyArray1<'_, u8>,
        shapes: PyReadonlyArray2<'_, u64>,
        materials: &str,
        world_width: usize,
        start_x: Option<usize>,
    ) -> PyResult<Self> {
        let setting = setting(world_width, start_x);
        let bodies = at_once(py, || {
            let batch = Batch::read(&codes, &shapes, &palette(materials)?)?;
            memory::check(batch.bytes(0..batch.len()), "the flock", "use fewer bodies at once")?;
            batch.all(|body| check_place(&setting, body))
        })?;
        let size = bodies.len();
        let made = work::run(py, &Watch::over(0), None, move |_| Setup::new(bodies, setting))?;
        Ok(Self { size, robots: Slot::new("flock", made.finished()?) })
    }

    fn __len__(&self) -> usize {
        self.size
    }

    /// Simulates env steps, robot `i` under `patterns[i]`.
    fn advance(&self, py: Python<'_>, patterns: Vec<String>, env_steps: u32) -> PyResult<()> {
        if patterns.len() != self.size {
            let (found, expected) = (patterns.len(), self.size);
            return Err(bad_value(format!("{found} patterns, expected {expected}: one for each robot")));
        }
        let (watch, stimuli) = self.robots.with(py, |setup| {
            let stimuli = setup.bodies.first().map_or(0, |body| body.palette().stimuli());
            Ok((setup.watch.clone(), stimuli))
        })?;
        let read = |digits: String| pattern(digits, stimuli);
        let patterns = patterns.into_iter().map(read).collect::<PyResult<Vec<Pattern>>>()?;
        self.robots.run(py, &watch, None, move |setup, _| setup.advance(&patterns, env_steps))?.finished()
    }

    fn centers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let centers: Vec<f64> = self
            .robots
            .with(py, |setup| Ok((0..setup.robots.len()).flat_map(|robot| setup.robots.center(robot)).collect()))?;
        centers.into_pyarray(py).reshape([self.size, 2])
    }

    fn clocks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u32>>> {
        let clocks: Vec<u32> = self
            .robots
            .with(py, |setup| Ok((0..setup.robots.len()).map(|robot| setup.robots.clock(robot)).collect()))?;
        Ok(clocks.into_pyarray(py))
    }

    /// Env step and kind of each robot's fault.
    fn faults(&self, py: Python<'_>) -> PyResult<Vec<(u32, &'static str)>> {
        self.robots.with(py, |setup| {
            Ok((0..setup.robots.len()).map(|robot| Ending::from(setup.robots.fault(robot)).words()).collect())
        })
    }

    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        let points: Vec<Vec<[f64; 2]>> = self
            .robots
            .with(py, |setup| Ok((0..setup.robots.len()).map(|robot| setup.robots.points(robot)).collect()))?;
        let array = |points: Vec<[f64; 2]>| {
            let count = points.len();
            points.into_iter().flatten().collect::<Vec<f64>>().into_pyarray(py).reshape([count, 2])
        };
        points.into_iter().map(array).collect()
    }

    /// The four points of each voxel of a robot, by their places in its pose.
    fn voxels(&self, py: Python<'_>, robot: usize) -> PyResult<Vec<[usize; 4]>> {
        self.robots
            .with(py, |setup| Ok(setup.robots.lattice(robot).voxels().iter().map(|voxel| voxel.corners).collect()))
    }

    fn snapshot(&self, py: Python<'_>) -> PyResult<FlockState> {
        self.robots.with(py, |setup| Ok(FlockState(setup.snapshots())))
    }

    fn restore(&self, py: Python<'_>, state: &FlockState) -> PyResult<()> {
        self.robots.with(py, |setup| {
            let points = |snapshot: &Snapshot| snapshot.state.position.len();
            let own: Vec<usize> = setup.snapshots().iter().map(points).collect();
            if own != state.0.iter().map(points).collect::<Vec<_>>() {
                return Err(bad_value("the state is of other bodies"));
            }
            setup.restore(&state.0);
            Ok(())
        })
    }

    /// Panics at work on the robots as a fault of the library would: at once or in a thread. For the tests.
    fn panic(&self, py: Python<'_>, at_once: bool) -> PyResult<()> {
        if at_once {
            return self.robots.with(py, |_| panic!("a test at once"));
        }
        self.robots.run(py, &Watch::over(0), None, |_, _| panic!("a test in a thread"))?.finished()
    }

    fn close(&self, py: Python<'_>) -> PyResult<()> {
        self.robots.close(py)
    }
}
