//! The socket of a page's requests and of its swarm's frames. Each page has a thread of its own.

use std::sync::Arc;
use std::thread;

use crossbeam_channel::{Receiver, bounded, select};
use tungstenite::Utf8Bytes;

use crate::connections::SharedStream;
use crate::post::{Post, post};
use crate::served::Served;
use crate::socket::{WAITING, pump};
use nbc_play::Visit;

pub(super) fn serve(served: &Arc<Served>, wire: SharedStream, rest: Vec<u8>) {
    let (requests, waiting) = bounded(WAITING);
    let (line, outgoing, woken) = post();
    let visited = served.clone();
    thread::spawn(move || visit(&visited, Arc::new(line), &waiting, &woken));
    pump(wire, rest, requests, outgoing, &served.waiting);
}

fn visit(served: &Served, line: Arc<Post>, requests: &Receiver<Utf8Bytes>, woken: &Receiver<()>) {
    let mut visit = Visit::new(served.site.clone(), line, served.now());
    loop {
        select! {
            recv(requests) -> text => match text {
                Ok(text) => visit.receive(&text, served.now()),
                Err(_) => return,
            },
            recv(woken) -> _ => {}
            default(visit.due(served.now())) => {}
        }
        visit.advance(served.now());
    }
}
