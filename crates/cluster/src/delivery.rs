//! Delivery of results to searches. A result is sent until the search confirms it, and then its task is removed from
//! the queue.

use std::sync::Arc;
use std::time::Duration;

use async_nats::jetstream::AckKind;
use async_nats::jetstream::message::Acker;
use tokio::runtime::Handle;
use tokio::task::JoinSet;
use tokio::time;

use crate::connection::{Connection, answer_subject};
use crate::message::{AnswerReply, decode};

const ATTEMPT: Duration = Duration::from_secs(2);
/// The number of attempts. A search that does not reply for so long has ended.
const ATTEMPTS: usize = 30;

pub struct Delivery {
    handle: Handle,
    client: async_nats::Client,
    worker: String,
    open: JoinSet<DeliveryEnd>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeliveryEnd {
    Received,
    /// The search has ended, or cannot be reached.
    Unwanted {
        search: String,
    },
    Rejected(AnswerReply),
}

impl Delivery {
    pub fn new(connection: &Connection, worker: &str) -> Self {
        let handle = connection.runtime.handle().clone();
        Self { handle, client: connection.client.clone(), worker: worker.to_owned(), open: JoinSet::new() }
    }

    pub fn start(&mut self, search: String, bytes: Vec<u8>, acker: Arc<Acker>) {
        let (client, subject) = (self.client.clone(), answer_subject(&search, &self.worker));
        let deliver = async move {
            match deliver(client, subject, bytes, acker).await {
                None => DeliveryEnd::Unwanted { search },
                Some(AnswerReply::Received) => DeliveryEnd::Received,
                Some(reply) => DeliveryEnd::Rejected(reply),
            }
        };
        self.open.spawn_on(deliver, &self.handle);
    }

    pub fn finished(&mut self) -> Vec<DeliveryEnd> {
        std::iter::from_fn(|| self.open.try_join_next()).flatten().collect()
    }

    pub async fn finish(&mut self, most: Duration) -> Vec<DeliveryEnd> {
        let mut ended = Vec::new();
        let end = time::Instant::now() + most;
        while let Ok(Some(one)) = time::timeout_at(end, self.open.join_next()).await {
            ended.extend(one.ok());
        }
        ended
    }
}

async fn deliver(
    client: async_nats::Client,
    subject: String,
    bytes: Vec<u8>,
    acker: Arc<Acker>,
) -> Option<AnswerReply> {
    for _ in 0..ATTEMPTS {
        let request = client.request(subject.clone(), bytes.clone().into());
        if let Ok(Ok(message)) = time::timeout(ATTEMPT, request).await
            && let Some(reply) = decode(&message.payload)
        {
            if reply == AnswerReply::Received {
                // A task that is not acknowledged is made once more, which does no harm.
                let _ = acker.ack().await;
            }
            return Some(reply);
        }
        let _ = acker.ack_with(AckKind::Progress).await;
        time::sleep(ATTEMPT / 4).await;
    }
    let _ = acker.ack_with(AckKind::Term).await;
    None
}
