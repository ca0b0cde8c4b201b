//! Circuit files, read and written in the format of their extension.

use std::path::{Path, PathBuf};

use crate::verilog::{self, TopModule, WantedModules};
use crate::{DiskWorld, disk, wording};
use nbc_base::budget::Limit;
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::source::{FileError, FileId, ProofOrigin, Sources, VerilogPlace};
use nbc_circuit::CancelFlag;
use nbc_circuit::formats::{AigerModel, CircuitFormat, CircuitSource, Design, aiger, bench, blif, pla, verilog_module};
use nbc_lang::check::verilog_files;
use nbc_lang::syntax;

/// A circuit file to be read.
#[derive(Clone, Copy, Debug)]
pub struct CircuitFile<'a> {
    pub path: &'a Path,
    /// Other files of the same design, of Verilog.
    pub others: &'a [PathBuf],
    /// The clock of registers for which the file names none.
    pub clock: Option<&'a str>,
    pub top: &'a TopModule,
}

/// A circuit that was read.
#[derive(Clone, Debug)]
pub struct CircuitRead {
    pub design: Design,
    pub warnings: Diagnostics,
    /// What a proof of it begins with.
    pub origin: ProofOrigin,
}

impl CircuitRead {
    fn plain(design: Design, warnings: Diagnostics) -> Self {
        Self { design, warnings, origin: ProofOrigin::File }
    }
}

pub fn read_model(path: &Path) -> Result<AigerModel, Diagnostics> {
    let file = path.display().to_string();
    if CircuitSource::of_path(&file) != Some(CircuitSource::Aiger) {
        return Err(wording::no_model(&file).into());
    }
    let bytes = disk::read(path, Limit::CircuitFileBytes.most()).map_err(|error| unreadable(path, &error))?;
    Ok(AigerModel::read(&bytes)?)
}

pub fn read_circuit(from: &CircuitFile<'_>) -> Result<CircuitRead, Diagnostics> {
    let read = read(from)?;
    if !read.design.netlist.outputs().is_empty() {
        return Ok(read);
    }
    let circuit = read.design.netlist.name.clone();
    let files: Vec<_> = read.warnings.sources.iter().collect();
    let declares = |line: &str| {
        let mut words = line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        words.any(|word| matches!(word, "module" | "model")) && words.any(|word| word == circuit)
    };
    let place = files.iter().find_map(|file| {
        let line = file.text.lines().position(declares)? + 1;
        Some(VerilogPlace { file: file.name.as_str().into(), line, columns: None })
    });
    let list = vec![wording::no_outputs(&circuit).at_verilog(&files, place.as_ref())];
    Err(Diagnostics { list, sources: read.warnings.sources })
}

fn read(from: &CircuitFile<'_>) -> Result<CircuitRead, Diagnostics> {
    let &CircuitFile { path, others, clock, top } = from;
    let name = path.display().to_string();
    let format = CircuitSource::of_path(&name);
    let has_modules = matches!(format, Some(CircuitSource::Verilog | CircuitSource::Blif));
    if format.is_some() && top.name.is_some() && !has_modules {
        return Err(wording::no_modules(&name).into());
    }
    if format.is_some() && !top.parameters.is_empty() && format != Some(CircuitSource::Verilog) {
        return Err(wording::no_parameters(&name).into());
    }
    let is_verilog = |path: &PathBuf| CircuitSource::of_path(&path.to_string_lossy()) == Some(CircuitSource::Verilog);
    if !others.is_empty() && (format != Some(CircuitSource::Verilog) || !others.iter().all(is_verilog)) {
        return Err(wording::several_files().into());
    }
    let design = match format {
        Some(CircuitSource::Aiger) => {
            let bytes = disk::read(path, Limit::CircuitFileBytes.most()).map_err(|error| unreadable(path, &error))?;
            aiger::read(&bytes, clock)?
        }
        Some(CircuitSource::Bench) => parse(name.clone(), text(path)?, |text, file| bench::read(text, file, clock))?.0,
        Some(CircuitSource::Blif) => return blif(name, text(path)?, from),
        Some(CircuitSource::Pla) => {
            without_effect(&name, clock)?;
            let (design, sources) = parse(name, text(path)?, pla::read)?;
            let file = sources.iter().next().expect("the text was added");
            let list = pla::opened(&file.text, file.id);
            return Ok(CircuitRead::plain(design, Diagnostics { list, sources }));
        }
        Some(CircuitSource::Verilog) => {
            without_effect(&name, clock)?;
            return verilog_top(from);
        }
        None => return Err(wording::circuit_format(&name).into()),
    };
    if design.netlist.registers().next().is_none() {
        without_effect(&name, clock)?;
    }
    Ok(CircuitRead::plain(design, Diagnostics::default()))
}

fn blif(name: String, text: String, from: &CircuitFile<'_>) -> Result<CircuitRead, Diagnostics> {
    let model = from.top.name.as_deref();
    let (design, sources) = parse(name.clone(), text, |text, file| blif::read_model(text, file, from.clock, model))?;
    let file = sources.iter().next().expect("the text was added");
    if from.clock.is_some() && blif::read_model(&file.text, file.id, None, model).is_ok() {
        without_effect(&name, from.clock)?;
    }
    let list = blif::ignored(&file.text, file.id);
    Ok(CircuitRead::plain(design, Diagnostics { list, sources }))
}

fn without_effect(file: &str, clock: Option<&str>) -> Result<(), Diagnostics> {
    clock.map_or(Ok(()), |clock| Err(wording::no_unclocked(file, clock).into()))
}

fn verilog_top(from: &CircuitFile<'_>) -> Result<CircuitRead, Diagnostics> {
    let mut sources = Sources::default();
    for path in std::iter::once(from.path).chain(from.others.iter().map(PathBuf::as_path)) {
        let text = text(path)?;
        sources.add(path.display().to_string(), text);
    }
    let files: Vec<_> = sources.iter().collect();
    let design = verilog_files(&DiskWorld, &files);
    let modules = verilog::read(&design, &WantedModules::Top(from.top), &CancelFlag::default());
    let read = modules.map_err(|error| Diagnostic::unread_verilog(&files, &error)).and_then(|modules| {
        let warnings = modules.notes.iter().map(|note| Diagnostic::of_verilog(&files, note)).collect();
        let origin = modules.origin(0);
        Ok((verilog_module(&modules.modules[0], &files, from.clock)?, warnings, origin))
    });
    match read {
        Ok((design, list, origin)) => Ok(CircuitRead { design, warnings: Diagnostics { list, sources }, origin }),
        Err(list) => Err(Diagnostics { list, sources }),
    }
}

pub fn encode_circuit(design: &Design, format: CircuitFormat) -> Result<Vec<u8>, Diagnostic> {
    let bytes = format.encode(design)?;
    if format != CircuitFormat::Nb {
        return Ok(bytes);
    }
    Ok(canonical(String::from_utf8(bytes).expect("a program is text"))?.into_bytes())
}

/// A file of ours that begins with comments, or ends with them where the format wants it so.
pub fn with_comment(bytes: Vec<u8>, format: CircuitFormat, lines: &[String]) -> Vec<u8> {
    let before = |sign: &str| lines.iter().map(|line| format!("{sign} {line}\n")).collect::<String>().into_bytes();
    let comment = match format {
        CircuitFormat::Nb => [before("//!"), b"\n".to_vec()].concat(),
        CircuitFormat::Blif | CircuitFormat::Pla => before("#"),
        CircuitFormat::Verilog | CircuitFormat::Dot => before("//"),
        CircuitFormat::AigerBinary | CircuitFormat::AigerText => {
            return [bytes, b"c\n".to_vec(), lines.join("\n").into_bytes(), b"\n".to_vec()].concat();
        }
    };
    [comment, bytes].concat()
}

pub fn read_rows(path: &Path) -> Result<(Sources, FileId), Diagnostics> {
    let mut sources = Sources::default();
    let file = sources.add(path.display().to_string(), text(path)?);
    Ok((sources, file))
}

/// A program of ours as the formatter writes it, unless it is too large to be read again.
fn canonical(text: String) -> Result<String, Diagnostic> {
    if Limit::SourceBytes.permit(text.len() as u64).is_err() {
        return Err(wording::nb_too_large(text.len()));
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
    disk::read_text(path, Limit::CircuitFileBytes.most()).map_err(|error| unreadable(path, &error))
}

fn parse(
    name: String,
    text: String,
    read: impl FnOnce(&str, FileId) -> Result<Design, Vec<Diagnostic>>,
) -> Result<(Design, Sources), Diagnostics> {
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let read = read(&sources.file(file).text, file);
    match read {
        Ok(design) => Ok((design, sources)),
        Err(list) => Err(Diagnostics { list, sources }),
    }
}
