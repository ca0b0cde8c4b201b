//! Why latches stay as they are, in words.

pub(super) const NOT_ONE_BIT: &str = "it is not a latch of one bit";
pub(super) const NOT_RECOGNIZED: &str = "one robot in its place would not be recognized as a latch";
