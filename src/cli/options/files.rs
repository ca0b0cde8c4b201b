//! `--file`: files that replace those that a program declares.

use std::ffi::OsString;
use std::fs;
use std::sync::Arc;

use clap::Args;

use crate::cli::wording;
use nbc_base::diag::Diagnostic;
use nbc_session::{Checked, CompileOptions};

#[derive(Args)]
pub(in crate::cli) struct FilesArguments {
    /// The file that a memory begins with, by the name that the program declares; `--NAME PATH` is short for it
    #[arg(long = "file", value_name = "NAME=PATH", value_parser = named_file)]
    named_files: Vec<(String, String)>,
}

impl FilesArguments {
    pub(in crate::cli) fn is_given(&self) -> bool {
        !self.named_files.is_empty()
    }

    pub(in crate::cli) fn files(&self) -> Vec<(String, String)> {
        self.named_files.clone()
    }

    /// Fails if no source declares one of the files.
    pub(in crate::cli) fn check(&self, sources: &[Arc<Checked>]) -> Result<(), Diagnostic> {
        for (at, (name, _)) in self.named_files.iter().enumerate() {
            if self.named_files[at + 1..].iter().any(|(other, _)| other == name) {
                return Err(wording::two_files(name));
            }
            let declared: Vec<_> = sources.iter().map(|source| source.declares_file(name)).collect();
            if declared.iter().all(Result::is_err) {
                declared.into_iter().collect::<Result<(), _>>()?;
            }
        }
        Ok(())
    }

    /// The options with the files that a source declares.
    pub(in crate::cli) fn of(&self, source: &Checked, options: CompileOptions) -> CompileOptions {
        let mut files = self.files();
        files.retain(|(name, _)| source.declares_file(name).is_ok());
        CompileOptions { files, ..options }
    }
}

fn named_file(text: &str) -> Result<(String, String), String> {
    let (name, path) = text.split_once('=').ok_or("expected a name, `=` and a path")?;
    Ok((name.to_owned(), path.to_owned()))
}

/// The arguments with `--NAME PATH` as `--file NAME=PATH`, where a source among them declares the file `NAME`.
pub(in crate::cli) fn with_named_files(arguments: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let sources = arguments.iter().filter(|path| path.to_string_lossy().ends_with(".nb"));
    // Pipes and devices are not read here, and large files are refused later.
    let is_source = |path: &&OsString| fs::metadata(path).is_ok_and(|about| about.is_file() && about.len() < 8 << 20);
    let texts: Vec<String> = sources.filter(is_source).filter_map(|path| fs::read_to_string(path).ok()).collect();
    let declares = |text: &str, name: &str| {
        let rest = |line: &str| {
            Some(line.strip_prefix("file ")?.trim_start().strip_prefix(name)?.trim_start().starts_with('='))
        };
        text.lines().any(|line| rest(line) == Some(true))
    };
    let mut given = Vec::with_capacity(arguments.len());
    let mut rest = arguments.into_iter().peekable();
    while let Some(argument) = rest.next() {
        // What is not text is refused later.
        let text = argument.to_str().unwrap_or_default().to_owned();
        let (name, value) = match text.strip_prefix("--").map(|option| option.split_once('=')) {
            Some(Some((name, value))) => (name.to_owned(), Some(value.into())),
            Some(None) => (text[2..].to_owned(), None),
            None => (String::new(), None),
        };
        if name.is_empty() || !texts.iter().any(|source| declares(source, &name)) {
            given.push(argument);
            continue;
        }
        let mut named = OsString::from(format!("{name}="));
        named.push(value.or_else(|| rest.next()).unwrap_or_default());
        given.extend(["--file".into(), named]);
    }
    given
}
