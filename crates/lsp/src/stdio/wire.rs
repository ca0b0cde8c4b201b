//! Messages over standard input and output: their headers, their texts, and the answers to texts that are not messages.

use std::io::{self, BufRead, Read, Write};
use std::thread::{self, JoinHandle};

use crossbeam_channel::{Sender, bounded};
use lsp_server::{Connection, ErrorCode, Message};
use serde_json::Value;

use crate::message::{message, parse, refusal};

/// A longer text could not be checked anyway.
const MOST: u64 = 64 << 20;
const LINE: u64 = 4096;

pub(super) struct Wire {
    reader: JoinHandle<Result<(), String>>,
    writer: JoinHandle<io::Result<()>>,
}

pub(super) fn open() -> (Connection, Wire) {
    let (arriving, receiver) = bounded(0);
    let (sender, leaving) = bounded::<Message>(0);
    let reader = thread::spawn(move || read_all(&mut io::stdin().lock(), &arriving));
    let writer =
        thread::spawn(move || leaving.into_iter().try_for_each(|message| message.write(&mut io::stdout().lock())));
    (Connection { sender, receiver }, Wire { reader, writer })
}

impl Wire {
    pub(super) fn join(self) -> Result<(), String> {
        let read = self.reader.join().unwrap_or_else(|_| Err("the reader failed".to_owned()));
        // What came before a broken message is still answered.
        let written = self.writer.join().map_err(|_| "the writer failed".to_owned())?;
        read.and(written.map_err(|error| nbc_base::diag::io_words(&error)))
    }
}

fn read_all(input: &mut impl BufRead, messages: &Sender<Message>) -> Result<(), String> {
    loop {
        let arrived = match read(input) {
            Ok(Some(arrived)) => arrived,
            Ok(None) => return Ok(()),
            Err(reason) => {
                refuse(&refusal(&Value::Null, ErrorCode::InvalidRequest, &reason));
                return Err(reason);
            }
        };
        let message = match arrived {
            Ok(message) => message,
            Err(answer) => {
                refuse(&answer);
                continue;
            }
        };
        let is_last = matches!(&message, Message::Notification(told) if told.method == "exit");
        if messages.send(message).is_err() || is_last {
            return Ok(());
        }
    }
}

fn refuse(answer: &Value) {
    let answer = answer.to_string();
    let mut output = io::stdout().lock();
    // A client that does not read misses it.
    let _ = write!(output, "Content-Length: {}\r\n\r\n{answer}", answer.len()).and_then(|()| output.flush());
}

/// An error answers a text that is not a message, after which the next can be read; `None` at the end of the input.
fn read(input: &mut impl BufRead) -> Result<Option<Result<Message, Value>>, String> {
    let Some(length) = length(input)? else { return Ok(None) };
    if length > MOST {
        return Err(format!("a message has {length} bytes, expected at most {MOST}"));
    }
    let mut bytes = Vec::new();
    // Room is made for what has come, not for what is announced.
    let read = input.by_ref().take(length).read_to_end(&mut bytes).map_err(|error| nbc_base::diag::io_words(&error))?;
    if (read as u64) < length {
        return Err(format!("a message has {length} bytes, and the input ends after {read}"));
    }
    Ok(Some(parse(&bytes).and_then(message)))
}

fn length(input: &mut impl BufRead) -> Result<Option<u64>, String> {
    let mut length = None;
    loop {
        let mut line = Vec::new();
        let read =
            input.by_ref().take(LINE).read_until(b'\n', &mut line).map_err(|error| nbc_base::diag::io_words(&error))?;
        if read == 0 {
            return Ok(None);
        }
        let line = line.strip_suffix(b"\r\n").and_then(|line| str::from_utf8(line).ok());
        let line = line.ok_or("expected a line such as `Content-Length: 2` that ends with CR LF")?;
        if line.is_empty() {
            return length.map(Some).ok_or_else(|| "expected `Content-Length` before a message".to_owned());
        }
        let (name, value) = line.split_once(':').ok_or_else(|| format!("expected a header, found `{line}`"))?;
        if name.eq_ignore_ascii_case("Content-Length") {
            let value = value.trim();
            length = Some(value.parse().map_err(|_| format!("expected a length in bytes, found `{value}`"))?);
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use serde_json::json;

    use super::*;

    fn first(text: &str) -> Result<Option<Result<Message, Value>>, String> {
        read(&mut text.as_bytes())
    }

    #[test]
    fn messages_are_read_by_their_lengths() {
        let text = "content-length: 15\r\nContent-Type: x\r\n\r\n{\"method\":\"ab\"}rest";
        let read = first(text).unwrap().unwrap();
        assert!(matches!(read, Ok(Message::Notification(told)) if told.method == "ab"));
        assert!(first("").unwrap().is_none());
    }

    #[test]
    fn a_length_beyond_the_limit_reserves_no_memory() {
        let reason = |text: &str| first(text).unwrap_err();
        assert!(reason("Content-Length: 10000000000000\r\n\r\n{}").contains("at most 67108864"));
        assert!(reason("Content-Length: 99999999999999999999\r\n\r\n{}").contains("a length in bytes"));
        assert!(reason("Content-Length: 60000000\r\n\r\n{}").contains("ends after 2"));
        assert!(reason(&"x".repeat(10_000)).contains("ends with CR LF"));
        assert!(reason("\r\n").contains("Content-Length"));
    }

    #[test]
    fn a_text_that_is_not_a_message_has_an_answer_and_a_successor() {
        for (text, expected, code) in [
            ("{x}", Value::Null, ErrorCode::ParseError),
            ("[]", Value::Null, ErrorCode::InvalidRequest),
            ("[\"exit\"]", Value::Null, ErrorCode::InvalidRequest),
            ("{\"id\":7}", json!(7), ErrorCode::InvalidRequest),
            ("{\"id\":1.5,\"method\":\"shutdown\"}", json!(1.5), ErrorCode::InvalidRequest),
        ] {
            let framed = format!("Content-Length: {}\r\n\r\n{text}", text.len());
            let Ok(Some(Err(answer))) = first(&framed) else { panic!("{text}") };
            assert_eq!((&answer["id"], &answer["error"]["code"]), (&expected, &json!(code as i32)), "{text}");
        }
    }

    proptest! {
        #[test]
        fn any_bytes_are_messages_or_faults(
            length in "Content-Length: ([0-9]{1,20}|-1|x)\r\n(\r\n)?",
            text in prop::collection::vec(any::<u8>(), 0..60),
        ) {
            let _ = read(&mut &[length.as_bytes(), &text].concat()[..]);
            let _ = parse(&text).and_then(message);
        }
    }
}
