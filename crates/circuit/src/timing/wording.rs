//! Why latches stay as they are, in words.

use crate::timing::held::WhyKept;

impl WhyKept {
    pub fn explain(self) -> &'static str {
        match self {
            Self::NotOneBit => "it is not a latch of one bit",
            Self::NotRecognized => "one robot in its place would not be recognized as a latch",
        }
    }
}
