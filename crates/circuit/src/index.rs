//! Indices that may be missing, for long lists of them.

use std::num::NonZeroU32;

/// An index below `u32::MAX`: `Option<ListIndex>` takes four bytes, where `Option<u32>` takes eight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ListIndex(NonZeroU32);

impl ListIndex {
    pub fn new(index: u32) -> Self {
        Self(NonZeroU32::MIN.checked_add(index).expect("lists are shorter than 2^32 - 1"))
    }

    pub fn get(self) -> u32 {
        self.0.get() - 1
    }
}
