//! The reasons for which circuits cannot be exported, and their messages.

use nbc_base::diag::{Code, Diagnostic};

/// The reason for which a circuit cannot be exported as a page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExportError {
    /// A circuit with more robots than an exported page may have.
    TooManyRobots {
        /// Its robots.
        robots: usize,
        /// The most.
        most: usize,
    },
    /// A swarm with more different bodies than an exported page may have, as in a world with worn robots.
    TooManyBodies {
        /// Its different bodies.
        bodies: usize,
        /// The most.
        most: usize,
    },
}

impl From<ExportError> for Diagnostic {
    fn from(error: ExportError) -> Self {
        match error {
            ExportError::TooManyRobots { robots, most } => {
                let message = format!("the circuit needs {robots} robots; an exported page has at most {most}");
                Self::without_place(Code::BadValue, message).with_help("choose a smaller circuit with `--circuit`")
            }
            ExportError::TooManyBodies { bodies, most } => {
                let message = format!("the swarm has {bodies} different bodies; an exported page has at most {most}");
                Self::without_place(Code::BadValue, message).with_help("export it in a world without `noise`")
            }
        }
    }
}
