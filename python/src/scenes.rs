//! Evolution Gym's worlds: robots that are driven from outside, on terrain and among objects.

use std::sync::atomic::{AtomicU64, Ordering};

use nbc::{Constants, Grid, Scene, SceneObject, SceneState, Scenes as Simulations, Sight, State};
use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;

use crate::errors::bad_value;
use crate::memory;
use crate::physics::Ending;
use crate::slot::Slot;
use crate::work::{Watch, at_once};

/// With fewer scenes than this the caller's thread simulates a portion of env steps: another thread would cost more
/// than it does.
const FEW: usize = 9;

/// Env steps between two looks for an interrupt: some milliseconds of work.
const PORTION: u32 = 64;

/// The most columns and rows of a world: a table has a place for each of its cells.
const MOST_CELLS: usize = 4096;

/// An object: its codes, row 0 on top, the column and row of its lower left corner, and the neighbors that are left
/// apart, by their places in reading order.
type Object<'py> = (PyReadonlyArray2<'py, u8>, usize, usize, Vec<[usize; 2]>);

/// Numbers of scenes, or of an object in each of them.
type Numbers<'py> = PyReadonlyArray1<'py, usize>;

type Table<'py> = Bound<'py, PyArray2<f64>>;

type Column<'py, T> = Bound<'py, PyArray1<T>>;

type Moving<'py> = (Table<'py>, Table<'py>);

/// The state of a scene: position, earlier position and velocity of each point that moves, env steps, and the fault.
type Kept<'py> = (Table<'py>, u32, Option<(u32, String)>);

#[pyclass(frozen)]
pub struct Scenes {
    scenes: Slot<Simulations>,
    size: usize,
    changes: AtomicU64,
}

#[pymethods]
impl Scenes {
    #[new]
    fn new(py: Python<'_>, scenes: Vec<Vec<Object<'_>>>) -> PyResult<Self> {
        let size = scenes.len();
        let voxels =
            scenes.iter().flatten().map(|(codes, ..)| codes.as_array().iter().filter(|&&code| code > 0).count());
        let bytes = (voxels.sum::<usize>() as u64).saturating_mul(memory::VOXEL_BYTES);
        memory::check(bytes, "the worlds", "use fewer or smaller worlds")?;
        let made = at_once(py, || {
            let constants = Constants::default();
            let scenes = scenes.iter().map(|objects| scene(objects, &constants)).collect::<PyResult<Vec<Scene>>>()?;
            Ok(Simulations::new(scenes))
        })?;
        Ok(Self { scenes: Slot::new("simulation", made), size, changes: AtomicU64::new(0) })
    }

    fn __len__(&self) -> usize {
        self.size
    }

    /// A number that grows whenever the state of a scene changes.
    fn changes(&self) -> u64 {
        self.changes.load(Ordering::Relaxed)
    }

    /// Sets the targets of the actuators of all scenes, one scene after another.
    fn act(&self, py: Python<'_>, targets: PyReadonlyArray1<'_, f64>) -> PyResult<()> {
        let mut rest = targets.as_slice()?;
        self.scenes.with(py, |scenes| {
            for n in 0..scenes.len() {
                let Some((own, others)) = rest.split_at_checked(scenes.scene(n).targets()) else {
                    return Err(bad_value("fewer targets than actuators"));
                };
                scenes.set_targets(n, own);
                rest = others;
            }
            if rest.is_empty() { Ok(()) } else { Err(bad_value("more targets than actuators")) }
        })
    }

    /// Simulates env steps. After an interrupt the scenes are as before.
    fn step(&self, py: Python<'_>, env_steps: u32) -> PyResult<()> {
        self.changes.fetch_add(1, Ordering::Relaxed);
        if env_steps > PORTION || self.size >= FEW {
            let advance = move |scenes: &mut Simulations, watch: &Watch| advance(scenes, env_steps, watch);
            return self.scenes.run(py, &Watch::over(0), None, advance)?.finished();
        }
        self.scenes.with(py, |scenes| {
            py.detach(|| scenes.advance(env_steps));
            Ok(())
        })
    }

    fn reset(&self, py: Python<'_>, scene: usize) -> PyResult<()> {
        self.changes.fetch_add(1, Ordering::Relaxed);
        self.scenes.with(py, |scenes| {
            known(scenes, scene)?;
            scenes.reset(scene);
            Ok(())
        })
    }

    /// The places of an object's actuators in the targets of a scene.
    fn channels(&self, py: Python<'_>, scene: usize, object: usize) -> PyResult<(usize, usize)> {
        self.scenes.with(py, |scenes| {
            let channels = look(scenes, scene, object)?.0.channels(object);
            Ok((channels.start, channels.end))
        })
    }

    /// The points of an object in each of these scenes, one scene after another: position in voxels, and velocity in
    /// voxels per second.
    fn points<'py>(&self, py: Python<'py>, scenes: Numbers<'py>, objects: Numbers<'py>) -> PyResult<Moving<'py>> {
        let constants = Constants::default();
        let (mut positions, mut velocities): (Vec<[f64; 2]>, Vec<[f64; 2]>) = (Vec::new(), Vec::new());
        self.each(py, &scenes, &objects, |_, scene, object, state| {
            positions.extend(scene.positions(object, state, &constants));
            velocities.extend(scene.velocities(object, state, &constants));
        })?;
        Ok((array(py, positions)?, array(py, velocities)?))
    }

    fn counts<'py>(
        &self,
        py: Python<'py>,
        scenes: Numbers<'py>,
        objects: Numbers<'py>,
    ) -> PyResult<Column<'py, usize>> {
        let (constants, mut counts) = (Constants::default(), Vec::new());
        self.each(py, &scenes, &objects, |_, scene, object, state| {
            counts.push(scene.positions(object, state, &constants).len());
        })?;
        Ok(counts.into_pyarray(py))
    }

    /// Means over the points of an object in each of these scenes: their place in voxels and in meters, and their
    /// velocity in voxels and in meters per second, x before y.
    fn centers<'py>(&self, py: Python<'py>, scenes: Numbers<'py>, objects: Numbers<'py>) -> PyResult<Table<'py>> {
        let constants = Constants::default();
        self.table(py, &scenes, &objects, 8, |scene, object, state, row| {
            let center = scene.center(object, state, &constants);
            let means = [center.place, center.place_in_meters, center.velocity, center.velocity_in_meters];
            row.copy_from_slice(means.as_flattened());
        })
    }

    /// The points of an object from its center of mass in each of these scenes, in voxels: first x, then y, each with
    /// room for that many points.
    fn shapes<'py>(
        &self,
        py: Python<'py>,
        scenes: Numbers<'py>,
        objects: Numbers<'py>,
        most: usize,
    ) -> PyResult<Table<'py>> {
        let constants = Constants::default();
        self.table(py, &scenes, &objects, 2 * most, |scene, object, state, row| {
            let middle = scene.center(object, state, &constants).place;
            let (xs, ys) = row.split_at_mut(most);
            for ((at, x), y) in scene.positions(object, state, &constants).iter().zip(xs).zip(ys) {
                (*x, *y) = (at[0] - middle[0], at[1] - middle[1]);
            }
        })
    }

    /// How far below (or above) the center of mass of an object the terrain is in each column, in voxels. `terrain` has
    /// the numbers of the objects that are terrain, a row for each scene.
    #[expect(clippy::too_many_arguments, reason = "each is an argument of Evolution Gym's, too")]
    fn surface<'py>(
        &self,
        py: Python<'py>,
        scenes: Numbers<'py>,
        objects: Numbers<'py>,
        terrain: PyReadonlyArray2<'py, usize>,
        columns: usize,
        reach: f64,
        is_above: bool,
    ) -> PyResult<Table<'py>> {
        let (constants, sight) = (Constants::default(), Sight { columns, reach, is_above });
        let terrain = terrain.as_array();
        let mut rows = terrain.rows().into_iter();
        let mut wrong = None;
        let found = self.table(py, &scenes, &objects, 2 * columns + 1, |scene, object, state, row| {
            let terrain: Vec<usize> = rows.next().into_iter().flatten().copied().collect();
            match terrain.iter().find(|&&object| object >= scene.objects()) {
                Some(&object) => wrong = Some(object),
                None => row.copy_from_slice(&scene.surface(object, &terrain, &sight, state, &constants)),
            }
        });
        wrong.map_or(found, |object| Err(no_object(object)))
    }

    /// The width and the height of an object in each of these scenes, and the area of the convex hull of its points, in
    /// voxels.
    fn extents<'py>(&self, py: Python<'py>, scenes: Numbers<'py>, objects: Numbers<'py>) -> PyResult<Table<'py>> {
        let constants = Constants::default();
        self.table(py, &scenes, &objects, 3, |scene, object, state, row| {
            row.copy_from_slice(&scene.extent(object, state, &constants));
        })
    }

    fn turns<'py>(&self, py: Python<'py>, scenes: Numbers<'py>, objects: Numbers<'py>) -> PyResult<Column<'py, f64>> {
        let mut turns = Vec::new();
        self.each(py, &scenes, &objects, |_, scene, object, state| turns.push(scene.turn(object, state)))?;
        Ok(turns.into_pyarray(py))
    }

    /// The four points of each voxel of an object, by their places among its points.
    fn voxels(&self, py: Python<'_>, scene: usize, object: usize) -> PyResult<Vec<[usize; 4]>> {
        self.scenes.with(py, |scenes| Ok(look(scenes, scene, object)?.0.voxels(object)))
    }

    /// The env step that was abandoned in each scene, 0 for none.
    fn faults<'py>(&self, py: Python<'py>) -> PyResult<Column<'py, u32>> {
        let steps: Vec<u32> = self.scenes.with(py, |scenes| {
            Ok((0..scenes.len()).map(|n| scenes.fault(n).map_or(0, |fault| fault.env_step)).collect())
        })?;
        Ok(steps.into_pyarray(py))
    }

    fn clocks<'py>(&self, py: Python<'py>) -> PyResult<Column<'py, u32>> {
        let clocks: Vec<u32> =
            self.scenes.with(py, |scenes| Ok((0..scenes.len()).map(|n| scenes.clock(n)).collect()))?;
        Ok(clocks.into_pyarray(py))
    }

    fn state<'py>(&self, py: Python<'py>, scene: usize) -> PyResult<Kept<'py>> {
        let SceneState { state, clock, fault } = self.scenes.with(py, |scenes| {
            known(scenes, scene)?;
            Ok(scenes.state(scene))
        })?;
        let State { position, previous, velocity } = state;
        let all: Vec<[f64; 2]> = [position, previous, velocity].concat();
        let words = Ending::from(fault).words();
        Ok((array(py, all)?, clock, fault.map(|_| (words.0, words.1.to_owned()))))
    }

    fn restore(
        &self,
        py: Python<'_>,
        scene: usize,
        points: PyReadonlyArray2<'_, f64>,
        clock: u32,
        fault: Option<(u32, String)>,
    ) -> PyResult<()> {
        self.changes.fetch_add(1, Ordering::Relaxed);
        let values = points.as_slice()?;
        let all: Vec<[f64; 2]> = values.chunks_exact(2).map(|at| [at[0], at[1]]).collect();
        let count = all.len() / 3;
        let state = State {
            position: all[..count].to_vec(),
            previous: all[count..2 * count].to_vec(),
            velocity: all[2 * count..].to_vec(),
        };
        let fault = fault.map(|(env_step, kind)| nbc::Fault {
            env_step,
            kind: if kind == "unstable" { nbc::FaultKind::Unstable } else { nbc::FaultKind::NonFinite },
        });
        self.scenes.with(py, |scenes| {
            known(scenes, scene)?;
            if scenes.state(scene).state.position.len() != count || all.len() != 3 * count {
                return Err(bad_value("the state is of other objects"));
            }
            scenes.restore(scene, &SceneState { state, clock, fault });
            Ok(())
        })
    }

    fn close(&self, py: Python<'_>) -> PyResult<()> {
        self.scenes.close(py)
    }
}

impl Scenes {
    /// Looks at an object of each of these scenes: at the number of the look, the scene, the object and the state.
    fn each(
        &self,
        py: Python<'_>,
        scenes: &Numbers<'_>,
        objects: &Numbers<'_>,
        mut see: impl FnMut(usize, &Scene, usize, &State),
    ) -> PyResult<()> {
        let (scenes, objects) = (scenes.as_slice()?, objects.as_slice()?);
        self.scenes.with(py, |all| {
            for (n, (&scene, &object)) in scenes.iter().zip(objects).enumerate() {
                let (scene, state) = look(all, scene, object)?;
                see(n, scene, object, state);
            }
            Ok(())
        })
    }

    /// A row of numbers for an object of each of these scenes.
    fn table<'py>(
        &self,
        py: Python<'py>,
        scenes: &Numbers<'py>,
        objects: &Numbers<'py>,
        columns: usize,
        mut fill: impl FnMut(&Scene, usize, &State, &mut [f64]),
    ) -> PyResult<Table<'py>> {
        let rows = scenes.len();
        let mut values = vec![0.0; rows * columns];
        self.each(py, scenes, objects, |n, scene, object, state| {
            fill(scene, object, state, &mut values[n * columns..][..columns]);
        })?;
        values.into_pyarray(py).reshape([rows, columns])
    }
}

fn known(scenes: &Simulations, scene: usize) -> PyResult<()> {
    let is_known = scene < scenes.len();
    if is_known { Ok(()) } else { Err(PyIndexError::new_err(format!("there is no scene {scene}"))) }
}

/// A scene with its state, if it has such an object.
fn look(scenes: &mut Simulations, scene: usize, object: usize) -> PyResult<(&Scene, &State)> {
    known(scenes, scene)?;
    let found = scenes.look(scene);
    if object < found.0.objects() { Ok(found) } else { Err(no_object(object)) }
}

fn no_object(object: usize) -> PyErr {
    PyIndexError::new_err(format!("there is no object {object}"))
}

/// Simulates env steps in portions; if the watch ends them, the scenes are put back.
fn advance(scenes: &mut Simulations, env_steps: u32, watch: &Watch) {
    if env_steps <= PORTION {
        return scenes.advance(env_steps);
    }
    let before: Vec<SceneState> = (0..scenes.len()).map(|n| scenes.state(n)).collect();
    for done in (0..env_steps).step_by(PORTION as usize) {
        if watch.is_stopped() {
            before.iter().enumerate().for_each(|(n, state)| scenes.restore(n, state));
            return;
        }
        scenes.advance(PORTION.min(env_steps - done));
    }
}

fn scene(objects: &[Object<'_>], constants: &Constants) -> PyResult<Scene> {
    let read = |(codes, column, row, apart): &Object<'_>| {
        let codes = codes.as_array();
        let (height, width) = codes.dim();
        if column.saturating_add(width).max(row.saturating_add(height)) > MOST_CELLS {
            return Err(bad_value(format!("a world has at most {MOST_CELLS} columns and rows")));
        }
        if codes.iter().any(|&code| code > 5) {
            return Err(bad_value("codes of voxels are 0 to 5"));
        }
        let codes: Vec<u8> = codes.iter().copied().collect();
        let grid = Grid::structure(width, height, &codes).with_apart(apart.iter().copied());
        Ok(SceneObject { grid, at: [*column, *row] })
    };
    let objects = objects.iter().map(read).collect::<PyResult<Vec<SceneObject>>>()?;
    if objects.iter().all(|object| object.grid.is_fixed()) {
        return Err(bad_value("nothing in the world can move"));
    }
    Ok(Scene::new(&objects, constants))
}

fn array(py: Python<'_>, points: Vec<[f64; 2]>) -> PyResult<Table<'_>> {
    let count = points.len();
    points.into_flattened().into_pyarray(py).reshape([count, 2])
}
