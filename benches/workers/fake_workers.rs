//! Stand-ins for workers: each takes a task, sleeps and answers.

use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Read, Write, copy, sink};
use std::net::TcpStream;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::json;

use crate::cluster::server::Server;
use crate::cluster::wire::{message, subject_of};

/// The time that a stand-in sleeps over an evaluation.
const EVALUATION: Duration = Duration::from_millis(100);
/// What a request for a task says.
const WISH: &str = "{\"batch\":1,\"expires\":600000000000}";

/// Stand-ins behind one connection.
pub struct FakeWorkers {
    /// Of their connection, which is in all names.
    number: usize,
    /// The part of subjects that names the physics.
    token: String,
    out: Mutex<TcpStream>,
    sleeping: Mutex<VecDeque<FakeTask>>,
    came: Condvar,
    answered: AtomicU64,
}

/// A task that is slept over.
struct FakeTask {
    due: Instant,
    task: String,
    acknowledgment: String,
}

impl FakeWorkers {
    /// Starts some. They work until the server ends.
    pub fn start(server: &Server, number: usize, workers: usize, token: &str) -> Arc<Self> {
        let stream = TcpStream::connect(("127.0.0.1", server.port())).unwrap();
        stream.set_nodelay(true).unwrap();
        let (out, token) = (Mutex::new(stream.try_clone().unwrap()), token.to_owned());
        let (sleeping, came, answered) = (Mutex::default(), Condvar::new(), AtomicU64::new(0));
        let this = Arc::new(Self { number, token, out, sleeping, came, answered });
        let options = "{\"verbose\":false,\"pedantic\":false,\"headers\":true,\"no_responders\":true}";
        this.say(format!("CONNECT {options}\r\nSUB task{number} 1\r\nSUB reply{number}.> 2\r\n").as_bytes());
        (0..workers).for_each(|_| this.say(this.request().as_bytes()));
        let (reader, sleeper) = (Arc::clone(&this), Arc::clone(&this));
        thread::spawn(move || reader.read(BufReader::new(stream)));
        thread::spawn(move || sleeper.answer());
        this
    }

    /// The number of answers that the search has confirmed.
    pub fn answered(&self) -> u64 {
        self.answered.load(Ordering::Relaxed)
    }

    fn say(&self, bytes: &[u8]) {
        // When the server is gone, the measurement is over.
        let _ = self.out.lock().unwrap().write_all(bytes);
    }

    fn request(&self) -> String {
        let subject = format!("$JS.API.CONSUMER.MSG.NEXT.nbc-tasks.workers-{}", self.token);
        format!("PUB {subject} task{} {}\r\n{WISH}\r\n", self.number, WISH.len())
    }

    fn read(&self, mut reader: BufReader<TcpStream>) {
        let mut line = String::new();
        while reader.read_line(&mut line).is_ok_and(|length| length > 0) {
            let words: Vec<&str> = line.trim_end().split(' ').collect();
            match words[..] {
                ["PING"] => self.say(b"PONG\r\n"),
                ["MSG", task, "1", acknowledgment, size] => {
                    skip(&mut reader, size);
                    let (due, task) = (Instant::now() + EVALUATION, task.to_owned());
                    let sleeping = FakeTask { due, task, acknowledgment: acknowledgment.to_owned() };
                    self.sleeping.lock().unwrap().push_back(sleeping);
                    self.came.notify_one();
                }
                ["MSG", subject, "2", size] => {
                    skip(&mut reader, size);
                    self.answered.fetch_add(1, Ordering::Relaxed);
                    let (_, acknowledgment) = subject.split_once('.').unwrap();
                    self.say(format!("PUB {acknowledgment} 4\r\n+ACK\r\n{}", self.request()).as_bytes());
                }
                ["HMSG", .., size] => skip(&mut reader, size),
                _ => {}
            }
            line.clear();
        }
    }

    /// Answers each task when it has been slept over.
    fn answer(&self) {
        for count in 1_u64.. {
            let none = |sleeping: &mut VecDeque<FakeTask>| sleeping.is_empty();
            let mut sleeping = self.came.wait_while(self.sleeping.lock().unwrap(), none).unwrap();
            let FakeTask { due, task, acknowledgment } = sleeping.pop_front().unwrap();
            drop(sleeping);
            thread::sleep(due.saturating_duration_since(Instant::now()));
            let payload = better(&task, count * 1000 + self.number as u64);
            let (number, search, length) = (self.number, task.split('.').nth(4).unwrap(), payload.len());
            let (subject, reply) = (subject_of(&format!("answer.{search}.sleeper{number}")), format!("reply{number}"));
            let head = format!("PUB {subject} {reply}.{acknowledgment} {length}\r\n");
            self.say(&[head.as_bytes(), &payload, b"\r\n"].concat());
        }
    }
}

/// An answer with greater fitnesses than any before: it enters the archive, so that the search has elites to vary.
fn better(task: &str, count: u64) -> Vec<u8> {
    let key: Vec<u64> = task.split('.').skip(5).map(|number| number.parse().unwrap()).collect();
    let is_right = |bit: &u64| count >> bit & 1 == 1;
    let fitness = count as f64;
    let displacement: Vec<f64> = (0..4).map(|bit| if is_right(&bit) { fitness } else { -fitness }).collect();
    let behavior: String = (0..4).map(|bit| if is_right(&bit) { 'R' } else { 'L' }).collect();
    let scores = json!({ "fitness": [fitness, fitness], "behavior": behavior, "displacement": displacement });
    let work = json!({ "env_steps": GATES_STEPS, "left_out": 0 });
    message(&json!({
        "key": { "run": key[0], "generation": key[1], "index": key[2] },
        "result": { "Evaluation": { "outcome": { "Measured": scores }, "work": work } },
    }))
}

/// Env steps of an evaluation of `gates`.
const GATES_STEPS: u64 = (40 + 4 * 10) * 84;

fn skip(reader: &mut impl Read, size: &str) {
    copy(&mut reader.take(size.parse::<u64>().unwrap() + 2), &mut sink()).unwrap();
}
