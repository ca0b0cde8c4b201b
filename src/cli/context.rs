//! The context of every command: where and how to print.

use std::fmt;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

use clap::{Args, Command, ValueEnum};
use serde::Serialize;
use serde_json::ser::Formatter;

use crate::cli::Status;
use crate::cli::documents::DiagnosticList;
use crate::cli::failure::Failure;
use crate::cli::output::Output;
use crate::cli::wording;
use nbc_base::diag::suggest::alternatives;
use nbc_base::diag::{Diagnostic, Diagnostics, is_hidden, render, visible};
use nbc_base::source::{ForeignCircuit, ProofOrigin, Sources};
use nbc_session::Checked;
use nbc_session::report::{Document, Schema, Svg, png};
use nbc_session::store;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum OutputFormat {
    /// Text for people.
    #[default]
    Text,
    /// JSON for programs.
    Json,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum ColorChoice {
    /// On a terminal, unless NO_COLOR is set
    #[default]
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

#[derive(Args)]
pub(super) struct GlobalArguments {
    /// The format of the output: text for people or JSON for programs
    #[arg(long, global = true, value_enum, default_value_t, hide_possible_values = false)]
    format: OutputFormat,
    /// When to color messages
    #[arg(long, global = true, value_enum, default_value_t)]
    color: ColorChoice,
}

impl ColorChoice {
    fn on(self, stream: &impl IsTerminal) -> bool {
        match self {
            Self::Always => true,
            Self::Never => false,
            Self::Auto => stream.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
        }
    }
}

/// Results go to standard output; progress, logs and diagnostics to standard error.
pub struct Context {
    pub format: OutputFormat,
    /// Of messages.
    pub color: bool,
    /// Of results.
    paint: bool,
    /// For completion scripts.
    pub command: fn() -> Command,
    out: Output,
}

impl Context {
    pub(super) fn new(global: &GlobalArguments, command: fn() -> Command) -> Self {
        Self {
            format: global.format,
            color: global.color.on(&io::stderr()),
            paint: global.color.on(&io::stdout()),
            command,
            out: Output::new(io::stdout()),
        }
    }

    /// The context of a command line that clap refuses.
    pub(super) fn bare(format: OutputFormat, command: fn() -> Command) -> Self {
        Self::new(&GlobalArguments { format, color: ColorChoice::Auto }, command)
    }

    /// Prints to standard output. A closed pipe is ignored and the command continues, because its work decides the exit
    /// status.
    pub fn print(&mut self, text: impl fmt::Display) -> Result<(), Failure> {
        Ok(self.out.write_all(visible(&text.to_string()).as_bytes())?)
    }

    /// Prints with the words for passing and failing in green and red.
    pub fn print_verdicts(&mut self, text: &str) -> Result<(), Failure> {
        let text = visible(text);
        let text = if self.paint { painted(&text).into() } else { text };
        Ok(self.out.write_all(text.as_bytes())?)
    }

    /// Clears the screen, if text is printed to a terminal.
    pub fn clear(&mut self) -> Result<(), Failure> {
        if self.format == OutputFormat::Text && io::stdout().is_terminal() {
            self.out.write_all(b"\x1b[2J\x1b[3J\x1b[H")?;
        }
        self.flush()
    }

    pub fn print_json(&mut self, schema: Schema, value: &impl Serialize) -> Result<(), Failure> {
        let mut writer = serde_json::Serializer::with_formatter(&mut self.out, Visible);
        Document::new(schema, value).serialize(&mut writer).map_err(io::Error::from)?;
        Ok(writeln!(self.out)?)
    }

    pub fn print_result<T: fmt::Display>(
        &mut self,
        schema: Schema,
        value: &impl Serialize,
        text: impl FnOnce() -> T,
    ) -> Result<(), Failure> {
        match self.format {
            OutputFormat::Json => self.print_json(schema, value),
            OutputFormat::Text => self.print(text()),
        }
    }

    pub fn flush(&mut self) -> Result<(), Failure> {
        Ok(self.out.flush()?)
    }

    /// Writes to standard error. Errors are ignored, because there is no other place to report them.
    pub fn log(&self, text: &str) {
        log(text);
    }

    /// Logs warnings about a source, each once.
    pub fn warn<'d>(&self, source: &Checked, warnings: impl IntoIterator<Item = &'d Diagnostic>) {
        let mut told: Vec<Diagnostic> = Vec::new();
        for warning in warnings {
            let is_new = told.iter().all(|known| (known.code, &known.message) != (warning.code, &warning.message));
            told.extend(is_new.then(|| warning.clone()));
        }
        self.tell(&told, &source.sources);
    }

    /// Logs what the proofs of circuits of other tools' files begin with, a line for each file.
    pub fn origins(&self, source: &Checked) {
        let mut lines: Vec<(&str, String, Vec<String>)> = Vec::new();
        for ForeignCircuit { file, circuit, origin } in &source.foreign {
            let file = file.as_str();
            let words = match origin {
                ProofOrigin::File => origin.to_string(),
                ProofOrigin::Slang { version, .. } => format!("{origin} (Yosys {version})"),
            };
            match lines.iter_mut().find(|(known, same, _)| *known == file && *same == words) {
                Some((_, _, circuits)) => circuits.push(circuit.clone()),
                None => lines.push((file, words, vec![circuit.clone()])),
            }
        }
        for (file, words, circuits) in lines {
            self.log(&format!("{file}: {} proved from {words}\n", alternatives(&circuits, "and")));
        }
    }

    /// Reports a failure, and returns the exit status.
    pub(super) fn report(&mut self, failure: Failure) -> Status {
        match failure {
            Failure::Input(found) => {
                self.print_diagnostics(&found);
                self.tell(&found.list, &found.sources);
            }
            Failure::Output(error) => self.tell(&[wording::unprintable(&error)], &Sources::default()),
        }
        Status::BadInput
    }

    /// Prints to standard output, if it is JSON.
    pub(super) fn print_diagnostics(&mut self, found: &Diagnostics) {
        if self.format == OutputFormat::Json {
            let value = DiagnosticList { diagnostics: found.findings() };
            // The failure itself is what matters if this cannot be written either.
            let _ = self.print_json(Schema::Diagnostics, &value).and_then(|()| self.flush());
        }
    }

    /// Writes a file that the user named, and says so on standard error.
    pub fn write(&self, path: &Path, bytes: &[u8]) -> Result<(), Failure> {
        store::write(path, bytes).map_err(|error| Failure::unwritable(path, &error))?;
        self.wrote(path);
        Ok(())
    }

    /// Writes PNG if the path ends so, and else SVG.
    pub fn write_picture(&self, path: &Path, svg: &Svg) -> Result<(), Failure> {
        let is_png = path.extension().is_some_and(|extension| extension == "png");
        self.write(path, &if is_png { png(svg) } else { svg.finish().into_bytes() })
    }

    pub fn wrote(&self, path: &Path) {
        self.log(&format!("wrote {}\n", path.display()));
    }

    pub fn tell(&self, diagnostics: &[Diagnostic], sources: &Sources) {
        tell(diagnostics, sources, self.color);
    }
}

/// As [`Context::log`], from any thread.
pub(super) fn log(text: &str) {
    let _ = io::stderr().write_all(visible(text).as_bytes());
}

/// As [`Context::tell`], from any thread.
pub(super) fn tell(diagnostics: &[Diagnostic], sources: &Sources, color: bool) {
    // `render` escapes the control characters of the user's text; those of the colors must stay.
    let _ = io::stderr().write_all(render::text(diagnostics, sources, color).as_bytes());
}

/// `pass` in green, `fail` and `FAIL` in red, where they begin or end a line.
fn painted(text: &str) -> String {
    text.split_inclusive('\n').map(paint_line).collect()
}

fn paint_line(line: &str) -> String {
    const COLORS: [(&str, &str); 3] = [("pass", "32"), ("FAIL", "1;31"), ("fail", "31")];
    let end = line.trim_end().len();
    let begins =
        |word: &str| line[..end].strip_prefix(word).is_some_and(|rest| rest.is_empty() || rest.starts_with(' '));
    let ends = |word: &str| line[..end].strip_suffix(word).is_some_and(|rest| rest.ends_with(' '));
    let first = COLORS.iter().find(|(word, _)| begins(word)).map(|found| (0, found));
    let found = first.or_else(|| COLORS.iter().find(|(word, _)| ends(word)).map(|found| (end - found.0.len(), found)));
    let Some((at, (word, color))) = found else { return line.to_owned() };
    format!("{}\x1b[{color}m{word}\x1b[0m{}", &line[..at], &line[at + word.len()..])
}

/// JSON with control characters escaped, because a terminal would execute them.
struct Visible;

impl Formatter for Visible {
    fn write_string_fragment<W: ?Sized + Write>(&mut self, writer: &mut W, fragment: &str) -> io::Result<()> {
        let mut rest = fragment;
        while let Some((at, hidden)) = rest.char_indices().find(|(_, c)| is_hidden(*c)) {
            // All of them are below U+10000, so each is one unit of UTF-16.
            write!(writer, "{}\\u{:04x}", &rest[..at], u32::from(hidden))?;
            rest = &rest[at + hidden.len_utf8()..];
        }
        writer.write_all(rest.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_say_how_a_test_ended_are_colored() {
        let text = "pass  latch (5 rows)\nFAIL  pass\n    0 1  1 -  pass\n  passed a gate\n1 passed, 0 failed\n";
        let green = "\x1b[32mpass\x1b[0m";
        let expected = format!(
            "{green}  latch (5 rows)\n\x1b[1;31mFAIL\x1b[0m  pass\n    0 1  1 -  {green}\n  passed a gate\n\
             1 passed, 0 failed\n"
        );
        assert_eq!(painted(text), expected);
        assert_eq!(painted("FAIL\n"), "\x1b[1;31mFAIL\x1b[0m\n");
    }
}
