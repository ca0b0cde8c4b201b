//! Verilog through a [`SourceWorld`]: what its reader is given, and what it says.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::{FileError, SourceWorld};
use crate::budget::Limit;

/// A Verilog file, or one that it reads.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct VerilogFile {
    /// Its path in messages.
    pub path: String,
    pub text: String,
}

/// Verilog files that are read as one design.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct VerilogFiles {
    pub files: Vec<VerilogFile>,
    /// The files that these may include or load into memories, by the paths that they use.
    pub others: BTreeMap<String, VerilogFile>,
}

impl VerilogFiles {
    /// The files with these paths and texts, and all files of a world below their folders that they name in quotes.
    pub fn of<'f>(world: &(impl SourceWorld + ?Sized), files: impl IntoIterator<Item = (&'f str, &'f str)>) -> Self {
        let mut found = Self::default();
        let (mut looked, mut bytes) = (BTreeSet::new(), 0);
        for (path, text) in files {
            let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
            let mut waiting = vec![(String::new(), text.to_owned())];
            while let Some((inside, text)) = waiting.pop() {
                for name in text.split('"').filter(|name| is_path_inside(name)) {
                    for used in [joined(&inside, name), name.to_owned()] {
                        let path = joined(folder, &used);
                        let is_new = Limit::VerilogFiles.permit(looked.len() as u64).is_ok()
                            && looked.insert(path.clone())
                            && !found.others.contains_key(&used);
                        let Some(text) = is_new.then(|| read_inside(world, folder, &path).ok()).flatten() else {
                            continue;
                        };
                        bytes += text.len() as u64;
                        if Limit::VerilogBytes.permit(bytes).is_ok() {
                            let parent = used.rsplit_once('/').map_or("", |(parent, _)| parent).to_owned();
                            waiting.push((parent, text.clone()));
                            found.others.insert(used, VerilogFile { path, text });
                        }
                    }
                }
            }
            found.files.push(VerilogFile { path: path.to_owned(), text: text.to_owned() });
        }
        found
    }
}

/// Whether a text in quotes can be the path of a file in a folder or below.
fn is_path_inside(name: &&str) -> bool {
    let is_letter = |c: char| c.is_ascii_alphanumeric() || "._-+/".contains(c);
    let is_part = |part: &str| !part.is_empty() && part != "." && part != "..";
    name.len() < 256 && name.contains('.') && name.chars().all(is_letter) && name.split('/').all(is_part)
}

fn joined(folder: &str, name: &str) -> String {
    if folder.is_empty() { name.to_owned() } else { format!("{folder}/{name}") }
}

/// The text of a file, unless a link leads out of the folder.
fn read_inside(world: &(impl SourceWorld + ?Sized), folder: &str, path: &str) -> Result<String, FileError> {
    let root = world.identity(if folder.is_empty() { "." } else { folder });
    let is_inside = match root.as_str() {
        "." => true,
        root => world.identity(path).strip_prefix(root).is_some_and(|inside| inside.starts_with(['/', '\\'])),
    };
    if is_inside { world.read(path) } else { Err(FileError::NotFound) }
}

/// The modules of Verilog files that no other contains.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VerilogModules {
    /// The version of the Yosys that read them, such as `0.70`.
    pub version: String,
    pub modules: Vec<VerilogModule>,
    /// Warnings of the reader.
    pub notes: Vec<VerilogNote>,
}

/// A module as it was read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VerilogModule {
    pub name: String,
    /// A flat model.
    pub blif: String,
    /// Where its nets are declared.
    pub nets: BTreeMap<String, VerilogPlace>,
    /// The ports whose leftmost bit has the lowest number, such as `a` of `input [0:3] a`.
    pub ascending: BTreeSet<String>,
    pub second: SecondReading,
}

/// What a second reader has made of a module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SecondReading {
    /// The same circuit; that is proved.
    Alike,
    /// A circuit that is equal in so many random steps.
    Equal(usize),
    /// Another circuit.
    Different,
    /// One that makes no steps that could be compared.
    NoSteps,
    /// It could not read the module.
    #[default]
    None,
}

impl VerilogModule {
    /// The place of the statement of the BLIF text at these bytes: that of a net in it.
    pub fn place(&self, at: usize) -> Option<&VerilogPlace> {
        let start = self.blif[..at].rfind('\n').map_or(0, |end| end + 1);
        let words: Vec<&str> = self.blif[start..].lines().next()?.split_whitespace().collect();
        // What a statement defines comes first: the last net of `.names`, the second one of `.latch`.
        let defined = if words[0] == ".latch" { words.get(2) } else { words.last() };
        let nets =
            defined.into_iter().chain(&words[1..]).map(|word| word.split_once('=').map_or(*word, |(_, net)| net));
        let whole = |net: &str| net.strip_suffix(']').and_then(|net| net.rsplit_once('[')).map(|(bus, _)| bus.to_owned());
        nets.filter_map(|net| self.nets.get(net).or_else(|| self.nets.get(&whole(net)?))).next()
    }
}

/// A place in a Verilog file or in one that it includes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilogPlace {
    /// The path of the file, which many places share.
    pub file: Arc<str>,
    /// The line, from 1.
    pub line: usize,
    /// The first column, from 1, and the one after the last; without them the whole line is meant.
    pub columns: Option<[usize; 2]>,
}

/// An error or a warning about Verilog.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VerilogNote {
    pub is_error: bool,
    pub message: String,
    /// What is said of the place.
    pub label: String,
    pub place: Option<VerilogPlace>,
    pub help: Option<String>,
}

/// The reason why Verilog could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum VerilogError {
    /// This world runs no other programs.
    NoReader,
    /// The reader is not installed.
    NotInstalled,
    /// Nobody waits for it any more.
    Cancelled,
    /// There is no temporary folder to work in; the operating system's message.
    NoFolder(String),
    /// A module that the files do not have.
    NoModule { module: String, known: Vec<String> },
    /// A parameter that the top module does not have.
    NoParameter { parameter: String, known: Vec<String> },
    /// Parameters without the module that they are for.
    SeveralModules { known: Vec<String> },
    /// Faults of the files.
    Faults(Vec<VerilogNote>),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::MemoryWorld;

    #[test]
    fn what_a_file_names_comes_with_it() {
        let mut world = MemoryWorld::default();
        let main = "`include \"parts/a.vh\"\n$readmemh(\"rom.hex\", m); $display(\"no.txt\"); `include \"../up.vh\"\n";
        for (path, text) in [
            ("in/main.v", main),
            ("in/parts/a.vh", "`include \"b.vh\"\n`include \"c.vh\"\n"),
            ("in/parts/b.vh", "b"),
            ("in/c.vh", "c"),
            ("in/rom.hex", "0"),
            ("up.vh", "secret"),
            ("in/more.vh", "not named"),
        ] {
            world.insert(path, text);
        }
        let found = VerilogFiles::of(&world, [("in/main.v", main)]);
        let others: Vec<&str> = found.others.keys().map(String::as_str).collect();
        assert_eq!(others, ["c.vh", "parts/a.vh", "parts/b.vh", "rom.hex"]);
        assert_eq!(found.others["parts/b.vh"].path, "in/parts/b.vh");
    }

    #[test]
    fn paths_stay_inside() {
        for name in ["a.vh", "parts/a.vh", "x-1.2+y_z.mem"] {
            assert!(is_path_inside(&name), "{name}");
        }
        for name in ["", "a", "/etc/a.b", "../a.b", "a/../b.c", "a b.c", "a;b.c", "a\n.c", "C:\\a.b", "a//b.c"] {
            assert!(!is_path_inside(&name), "{name}");
        }
    }
}
