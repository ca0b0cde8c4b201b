//! Files that were made for a page to download. Each can be fetched once.

use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError};

/// The most files that wait. If there are more, the oldest is dropped.
const MOST: usize = 8;

/// The files that wait to be fetched, and the number of the last one.
#[derive(Default)]
pub(super) struct Takes(Mutex<(u64, VecDeque<Take>)>);

pub(super) struct Take {
    number: u64,
    pub(super) name: String,
    pub(super) kind: &'static str,
    pub(super) bytes: Vec<u8>,
}

impl Takes {
    /// Returns the address relative to the page.
    pub(super) fn keep(&self, name: &str, kind: &'static str, bytes: Vec<u8>) -> String {
        let mut takes = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (number, files) = &mut *takes;
        *number += 1;
        if files.len() == MOST {
            files.pop_front();
        }
        files.push_back(Take { number: *number, name: name.to_owned(), kind, bytes });
        format!("take/{number}/{name}")
    }

    pub(super) fn fetch(&self, number: u64, name: &str) -> Option<Take> {
        let mut takes = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = takes.1.iter().position(|take| take.number == number && take.name == name)?;
        takes.1.remove(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_fetched_once_by_its_number_and_name() {
        let takes = Takes::default();
        assert_eq!(takes.keep("a.csv", "text/csv", vec![1]), "take/1/a.csv");
        assert!(takes.fetch(1, "b.csv").is_none() && takes.fetch(2, "a.csv").is_none());
        assert_eq!(takes.fetch(1, "a.csv").unwrap().bytes, [1]);
        assert!(takes.fetch(1, "a.csv").is_none());
        for _ in 0..=MOST {
            takes.keep("a.csv", "text/csv", vec![1]);
        }
        assert!(takes.fetch(2, "a.csv").is_none() && takes.fetch(3, "a.csv").is_some());
    }
}
