//! Work on several machines: `nbc worker`, `nbc workers`, and the server and workers of other commands with `--nats`.

mod worker;
mod workers;

use clap::Args;
use nbc_cluster::{NatsServer, QueueOptions};

use crate::cli::context::log;
use crate::cli::options::queue::{NatsAccess, QueueArguments};
use crate::cli::{Failure, Interrupt};

pub use nbc_cluster::QueueExecutor;
pub use worker::WorkerArguments;
pub use workers::WorkersArguments;

/// The options of commands that need a server.
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

/// The workers at a server, if the options name one. A signal stops their work; `note` receives notes on its progress.
pub fn open_queue(
    arguments: &QueueArguments,
    interrupt: &Interrupt,
    note: impl Fn(String) + Send + 'static,
) -> Result<Option<QueueExecutor>, Failure> {
    let Some(address) = &arguments.nats else { return Ok(None) };
    let (server, trust_workers) = (server(address, &arguments.access), arguments.trust_workers);
    let options = QueueOptions { server, trust_workers, cancel: interrupt.cancel(), log };
    QueueExecutor::open(options, note).map(Some).map_err(Failure::plain)
}

fn server(address: &str, access: &NatsAccess) -> NatsServer {
    let NatsAccess { creds, tls_ca } = access.clone();
    NatsServer { address: address.to_owned(), credentials: creds, root_certificate: tls_ca }
}
