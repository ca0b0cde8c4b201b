//! Why registers stay as they are, in words.

use crate::timing::pulsed::WhyKept;

impl WhyKept {
    pub fn explain(self) -> &'static str {
        match self {
            Self::OtherForm => {
                "it is not made of eight NAND cells as `register` is, or its first latch is read elsewhere or starts \
                 otherwise"
            }
            Self::DerivedClock => "its clock is not an input",
            Self::FastData => "its data may change before a pulse has ended",
            Self::NotOneBit => "it is not a latch of one bit",
            Self::NotRecognized => "one robot in its place would not be recognized as a latch",
            Self::NoGain => "pulsed latches would not save robots",
        }
    }
}
