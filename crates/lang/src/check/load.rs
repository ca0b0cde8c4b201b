//! The files of a program: the checked file, the files it uses, and the prelude.

use std::collections::{BTreeMap, BTreeSet};

use crate::check::foreign::{Foreign, ForeignDesign};
use crate::check::names::Home;
use crate::check::wording;
use crate::syntax::tree::{DeclarationKind, TestKind, Text, Tree};
use crate::syntax::{KnownTexts, parse_again};
use nbc_base::budget::Limit;
use nbc_base::diag::{Diagnostic, Suggestion, similar_file};
use nbc_base::model::Circuit;
use nbc_base::source::{FileError, FileId, ForeignCircuit, ProofOrigin, SourceWorld, Sources, Span};
use nbc_circuit::formats::{CircuitSource, Design, circuit};
use nbc_circuit::rows::RowFormat;

pub const PRELUDE: [(&str, &str); 2] = [
    ("prelude.nb", include_str!("../../library/prelude.nb")),
    ("standard.nb", include_str!("../../library/standard.nb")),
];

/// Decided by the extension. Text of any other file is never shown in messages.
#[derive(Clone, Copy, PartialEq, Eq)]
enum UsedKind {
    Program,
    Circuit(CircuitSource),
}

pub fn is_usable(path: &str) -> bool {
    UsedKind::of_path(path).is_some()
}

impl UsedKind {
    fn of_path(path: &str) -> Option<Self> {
        if path.ends_with(".nb") { Some(Self::Program) } else { CircuitSource::of_path(path).map(Self::Circuit) }
    }
}

/// The prelude's trees come first, the checked file's last.
#[derive(Default)]
pub(crate) struct Loaded {
    pub(crate) trees: Vec<(Home, Tree)>,
    pub(crate) faults: Vec<Diagnostic>,
    pub(crate) incomplete: BTreeSet<FileId>,
    pub(crate) foreign: Vec<ForeignCircuit>,
    /// Of other tools' files, in the order of `foreign`.
    pub(crate) circuits: Vec<Circuit>,
    /// By the places of their paths.
    pub(crate) rows: BTreeMap<Span, FileId>,
}

pub fn open(world: &dyn SourceWorld, path: &str, sources: &mut Sources) -> Result<FileId, Diagnostic> {
    match world.read(path) {
        Ok(text) => Ok(sources.add(path, text)),
        Err(error) => Err(Diagnostic::unreadable_in(world, path, &error)),
    }
}

pub(crate) fn load(world: &dyn SourceWorld, sources: &mut Sources, file: FileId, known: &mut KnownTexts) -> Loaded {
    let mut loader = Loader { world, known, loaded: Loaded::default(), open: Vec::new(), done: Vec::new() };
    for (name, text) in PRELUDE {
        let id = sources.add(name, text);
        let parsed = parse_again(sources, id, loader.known);
        loader.loaded.faults.extend(parsed.errors);
        loader.loaded.trees.push((Home::Prelude, parsed.tree));
    }
    loader.file(sources, file, Home::Own);
    loader.loaded
}

struct Loader<'a> {
    world: &'a dyn SourceWorld,
    known: &'a mut KnownTexts,
    loaded: Loaded,
    /// Outermost first: identity and path as written.
    open: Vec<(String, String)>,
    done: Vec<String>,
}

impl Loader<'_> {
    fn file(&mut self, sources: &mut Sources, id: FileId, home: Home) {
        let name = normal(&sources.file(id).name);
        let identity = self.world.identity(&name);
        let parsed = parse_again(sources, id, self.known);
        if home == Home::Own && parsed.tree.declarations.is_empty() && parsed.errors.is_empty() {
            self.loaded.faults.push(wording::empty_file(&sources.file(id).name, Span::new(id, 0, 0)));
        }
        self.loaded.faults.extend(parsed.errors);
        self.open.push((identity, name));
        for declaration in &parsed.tree.declarations {
            if let DeclarationKind::Use(paths) = &declaration.kind {
                self.list(sources, id, paths);
            }
            if home == Home::Own
                && let DeclarationKind::Test(test) = &declaration.kind
                && let TestKind::FromFile { path, .. } = &test.kind
            {
                self.rows(sources, id, path);
            }
        }
        self.done.extend(self.open.pop().map(|(identity, _)| identity));
        self.loaded.trees.push((home, parsed.tree));
    }

    /// Once for all tests that name the file.
    fn rows(&mut self, sources: &mut Sources, from: FileId, path: &Text) {
        let name = beside(&sources.file(from).name, &path.text);
        let known = self.loaded.rows.values().copied().find(|&file| sources.file(file).name == name);
        let read = match known {
            Some(file) => Ok(file),
            None if RowFormat::of_path(&name).is_none() => Err(vec![wording::not_rows(&name, path.span)]),
            None => self.text(sources, &name, path),
        };
        match read {
            Ok(file) => _ = self.loaded.rows.insert(path.span, file),
            Err(faults) => self.loaded.faults.extend(faults),
        }
    }

    /// The Verilog files of a list, and folders of them, are one design.
    fn list(&mut self, sources: &mut Sources, from: FileId, paths: &[Text]) {
        let is_of_design = |path: &&Text| {
            matches!(UsedKind::of_path(&path.text), None | Some(UsedKind::Circuit(CircuitSource::Verilog)))
        };
        let (design, others): (Vec<&Text>, Vec<&Text>) = paths.iter().partition(is_of_design);
        others.into_iter().for_each(|path| self.used(sources, from, path));
        match design[..] {
            [] => {}
            [path] => self.used(sources, from, path),
            _ => self.design(sources, from, &design),
        }
    }

    fn design(&mut self, sources: &mut Sources, from: FileId, paths: &[&Text]) {
        let own = sources.file(from).name.clone();
        let names: Vec<String> = paths.iter().map(|path| beside(&own, &path.text)).collect();
        let identities: Vec<String> = names.iter().map(|name| self.world.identity(name)).collect();
        let identity = identities.join("\n");
        if self.done.contains(&identity) {
            return;
        }
        let mut files: Vec<(String, &Text)> = Vec::new();
        let mut faults = Vec::new();
        for ((name, identity), path) in names.iter().zip(&identities).zip(paths) {
            let found = self.design_files(name, identity);
            if found.is_empty() {
                faults.push(wording::not_usable(name, path.span));
            }
            for file in found {
                if !files.iter().any(|(known, _)| *known == file) {
                    files.push((file, path));
                }
            }
        }
        let result = if faults.is_empty() { self.verilog(sources, &names.join(", "), &files) } else { Err(faults) };
        self.finish(identity, from, result);
    }

    fn design_files(&self, name: &str, identity: &str) -> Vec<String> {
        let is_verilog = |path| UsedKind::of_path(path) == Some(UsedKind::Circuit(CircuitSource::Verilog));
        if is_verilog(name) && is_verilog(identity) { vec![name.to_owned()] } else { self.verilog_of(name) }
    }

    fn used(&mut self, sources: &mut Sources, from: FileId, path: &Text) {
        let name = beside(&sources.file(from).name, &path.text);
        let identity = self.world.identity(&name);
        if let Some(at) = self.open.iter().position(|(open, _)| *open == identity) {
            let open = &self.open[at..];
            let circle = open.iter().chain(open.first()).map(|(_, name)| name);
            self.loaded.faults.push(wording::circular_use(circle, path.span));
        } else if Limit::Uses.permit(self.open.len() as u64 + 1).is_err() {
            self.loaded.faults.push(wording::deep_use(Limit::Uses.most(), path.span));
        } else if !self.done.contains(&identity) {
            self.read(sources, name, identity, path);
        }
    }

    fn read(&mut self, sources: &mut Sources, name: String, identity: String, path: &Text) {
        let kind = UsedKind::of_path(&name).filter(|&kind| UsedKind::of_path(&identity) == Some(kind));
        let result = match kind {
            Some(UsedKind::Program) => self.text(sources, &name, path).map(|file| self.file(sources, file, Home::Used)),
            Some(UsedKind::Circuit(format)) => self.circuits(sources, format, &name, path),
            None => match self.verilog_of(&name) {
                files if files.is_empty() => Err(vec![wording::not_usable(&name, path.span)]),
                files => self.verilog(sources, &name, &files.into_iter().map(|file| (file, path)).collect::<Vec<_>>()),
            },
        };
        self.finish(identity, path.span.file, result);
    }

    fn finish(&mut self, identity: String, from: FileId, result: Result<(), Vec<Diagnostic>>) {
        self.done.push(identity);
        if result.is_err() {
            self.loaded.incomplete.insert(from);
        }
        for fault in result.err().into_iter().flatten() {
            // There may be thousands more after the first file above the limit.
            if !self.loaded.faults.iter().any(|known| known.message == fault.message) {
                self.loaded.faults.push(fault);
            }
        }
    }

    fn text(&self, sources: &mut Sources, name: &str, path: &Text) -> Result<FileId, Vec<Diagnostic>> {
        let text = self.world.read(name).map_err(|error| {
            let meant = if error == FileError::NotFound { self.similar(name, path) } else { Suggestion::None };
            vec![wording::unreadable_use(name, &error, &meant, path.span)]
        })?;
        permit(sources, &text, path.span)?;
        Ok(sources.add(name, text))
    }

    fn similar(&self, name: &str, path: &Text) -> Suggestion {
        let Suggestion::Near(near) = similar_file(self.world, name) else { return Suggestion::None };
        let file = near.rsplit('/').next().unwrap_or_default();
        let folder = path.text.rfind('/').map_or("", |end| &path.text[..=end]);
        Suggestion::Near(format!("{folder}{file}"))
    }

    fn circuits(
        &mut self,
        sources: &mut Sources,
        format: CircuitSource,
        name: &str,
        path: &Text,
    ) -> Result<(), Vec<Diagnostic>> {
        let file = match format {
            CircuitSource::Verilog => return self.verilog(sources, name, &[(name.to_owned(), path)]),
            CircuitSource::Aiger => None,
            _ => Some(self.text(sources, name, path)?),
        };
        let foreign = Foreign { world: self.world, format, name, place: path.span };
        let (design, warnings) = foreign.design(file.map(|file| sources.file(file)))?;
        self.loaded.faults.extend(warnings);
        let circuit = design.netlist.name.clone();
        self.loaded.foreign.push(ForeignCircuit { file: name.to_owned(), circuit, origin: ProofOrigin::File });
        self.add_circuits(sources, name, &[design], path)
    }

    fn verilog_of(&self, folder: &str) -> Vec<String> {
        let names = self.world.list(folder).unwrap_or_default().into_iter();
        let is_verilog = |name: &String| CircuitSource::of_path(name) == Some(CircuitSource::Verilog);
        names.filter(is_verilog).map(|name| format!("{folder}/{name}")).collect()
    }

    /// The files are one design, each with the path of its use.
    fn verilog(&mut self, sources: &mut Sources, name: &str, files: &[(String, &Text)]) -> Result<(), Vec<Diagnostic>> {
        let ids = files.iter().map(|(file, path)| self.text(sources, file, path)).collect::<Result<Vec<_>, _>>()?;
        let path = files[0].1;
        let files: Vec<_> = ids.iter().map(|&id| sources.file(id)).collect();
        let foreign = Foreign { world: self.world, format: CircuitSource::Verilog, name, place: path.span };
        let ForeignDesign { designs, warnings, circuits } = foreign.verilog(&files)?;
        self.loaded.faults.extend(warnings);
        self.loaded.foreign.extend(circuits);
        self.add_circuits(sources, name, &designs, path)
    }

    fn add_circuits(
        &mut self,
        sources: &mut Sources,
        name: &str,
        designs: &[Design],
        path: &Text,
    ) -> Result<(), Vec<Diagnostic>> {
        let (file, mut text) = (sources.next(), String::new());
        let circuits: Vec<Circuit> = designs.iter().map(|design| circuit(design, file, &mut text)).collect();
        permit(sources, &text, path.span)?;
        sources.add(format!("{name} (its names)"), text);
        self.loaded.circuits.extend(circuits);
        Ok(())
    }
}

fn permit(sources: &Sources, text: &str, at: Span) -> Result<(), Vec<Diagnostic>> {
    let bytes = sources.iter().map(|file| file.text.len()).sum::<usize>() + text.len();
    let files = sources.iter().count() - PRELUDE.len() + 1;
    if Limit::Files.permit(files as u64).is_err() {
        return Err(vec![wording::many_files(Limit::Files.most(), at)]);
    }
    let size = Limit::ProgramBytes.permit(bytes as u64);
    size.map_err(|_| vec![wording::large_program(Limit::ProgramBytes.most() >> 20, at)])
}

pub fn beside(file: &str, path: &str) -> String {
    match file.rfind(['/', '\\']) {
        Some(end) if !path.starts_with('/') => normal(&format!("{}/{path}", &file[..end])),
        _ => normal(path),
    }
}

/// Without `.`, and without `..` where that does not depend on links; `path-clean` has other slashes on Windows.
fn normal(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            "." => {}
            ".." if parts.last().is_some_and(|last| !matches!(*last, ".." | "")) => _ = parts.pop(),
            "" if !parts.is_empty() => {}
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_of_used_files_are_relative_to_the_importing_file() {
        assert_eq!(beside("circuits/latch.nb", "adder.nb"), "circuits/adder.nb");
        assert_eq!(beside("circuits/latch.nb", "../lib/./adder.nb"), "lib/adder.nb");
        assert_eq!(beside("latch.nb", "../adder.nb"), "../adder.nb");
        assert_eq!(beside("a/latch.nb", "/etc/adder.nb"), "/etc/adder.nb");
    }
}
