//! Why a command could not be carried out.

use std::io;
use std::path::Path;

#[cfg(feature = "gpu")]
use crate::cli::wording::DeviceFailure;
#[cfg(not(feature = "cluster"))]
use crate::cli::wording::NoCluster;
#[cfg(not(feature = "gpu"))]
use crate::cli::wording::NoDevices;
#[cfg(not(feature = "play"))]
use crate::cli::wording::NoPage;
use crate::cli::wording::{DrawError, SubjectError, UsageError};
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
    /// Input at fault in places of `sources`.
    pub fn input(diagnostics: Vec<Diagnostic>, sources: Sources) -> Self {
        Self::Input(Diagnostics { list: diagnostics, sources })
    }

    /// A fault without a place in a text.
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

impl From<UsageError> for Failure {
    fn from(error: UsageError) -> Self {
        Self::plain(error.into())
    }
}

#[cfg(feature = "cluster")]
impl From<nbc_cluster::ClusterError> for Failure {
    fn from(error: nbc_cluster::ClusterError) -> Self {
        Self::plain(error.into())
    }
}

#[cfg(not(feature = "cluster"))]
impl From<NoCluster> for Failure {
    fn from(error: NoCluster) -> Self {
        Self::plain(error.into())
    }
}

#[cfg(feature = "gpu")]
impl From<DeviceFailure> for Failure {
    fn from(error: DeviceFailure) -> Self {
        Self::plain(error.into())
    }
}

#[cfg(not(feature = "gpu"))]
impl From<NoDevices> for Failure {
    fn from(error: NoDevices) -> Self {
        Self::plain(error.into())
    }
}

#[cfg(feature = "play")]
impl From<nbc_play::PlayError> for Failure {
    fn from(error: nbc_play::PlayError) -> Self {
        Self::plain(error.into())
    }
}

#[cfg(not(feature = "play"))]
impl From<NoPage> for Failure {
    fn from(error: NoPage) -> Self {
        Self::plain(error.into())
    }
}

impl From<nbc_lsp::ServerError> for Failure {
    fn from(error: nbc_lsp::ServerError) -> Self {
        Self::plain(error.into())
    }
}

impl From<SubjectError> for Failure {
    fn from(error: SubjectError) -> Self {
        Self::plain(error.into())
    }
}

impl From<DrawError> for Failure {
    fn from(error: DrawError) -> Self {
        Self::plain(error.into())
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}
