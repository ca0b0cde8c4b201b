//! A NATS server of a test's own.

use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::support::*;

/// The server, which is killed when it is dropped.
pub struct Server {
    port: u16,
    options: Vec<String>,
    store: PathBuf,
    pub child: Child,
    // Removed last.
    folder: TempDir,
}

impl Server {
    /// Starts `nats-server` with JetStream; `None`, with a message, where it is not installed.
    pub fn start(options: &[&str]) -> Option<Self> {
        let folder = tempfile::tempdir().unwrap();
        let store = folder.path().join("store");
        Self::start_in(folder, store, options)
    }

    /// As [`Server::start`], with its data in a folder.
    pub fn start_in(folder: TempDir, store: PathBuf, options: &[&str]) -> Option<Self> {
        NATS_SERVER.find()?;
        let options: Vec<String> = options.iter().map(|&option| option.to_owned()).collect();
        // The server chooses its port: one that was free a moment ago may be taken.
        let child = spawn("-1", &folder, &store, &options);
        let port = chosen_port(&folder, &child);
        Some(Self { port, options, store, child, folder })
    }

    pub fn restart(&mut self) {
        self.stop();
        self.start_again();
    }

    pub fn restart_empty(&mut self) {
        self.stop();
        fs::remove_dir_all(&self.store).unwrap();
        self.start_again();
    }

    /// Kills it and starts it again without the messages, but with what it has noted about them: as after a disk that
    /// kept one and lost the other.
    pub fn restart_without_messages(&mut self) {
        self.stop();
        fs::remove_dir_all(self.store.join("jetstream/$G/streams/nbc-tasks/msgs")).unwrap();
        self.start_again();
    }

    fn start_again(&mut self) {
        self.child = spawn(&self.port.to_string(), &self.folder, &self.store, &self.options);
        assert_eq!(chosen_port(&self.folder, &self.child), self.port);
    }

    fn stop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }

    pub fn port(&self) -> u16 {
        self.port
    }

    pub fn url(&self) -> String {
        format!("nats://127.0.0.1:{}", self.port)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.stop();
    }
}

fn spawn(port: &str, folder: &TempDir, store: &Path, options: &[String]) -> Child {
    let mut command = Command::new("nats-server");
    command.args(["--port", port, "--ports_file_dir"]).arg(folder.path()).args(["--jetstream", "--store_dir"]);
    command.arg(store).args(options).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

fn chosen_port(folder: &TempDir, server: &Child) -> u16 {
    let path = folder.path().join(format!("nats-server_{}.ports", server.id()));
    let started = Instant::now();
    loop {
        let text = fs::read_to_string(&path).unwrap_or_default();
        let address =
            serde_json::from_str(&text).ok().and_then(|ports: Value| ports["nats"][0].as_str().map(str::to_owned));
        if let Some(address) = address {
            let port = address.rsplit(':').next().and_then(|port| port.parse().ok()).expect("a port");
            if TcpStream::connect(("127.0.0.1", port)).is_ok() {
                return port;
            }
        }
        assert!(started.elapsed() < PATIENCE, "the server listens");
        thread::sleep(Duration::from_millis(5));
    }
}
