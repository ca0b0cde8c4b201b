//! Work on several machines through a queue of a NATS server (docs/cluster.md).
//!
//! A program hands tasks to a [`QueueExecutor`]; [`Worker`]s on other machines do them. [`ClusterWatch`] lists both.

mod answer_message;
mod checker;
mod connection;
mod delivery;
mod listing;
mod message;
mod open_batches;
mod physics;
mod queue;
mod queue_executor;
mod reports;
mod task_batch;
mod task_message;
mod task_sender;
mod wording;
mod worker;
mod worker_state;
mod worker_statistics;
mod worker_thread;

pub use connection::NatsServer;
pub use listing::{ClusterListing, ClusterWatch};
pub use queue_executor::{QueueExecutor, QueueOptions};
pub use worker::{Worker, WorkerOptions};

pub type Log = fn(&str);
