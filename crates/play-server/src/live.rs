//! The socket of a page's requests and of its swarm's frames. Each page has a thread of its own.

use std::sync::Arc;
use std::thread;

use axum::extract::ws::{Utf8Bytes, WebSocket};
use crossbeam_channel::{Receiver, bounded, select};

use crate::post::{Post, post};
use crate::served::Served;
use crate::socket::{WAITING, pump};
use nbc_play::Visit;

pub(super) async fn serve(served: Arc<Served>, socket: WebSocket) {
    let (requests, waiting) = bounded(WAITING);
    let (line, outgoing, woken) = post();
    let visited = served.clone();
    thread::spawn(move || visit(&visited, Arc::new(line), &waiting, &woken));
    pump(socket, requests, outgoing, &served.waiting).await;
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
