//! How a command ended.

use std::process::ExitCode;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    Done,
    TestFailed,
    /// An editor ended its server without a request to shut down; the protocol asks for 1.
    Abandoned,
    BadInput,
    Interrupted,
}

impl Status {
    pub fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::TestFailed | Self::Abandoned => 1,
            Self::BadInput => 2,
            Self::Interrupted => 4,
        }
    }
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        status.code().into()
    }
}
