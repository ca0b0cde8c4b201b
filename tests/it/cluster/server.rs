//! A NATS server of a test's own.

use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// The server, which is killed when it is dropped.
pub struct Server {
    port: u16,
    options: Vec<String>,
    store: PathBuf,
    child: Child,
    // Removed last.
    _folder: tempfile::TempDir,
}

impl Server {
    /// Starts `nats-server` with JetStream; `None`, with a message, where it is not installed.
    pub fn start(options: &[&str]) -> Option<Self> {
        let folder = tempfile::tempdir().unwrap();
        let store = folder.path().join("store");
        Self::start_in(folder, store, options)
    }

    /// As [`Server::start`], with its data in a folder.
    pub fn start_in(folder: tempfile::TempDir, store: PathBuf, options: &[&str]) -> Option<Self> {
        if Command::new("nats-server").arg("--version").stdout(Stdio::null()).status().is_err() {
            eprintln!("skipped: `nats-server` is not installed (apt-get install nats-server)");
            return None;
        }
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let options: Vec<String> = options.iter().map(|&option| option.to_owned()).collect();
        let child = spawn(port, &store, &options);
        Some(Self { port, options, store, child, _folder: folder })
    }

    /// Kills it and starts it again on the same disk.
    pub fn restart(&mut self) {
        self.stop();
        self.child = spawn(self.port, &self.store, &self.options);
    }

    /// Kills it and starts it again on an empty disk.
    pub fn restart_empty(&mut self) {
        self.stop();
        std::fs::remove_dir_all(&self.store).unwrap();
        self.child = spawn(self.port, &self.store, &self.options);
    }

    fn stop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }

    pub fn port(&self) -> u16 {
        self.port
    }

    pub fn process(&self) -> u32 {
        self.child.id()
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

fn spawn(port: u16, store: &Path, options: &[String]) -> Child {
    let mut command = Command::new("nats-server");
    command.args(["--port", &port.to_string(), "--jetstream", "--store_dir"]).arg(store).args(options);
    let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let started = Instant::now();
    while TcpStream::connect(("127.0.0.1", port)).is_err() {
        assert!(started.elapsed() < Duration::from_secs(60), "the server listens");
        thread::yield_now();
    }
    child
}
