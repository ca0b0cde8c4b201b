//! Circuit files, read and written in the format of their extension.

use std::path::Path;

use crate::circuit::formats::{CircuitFormat, Design, aiger, bench, blif};
use crate::diag::{Diagnostic, Diagnostics};
use crate::source::{FileError, Sources};
use crate::store::wording::StoreError;
use crate::store::{disk, yosys};
use crate::syntax;

/// Reads a circuit; `clock` names the clock of registers for which the file names none.
///
/// # Errors
/// A file that cannot be read, of an unknown format, or damaged.
pub fn read_circuit(path: &Path, clock: Option<&str>) -> Result<Design, Diagnostics> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    match ending.as_str() {
        "aig" | "aag" => {
            let bytes = disk::read(path, disk::MAX_CIRCUIT_BYTES).map_err(|error| unreadable(path, &error))?;
            Ok(aiger::read(&bytes, clock)?)
        }
        "blif" | "bench" => {
            let text = text(path)?;
            let read = if ending == "bench" { bench::read } else { blif::read };
            parse(path.display().to_string(), text, |text, file| read(text, file, clock))
        }
        "v" | "sv" => {
            let flat = yosys::flatten(path, text(path)?)?;
            parse(format!("{} (as BLIF)", path.display()), flat, |text, file| blif::read(text, file, clock))
        }
        _ => Err(Diagnostic::from(StoreError::CircuitFormat { file: path.display().to_string() }).into()),
    }
}

/// A design as the bytes of a file; a program of the language is written as the formatter writes it.
///
/// # Errors
/// Why the format cannot hold the design.
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
    read: impl FnOnce(&str, crate::source::FileId) -> Result<Design, Vec<Diagnostic>>,
) -> Result<Design, Diagnostics> {
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let read = read(&sources.file(file).text, file);
    read.map_err(|diagnostics| Diagnostics { list: diagnostics, sources })
}
