//! `nbc bench --swarm`: how fast a whole swarm is simulated, including its trace and recording.

use std::collections::BTreeMap;
use std::time::Instant;

use serde::Serialize;

use crate::cli::bench::speed::{PATIENCE, cycle_substeps, processor_seconds, race};
use crate::model::{Column, Function};
use crate::sim::{Kernel, LaneBackend, Simulator};
use crate::store;
use crate::swarm::{Assembly, LiveSwarm, Member, Room, StimulusSource};

/// The robots of a counter of three bits (circuits/counter.nb), by their gates.
const GATES: [(Function, usize); 5] =
    [(Function::NAND, 24), (Function::NOT, 2), (Function::XNOR, 1), (Function::XOR, 1), (Function::new(0b0100), 1)];
/// Cycles for which the inputs are held.
const HOLD: usize = 8;
/// Cycles for which the world has room.
const CYCLES: usize = 1000;

/// How fast the swarm was.
#[derive(Serialize)]
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
    /// Measures the swarm on one thread, and on all.
    pub(super) fn measure(kernel: Kernel) -> Self {
        let assembly = assembly();
        let mut boxes: BTreeMap<usize, f64> = BTreeMap::new();
        let sides = assembly.members.iter().map(|member| member.robot.body.width());
        let seconds: f64 =
            sides.map(|side| 1.0 / *boxes.entry(side).or_insert_with(|| race(side, kernel, 1, None))).sum();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread can be started");
        Self {
            robots: assembly.members.len(),
            one_core: pool.install(|| speed(&assembly, kernel, processor_seconds)),
            different: assembly.members.len() as f64 / seconds,
            all_threads: speed(&assembly, kernel, || None),
            threads: rayon::current_num_threads(),
        }
    }

    pub(super) fn describe(&self) -> String {
        let Self { robots, one_core, different, all_threads, threads } = self;
        let (share, thousand) = (100.0 * one_core / different, 1e3);
        format!(
            "\na swarm of {robots} robots: {:.0}k lane-substeps per second on one core, {share:.0} % of different \
             bodies side by side \
             ({:.0}k); {:.0}k on {threads} threads\n",
            one_core / thousand,
            different / thousand,
            all_threads / thousand,
        )
    }
}

/// Robots that all sense the two inputs.
fn assembly() -> Assembly {
    let library = store::shipped_library();
    let gates = GATES.into_iter().flat_map(|(function, count)| std::iter::repeat_n(function, count));
    let member = |(i, function): (usize, Function)| Member {
        net: format!("n{i}"),
        robot: library.robots_for(function).next().expect("the shipped robots compute every function").clone(),
        senses: [StimulusSource::Input(0), StimulusSource::Input(1)],
        start: false,
    };
    let inputs = ["a", "b"].map(|name| Column { name: name.to_owned(), width: 1 });
    let (outputs, shown) = (Vec::new(), Vec::new());
    let members = gates.enumerate().map(member).collect();
    Assembly { circuit: "counter".to_owned(), inputs: inputs.into(), members, outputs, shown }
}

/// Lane-substeps per second by that clock, or in wall-clock time if the system does not have it. Poses are recorded as
/// for a page.
fn speed(assembly: &Assembly, kernel: Kernel, clock: impl Fn() -> Option<f64>) -> f64 {
    let simulator = Simulator::new(LaneBackend { kernel, ..LaneBackend::default() });
    let mut swarm = LiveSwarm::new(&simulator, assembly, CYCLES, 1, Some(Room::SWARM));
    let (start, spent, mut cycles) = (Instant::now(), clock(), 0);
    while start.elapsed() < 4 * PATIENCE {
        let pattern = cycles / HOLD;
        swarm.step(&[pattern & 1 == 1, pattern & 2 == 2]);
        cycles += 1;
    }
    let seconds = clock().zip(spent).map_or(start.elapsed().as_secs_f64(), |(now, then)| now - then);
    (cycles * assembly.members.len()) as f64 * cycle_substeps() / seconds
}
