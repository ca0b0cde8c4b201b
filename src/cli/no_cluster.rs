//! `nbc worker`, `nbc workers` and `--nats` in a program that was built without them.

use std::convert::Infallible;
use std::ffi::OsString;

use clap::Args;

use crate::cli::queue::QueueArguments;
use crate::cli::wording::NoCluster;
use crate::cli::{Context, Failure, Interrupt, Status};
use nbc_swarm::{Executor, Task, TaskResult};

macro_rules! not_built {
    ($($(#[$about:meta])* $arguments:ident,)*) => {$(
        #[derive(Args)]
        $(#[$about])*
        pub struct $arguments {
            #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
            rest: Vec<OsString>,
        }

        impl $arguments {
            /// Says how to get it.
            ///
            /// # Errors
            /// Always.
            pub fn run(self, _context: &mut Context) -> Result<Status, Failure> {
                let _ = self.rest;
                Err(NoCluster.into())
            }
        }
    )*};
}

not_built! {
    /// Evaluate robots for searches on other machines (not in this build)
    #[command(after_help = "Example:\n  nbc worker --nats nats://localhost:4222")]
    WorkerArguments,
    /// List the workers at a NATS server (not in this build)
    #[command(after_help = "Example:\n  nbc workers --nats nats://localhost:4222")]
    WorkersArguments,
}

/// Workers, which cannot be there.
pub struct NoQueue(Infallible);

pub use NoQueue as QueueExecutor;

impl NoQueue {
    /// Cannot be called.
    ///
    /// # Errors
    /// Never.
    pub fn end(self) -> Result<(), NoCluster> {
        match self.0 {}
    }
}

impl Executor for NoQueue {
    fn perform(&self, _run: usize, _tasks: &[Task], _observe: &dyn Fn()) -> Option<Vec<TaskResult>> {
        match self.0 {}
    }
}

/// Says how to get it.
///
/// # Errors
/// Always.
pub fn open_queue(
    _address: &str,
    _arguments: &QueueArguments,
    _interrupt: &Interrupt,
    _note: impl Fn(String) + Send + 'static,
) -> Result<NoQueue, Failure> {
    Err(NoCluster.into())
}
