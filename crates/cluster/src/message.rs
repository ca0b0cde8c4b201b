//! The messages between searches and their workers: data only, checked when read. The first byte is the version; the
//! rest is in postcard's format.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// The version of the messages, which is also in their subjects.
pub const VERSION: u8 = 7;
pub const MOST_BYTES: usize = 256 * 1024;
const MOST_NAME: usize = 100;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MessageFault {
    TooLong,
    Version,
    Shape,
    /// It has values that no program of this version sends.
    Values,
}

/// The place of a task in the work of a program: its run, its generation, its number among the tasks of that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TaskKey {
    pub run: u32,
    pub generation: u32,
    pub index: u32,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct WorkerNote {
    pub name: String,
    /// The version of the program.
    pub program: String,
    /// The hash of its physics.
    pub physics: u64,
    pub threads: u32,
    pub evaluations: u64,
    /// Evaluations that it took over because another worker did not answer.
    pub redelivered: u64,
    /// Evaluations of the last seconds, for each thousand seconds.
    pub per_kilosecond: u64,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SearchNote {
    pub name: String,
    /// The version of the program.
    pub program: String,
    pub physics: u64,
    pub runs: u32,
    pub workers: u32,
    pub evaluations: u64,
    /// Evaluations of the last seconds, for each thousand seconds.
    pub per_kilosecond: u64,
    /// Evaluations without a result.
    pub waiting: u64,
    /// Evaluations that were given to a second worker.
    pub redelivered: u64,
    pub refused: u32,
}

/// The reply to an answer or a note.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum AnswerReply {
    /// The answer was received.
    Received,
    /// The worker has other physics, or another version of the program.
    OtherPhysics,
    /// The worker sent a message that is invalid.
    Invalid,
    /// The worker sent a result that is wrong.
    Wrong,
}

/// The bytes of a message of plain values.
pub fn encode(message: &impl Serialize) -> Vec<u8> {
    postcard::to_extend(message, vec![VERSION]).expect("plain values can be written")
}

/// Reads a message of plain values.
pub fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, MessageFault> {
    if bytes.len() > MOST_BYTES {
        return Err(MessageFault::TooLong);
    }
    match bytes.split_first() {
        Some((&VERSION, rest)) => match postcard::take_from_bytes(rest) {
            Ok((message, [])) => Ok(message),
            _ => Err(MessageFault::Shape),
        },
        _ => Err(MessageFault::Version),
    }
}

impl WorkerNote {
    /// Reads and checks.
    pub fn decode(bytes: &[u8]) -> Result<Self, MessageFault> {
        let note: Self = decode(bytes)?;
        if is_name(&note.name) && is_name(&note.program) { Ok(note) } else { Err(MessageFault::Values) }
    }
}

impl SearchNote {
    /// Reads and checks.
    pub fn decode(bytes: &[u8]) -> Result<Self, MessageFault> {
        let note: Self = decode(bytes)?;
        if is_name(&note.name) && is_name(&note.program) { Ok(note) } else { Err(MessageFault::Values) }
    }
}

impl AnswerReply {
    /// Reads.
    pub fn decode(bytes: &[u8]) -> Result<Self, MessageFault> {
        decode(bytes)
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
        let mut bytes = encode(&AnswerReply::Received);
        assert_eq!(AnswerReply::decode(&bytes), Ok(AnswerReply::Received));
        bytes.push(0);
        assert_eq!(AnswerReply::decode(&bytes), Err(MessageFault::Shape));
        bytes[0] = VERSION + 1;
        assert_eq!(AnswerReply::decode(&bytes), Err(MessageFault::Version));
        assert_eq!(AnswerReply::decode(&vec![VERSION; MOST_BYTES + 1]), Err(MessageFault::TooLong));
        assert_eq!(AnswerReply::decode(&[]), Err(MessageFault::Version));
    }

    proptest! {
        #[test]
        fn any_bytes_are_a_message_or_a_fault(rest in prop::collection::vec(any::<u8>(), 0..300)) {
            let bytes = [vec![VERSION], rest].concat();
            let _ = WorkerNote::decode(&bytes);
            let _ = SearchNote::decode(&bytes);
            let _ = AnswerReply::decode(&bytes);
        }
    }
}
