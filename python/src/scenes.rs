//! Evolution Gym's worlds: robots that are driven from outside, on terrain and among objects.

use nbc::{Constants, Grid, Scene, SceneObject, SceneState, Scenes as Simulations, State};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::errors::bad_value;
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

/// An object: its codes, row 0 on top, and the column and row of its lower left corner.
type Object<'py> = (PyReadonlyArray2<'py, u8>, usize, usize);

/// Positions and velocities.
type Moving<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>);

/// The state of a scene: position, earlier position and velocity of each point that moves, env steps, and the fault.
type Kept<'py> = (Bound<'py, PyArray2<f64>>, u32, Option<(u32, String)>);

/// Scenes, each a world of its own.
#[pyclass(frozen)]
pub struct Scenes {
    scenes: Slot<Simulations>,
    size: usize,
}

#[pymethods]
impl Scenes {
    #[new]
    fn new(py: Python<'_>, scenes: Vec<Vec<Object<'_>>>) -> PyResult<Self> {
        let size = scenes.len();
        let made = at_once(py, || {
            let constants = Constants::default();
            let scenes = scenes.iter().map(|objects| scene(objects, &constants)).collect::<PyResult<Vec<Scene>>>()?;
            Ok(Simulations::new(scenes))
        })?;
        Ok(Self { scenes: Slot::new("simulation", made), size })
    }

    fn __len__(&self) -> usize {
        self.size
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
        if env_steps > PORTION || self.size >= FEW {
            let advance = move |scenes: &mut Simulations, watch: &Watch| advance(scenes, env_steps, watch);
            return self.scenes.run(py, &Watch::over(0), None, advance)?.finished();
        }
        self.scenes.with(py, |scenes| {
            py.detach(|| scenes.advance(env_steps));
            Ok(())
        })
    }

    /// Puts a scene back to its start.
    fn reset(&self, py: Python<'_>, scene: usize) -> PyResult<()> {
        self.scenes.with(py, |scenes| {
            scenes.reset(scene);
            Ok(())
        })
    }

    /// The places of an object's actuators in the targets of a scene.
    fn channels(&self, py: Python<'_>, scene: usize, object: usize) -> PyResult<(usize, usize)> {
        self.scenes.with(py, |scenes| {
            let channels = scenes.scene(scene).channels(object);
            Ok((channels.start, channels.end))
        })
    }

    /// The points of an object in each of these scenes, one scene after another: position in voxels, and velocity in
    /// voxels per second.
    fn points<'py>(&self, py: Python<'py>, scenes: Vec<usize>, object: usize) -> PyResult<Moving<'py>> {
        let (positions, velocities) = self.scenes.with(py, |all| {
            let constants = Constants::default();
            let (mut positions, mut velocities): (Vec<[f64; 2]>, Vec<[f64; 2]>) = (Vec::new(), Vec::new());
            for n in scenes {
                let state = all.state(n).state;
                positions.extend(all.scene(n).positions(object, &state, &constants));
                velocities.extend(all.scene(n).velocities(object, &state, &constants));
            }
            Ok((positions, velocities))
        })?;
        Ok((array(py, positions)?, array(py, velocities)?))
    }

    /// How far an object has turned in each of these scenes.
    fn turns<'py>(&self, py: Python<'py>, scenes: Vec<usize>, object: usize) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let turns: Vec<f64> =
            self.scenes.with(py, |all| Ok(scenes.iter().map(|&scene| all.turn(scene, object)).collect()))?;
        Ok(turns.into_pyarray(py))
    }

    /// The four points of each voxel of an object, by their places among its points.
    fn voxels(&self, py: Python<'_>, scene: usize, object: usize) -> PyResult<Vec<[usize; 4]>> {
        self.scenes.with(py, |scenes| Ok(scenes.scene(scene).voxels(object)))
    }

    /// The env step that was abandoned in each scene, 0 for none.
    fn faults<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u32>>> {
        let steps: Vec<u32> = self.scenes.with(py, |scenes| {
            Ok((0..scenes.len()).map(|n| scenes.fault(n).map_or(0, |fault| fault.env_step)).collect())
        })?;
        Ok(steps.into_pyarray(py))
    }

    /// Env steps that each scene has done.
    fn clocks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u32>>> {
        let clocks: Vec<u32> =
            self.scenes.with(py, |scenes| Ok((0..scenes.len()).map(|n| scenes.clock(n)).collect()))?;
        Ok(clocks.into_pyarray(py))
    }

    /// The state of a scene, for `restore`.
    fn state<'py>(&self, py: Python<'py>, scene: usize) -> PyResult<Kept<'py>> {
        let SceneState { state, clock, fault } = self.scenes.with(py, |scenes| Ok(scenes.state(scene)))?;
        let State { position, previous, velocity } = state;
        let all: Vec<[f64; 2]> = [position, previous, velocity].concat();
        let words = Ending::from(fault).words();
        Ok((array(py, all)?, clock, fault.map(|_| (words.0, words.1.to_owned()))))
    }

    /// Sets a scene to an earlier state.
    fn restore(
        &self,
        py: Python<'_>,
        scene: usize,
        points: PyReadonlyArray2<'_, f64>,
        clock: u32,
        fault: Option<(u32, String)>,
    ) -> PyResult<()> {
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
            if scenes.state(scene).state.position.len() != count || all.len() != 3 * count {
                return Err(bad_value("the state is of other objects"));
            }
            scenes.restore(scene, &SceneState { state, clock, fault });
            Ok(())
        })
    }

    /// Ends the simulation.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        self.scenes.close(py)
    }
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

/// The scene of these objects.
fn scene(objects: &[Object<'_>], constants: &Constants) -> PyResult<Scene> {
    let read = |(codes, column, row): &Object<'_>| {
        let codes = codes.as_array();
        let (height, width) = codes.dim();
        if column.saturating_add(width).max(row.saturating_add(height)) > MOST_CELLS {
            return Err(bad_value(format!("a world has at most {MOST_CELLS} columns and rows")));
        }
        if codes.iter().any(|&code| code > 5) {
            return Err(bad_value("codes of voxels are 0 to 5"));
        }
        let codes: Vec<u8> = codes.iter().copied().collect();
        Ok(SceneObject { grid: Grid::structure(width, height, &codes), at: [*column, *row] })
    };
    let objects = objects.iter().map(read).collect::<PyResult<Vec<SceneObject>>>()?;
    if objects.iter().all(|object| object.grid.is_fixed()) {
        return Err(bad_value("nothing in the world can move"));
    }
    Ok(Scene::new(&objects, constants))
}

/// Points as an array of numpy.
fn array(py: Python<'_>, points: Vec<[f64; 2]>) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let count = points.len();
    points.into_flattened().into_pyarray(py).reshape([count, 2])
}
