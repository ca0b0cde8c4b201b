//! `--nats` and its options: workers at a NATS server do the work. A program without the feature does not list them,
//! and says what is missing to those who give them.

use std::path::PathBuf;

use clap::Args;

/// The files that a client needs to connect to a NATS server.
#[derive(Args, Clone, Debug, Default)]
pub struct NatsAccess {
    /// The file with the credentials for the server
    #[cfg_attr(not(feature = "cluster"), arg(hide = true))]
    #[arg(long, value_name = "FILE", requires = "nats")]
    pub creds: Option<PathBuf>,
    /// The file with the root certificate for the server's, if the system does not trust it
    #[cfg_attr(not(feature = "cluster"), arg(hide = true))]
    #[arg(long, value_name = "FILE", requires = "nats")]
    pub tls_ca: Option<PathBuf>,
}

/// Whether workers at a NATS server do the work.
#[derive(Args, Clone, Debug, Default)]
pub struct QueueArguments {
    /// Let workers at this NATS server do the work, such as `nats://localhost:4222`; results do not depend on it
    #[cfg_attr(not(feature = "cluster"), arg(hide = true))]
    #[arg(long, value_name = "URL", group = "place")]
    pub nats: Option<String>,
    #[command(flatten)]
    pub access: NatsAccess,
    /// Do not check workers by doing some of their work here
    #[cfg_attr(not(feature = "cluster"), arg(hide = true))]
    #[arg(long, requires = "nats")]
    pub trust_workers: bool,
}
