//! A client of NATS that sees and says whatever it wants.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use crate::cluster::server::Server;
use crate::support::*;

/// The first byte of each message.
pub const VERSION: u8 = 8;

pub fn subject_of(rest: &str) -> String {
    format!("nbc.v{VERSION}.{rest}")
}

/// A connection that receives every message of the program.
pub struct Wire {
    reader: BufReader<TcpStream>,
}

pub struct Seen {
    pub subject: String,
    /// The subject for an answer, or empty.
    pub reply: String,
    pub payload: Vec<u8>,
}

impl Seen {
    /// Whether it is an answer of the worker to a task of run 0.
    pub fn is_first_answer_of(&self, worker: &str) -> bool {
        let text = self.payload.get(1..).unwrap_or_default();
        self.is_answer_of(worker) && text.starts_with(br#"{"key":{"run":0,"#)
    }

    pub fn is_answer_of(&self, worker: &str) -> bool {
        self.subject.starts_with(&subject_of("answer.")) && self.subject.ends_with(&format!(".{worker}"))
    }
}

impl Wire {
    /// Connects, and returns when the server has the subscription.
    pub fn open(server: &Server) -> Self {
        let stream = TcpStream::connect(("127.0.0.1", server.port())).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(120))).unwrap();
        let mut wire = Self { reader: BufReader::new(stream) };
        wire.say(b"CONNECT {\"verbose\":false,\"pedantic\":false}\r\n");
        wire.subscribe(&subject_of(">"));
        wire
    }

    fn say(&mut self, bytes: &[u8]) {
        self.reader.get_mut().write_all(bytes).unwrap();
    }

    fn line(&mut self) -> String {
        let mut line = String::new();
        assert!(self.reader.read_line(&mut line).expect("the server says something") > 0, "the server is there");
        line.trim_end().to_owned()
    }

    /// Receives the messages of further subjects. The subscription is called by its subjects.
    pub fn subscribe(&mut self, subjects: &str) {
        self.say(format!("SUB {subjects} {subjects}\r\nPING\r\n").as_bytes());
        while self.line() != "PONG" {}
    }

    pub fn request(&mut self, subject: &str, payload: &str) {
        let reply = subject_of("reply.wire");
        self.publish(&format!("{subject} {reply}"), payload.as_bytes());
        let answer = String::from_utf8(self.wait_for(|message| message.subject == reply).payload).unwrap();
        assert!(!answer.contains("error"), "{answer}");
    }

    /// Sends a message. The subject for an answer may follow the subject.
    pub fn publish(&mut self, subject: &str, payload: &[u8]) {
        let head = format!("PUB {subject} {}\r\n", payload.len());
        self.say(&[head.as_bytes(), payload, b"\r\n"].concat());
    }

    #[track_caller]
    pub fn wait_for(&mut self, wanted: impl Fn(&Seen) -> bool) -> Seen {
        let end = Instant::now() + PATIENCE;
        loop {
            assert!(Instant::now() < end, "the message does not come");
            let line = self.line();
            if line == "PING" {
                self.say(b"PONG\r\n");
            }
            let words: Vec<&str> = line.split(' ').collect();
            let [kind @ ("MSG" | "HMSG"), subject, _, .., size] = words[..] else { continue };
            let reply = if words.len() > 4 { words[3] } else { "" };
            let mut payload = vec![0; size.parse::<usize>().unwrap() + 2];
            self.reader.read_exact(&mut payload).unwrap();
            payload.truncate(payload.len() - 2);
            let seen = Seen { subject: subject.to_owned(), reply: reply.to_owned(), payload };
            if kind == "MSG" && wanted(&seen) {
                return seen;
            }
        }
    }
}

/// The bytes of a message.
pub fn message(content: &Value) -> Vec<u8> {
    [vec![VERSION], content.to_string().into_bytes()].concat()
}

/// The report of a worker with foreign physics.
pub fn foreign_note(name: &str) -> Vec<u8> {
    let (version, physics) = ("9.9.9", "0000000000000007");
    message(&json!({
        "name": name, "version": version, "physics": physics, "threads": 1, "evaluations": 0,
        "evaluations_per_second": 0.0, "redelivered": 0,
    }))
}
