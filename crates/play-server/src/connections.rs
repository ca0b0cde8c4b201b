//! The connections of a server. Connections without a request are closed. If there are too many, the oldest is closed.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::time::Duration;

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::{TcpListener, TcpStream};
use tokio::task::AbortHandle;

/// The most connections that carry requests. Sockets of pages are counted apart.
const MOST: usize = 128;
/// The time by which the head of a request must be complete.
pub(super) const PATIENCE: Duration = Duration::from_secs(10);
/// The time between two attempts while the system gives no more connections.
const BREATH: Duration = Duration::from_millis(50);

/// Connections without a request are closed after some time.
pub(super) async fn serve(listener: TcpListener, router: Router, patience: Duration) -> Infallible {
    let mut open: VecDeque<AbortHandle> = VecDeque::new();
    loop {
        let Ok((stream, _)) = listener.accept().await else {
            tokio::time::sleep(BREATH).await;
            continue;
        };
        open.retain(|connection| !connection.is_finished());
        if open.len() == MOST
            && let Some(oldest) = open.pop_front()
        {
            oldest.abort();
        }
        open.push_back(tokio::spawn(answer(stream, router.clone(), patience)).abort_handle());
    }
}

/// Answers the requests of a connection until it is closed, silent for too long, or a socket of a page.
async fn answer(stream: TcpStream, router: Router, patience: Duration) {
    let mut server = http1::Builder::new();
    server.timer(TokioTimer::new()).header_read_timeout(patience);
    let connection = server.serve_connection(TokioIo::new(stream), TowerToHyperService::new(router));
    // A protocol error closes the connection.
    let _ = connection.with_upgrades().await;
}

#[cfg(test)]
mod tests {
    use std::io::Read;
    use std::net::TcpStream;

    use super::*;

    #[test]
    fn a_silent_connection_is_closed_in_time() {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
        let listener = runtime.block_on(TcpListener::bind("127.0.0.1:0")).unwrap();
        let address = listener.local_addr().unwrap();
        std::thread::spawn(move || runtime.block_on(serve(listener, Router::new(), Duration::from_millis(50))));
        let mut silent = TcpStream::connect(address).unwrap();
        silent.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        assert_eq!(silent.read(&mut [0]).unwrap(), 0);
    }
}
