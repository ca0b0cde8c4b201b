//! `nbc worker`, `nbc workers` and `--nats` in a program that was built without them.

use std::ffi::OsString;

use clap::Args;

use crate::cli::distant::DistantLaboratory;
use crate::cli::nats_access::QueueArguments;
use crate::cli::place::TaskPlace;
use crate::cli::wording::ClusterError;
use crate::cli::{Context, Failure, Interrupt, Status};

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
                Err(ClusterError::NotBuilt.into())
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

/// Says how to get it.
///
/// # Errors
/// Always.
pub fn open_place(_server: &str, _arguments: &QueueArguments) -> Result<Box<dyn TaskPlace>, Failure> {
    Err(ClusterError::NotBuilt.into())
}

/// Says how to get it.
///
/// # Errors
/// Always.
pub fn open_laboratory(
    _server: &str,
    _arguments: &QueueArguments,
    _interrupt: &Interrupt,
    _show: impl Fn(String) + Send + 'static,
) -> Result<Box<dyn DistantLaboratory>, Failure> {
    Err(ClusterError::NotBuilt.into())
}
