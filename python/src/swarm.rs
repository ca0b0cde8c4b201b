//! Swarms that are simulated cycle by cycle.

use nbc::LiveSwarm;
use numpy::{IntoPyArray, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use crate::errors::{bad_value, robot_fault};
use crate::slot::Slot;
use crate::work::Watch;

#[pyclass(frozen)]
pub struct Swarm {
    live: Slot<LiveSwarm>,
    bits: usize,
}

/// What a robot keeps of its walk in a cycle: a hundred bytes, so that a swarm keeps a gigabyte at most.
const MOST_ROBOT_CYCLES: u64 = 10_000_000;

/// Refuses cycles that could not be kept.
fn check_room(live: &LiveSwarm, cycles: u64) -> PyResult<()> {
    let (robots, done) = (live.trace().robots.len().max(1) as u64, live.trace().cycles.len() as u64);
    let most = MOST_ROBOT_CYCLES / robots;
    if cycles <= most.saturating_sub(done) {
        return Ok(());
    }
    let message = format!("{cycles} more cycles after {done}; this swarm keeps at most {most} ({robots} robots)");
    Err(bad_value(message))
}

impl Swarm {
    pub fn new(live: LiveSwarm) -> Self {
        let bits = live.trace().inputs.iter().map(|port| port.width).sum();
        Self { live: Slot::new("swarm", live), bits }
    }
}

#[pymethods]
impl Swarm {
    /// Holds each of these rows of bits on the input ports for cycles; the bits of the output ports at the end of each
    /// row. A cycle that is interrupted is completed. A cycle in which a robot fails has no outputs and ends the swarm.
    fn step(
        &self,
        py: Python<'_>,
        rows: Vec<Vec<bool>>,
        hold: u64,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Vec<Vec<bool>>> {
        if let Some(row) = rows.iter().find(|row| row.len() != self.bits) {
            let (found, expected) = (row.len(), self.bits);
            return Err(bad_value(format!("{found} input bits, expected {expected}")));
        }
        let all = hold.saturating_mul(rows.len() as u64);
        self.live.with(py, |live| check_room(live, all))?;
        let watch = Watch::over(all);
        let done = self.live.run(py, &watch, progress.as_ref(), move |live, watch| {
            let mut observer = watch.observer();
            let (mut outputs, mut cycle) = (Vec::new(), 0);
            for row in &rows {
                for held in 1..=hold {
                    if watch.is_stopped() {
                        return Ok(outputs);
                    }
                    let now = &live.step(row)?.outputs;
                    if held == hold {
                        outputs.push(now.clone());
                    }
                    cycle += 1;
                    nbc::Observer::progress(&mut observer, cycle, all);
                }
            }
            Ok::<_, nbc::RobotFault>(outputs)
        })?;
        done.finished()?.map_err(|fault| robot_fault(py, &fault))
    }

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

    fn spacetime(&self, py: Python<'_>) -> PyResult<String> {
        self.live.with(py, |live| Ok(nbc::draw_swarm(live.trace()).finish()))
    }

    fn close(&self, py: Python<'_>) -> PyResult<()> {
        self.live.close(py)
    }
}
