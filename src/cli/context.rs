//! What every command is given: where and how to print.

use std::fmt;
use std::io::{self, IsTerminal, Write};

use clap::{Args, ValueEnum};
use serde::Serialize;
use serde_json::ser::Formatter;

use crate::cli::Failure;
use crate::cli::output::Output;
use crate::diag::{Diagnostic, is_hidden, render, visible};
use crate::report::{Document, Schema};
use crate::source::Sources;

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
    out: Output,
}

impl Context {
    pub(super) fn new(global: &GlobalArguments) -> Self {
        Self { format: global.format, color: global.color.on(), out: Output::new(io::stdout().lock()) }
    }

    /// Prints to standard output. Into a closed pipe nothing is printed any more; the work goes on, since it decides the exit status.
    ///
    /// # Errors
    /// When the output cannot be written, for example on a full disk.
    pub fn print(&mut self, text: impl fmt::Display) -> Result<(), Failure> {
        Ok(self.out.write_all(visible(&text.to_string()).as_bytes())?)
    }

    /// Prints a value as one line of JSON, with its schema.
    ///
    /// # Errors
    /// As [`Context::print`].
    pub fn print_json(&mut self, schema: Schema, value: &impl Serialize) -> Result<(), Failure> {
        let mut writer = serde_json::Serializer::with_formatter(&mut self.out, Visible);
        Document::new(schema, value).serialize(&mut writer).map_err(io::Error::from)?;
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
        let _ = io::stderr().write_all(visible(text).as_bytes());
    }

    /// Writes diagnostics to standard error, with their excerpts of the sources.
    pub fn tell(&self, diagnostics: &[Diagnostic], sources: &Sources) {
        // What is of the user is made visible there; colors are ours.
        let _ = io::stderr().write_all(render::text(diagnostics, sources, self.color).as_bytes());
    }
}

/// JSON without characters that steer a terminal.
struct Visible;

impl Formatter for Visible {
    fn write_string_fragment<W: ?Sized + Write>(&mut self, writer: &mut W, fragment: &str) -> io::Result<()> {
        let mut rest = fragment;
        while let Some((at, hidden)) = rest.char_indices().find(|(_, c)| is_hidden(*c)) {
            // All of them lie below U+10000, so that one unit of UTF-16 names each.
            write!(writer, "{}\\u{:04x}", &rest[..at], u32::from(hidden))?;
            rest = &rest[at + hidden.len_utf8()..];
        }
        writer.write_all(rest.as_bytes())
    }
}
