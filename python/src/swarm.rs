//! Swarms that are simulated cycle by cycle.

use nbc::LiveSwarm;
use numpy::{IntoPyArray, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use crate::errors::{bad_value, robot_fault};
use crate::slot::Slot;
use crate::work::Watch;

/// A swarm during its simulation.
#[pyclass(frozen)]
pub struct Swarm {
    live: Slot<LiveSwarm>,
    bits: usize,
}

impl Swarm {
    /// A swarm at its start.
    pub fn new(live: LiveSwarm) -> Self {
        let bits = live.trace().inputs.iter().map(|port| port.width).sum();
        Self { live: Slot::new("swarm", live), bits }
    }
}

#[pymethods]
impl Swarm {
    /// Simulates cycles with these bits on the input ports; the bits of the output ports after each. A cycle that is
    /// interrupted is completed. A cycle in which a robot fails has no outputs and ends the swarm.
    fn step(
        &self,
        py: Python<'_>,
        rows: Vec<Vec<bool>>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Vec<Vec<bool>>> {
        if let Some(row) = rows.iter().find(|row| row.len() != self.bits) {
            let (found, expected) = (row.len(), self.bits);
            return Err(bad_value(format!("{found} input bits, expected {expected}")));
        }
        let watch = Watch::over(rows.len() as u64);
        let done = self.live.run(py, &watch, progress.as_ref(), move |live, watch| {
            let mut observer = watch.observer();
            let (mut outputs, all) = (Vec::new(), rows.len() as u64);
            for (cycle, row) in (1..).zip(&rows) {
                if watch.is_stopped() {
                    break;
                }
                outputs.push(live.step(row)?.outputs.clone());
                nbc::Observer::progress(&mut observer, cycle, all);
            }
            Ok::<_, nbc::RobotFault>(outputs)
        })?;
        done.finished()?.map_err(|fault| robot_fault(py, &fault))
    }

    /// Cycles done.
    fn cycles(&self, py: Python<'_>) -> PyResult<usize> {
        self.live.with(py, |live| Ok(live.trace().cycles.len()))
    }

    /// The bits of the input ports, of the robots and of the output ports in each cycle.
    fn bits<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyArray2<bool>>; 3]> {
        self.live.with(py, |live| {
            let trace = live.trace();
            let array = |rows: Vec<&Vec<bool>>, width: usize| {
                let flat: Vec<bool> = rows.iter().flat_map(|row| row.iter().copied()).collect();
                flat.into_pyarray(py).reshape([rows.len(), width])
            };
            let outputs = trace.outputs.iter().map(|port| port.width).sum();
            Ok([
                array(trace.cycles.iter().map(|cycle| &cycle.inputs).collect(), self.bits)?,
                array(trace.cycles.iter().map(|cycle| &cycle.bits).collect(), trace.robots.len())?,
                array(trace.cycles.iter().map(|cycle| &cycle.outputs).collect(), outputs)?,
            ])
        })
    }

    /// Horizontal places of the robots, and the number of samples of a cycle.
    fn paths<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyArray2<f64>>, usize)> {
        self.live.with(py, |live| {
            let trace = live.trace();
            let samples = trace.robots.first().map_or(0, |robot| robot.com_x.len());
            let places: Vec<f64> = trace.robots.iter().flat_map(|robot| robot.com_x.iter().copied()).collect();
            Ok((places.into_pyarray(py).reshape([trace.robots.len(), samples])?, trace.samples_per_cycle))
        })
    }

    /// The swarm in space and time as SVG.
    fn spacetime(&self, py: Python<'_>) -> PyResult<String> {
        self.live.with(py, |live| Ok(nbc::draw_swarm(live.trace()).finish()))
    }

    /// Ends the simulation.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        self.live.close(py)
    }
}
