//! The connections of a server, each with a thread. If there are too many without a socket, the oldest is closed.

use std::collections::VecDeque;
use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::thread;
use std::time::Duration;

/// The most connections that carry requests. Sockets of pages are counted apart.
const MOST: usize = 128;
const BREATH: Duration = Duration::from_millis(50);

/// A connection, which several threads may share: each write is done as a whole.
#[derive(Clone)]
pub(super) struct SharedStream(Arc<Ends>);

struct Ends {
    stream: TcpStream,
    writing: Mutex<()>,
    /// Whether it carries a request, and is not a socket of a page.
    counts: AtomicBool,
}

impl SharedStream {
    fn new(stream: TcpStream) -> Self {
        Self(Arc::new(Ends { stream, writing: Mutex::new(()), counts: AtomicBool::new(true) }))
    }

    pub(super) fn stream(&self) -> &TcpStream {
        &self.0.stream
    }

    pub(super) fn becomes_socket(&self) {
        self.0.counts.store(false, Ordering::Relaxed);
    }

    pub(super) fn close(&self) {
        self.0.counts.store(false, Ordering::Relaxed);
        let _ = self.0.stream.shutdown(Shutdown::Both);
    }
}

impl Read for SharedStream {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.stream().read(bytes)
    }
}

impl Write for SharedStream {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let _turn = self.0.writing.lock().unwrap_or_else(PoisonError::into_inner);
        self.stream().write_all(bytes).map(|()| bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Answers each connection in a thread of its own, until one comes after the stop.
pub(super) fn serve(
    listener: &TcpListener,
    is_stopped: &AtomicBool,
    answer: impl Fn(SharedStream) + Clone + Send + 'static,
) {
    let mut open: VecDeque<Weak<Ends>> = VecDeque::new();
    loop {
        let Ok((stream, _)) = listener.accept() else {
            thread::sleep(BREATH);
            continue;
        };
        open.retain(|wire| wire.strong_count() > 0);
        let wires = open.iter().filter_map(Weak::upgrade).map(SharedStream);
        if is_stopped.load(Ordering::Relaxed) {
            return wires.for_each(|wire| wire.close());
        }
        let waiting: Vec<SharedStream> = wires.filter(|wire| wire.0.counts.load(Ordering::Relaxed)).collect();
        if waiting.len() >= MOST {
            waiting[0].close();
        }
        let (wire, answer) = (SharedStream::new(stream), answer.clone());
        open.push_back(Arc::downgrade(&wire.0));
        // If no thread can be started, the connection is closed.
        let _ = thread::Builder::new().spawn(move || answer(wire));
    }
}
