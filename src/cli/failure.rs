//! The failure of a command.

use std::io;
use std::path::Path;

use crate::cli::draw::wording::DrawError;
use crate::cli::evolve::wording::EvolveError;
#[cfg(feature = "gpu")]
use crate::cli::gpu::wording::DeviceFailure;
use crate::cli::runs::wording::RunChoiceError;
#[cfg(not(all(feature = "play", feature = "cluster", feature = "gpu")))]
use crate::cli::wording::MissingFeature;
use crate::cli::wording::UsageError;
use nbc_base::diag::{Diagnostic, Diagnostics, io_words};
use nbc_base::source::Sources;

/// Why a command could not be carried out.
#[derive(Debug)]
pub enum Failure {
    /// The user's input is at fault.
    Input(Diagnostics),
    /// Standard output cannot be written.
    Output(io::Error),
}

impl Failure {
    /// Errors of the input, with their places in `sources`.
    pub fn input(diagnostics: Vec<Diagnostic>, sources: Sources) -> Self {
        Self::Input(Diagnostics { list: diagnostics, sources })
    }

    /// One error without a place in a text.
    pub fn plain(diagnostic: Diagnostic) -> Self {
        Self::Input(diagnostic.into())
    }

    /// A file or folder that cannot be read.
    pub fn unreadable(path: &Path, error: &io::Error) -> Self {
        UsageError::Unreadable { path: path.display().to_string(), reason: io_words(error) }.into()
    }

    /// A file or folder that cannot be written.
    pub fn unwritable(path: &Path, error: &io::Error) -> Self {
        Self::plain(Diagnostic::unwritable(path, error))
    }
}

/// Standard output that cannot be written.
pub(super) fn unprintable(error: &io::Error) -> Diagnostic {
    UsageError::Output { reason: io_words(error) }.into()
}

impl From<Diagnostics> for Failure {
    fn from(found: Diagnostics) -> Self {
        Self::Input(found)
    }
}

/// Errors without a place in a text, which are worded as diagnostics.
macro_rules! failures {
    ($($(#[$when:meta])* $error:ty,)*) => {$(
        $(#[$when])*
        impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Self::plain(error.into())
            }
        }
    )*};
}

failures! {
    #[cfg(feature = "gpu")]
    DeviceFailure,
    DrawError,
    EvolveError,
    #[cfg(not(all(feature = "play", feature = "cluster", feature = "gpu")))]
    MissingFeature,
    #[cfg(feature = "play")]
    nbc_play::ExportError,
    #[cfg(feature = "play")]
    nbc_play_server::PlayError,
    RunChoiceError,
    nbc_lsp::ServerError,
    UsageError,
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}
