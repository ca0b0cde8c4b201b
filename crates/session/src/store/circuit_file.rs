//! Circuit files, read and written in the format of their extension.

use std::path::Path;

use crate::store::verilog::Verilog;
use crate::store::wording::StoreError;
use crate::store::{DiskWorld, disk};
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::source::{FileError, FileId, Sources};
use nbc_circuit::CancelFlag;
use nbc_circuit::formats::{CircuitFormat, CircuitSource, Design, aiger, bench, blif};
use nbc_lang::syntax;

/// Reads a circuit; `clock` names the clock of registers for which the file names none.
///
/// # Errors
/// A file that cannot be read, of an unknown format, or damaged.
pub fn read_circuit(path: &Path, clock: Option<&str>) -> Result<Design, Diagnostics> {
    let name = path.display().to_string();
    match CircuitSource::of_path(&name) {
        Some(CircuitSource::Aiger) => {
            let bytes = disk::read(path, disk::MAX_CIRCUIT_BYTES).map_err(|error| unreadable(path, &error))?;
            Ok(aiger::read(&bytes, clock)?)
        }
        Some(CircuitSource::Bench) => parse(name, text(path)?, |text, file| bench::read(text, file, clock)),
        Some(CircuitSource::Blif) => parse(name, text(path)?, |text, file| blif::read(text, file, clock)),
        Some(CircuitSource::Verilog) => {
            let flat = translated(name.clone(), text(path)?)?;
            parse(format!("{name} (as BLIF)"), flat, |text, file| blif::read(text, file, clock))
        }
        None => Err(Diagnostic::from(StoreError::CircuitFormat { file: name }).into()),
    }
}

/// The top module of a Verilog text as BLIF.
fn translated(name: String, text: String) -> Result<String, Diagnostics> {
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let (source, cancel) = (sources.file(file), &CancelFlag::default());
    Verilog { world: &DiskWorld, path: &source.name, text: &source.text, cancel }.flatten().map_err(|error| {
        let fault = Diagnostic::untranslated(sources.file(file), &error);
        Diagnostics { list: vec![fault], sources }
    })
}

/// A design as the bytes of a file; a program of the language is written as the formatter writes it.
///
/// # Errors
/// The reason why the format cannot express the design.
pub fn encode_circuit(design: &Design, format: CircuitFormat) -> Result<Vec<u8>, Diagnostic> {
    let bytes = format.encode(design)?;
    if format != CircuitFormat::Nb {
        return Ok(bytes);
    }
    Ok(canonical(String::from_utf8(bytes).expect("a program is text"))?.into_bytes())
}

/// A program of ours as the formatter writes it, unless it is too large to be read again.
fn canonical(text: String) -> Result<String, Diagnostic> {
    if text.len() as u64 > syntax::MAX_SOURCE_BYTES {
        return Err(StoreError::NbTooLarge { bytes: text.len(), most: syntax::MAX_SOURCE_BYTES }.into());
    }
    let mut sources = Sources::default();
    let file = sources.add("the circuit as a .nb file", text);
    let parsed = syntax::parse(&sources, file);
    assert!(parsed.errors.is_empty(), "a program that was written can be parsed: {:?}", parsed.errors.first());
    Ok(syntax::format(&sources, file, &parsed.tree))
}

fn unreadable(path: &Path, error: &FileError) -> Diagnostics {
    Diagnostic::unreadable(&path.display().to_string(), error).into()
}

fn text(path: &Path) -> Result<String, Diagnostics> {
    disk::read_text(path, disk::MAX_CIRCUIT_BYTES).map_err(|error| unreadable(path, &error))
}

/// Reads a text under a name for messages.
fn parse(
    name: String,
    text: String,
    read: impl FnOnce(&str, FileId) -> Result<Design, Vec<Diagnostic>>,
) -> Result<Design, Diagnostics> {
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let read = read(&sources.file(file).text, file);
    read.map_err(|diagnostics| Diagnostics { list: diagnostics, sources })
}
