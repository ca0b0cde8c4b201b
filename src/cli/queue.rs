//! The options for work on several machines.

use std::path::PathBuf;

use clap::Args;

use crate::cli::cluster::{QueueExecutor, open_queue};
use crate::cli::{Failure, Interrupt};

/// What a NATS server asks of its clients.
#[derive(Args, Clone, Debug, Default)]
pub struct NatsAccess {
    /// The file with the credentials for the server
    #[arg(long, value_name = "FILE", requires = "nats")]
    pub creds: Option<PathBuf>,
    /// The file with the root certificate for the server's, if the system does not trust it
    #[arg(long, value_name = "FILE", requires = "nats")]
    pub tls_ca: Option<PathBuf>,
}

/// Whether workers at a NATS server do the work.
#[derive(Args, Clone, Debug, Default)]
pub struct QueueArguments {
    /// Let workers at this NATS server do the work, such as `nats://localhost:4222`; results do not depend on it
    #[arg(long, value_name = "URL", group = "place")]
    pub nats: Option<String>,
    #[command(flatten)]
    pub access: NatsAccess,
    /// Do not check workers by doing some of their work here
    #[arg(long, requires = "nats")]
    pub trust_workers: bool,
}

impl QueueArguments {
    /// The workers, if they do the work, until a signal arrives. Notes on their progress go to `note`.
    ///
    /// # Errors
    /// When the server cannot be used.
    pub fn open(
        &self,
        interrupt: &Interrupt,
        note: impl Fn(String) + Send + 'static,
    ) -> Result<Option<QueueExecutor>, Failure> {
        self.nats.as_ref().map(|address| open_queue(address, self, interrupt, note)).transpose()
    }
}
