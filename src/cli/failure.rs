//! Why a command could not be carried out.

use std::io;
use std::path::Path;

use crate::cli::{Context, Format, Status};
use crate::diag::{Code, Diagnostic, io_words, json};
use crate::report::Schema;
use crate::source::Sources;

/// Why a command could not be carried out.
#[derive(Debug)]
pub enum Failure {
    /// The user's input is at fault.
    Input {
        /// What is wrong with it.
        diagnostics: Vec<Diagnostic>,
        /// The texts that the diagnostics point into.
        sources: Sources,
    },
    /// Standard output cannot be written.
    Output(io::Error),
}

impl Failure {
    /// Input at fault in places of `sources`.
    pub fn input(diagnostics: Vec<Diagnostic>, sources: Sources) -> Self {
        Self::Input { diagnostics, sources }
    }

    /// A fault without a place in a text.
    pub fn plain(diagnostic: Diagnostic) -> Self {
        Self::Input { diagnostics: vec![diagnostic], sources: Sources::default() }
    }

    /// A file or folder that cannot be written.
    pub fn unwritable(path: &Path, error: &io::Error) -> Self {
        Self::plain(Diagnostic::unwritable(path, error))
    }

    /// Tells the user, and says how the program ends.
    pub fn report(self, context: &mut Context) -> Status {
        match self {
            Self::Input { diagnostics, sources } => {
                if context.format == Format::Json {
                    // The failure itself is what matters if this cannot be written either.
                    let _ = context
                        .print_json(
                            Schema::Diagnostics,
                            &serde_json::json!({ "diagnostics": json(&diagnostics, &sources) }),
                        )
                        .and_then(|()| context.flush());
                }
                context.tell(&diagnostics, &sources);
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

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}
