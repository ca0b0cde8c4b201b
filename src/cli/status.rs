//! How a command ended.

use std::process::ExitCode;

/// How a command ended, as the shell sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Done, and every test passed: 0.
    Done,
    /// A test failed: 1.
    TestFailed,
    /// An editor ended its server without a request to shut down: 1, as the protocol says.
    Abandoned,
    /// The input or the usage is at fault: 2.
    BadInput,
    /// A signal ended it in good order: 4.
    Interrupted,
}

impl Status {
    /// The exit status.
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
