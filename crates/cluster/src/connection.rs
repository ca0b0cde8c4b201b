//! A connection to a NATS server, for code that is not asynchronous.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use async_nats::jetstream::consumer::{AckPolicy, PullConsumer, pull};
use async_nats::jetstream::context::{CreateStreamError, CreateStreamErrorKind};
use async_nats::jetstream::stream::{RetentionPolicy, StorageType, Stream};
use async_nats::jetstream::{self, ErrorCode, stream};
use async_nats::{ConnectOptions, Event, ServerAddr, connection};
use percent_encoding::percent_decode_str;
use tokio::runtime::{Builder, EnterGuard, Runtime};
use tokio::time;

use crate::Log;
use crate::message::{MOST_BYTES, TaskKey, VERSION};
use crate::wording;
use nbc_base::diag::{Diagnostic, without_passwords};

const STREAM: &str = "nbc-tasks";
/// A task is given to another worker when its worker has not reported for this time.
pub const SILENCE: Duration = Duration::from_secs(6);
/// Tasks of a search that has ended without cleaning up are dropped after this time.
const MOST_AGE: Duration = Duration::from_secs(60 * 60);
pub const PATIENCE: Duration = Duration::from_secs(5);
/// Longer than for other replies: there is no second attempt, and a stream takes long to create on a busy disk.
const OPENING: Duration = Duration::from_secs(30);
const PAUSE: Duration = Duration::from_millis(50);
/// The client gives a connection up when two signs of life are missing.
const PING: Duration = Duration::from_secs(2);
const MOST_TAKEN: i64 = 1_000_000;

#[derive(Clone, Debug, Default)]
pub struct NatsServer {
    /// Its address, such as `nats://localhost:4222` or `tls://nats.example.org`.
    pub address: String,
    pub credentials: Option<PathBuf>,
    pub root_certificate: Option<PathBuf>,
}

pub struct Connection {
    pub runtime: &'static Runtime,
    pub client: async_nats::Client,
    pub jetstream: jetstream::Context,
    /// The server without a password, for messages.
    pub server: String,
}

impl Connection {
    /// If the connection breaks later, the client connects again by itself.
    pub fn open(server: &NatsServer, name: &str, log: Log) -> Result<Self, Diagnostic> {
        let shown = without_passwords(&server.address);
        let runtime = Builder::new_multi_thread()
            .worker_threads(1)
            .enable_all()
            .build()
            .map_err(|error| wording::no_client(&error.to_string()))?;
        let runtime: &'static Runtime = Box::leak(Box::new(runtime));
        let _entered = runtime.enter();
        let mut options = ConnectOptions::new().name(name).connection_timeout(PATIENCE).ping_interval(PING);
        let watch = Arc::new(Silence::new(&shown, log));
        options = options.event_callback(move |event| {
            watch.take(&event);
            async {}
        });
        // The client ignores the user in the address.
        if let Some((user, password)) = user_and_password(&server.address) {
            options = options.user_and_password(user, password);
        }
        if let Some(path) = &server.root_certificate {
            options = options.add_root_certificates(path.clone()).require_tls(true);
        }
        if let Some(path) = &server.credentials {
            let fault =
                |error: std::io::Error| wording::no_credentials(&path.display().to_string(), &error.to_string());
            options = runtime.block_on(options.credentials_file(path)).map_err(fault)?;
        }
        let connecting = async { options.connect(server.address.as_str()).await };
        let client = runtime.block_on(connecting).map_err(|error| {
            // Some reasons repeat the address.
            let reason = error.to_string().replace(&server.address, &shown);
            wording::no_server(&shown, &reason)
        })?;
        let jetstream = jetstream::ContextBuilder::new().timeout(PATIENCE).ack_timeout(PATIENCE).build(client.clone());
        Ok(Self { runtime, client, jetstream, server: shown })
    }

    /// A thread must enter before it uses or drops parts of the client, which start asynchronous tasks.
    pub fn enter(&self) -> EnterGuard<'static> {
        self.runtime.enter()
    }

    pub fn is_open(&self) -> bool {
        self.client.connection_state() == connection::State::Connected
    }

    pub async fn stream(jetstream: &jetstream::Context) -> Result<Stream, String> {
        let config = stream::Config {
            name: STREAM.to_owned(),
            subjects: vec![format!("nbc.v{VERSION}.task.>")],
            retention: RetentionPolicy::WorkQueue,
            storage: StorageType::File,
            max_age: MOST_AGE,
            max_message_size: MOST_BYTES as i32,
            ..stream::Config::default()
        };
        let end = Instant::now() + PATIENCE;
        loop {
            match jetstream.get_or_create_stream(config.clone()).await {
                // While another program makes it, the server may say that its subjects are taken.
                Err(error) if has_overlap(&error) && Instant::now() < end => time::sleep(PAUSE).await,
                stream => return stream.map_err(|error| error.to_string()),
            }
        }
    }

    pub async fn queue(jetstream: &jetstream::Context, token: &str) -> Result<PullConsumer, String> {
        let stream = Self::stream(jetstream).await?;
        let name = format!("workers-{token}");
        let config = pull::Config {
            durable_name: Some(name.clone()),
            ack_policy: AckPolicy::Explicit,
            ack_wait: SILENCE,
            filter_subject: format!("nbc.v{VERSION}.task.{token}.>"),
            max_ack_pending: MOST_TAKEN,
            max_waiting: MOST_TAKEN,
            inactive_threshold: MOST_AGE,
            ..pull::Config::default()
        };
        stream.get_or_create_consumer(&name, config).await.map_err(|error| error.to_string())
    }

    pub fn open_queue(&self, token: &str) -> Result<PullConsumer, Diagnostic> {
        let jetstream = jetstream::ContextBuilder::new().timeout(OPENING).build(self.client.clone());
        let queue = self.runtime.block_on(Self::queue(&jetstream, token));
        queue.map_err(|reason| self.no_queue(reason))
    }

    pub fn no_queue(&self, reason: String) -> Diagnostic {
        wording::no_queue(&self.server, &reason)
    }
}

struct Silence {
    server: String,
    log: Log,
    is_silent: AtomicBool,
}

impl Silence {
    fn new(server: &str, log: Log) -> Self {
        Self { server: server.to_owned(), log, is_silent: AtomicBool::new(false) }
    }

    fn take(&self, event: &Event) {
        let server = &self.server;
        match event {
            Event::Disconnected if !self.is_silent.swap(true, Ordering::Relaxed) => {
                (self.log)(&format!("the NATS server `{server}` does not answer; trying again\n"));
            }
            Event::Connected if self.is_silent.swap(false, Ordering::Relaxed) => {
                (self.log)(&format!("the NATS server `{server}` answers again\n"));
            }
            _ => {}
        }
    }
}

pub fn words(error: impl ToString) -> String {
    error.to_string()
}

fn has_overlap(error: &CreateStreamError) -> bool {
    let CreateStreamErrorKind::JetStream(error) = error.kind() else { return false };
    error.error_code() == ErrorCode::STREAM_SUBJECT_OVERLAP
}

pub fn task_subject(token: &str, search: &str, key: TaskKey) -> String {
    let TaskKey { run, generation, index } = key;
    format!("nbc.v{VERSION}.task.{token}.{search}.{run}.{generation}.{index}")
}

pub fn task_subjects(token: &str, search: &str) -> String {
    format!("nbc.v{VERSION}.task.{token}.{search}.>")
}

pub fn search_of(subject: &str) -> Option<&str> {
    subject.split('.').nth(4)
}

pub fn answer_subject(search: &str, worker: &str) -> String {
    format!("nbc.v{VERSION}.answer.{search}.{worker}")
}

pub fn worker_note_subject() -> String {
    format!("nbc.v{VERSION}.worker")
}

pub fn search_note_subject() -> String {
    format!("nbc.v{VERSION}.search")
}

pub fn reply_subject(worker: &str) -> String {
    format!("nbc.v{VERSION}.reply.{worker}")
}

pub fn random_name() -> String {
    format!("{:08x}", getrandom::u32().unwrap_or_else(|_| std::process::id()))
}

fn user_and_password(urls: &str) -> Option<(String, String)> {
    let url: ServerAddr = urls.split(',').next()?.parse().ok()?;
    let decoded = |text: &str| percent_decode_str(text).decode_utf8_lossy().into_owned();
    Some((decoded(url.username()?), decoded(url.password()?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_subject_of_a_task_names_its_search() {
        let subject = task_subject("0_2_0-00ff", "abcd", TaskKey { run: 1, generation: 2, index: 3 });
        assert_eq!(subject, "nbc.v8.task.0_2_0-00ff.abcd.1.2.3");
        assert_eq!(search_of(&subject), Some("abcd"));
    }

    #[test]
    fn users_and_passwords_are_read_from_addresses() {
        let expected = Some(("me".to_owned(), "a b".to_owned()));
        assert_eq!(user_and_password("nats://me:a%20b@host:4222,nats://other"), expected);
        assert_eq!(user_and_password("nats://host:4222"), None);
    }
}
