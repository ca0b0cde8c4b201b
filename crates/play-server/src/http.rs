//! Requests and answers over a connection: one request, one answer.

use std::io::{Read, Write};
use std::net::Shutdown;
use std::time::{Duration, Instant};

use tungstenite::Error;
use tungstenite::error::ProtocolError;
use tungstenite::handshake::machine::TryParse;
use tungstenite::handshake::server::{Request, write_response};
use tungstenite::http::{HeaderValue, Response, StatusCode, header};

use crate::connections::SharedStream;

/// The time by which the head of a request must be complete.
pub(super) const PATIENCE: Duration = Duration::from_secs(10);
const MOST_HEAD: usize = 16 << 10;
/// The most bytes read from a client that keeps sending while it should read its answer.
const MOST_REST: usize = 1 << 20;

pub(super) type HttpAnswer = Response<Vec<u8>>;

pub(super) fn status(status: StatusCode) -> HttpAnswer {
    let mut answer = HttpAnswer::default();
    *answer.status_mut() = status;
    answer
}

pub(super) fn content(kind: &'static str, bytes: impl Into<Vec<u8>>) -> HttpAnswer {
    let mut answer = HttpAnswer::new(bytes.into());
    answer.headers_mut().insert(header::CONTENT_TYPE, HeaderValue::from_static(kind));
    answer
}

/// Reads a request and the bytes after its head. The error is the status to answer, or `None` if the client is gone.
pub(super) fn read(wire: &SharedStream, patience: Duration) -> Result<(Request, Vec<u8>), Option<StatusCode>> {
    let end = Instant::now() + patience;
    let (mut head, mut part) = (Vec::new(), [0; 4096]);
    loop {
        let left = end.saturating_duration_since(Instant::now());
        // Zero would mean no timeout.
        wire.stream().set_read_timeout(Some(left.max(Duration::from_millis(1)))).map_err(|_| None)?;
        let size = wire.stream().read(&mut part).ok().filter(|&size| size > 0 && !left.is_zero()).ok_or(None)?;
        head.extend_from_slice(&part[..size]);
        match Request::try_parse(&head) {
            Ok(Some((size, request))) => return Ok((request, head.split_off(size))),
            Ok(None) if head.len() < MOST_HEAD => {}
            Ok(None) => return Err(Some(StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE)),
            Err(Error::Protocol(ProtocolError::WrongHttpMethod)) => return Err(Some(StatusCode::METHOD_NOT_ALLOWED)),
            Err(_) => return Err(Some(StatusCode::BAD_REQUEST)),
        }
    }
}

pub(super) fn write(mut wire: SharedStream, mut answer: HttpAnswer) {
    let length = HeaderValue::from(answer.body().len());
    answer.headers_mut().insert(header::CONTENT_LENGTH, length);
    answer.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
    let mut bytes = Vec::new();
    write_response(&mut bytes, &answer).expect("headers are ASCII");
    bytes.append(answer.body_mut());
    if wire.write_all(&bytes).is_err() || wire.stream().shutdown(Shutdown::Write).is_err() {
        return;
    }
    // Closing a connection with unread bytes discards the answer.
    let _ = std::io::copy(&mut wire.stream().take(MOST_REST as u64), &mut std::io::sink());
}

#[cfg(test)]
mod tests {
    use std::net::{TcpListener, TcpStream};
    use std::sync::atomic::AtomicBool;

    use super::*;
    use crate::connections;

    #[test]
    fn a_silent_connection_is_closed_in_time() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        let answer = |wire: SharedStream| _ = read(&wire, Duration::from_millis(50));
        std::thread::spawn(move || connections::serve(&listener, &AtomicBool::new(false), answer));
        let mut silent = TcpStream::connect(address).unwrap();
        silent.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        assert_eq!(silent.read(&mut [0]).unwrap(), 0);
    }
}
