//! A page of `nbc play`, as its script is, over real sockets.

use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

use crate::support::*;

/// A server of an empty folder, and a page of it.
pub(super) fn served(arguments: &[&str]) -> (Bench, Server, Page) {
    let bench = Bench::new();
    let server = Server::start(bench.path(), arguments);
    let page = server.page();
    (bench, server, page)
}

pub(super) struct Server {
    child: Child,
    _limit: Limit,
    /// `http://127.0.0.1:PORT/TOKEN/`
    pub(super) address: String,
    /// The token of the teacher's page, if there is a class.
    pub(super) teacher: Option<String>,
}

impl Server {
    pub(super) fn start(folder: &Path, arguments: &[&str]) -> Self {
        Self::run(program().args(["play", "--no-open"]).args(arguments).current_dir(folder))
    }

    pub(super) fn run(command: &mut Command) -> Self {
        let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
        let limit = Limit::of(&child);
        let mut address = String::new();
        let mut printed = BufReader::new(child.stdout.take().unwrap());
        printed.read_line(&mut address).unwrap();
        let mut teacher = None;
        if command.get_args().any(|argument| argument == "--class") {
            let mut line = String::new();
            printed.read_line(&mut line).unwrap();
            assert!(line.ends_with(" (for the teacher)\n"), "{line}");
            teacher = line.split('/').nth(3).map(str::to_owned);
        }
        Self { child, _limit: limit, address: address.trim().to_owned(), teacher }
    }

    pub(super) fn process(&self) -> u32 {
        self.child.id()
    }

    /// `127.0.0.1:PORT`
    pub(super) fn host(&self) -> &str {
        self.address.split('/').nth(2).unwrap()
    }

    pub(super) fn token(&self) -> &str {
        self.address.split('/').nth(3).unwrap()
    }

    /// The answer to a request without a body, as its head and its body.
    pub(super) fn get(&self, path: &str, headers: &str) -> (String, Vec<u8>) {
        let mut stream = TcpStream::connect(self.host()).unwrap();
        write!(stream, "GET {path} HTTP/1.1\r\n{headers}Connection: close\r\n\r\n").unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").unwrap_or(bytes.len());
        let head = String::from_utf8_lossy(&bytes[..end]).into_owned();
        (head, bytes.split_off((end + 4).min(bytes.len())))
    }

    /// The answer to a request of the server's own page.
    pub(super) fn fetch(&self, path: &str) -> (String, Vec<u8>) {
        self.get(&format!("/{}/{path}", self.token()), &format!("Host: {}\r\n", self.host()))
    }

    /// A socket, or the status with which it was refused.
    pub(super) fn socket(&self, name: &str, origin: &str) -> Result<WebSocket<TcpStream>, u16> {
        let address = format!("ws://{}/{}/{name}", self.host(), self.token());
        let mut request = address.into_client_request().unwrap();
        request.headers_mut().insert("Origin", origin.parse().unwrap());
        let stream = TcpStream::connect(self.host()).unwrap();
        match tungstenite::client(request, stream) {
            Ok((socket, _)) => Ok(socket),
            Err(tungstenite::HandshakeError::Failure(tungstenite::Error::Http(answer))) => {
                Err(answer.status().as_u16())
            }
            Err(other) => panic!("{other}"),
        }
    }

    pub(super) fn page(&self) -> Page {
        let socket = self.socket("live", &format!("http://{}", self.host())).unwrap();
        Page { socket, next: 0, events: VecDeque::new(), frames: VecDeque::new() }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub(super) struct Page {
    pub(super) socket: WebSocket<TcpStream>,
    next: u64,
    pub(super) events: VecDeque<Value>,
    pub(super) frames: VecDeque<Frame>,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) robots: usize,
    pub(super) now: u32,
    pub(super) first: u32,
    pub(super) last: u32,
    pub(super) runs: bool,
    pub(super) number: u8,
    pub(super) logged: u32,
    pub(super) cycles: u16,
    pub(super) shown: u16,
    pub(super) rest: Vec<u8>,
}

impl Frame {
    fn read(bytes: &[u8]) -> Self {
        let two = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
        let four = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!(bytes[..2], [1, 12]);
        Self {
            robots: two(2).into(),
            now: four(4),
            first: four(8),
            last: four(12),
            runs: bytes[20] == 1,
            number: bytes[21],
            logged: four(24),
            cycles: two(28),
            shown: two(30),
            rest: bytes[32..].to_vec(),
        }
    }

    /// The bytes of a cycle of the log, of a swarm with fewer than nine bits of each kind and one clock.
    pub(super) fn length(&self) -> usize {
        5 + 4 * self.robots
    }

    /// The bits of the outputs in the last cycle of the log.
    pub(super) fn outputs(&self) -> u8 {
        self.rest[(usize::from(self.cycles) - 1) * self.length() + 2]
    }

    pub(super) fn poses(&self) -> &[u8] {
        &self.rest[usize::from(self.cycles) * self.length()..]
    }
}

impl Page {
    pub(super) fn begin(&mut self, mut request: Value) -> u64 {
        self.next += 1;
        request["id"] = json!(self.next);
        self.send(&request);
        self.next
    }

    pub(super) fn send(&mut self, request: &Value) {
        self.socket.send(Message::text(request.to_string())).unwrap();
    }

    fn receive(&mut self) -> Option<Value> {
        match self.socket.read().unwrap() {
            Message::Text(text) => return Some(serde_json::from_str(&text).unwrap()),
            Message::Binary(bytes) => self.frames.push_back(Frame::read(&bytes)),
            _ => {}
        }
        None
    }

    /// The answer to a request, or its error; events before it are kept.
    pub(super) fn wait(&mut self, id: u64) -> Result<Value, Value> {
        loop {
            let Some(mut value) = self.receive() else { continue };
            if value["id"] == json!(id) && value.get("ok").is_some() {
                return Ok(value["ok"].take());
            }
            if value["id"] == json!(id) && value.get("error").is_some() {
                return Err(value["error"].take());
            }
            self.events.push_back(value);
        }
    }

    pub(super) fn ask(&mut self, request: Value) -> Result<Value, Value> {
        let id = self.begin(request);
        self.wait(id)
    }

    pub(super) fn done(&mut self, request: Value) -> Value {
        self.ask(request).unwrap()
    }

    pub(super) fn event(&mut self, fits: impl Fn(&Value) -> bool) -> Value {
        loop {
            if let Some(at) = self.events.iter().position(&fits) {
                return self.events.remove(at).unwrap();
            }
            let event = self.receive();
            self.events.extend(event);
        }
    }

    pub(super) fn frame(&mut self, fits: impl Fn(&Frame) -> bool) -> Frame {
        loop {
            while let Some(frame) = self.frames.pop_front() {
                if fits(&frame) {
                    return frame;
                }
            }
            let event = self.receive();
            self.events.extend(event);
        }
    }

    pub(super) fn compile(&mut self, path: &str, text: &str) -> Value {
        let program = self.done(json!({ "do": "program", "path": path, "text": text }));
        assert_eq!(program["errors"], 0, "{program}");
        let circuits = program["circuits"].as_array().unwrap();
        let circuit = circuits.last().unwrap()["circuit"].clone();
        self.done(json!({ "do": "compile", "path": path, "circuit": circuit, "swarm": null }))["swarm"].take()
    }
}
