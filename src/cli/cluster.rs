//! What the commands with `--nats` share: a server, and workers there.

use std::io::{self, Write};

use clap::Args;
use nbc_cluster::{NatsServer, QueueOptions};

use crate::cli::queue::{NatsAccess, QueueArguments};
use crate::cli::{Failure, Interrupt};

pub use nbc_cluster::QueueExecutor;

/// The server.
#[derive(Args, Clone, Debug)]
pub struct NatsArguments {
    /// The NATS server with JetStream, such as `nats://localhost:4222` or `tls://nats.example.org`
    #[arg(long, value_name = "URL")]
    nats: String,
    #[command(flatten)]
    access: NatsAccess,
}

impl NatsArguments {
    /// The server.
    pub fn server(&self) -> NatsServer {
        server(&self.nats, &self.access)
    }
}

/// The workers at a server. They stop when a signal arrives; notes on their progress go to `note`.
///
/// # Errors
/// When the server cannot be used.
pub fn open_queue(
    address: &str,
    arguments: &QueueArguments,
    interrupt: &Interrupt,
    note: impl Fn(String) + Send + 'static,
) -> Result<QueueExecutor, Failure> {
    let (server, trust_workers) = (server(address, &arguments.access), arguments.trust_workers);
    Ok(QueueExecutor::open(QueueOptions { server, trust_workers, cancel: interrupt.cancel(), log }, note)?)
}

/// Writes a line to standard error.
pub fn log(text: &str) {
    // Where standard error is closed, nobody wants to know.
    let _ = io::stderr().write_all(text.as_bytes());
}

fn server(address: &str, access: &NatsAccess) -> NatsServer {
    let NatsAccess { creds, tls_ca } = access.clone();
    NatsServer { address: address.to_owned(), credentials: creds, root_certificate: tls_ca }
}
