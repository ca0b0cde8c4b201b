//! Ctrl-C, SIGTERM and SIGUSR1 as a flag that long work checks.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::cli::Status;
use nbc_circuit::CancelFlag;
use nbc_session::store::{DiskWorld, GuardedWorld};
use nbc_session::{Cancellable, Observer};
use nbc_sim::{LaneBackend, Monitor};

/// A request to stop, raised by a signal; a second Ctrl-C or SIGTERM stops the program at once.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    #[cfg(unix)]
    pub fn watch() -> io::Result<Self> {
        use signal_hook::consts::{SIGINT, SIGTERM, SIGUSR1};
        use signal_hook::flag;
        let interrupt = Self::default();
        for signal in [SIGINT, SIGTERM] {
            flag::register_conditional_shutdown(signal, Status::Interrupted.code().into(), interrupt.0.clone())?;
        }
        for signal in [SIGINT, SIGTERM, SIGUSR1] {
            flag::register(signal, interrupt.0.clone())?;
        }
        Ok(interrupt)
    }

    /// Watches Ctrl-C and the end of the console.
    #[cfg(windows)]
    pub fn watch() -> io::Result<Self> {
        let interrupt = Self::default();
        let raised = interrupt.clone();
        let raise = move || {
            if raised.0.swap(true, Ordering::Relaxed) {
                std::process::exit(Status::Interrupted.code().into());
            }
        };
        ctrlc::set_handler(raise).map_err(io::Error::other)?;
        Ok(interrupt)
    }

    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    pub fn cancel(&self) -> CancelFlag {
        CancelFlag::from(self.0.clone())
    }

    /// The processor's back end, which stops after this request.
    pub fn ending(&self, processor: LaneBackend) -> LaneBackend {
        LaneBackend { monitor: Some(Arc::new(Monitor::until(self.cancel()))), ..processor }
    }

    /// The files of the disk; reading Verilog ends with this request.
    pub fn world(&self) -> GuardedWorld<DiskWorld> {
        GuardedWorld::until(DiskWorld, self.cancel())
    }

    pub fn observe<F: FnMut(u64, u64)>(&self, progress: F) -> impl Observer + use<F> {
        Cancellable { cancel: self.cancel(), progress }
    }
}
