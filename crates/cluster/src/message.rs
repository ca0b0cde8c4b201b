//! The messages between searches and their workers: data only, checked when read. The first byte is the version; the
//! rest is JSON.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// The version of the messages, which is also in their subjects.
pub const VERSION: u8 = 8;
pub const MOST_BYTES: usize = 1_000_000;
const MOST_NAME: usize = 100;

/// The place of a task in the work of a program: its run, its generation, its number among the tasks of that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TaskKey {
    pub run: u32,
    pub generation: u32,
    pub index: u32,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorkerNote {
    pub name: String,
    pub version: String,
    pub physics: String,
    pub threads: u32,
    pub evaluations: u64,
    pub evaluations_per_second: f64,
    pub redelivered: u64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SearchNote {
    pub name: String,
    pub version: String,
    pub physics: String,
    pub runs: u32,
    pub workers: u32,
    pub evaluations: u64,
    pub evaluations_per_second: f64,
    pub waiting: u64,
    pub redelivered: u64,
    pub refused: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum AnswerReply {
    Received,
    /// The worker has other physics, or another version of the program.
    OtherPhysics,
    Invalid,
    Wrong,
}

pub fn encode(message: &impl Serialize) -> Vec<u8> {
    let mut bytes = vec![VERSION];
    serde_json::to_writer(&mut bytes, message).expect("messages can be written as JSON");
    bytes
}

/// Reads a message; `None` if it is too long, of another version or damaged.
pub fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    let (&VERSION, rest) = bytes.split_first().filter(|_| bytes.len() <= MOST_BYTES)? else { return None };
    serde_json::from_slice(rest).ok()
}

impl WorkerNote {
    pub fn decode(bytes: &[u8]) -> Option<Self> {
        decode(bytes).filter(|note: &Self| [&note.name, &note.version, &note.physics].iter().all(|name| is_name(name)))
    }
}

impl SearchNote {
    pub fn decode(bytes: &[u8]) -> Option<Self> {
        decode(bytes).filter(|note: &Self| [&note.name, &note.version, &note.physics].iter().all(|name| is_name(name)))
    }
}

/// Whether a text can be a name, which is also a part of a subject: letters, digits, `-`, `_`; in versions also `.`.
pub fn is_name(name: &str) -> bool {
    let sound = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    !name.is_empty() && name.len() <= MOST_NAME && name.chars().all(sound)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn messages_that_are_too_long_old_or_followed_by_more_are_rejected() {
        let reply = decode::<AnswerReply>;
        let mut bytes = encode(&AnswerReply::Received);
        assert_eq!(reply(&bytes), Some(AnswerReply::Received));
        assert_eq!(reply(&[&bytes[..], b" 0"].concat()), None);
        assert_eq!(reply(&[&bytes[..], &[b' '; MOST_BYTES]].concat()), None);
        bytes[0] = VERSION + 1;
        assert_eq!([reply(&bytes), reply(&[])], [None; 2]);
    }

    proptest! {
        #[test]
        fn any_bytes_are_a_message_or_a_fault(rest in prop::collection::vec(any::<u8>(), 0..300)) {
            let bytes = [vec![VERSION], rest].concat();
            let _ = WorkerNote::decode(&bytes);
            let _ = SearchNote::decode(&bytes);
            let _ = decode::<AnswerReply>(&bytes);
        }
    }
}
