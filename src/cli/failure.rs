//! The failure of a command.

use std::io;
use std::path::Path;

use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::source::Sources;

#[derive(Debug)]
pub enum Failure {
    /// The user's input is at fault.
    Input(Diagnostics),
    /// Standard output cannot be written.
    Output(io::Error),
}

impl Failure {
    pub fn input(list: Vec<Diagnostic>, sources: Sources) -> Self {
        Self::Input(Diagnostics { list, sources })
    }

    pub fn unwritable(path: &Path, error: &io::Error) -> Self {
        Diagnostic::unwritable(path, error).into()
    }
}

impl From<Diagnostics> for Failure {
    fn from(found: Diagnostics) -> Self {
        Self::Input(found)
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}

/// Errors without a place in a text, which are worded as diagnostics.
macro_rules! failures {
    ($($(#[$when:meta])* $error:ty,)*) => {$(
        $(#[$when])*
        impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Self::Input(Diagnostic::from(error).into())
            }
        }
    )*};
}

failures! {
    Diagnostic,
    #[cfg(feature = "cluster")]
    nbc_cluster::ClusterError,
}
