//! The reasons for which bodies are invalid, and their messages.

use std::error::Error;
use std::fmt;

/// The reason why a network has no valid body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Undeveloped {
    FewActuators { found: usize, least: usize },
    Apart,
}

impl fmt::Display for Undeveloped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FewActuators { found, least } => {
                write!(f, "the body has {found} actuators, expected at least {least}")
            }
            Self::Apart => f.write_str("the body is not in one piece"),
        }
    }
}

impl Error for Undeveloped {}
