//! The files of a program: the checked file, the files it uses, and the prelude.

use std::collections::BTreeSet;

use crate::check::foreign::Foreign;
use crate::check::names::Home;
use crate::check::wording::LoadError;
use crate::syntax::parse;
use crate::syntax::tree::{DeclarationKind, Text, Tree};
use nbc_base::budget::Limit;
use nbc_base::diag::{Diagnostic, Suggestion, similar_file};
use nbc_base::source::{FileError, FileId, SourceWorld, Sources, Span};
use nbc_circuit::formats::CircuitSource;

/// The declarations available to every program: the paper's setting and the standard circuits.
pub const PRELUDE: [(&str, &str); 2] = [
    ("prelude.nb", include_str!("../../library/prelude.nb")),
    ("standard.nb", include_str!("../../library/standard.nb")),
];

/// The kind of a file, by its extension. Text of other files is never shown in messages.
#[derive(Clone, Copy, PartialEq, Eq)]
enum UsedKind {
    Program,
    Circuit(CircuitSource),
}

/// Whether a program can use a file of that name.
pub fn is_usable(path: &str) -> bool {
    UsedKind::of_path(path).is_some()
}

impl UsedKind {
    fn of_path(path: &str) -> Option<Self> {
        if path.ends_with(".nb") { Some(Self::Program) } else { CircuitSource::of_path(path).map(Self::Circuit) }
    }
}

/// The trees of a program: the prelude's first, the checked file's last.
pub(crate) struct Loaded {
    pub(crate) trees: Vec<(Home, Tree)>,
    pub(crate) faults: Vec<Diagnostic>,
    /// The files that use others which cannot be read.
    pub(crate) incomplete: BTreeSet<FileId>,
}

/// Reads a file named on the command line into `sources`.
///
/// # Errors
/// When the file cannot be read as source text.
pub fn open(world: &dyn SourceWorld, path: &str, sources: &mut Sources) -> Result<FileId, Diagnostic> {
    match world.read(path) {
        Ok(text) => Ok(sources.add(path, text)),
        Err(error) => Err(Diagnostic::unreadable_in(world, path, &error)),
    }
}

/// Parses a file and all files it uses.
pub(crate) fn load(world: &dyn SourceWorld, sources: &mut Sources, file: FileId) -> Loaded {
    let mut loader = Loader {
        world,
        loaded: Loaded { trees: Vec::new(), faults: Vec::new(), incomplete: BTreeSet::new() },
        open: Vec::new(),
        done: Vec::new(),
    };
    for (name, text) in PRELUDE {
        let id = sources.add(name, text);
        loader.parse(sources, id, Home::Prelude);
    }
    loader.file(sources, file, Home::Own);
    loader.loaded
}

struct Loader<'a> {
    world: &'a dyn SourceWorld,
    loaded: Loaded,
    /// The files being loaded, outermost first: each with its identity and its path as written.
    open: Vec<(String, String)>,
    /// The identities of the loaded files.
    done: Vec<String>,
}

impl Loader<'_> {
    fn parse(&mut self, sources: &Sources, id: FileId, home: Home) {
        let parsed = parse(sources, id);
        self.loaded.faults.extend(parsed.errors);
        self.loaded.trees.push((home, parsed.tree));
    }

    fn file(&mut self, sources: &mut Sources, id: FileId, home: Home) {
        let name = normal(&sources.file(id).name);
        let identity = self.world.identity(&name);
        let parsed = parse(sources, id);
        if home == Home::Own && parsed.tree.declarations.is_empty() && parsed.errors.is_empty() {
            let file = sources.file(id).name.clone();
            self.loaded.faults.push(LoadError::Empty { file }.at(Span::new(id, 0, 0)));
        }
        self.loaded.faults.extend(parsed.errors);
        self.open.push((identity, name));
        for declaration in &parsed.tree.declarations {
            if let DeclarationKind::Use(path) = &declaration.kind {
                self.used(sources, id, path);
            }
        }
        self.done.extend(self.open.pop().map(|(identity, _)| identity));
        self.loaded.trees.push((home, parsed.tree));
    }

    fn used(&mut self, sources: &mut Sources, from: FileId, path: &Text) {
        let name = beside(&sources.file(from).name, &path.text);
        let identity = self.world.identity(&name);
        if let Some(at) = self.open.iter().position(|(open, _)| *open == identity) {
            let open = &self.open[at..];
            let circle = open.iter().chain(open.first()).map(|(_, name)| name.clone()).collect();
            self.loaded.faults.push(LoadError::Circular { circle }.at(path.span));
        } else if Limit::Uses.permit(self.open.len() as u64 + 1).is_err() {
            self.loaded.faults.push(LoadError::TooDeep { most: Limit::Uses.most() }.at(path.span));
        } else if !self.done.contains(&identity) {
            self.read(sources, name, identity, path);
        }
    }

    /// Reads and parses a file at its first use.
    fn read(&mut self, sources: &mut Sources, name: String, identity: String, path: &Text) {
        let kind = UsedKind::of_path(&name).filter(|&kind| UsedKind::of_path(&identity) == Some(kind));
        let result = match kind {
            Some(UsedKind::Program) => self.text(sources, &name, path).map(|file| self.file(sources, file, Home::Used)),
            Some(UsedKind::Circuit(format)) => self.circuits(sources, format, &name, path),
            None => match self.verilog_of(&name) {
                files if files.is_empty() => Err(vec![LoadError::NotUsable { file: name }.at(path.span)]),
                files => self.verilog(sources, &name, &files, path),
            },
        };
        self.done.push(identity);
        if result.is_err() {
            self.loaded.incomplete.insert(path.span.file);
        }
        for fault in result.err().into_iter().flatten() {
            // There may be thousands more after the first file above the limit.
            if !self.loaded.faults.iter().any(|known| known.message == fault.message) {
                self.loaded.faults.push(fault);
            }
        }
    }

    /// Adds the text of a used file to `sources`.
    fn text(&self, sources: &mut Sources, name: &str, path: &Text) -> Result<FileId, Vec<Diagnostic>> {
        let text = self.world.read(name).map_err(|error| {
            let meant = if error == FileError::NotFound { self.similar(name, path) } else { Suggestion::None };
            LoadError::Unreadable { file: name.to_owned(), error, meant }
        });
        let text = text.and_then(|text| over_limits(sources, &text).map_or(Ok(text), Err));
        Ok(sources.add(name, text.map_err(|error| vec![error.at(path.span)])?))
    }

    /// The file that may have been meant, with the folder as it is written.
    fn similar(&self, name: &str, path: &Text) -> Suggestion {
        let Suggestion::Near(near) = similar_file(self.world, name) else { return Suggestion::None };
        let file = near.rsplit('/').next().unwrap_or_default();
        let folder = path.text.rfind('/').map_or("", |end| &path.text[..=end]);
        Suggestion::Near(format!("{folder}{file}"))
    }

    /// Translates another tool's file to circuits of the language, and parses them.
    fn circuits(
        &mut self,
        sources: &mut Sources,
        format: CircuitSource,
        name: &str,
        path: &Text,
    ) -> Result<(), Vec<Diagnostic>> {
        let foreign = Foreign { world: self.world, format, name, place: path.span };
        let text = match format {
            CircuitSource::Aiger => foreign.aiger(),
            CircuitSource::Bench => self.text(sources, name, path).and_then(|file| foreign.bench(sources.file(file))),
            CircuitSource::Blif => {
                let file = self.text(sources, name, path)?;
                let (text, warnings) = foreign.blif(sources.file(file))?;
                self.loaded.faults.extend(warnings);
                Ok(text)
            }
            CircuitSource::Verilog => return self.verilog(sources, name, &[name.to_owned()], path),
        }?;
        self.add_circuits(sources, name, text, path)
    }

    /// The Verilog files in a folder, in the order of their names.
    fn verilog_of(&self, folder: &str) -> Vec<String> {
        let names = self.world.list(folder).unwrap_or_default().into_iter();
        let is_verilog = |name: &String| CircuitSource::of_path(name) == Some(CircuitSource::Verilog);
        names.filter(is_verilog).map(|name| format!("{folder}/{name}")).collect()
    }

    /// Translates Verilog files as one design to circuits of the language, and parses them.
    fn verilog(
        &mut self,
        sources: &mut Sources,
        name: &str,
        files: &[String],
        path: &Text,
    ) -> Result<(), Vec<Diagnostic>> {
        let ids = files.iter().map(|file| self.text(sources, file, path)).collect::<Result<Vec<_>, _>>()?;
        let files: Vec<_> = ids.iter().map(|&id| sources.file(id)).collect();
        let foreign = Foreign { world: self.world, format: CircuitSource::Verilog, name, place: path.span };
        let (text, warnings) = foreign.verilog(&files)?;
        self.loaded.faults.extend(warnings);
        self.add_circuits(sources, name, text, path)
    }

    fn add_circuits(
        &mut self,
        sources: &mut Sources,
        name: &str,
        text: String,
        path: &Text,
    ) -> Result<(), Vec<Diagnostic>> {
        if let Some(error) = over_limits(sources, &text) {
            return Err(vec![error.at(path.span)]);
        }
        let file = sources.add(format!("{name} (as circuits)"), text);
        self.parse(sources, file, Home::Foreign);
        Ok(())
    }
}

/// The error of adding one more file, if any.
fn over_limits(sources: &Sources, text: &str) -> Option<LoadError> {
    let bytes = sources.iter().map(|file| file.text.len()).sum::<usize>() + text.len();
    let files = sources.iter().count() - PRELUDE.len() + 1;
    if Limit::Files.permit(files as u64).is_err() {
        return Some(LoadError::TooManyFiles { most: Limit::Files.most() });
    }
    let size = Limit::ProgramBytes.permit(bytes as u64);
    size.err().map(|_| LoadError::TooLarge { megabytes: Limit::ProgramBytes.most() >> 20 })
}

/// A path relative to the folder of another file.
pub fn beside(file: &str, path: &str) -> String {
    match file.rfind(['/', '\\']) {
        Some(end) if !path.starts_with('/') => normal(&format!("{}/{path}", &file[..end])),
        _ => normal(path),
    }
}

/// A path without `.`, and without `..` where this does not depend on links. Paths of a [`SourceWorld`] have slashes on
/// every system, unlike those that `path-clean` cleans.
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
