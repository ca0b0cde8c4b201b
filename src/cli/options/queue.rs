//! `--nats` and its options: workers at a NATS server do the work. Without the feature `cluster` there are none.

use clap::Args;

use crate::cli::{Failure, Interrupt};

#[cfg(feature = "cluster")]
pub use nbc_cluster::QueueExecutor;
#[cfg(not(feature = "cluster"))]
pub use nbc_swarm::LocalExecutor as QueueExecutor;

#[cfg(feature = "cluster")]
#[derive(Args, Clone, Debug)]
pub struct NatsAccess {
    /// The file with the credentials for the server
    #[arg(long, value_name = "FILE", requires = "nats")]
    creds: Option<std::path::PathBuf>,
    /// The file with the root certificate for the server's, if the system does not trust it
    #[arg(long, value_name = "FILE", requires = "nats")]
    tls_ca: Option<std::path::PathBuf>,
}

#[derive(Args, Clone, Debug)]
pub struct QueueArguments {
    /// Let workers at this NATS server do the work, such as `nats://localhost:4222`; results do not depend on it
    #[cfg(feature = "cluster")]
    #[arg(long, value_name = "URL", group = "place")]
    nats: Option<String>,
    #[cfg(feature = "cluster")]
    #[command(flatten)]
    access: NatsAccess,
    /// Do not check workers by doing some of their work here
    #[cfg(feature = "cluster")]
    #[arg(long, requires = "nats")]
    trust_workers: bool,
}

#[cfg(feature = "cluster")]
impl NatsAccess {
    pub fn server(&self, address: &str) -> nbc_cluster::NatsServer {
        let Self { creds, tls_ca } = self.clone();
        nbc_cluster::NatsServer { address: address.to_owned(), credentials: creds, root_certificate: tls_ca }
    }
}

#[cfg(feature = "cluster")]
impl QueueArguments {
    pub fn is_given(&self) -> bool {
        self.nats.is_some()
    }

    /// The workers at a server, if the options name one. A signal stops their work; `note` receives notes on its
    /// progress.
    pub fn open(
        &self,
        interrupt: &Interrupt,
        note: impl Fn(String) + Send + 'static,
    ) -> Result<Option<QueueExecutor>, Failure> {
        let Some(address) = &self.nats else { return Ok(None) };
        let options = nbc_cluster::QueueOptions {
            server: self.access.server(address),
            trust_workers: self.trust_workers,
            cancel: interrupt.cancel(),
            log: crate::cli::context::log,
        };
        Ok(Some(QueueExecutor::open(options, note)?))
    }
}

#[cfg(not(feature = "cluster"))]
impl QueueArguments {
    pub fn is_given(&self) -> bool {
        false
    }

    pub fn open(&self, _: &Interrupt, _: impl Fn(String) + Send + 'static) -> Result<Option<QueueExecutor>, Failure> {
        Ok(None)
    }
}

/// Waits until the workers have stopped.
pub fn end(queue: Option<QueueExecutor>) -> Result<(), Failure> {
    #[cfg(feature = "cluster")]
    if let Some(queue) = queue {
        queue.end()?;
    }
    #[cfg(not(feature = "cluster"))]
    drop(queue);
    Ok(())
}
