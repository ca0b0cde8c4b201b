//! Work on several machines: `nbc worker` and `nbc workers`.

mod worker;
mod workers;

use clap::Args;
use nbc_cluster::NatsServer;

use crate::cli::options::queue::NatsAccess;

pub use worker::WorkerArguments;
pub use workers::WorkersArguments;

#[derive(Args, Clone, Debug)]
pub struct NatsArguments {
    /// The NATS server with JetStream, such as `nats://localhost:4222` or `tls://nats.example.org`
    #[arg(long, value_name = "URL")]
    nats: String,
    #[command(flatten)]
    access: NatsAccess,
}

impl NatsArguments {
    pub fn server(&self) -> NatsServer {
        self.access.server(&self.nats)
    }
}
