//! Robots as gates, alone and in swarms: evaluation, characterization, assembly, simulation and verdicts.

mod activity;
mod assemble;
mod cells;
mod characterize;
mod evaluate;
mod gate;
mod holds;
mod judge;
mod live;
mod measure;
mod recording;
mod selection;
mod settling;
mod simulate;
mod trace;
mod verdict;
mod weak;
mod wording;
mod work;

pub use activity::{RowActivity, SimulationResult, activity};
pub use assemble::{Assembly, Member, StimulusSource, assemble};
pub use cells::{cells, prefer};
pub use characterize::{characterize, screen, sketch};
pub use evaluate::{evaluate, evaluate_bodies, evolve_generation, fixed_displacements, fixed_trials};
pub use judge::{Demand, STEADY_CYCLES, judge_logic, judge_swarm};
pub use live::{LiveSwarm, SwarmSnapshot, setting};
pub use measure::{FIXED_STEPS, Measurement, measure};
pub use recording::{Recorded, Recording, Room};
pub use selection::{Nominee, Selected, Selection};
pub use settling::Settling;
pub use simulate::{Exposure, simulate};
pub use trace::{CycleTrace, RobotTrace, SwarmTrace};
pub use verdict::{Lapse, Level, RowVerdict, TestVerdict};
pub use weak::{THIN_MARGIN, WeakRobot, weak_robots};
pub use wording::AssembleError;
pub use work::Work;
