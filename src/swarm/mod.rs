//! Robots as gates, alone and wired together: what drives a swarm, what it did, and whether it did what was asked.

mod assemble;
mod cells;
mod judge;
mod trace;

pub use assemble::{AssembleError, Assembly, Member, Signal, assemble};
pub use cells::cells;
pub use judge::{Demand, Lapse, RowVerdict, TestVerdict, judge};
pub use trace::{CycleTrace, RobotTrace, SwarmTrace};
