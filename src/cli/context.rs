//! What every command is given: where and how to print.

use std::fmt;
use std::io::{self, BufWriter, IsTerminal, StdoutLock, Write};

use clap::{Args, ValueEnum};
use serde::Serialize;

use crate::cli::Failure;

/// Who reads the output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// People.
    #[default]
    Text,
    /// Programs.
    Json,
}

/// When to color.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Color {
    /// On a terminal, unless NO_COLOR is set
    #[default]
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

/// Options that every command takes.
#[derive(Args)]
pub(super) struct GlobalArguments {
    /// Who reads the output: people or programs
    #[arg(long, global = true, value_enum, default_value_t, hide_possible_values = false)]
    format: Format,
    /// When to color messages
    #[arg(long, global = true, value_enum, default_value_t)]
    color: Color,
}

impl Color {
    fn on(self) -> bool {
        match self {
            Self::Always => true,
            Self::Never => false,
            Self::Auto => {
                io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
            }
        }
    }
}

/// What every command is given. Results go to standard output; progress, logs and diagnostics to standard error.
pub struct Context {
    /// Who reads the output.
    pub format: Format,
    /// Whether messages are colored.
    pub color: bool,
    out: BufWriter<StdoutLock<'static>>,
}

impl Context {
    pub(super) fn new(global: &GlobalArguments) -> Self {
        Self { format: global.format, color: global.color.on(), out: BufWriter::new(io::stdout().lock()) }
    }

    /// Prints to standard output.
    ///
    /// # Errors
    /// When the output cannot be written; a closed pipe then ends the program quietly.
    pub fn print(&mut self, text: impl fmt::Display) -> Result<(), Failure> {
        Ok(write!(self.out, "{text}")?)
    }

    /// Prints a value as one line of JSON.
    ///
    /// # Errors
    /// As [`Context::print`].
    pub fn print_json(&mut self, value: &impl Serialize) -> Result<(), Failure> {
        serde_json::to_writer(&mut self.out, value).map_err(io::Error::from)?;
        Ok(writeln!(self.out)?)
    }

    /// Hands on what was printed so far.
    ///
    /// # Errors
    /// As [`Context::print`].
    pub fn flush(&mut self) -> Result<(), Failure> {
        Ok(self.out.flush()?)
    }

    /// Writes a message to standard error; where that is closed, nobody wants it.
    pub fn log(&self, text: &str) {
        let _ = io::stderr().write_all(text.as_bytes());
    }
}
