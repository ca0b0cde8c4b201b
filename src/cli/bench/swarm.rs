//! `nbc bench --swarm`: how fast a whole swarm is simulated, including its trace and recording.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::Serialize;

use crate::cli::Failure;
use crate::cli::bench::speed::{cycle_substeps, on_one_thread, per_second, processor_seconds, race};
use nbc_base::diag::counted;
use nbc_base::model::Column;
use nbc_base::source::MemoryWorld;
use nbc_session::{Choice, CompileOptions, Session};
use nbc_sim::{Kernel, LaneBackend, Simulator};
use nbc_swarm::{Assembly, LiveSwarm, Room};

const FILE: &str = "circuits/counter.nb";
const SOURCE: &str = include_str!("../../../circuits/counter.nb");
const PATIENCE: Duration = Duration::from_secs(1);
/// Cycles for which the inputs are held.
const HOLD: usize = 8;
/// Cycles for which the world has room.
const CYCLES: usize = 1000;

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct SwarmFigures {
    robots: usize,
    /// Lane-substeps per second on one core.
    one_core: f64,
    /// Lane-substeps per second of different bodies in the same boxes, side by side on one core.
    different: f64,
    /// Lane-substeps per second on all threads, in wall-clock time.
    all_threads: f64,
    threads: usize,
}

impl SwarmFigures {
    pub(super) fn measure(kernel: Kernel) -> Result<Self, Failure> {
        let assembly = assembly()?;
        let mut boxes: BTreeMap<usize, f64> = BTreeMap::new();
        let sides = assembly.members.iter().map(|member| member.robot.body.width());
        let seconds: f64 =
            sides.map(|side| 1.0 / *boxes.entry(side).or_insert_with(|| race(side, kernel, 1, None))).sum();
        Ok(Self {
            robots: assembly.members.len(),
            one_core: on_one_thread(|| speed(&assembly, kernel, processor_seconds)),
            different: assembly.members.len() as f64 / seconds,
            all_threads: speed(&assembly, kernel, || None),
            threads: rayon::current_num_threads(),
        })
    }

    pub(super) fn describe(&self) -> String {
        let Self { robots, one_core, different, all_threads, threads } = self;
        let (share, thousand) = (100.0 * one_core / different, 1e3);
        format!(
            "\na swarm of {}: {:.0}k lane-substeps per second on one core, {share:.0} % of different \
             bodies side by side \
             ({:.0}k); {:.0}k on {}\n",
            counted(*robots, "robot"),
            one_core / thousand,
            different / thousand,
            all_threads / thousand,
            counted(*threads, "thread"),
        )
    }
}

fn assembly() -> Result<Assembly, Failure> {
    let mut session = Session::new(MemoryWorld::default());
    session.update(FILE, 1, SOURCE);
    let file = session.open(FILE)?;
    let circuit = file.circuit(&Choice::default())?;
    Ok(file.compile(&circuit, &CompileOptions::default())?.assembly)
}

/// Lane-substeps per second by that clock, or in wall-clock time if the system does not have it. Poses are recorded as
/// for a page.
fn speed(assembly: &Assembly, kernel: Kernel, clock: fn() -> Option<f64>) -> f64 {
    let simulator = Simulator::new(LaneBackend { kernel, ..LaneBackend::default() });
    let mut swarm = LiveSwarm::new(&simulator, assembly, CYCLES, 1, Some(Room::SWARM));
    let bits = assembly.inputs.iter().flat_map(Column::bits).count();
    let work = assembly.members.len() as f64 * cycle_substeps();
    let mut cycles = 0;
    per_second(PATIENCE, clock, || {
        let inputs: Vec<bool> = (0..bits).map(|bit| (cycles / HOLD) >> bit & 1 == 1).collect();
        swarm.step(&inputs).expect("a counter of robots in the paper's world is stable");
        cycles += 1;
        work
    })
}
