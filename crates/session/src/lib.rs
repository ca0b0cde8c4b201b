//! The interface that every door calls: from source text to swarms, tests, files and reports. `compile.rs` has the
//! stages in order.

mod buildable;
mod checked;
mod choice;
mod compile;
mod contents;
mod documents;
mod error_pages;
mod formatted;
mod hold;
mod mapping;
mod observer;
mod options;
mod pictures;
mod plan;
mod replay;
pub mod report;
mod robots;
mod run;
mod run_report;
mod schedule;
mod script;
mod session;
mod simulation;
mod start_bodies;
pub mod store;
mod swarm_run;
mod test;
mod test_timing;
mod waves;
mod wording;

pub use checked::{Checked, prelude};
pub use choice::{Choice, check_swarm_is_clear};
pub use compile::{Compiled, synthesize};
pub use error_pages::error_page;
pub use formatted::Formatted;
pub use mapping::Mapping;
pub use observer::{Cancellable, Observer, SwarmKeeper};
pub use options::{CompileOptions, RUNS};
pub use pictures::run_page;
pub use plan::Plan;
pub use replay::Excerpt;
pub use run_report::{RunList, RunReport};
pub use schedule::read_schedule;
pub use session::Session;
#[cfg(feature = "disk")]
pub use session::run_file;
pub use simulation::SimulationRun;
pub use swarm_run::{RunEnd, SwarmRun};
pub use test::{TestCase, TestOptions, TestRun};
