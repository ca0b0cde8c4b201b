//! The commands and options of features that this program was built without. They are not listed, and say how to build
//! it with them.

use std::ffi::OsString;

use clap::Args;

use crate::cli::wording::MissingFeature;
use crate::cli::{Context, Failure, Status};

/// Arguments of commands that always fail.
macro_rules! commands {
    ($missing:expr, $($(#[$about:meta])* $arguments:ident,)*) => {$(
        #[derive(Args)]
        #[command(hide = true)]
        $(#[$about])*
        pub struct $arguments {
            #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
            rest: Vec<OsString>,
        }

        impl $arguments {
            /// Says which feature is missing.
            pub fn run(self, _context: &mut Context) -> Result<Status, Failure> {
                let _ = self.rest;
                Err($missing.into())
            }
        }
    )*};
}

#[cfg(not(feature = "play"))]
pub(super) mod play {
    use super::*;

    commands! {
        MissingFeature::PLAY,
        /// Show robots live in a browser (not in this build)
        PlayArguments,
    }
}

#[cfg(not(feature = "cluster"))]
pub(super) mod cluster {
    use std::convert::Infallible;

    use nbc_base::diag::Diagnostic;
    use nbc_swarm::{Executor, Task, TaskResult};

    use super::*;
    use crate::cli::Interrupt;
    use crate::cli::options::queue::QueueArguments;

    commands! {
        MissingFeature::CLUSTER,
        /// Evaluate robots for searches on other machines (not in this build)
        #[command(after_help = "Example:\n  nbc worker --nats nats://localhost:4222")]
        WorkerArguments,
        /// List the workers at a NATS server (not in this build)
        #[command(after_help = "Example:\n  nbc workers --nats nats://localhost:4222")]
        WorkersArguments,
    }

    /// Workers at a server, of which there are none.
    pub struct NoQueue(Infallible);

    pub use NoQueue as QueueExecutor;

    impl NoQueue {
        /// Cannot be called.
        pub fn end(self) -> Result<(), Diagnostic> {
            match self.0 {}
        }
    }

    impl Executor for NoQueue {
        fn perform(&self, _run: usize, _tasks: &[Task], _observe: &dyn Fn()) -> Option<Vec<TaskResult>> {
            match self.0 {}
        }
    }

    /// No workers.
    pub fn open_queue(
        arguments: &QueueArguments,
        _interrupt: &Interrupt,
        _note: impl Fn(String) + Send + 'static,
    ) -> Result<Option<NoQueue>, Failure> {
        if arguments.nats.is_some() { Err(MissingFeature::CLUSTER.into()) } else { Ok(None) }
    }
}

#[cfg(not(feature = "gpu"))]
pub(super) mod gpu {
    use std::convert::Infallible;

    use nbc_sim::{LaneBackend, Simulator};
    use serde::{Serialize, Serializer};

    use super::*;
    use crate::cli::options::device::DeviceChoice;

    commands! {
        MissingFeature::GPU,
        /// List the OpenCL devices that can simulate (not in this build)
        #[command(after_help = "Example:\n  nbc devices")]
        DevicesArguments,
    }

    /// This processor.
    #[derive(Clone)]
    pub struct OnlyProcessor(LaneBackend);

    pub use OnlyProcessor as OpenDevice;

    impl OnlyProcessor {
        /// This processor, if no other device is asked for.
        pub fn open(choice: DeviceChoice, processor: LaneBackend, _context: &Context) -> Result<Self, Failure> {
            match choice {
                DeviceChoice::Processor | DeviceChoice::Auto => Ok(Self(processor)),
                DeviceChoice::Device(_) => Err(MissingFeature::GPU.into()),
            }
        }

        /// A simulator on it.
        pub fn simulator(&self) -> Simulator {
            Simulator::new(self.0.clone())
        }

        /// Whether a device was opened: never.
        pub fn is_device(&self) -> bool {
            false
        }

        /// Does nothing, because no device can have failed.
        pub fn check(&self) -> Result<(), Failure> {
            Ok(())
        }

        /// Does nothing, because no device can have failed.
        pub fn end(&self, _context: &Context) -> Result<(), Failure> {
            Ok(())
        }

        /// `None`, because there is no device.
        pub fn figures(&self) -> Option<NoFigures> {
            None
        }
    }

    /// The speed of a device, of which there is none.
    pub struct NoFigures(Infallible);

    pub use NoFigures as DeviceFigures;

    impl Serialize for NoFigures {
        fn serialize<S: Serializer>(&self, _serializer: S) -> Result<S::Ok, S::Error> {
            match self.0 {}
        }
    }

    impl NoFigures {
        /// Cannot be called.
        pub fn describe(&self) -> String {
            match self.0 {}
        }
    }
}
