//! The reasons for which circuits cannot be exported, and their messages.

use nbc_base::diag::{Code, Diagnostic};

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExportError {
    TooManyRobots { robots: usize, most: usize },
    TooManyBodies { bodies: usize, most: usize },
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
