//! `nbc workers`: lists the workers at a server, and the searches that they work for.

use clap::Args;
use nbc_cluster::ClusterWatch;

use crate::cli::cluster::NatsArguments;
use crate::cli::context::log;
use crate::cli::{Context, Failure, Interrupt, Status};
use nbc_session::report::Schema;

/// List the workers at a NATS server, and the searches that they work for
#[derive(Args)]
#[command(after_help = "\
Examples:
  nbc workers --nats nats://localhost:4222
  nbc workers --nats nats://localhost:4222 --watch --format json   a line of JSON every three seconds")]
pub struct WorkersArguments {
    #[command(flatten)]
    server: NatsArguments,
    /// List them again every three seconds, until Ctrl-C
    #[arg(long)]
    watch: bool,
}

impl WorkersArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let interrupt = Interrupt::watch()?;
        let mut watch = ClusterWatch::open(&self.server.server(), log)?;
        loop {
            let found = watch.listen(&interrupt.cancel());
            if self.watch && interrupt.is_raised() {
                return Ok(Status::Done);
            }
            context.print_result(Schema::Workers, &found, || found.describe())?;
            context.flush()?;
            if !self.watch {
                return Ok(Status::Done);
            }
        }
    }
}
