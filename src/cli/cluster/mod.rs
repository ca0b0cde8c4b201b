//! Work on several machines through a queue of a NATS server (docs/cluster.md).

mod answer_message;
mod audit;
mod bits;
mod connection;
mod delivery;
mod generation;
mod listing;
mod message;
mod physics;
mod queue_laboratory;
mod queue_place;
mod roster;
mod task_message;
mod task_sender;
mod worker;
mod worker_command;
mod worker_thread;

use std::io::Write;

use crate::cli::distant::DistantLaboratory;
use crate::cli::nats_access::QueueArguments;
use crate::cli::place::TaskPlace;
use crate::cli::{Failure, Interrupt};

pub use listing::WorkersArguments;
pub use worker_command::WorkerArguments;

/// The queue at a server as a place for tasks.
///
/// # Errors
/// When the server cannot be used.
pub fn open_place(server: &str, arguments: &QueueArguments) -> Result<Box<dyn TaskPlace>, Failure> {
    Ok(Box::new(place(server, arguments)?))
}

/// The queue at a server as a laboratory. It stops when a signal arrives; notes on its progress go to `show`.
///
/// # Errors
/// When the server cannot be used.
pub fn open_laboratory(
    server: &str,
    arguments: &QueueArguments,
    interrupt: &Interrupt,
    show: impl Fn(String) + Send + 'static,
) -> Result<Box<dyn DistantLaboratory>, Failure> {
    let (server, arguments) = (server.to_owned(), arguments.clone());
    let open = move || place(&server, &arguments);
    Ok(Box::new(queue_laboratory::QueueLaboratory::open(open, interrupt.clone(), show)?))
}

fn place(server: &str, arguments: &QueueArguments) -> Result<queue_place::QueuePlace, Failure> {
    let server = connection::NatsArguments { nats: server.to_owned(), access: arguments.access.clone() };
    // Where standard error is closed, nobody wants to know.
    let log = |text: &str| _ = std::io::stderr().write_all(text.as_bytes());
    queue_place::QueuePlace::open(&server, arguments.trust_workers, log)
}
