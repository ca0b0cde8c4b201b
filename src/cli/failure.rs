//! Why a command could not be carried out.

use std::io;
use std::path::Path;

use crate::cli::{Context, Format, Status};
use crate::diag::{Code, Diagnostic, Diagnostics, io_words};
use crate::report::Schema;
use crate::source::Sources;

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

    /// A file or folder that cannot be written.
    pub fn unwritable(path: &Path, error: &io::Error) -> Self {
        Self::plain(Diagnostic::unwritable(path, error))
    }

    /// Tells the user, and says how the program ends.
    pub fn report(self, context: &mut Context) -> Status {
        match self {
            Self::Input(found) => {
                if context.format == Format::Json {
                    // The failure itself is what matters if this cannot be written either.
                    let _ = context
                        .print_json(Schema::Diagnostics, &serde_json::json!({ "diagnostics": found.json() }))
                        .and_then(|()| context.flush());
                }
                context.tell(&found.list, &found.sources);
                Status::BadInput
            }
            Self::Output(error) => {
                context.tell(&[unprintable(&error)], &Sources::default());
                Status::BadInput
            }
        }
    }
}

/// Standard output that cannot be written.
pub(super) fn unprintable(error: &io::Error) -> Diagnostic {
    let message = format!("cannot write the output: {}", io_words(error));
    Diagnostic::without_place(Code::Unwritable, message)
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
