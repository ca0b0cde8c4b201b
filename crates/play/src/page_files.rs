//! The files of the served folder: read, saved, watched, and the examples that come with the program.

use std::collections::BTreeMap;
use std::sync::Arc;

use include_dir::{Dir, File, include_dir};

use crate::message::{ExampleEntry, FileChange, FileEntry, FileStamp, FileText, PlayEvent};
use crate::refusal::Refused;
use crate::shell::PageFolder;
use nbc_base::diag::is_hidden;
use nbc_base::model::Circuit;
use nbc_circuit::formats::CircuitSource;
use nbc_session::Session;

const EXAMPLES: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/circuits");

/// The text of a file that an example uses, by its path beside the examples.
pub fn beside_example(path: &str) -> Option<&'static str> {
    let file = EXAMPLES.get_file(path).filter(|_| path.contains('/'))?;
    file.contents_utf8()
}

pub(super) struct PageFiles {
    folder: Arc<dyn PageFolder>,
    known: BTreeMap<String, Option<String>>,
}

impl PageFiles {
    pub(super) fn new(folder: Arc<dyn PageFolder>) -> Self {
        Self { folder, known: BTreeMap::new() }
    }

    pub(super) fn list(&self) -> Vec<FileEntry> {
        let files = self.folder.files(&|path| path.ends_with(".nb") || is_circuit(path));
        files.into_iter().map(|(path, size)| FileEntry { path, size }).collect()
    }

    /// From now on, changes of the file are reported.
    pub(super) fn read(&mut self, path: String) -> Result<FileText, Refused> {
        let stamp = self.folder.stamp(&path);
        let text =
            self.folder.world().read(&path).map_err(|error| Refused::Unreadable { path: path.clone(), error })?;
        self.known.insert(path.clone(), stamp.clone());
        Ok(FileText { path, text, stamp })
    }

    /// Saves a program, unless somebody else has changed it since the page last knew it.
    pub(super) fn save(&mut self, path: String, text: &str, known: Option<&str>) -> Result<FileStamp, Refused> {
        if !path.ends_with(".nb") {
            return Err(Refused::Ending { path, expected: ".nb" });
        }
        if path.contains(|c| c == '\n' || is_hidden(c)) {
            return Err(Refused::HiddenInPath { path });
        }
        if self.folder.stamp(&path).as_deref() != known {
            return Err(Refused::Changed { path });
        }
        self.write(&path, text)?;
        let stamp = self.folder.stamp(&path);
        self.known.insert(path, stamp.clone());
        Ok(FileStamp { stamp })
    }

    pub(super) fn has(&self, path: &str) -> bool {
        self.folder.stamp(path).is_some()
    }

    pub(super) fn write(&self, path: &str, text: &str) -> Result<(), Refused> {
        self.may_write(path)?;
        let written = self.folder.write(path, text);
        written.map_err(|reason| Refused::Unwritable { path: path.to_owned(), reason })
    }

    pub(super) fn make_folder(&self, path: &str) -> Result<(), Refused> {
        let made = self.folder.make_folder(path);
        made.map_err(|reason| Refused::Unwritable { path: path.to_owned(), reason })
    }

    pub(super) fn may_write(&self, path: &str) -> Result<(), Refused> {
        self.folder.may_write(path).map_err(|error| Refused::Unreadable { path: path.to_owned(), error })
    }

    pub(super) fn changes(&mut self) -> Vec<(String, PlayEvent)> {
        let stamps: Vec<_> = self.known.keys().map(|path| (path.clone(), self.folder.stamp(path))).collect();
        let mut changed = Vec::new();
        for (path, stamp) in stamps {
            if self.known.get(&path) != Some(&stamp) {
                let event = PlayEvent::Changed(FileChange { path: path.clone(), stamp: stamp.clone() });
                self.known.insert(path.clone(), stamp);
                changed.push((path, event));
            }
        }
        changed
    }
}

pub(super) fn is_circuit(path: &str) -> bool {
    CircuitSource::of_path(path).is_some()
}

pub(super) fn program_around(files: &dyn PageFolder, session: &mut Session, path: &str) -> Result<FileText, Refused> {
    let (folder, name) = path.rsplit_once('/').map_or(("", path), |(folder, name)| (folder, name));
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let place = |number: u32| {
        let number = if number == 1 { String::new() } else { format!("_{number}") };
        if folder.is_empty() { format!("{stem}{number}.nb") } else { format!("{folder}/{stem}{number}.nb") }
    };
    let free = (1..).map(place).find(|place| files.stamp(place).is_none()).expect("some number is free");
    let text = format!("// The circuits of {name}, made of robots.\n\nuse {name:?}\n");
    session.update(&free, 1, text.clone());
    let checked = session.open(&free)?;
    let file = |circuit: &Circuit| &checked.sources.file(circuit.span.file).name;
    let circuits = checked.program.circuits.iter().filter(|circuit| file(circuit).starts_with(path));
    let swarms = circuits.map(|circuit| format!("\nswarm {0}_robots {{\n    circuit: {0}\n}}\n", circuit.name));
    Ok(FileText { path: free, text: text + &swarms.collect::<String>(), stamp: None })
}

pub(super) fn examples() -> Vec<ExampleEntry> {
    let mut files: Vec<_> =
        EXAMPLES.files().filter(|file| file.path().extension().is_some_and(|e| e == "nb")).collect();
    files.sort_by_key(|file| file.path());
    let about = |text: &str| {
        let comment = text.lines().next().and_then(|line| line.trim_start().strip_prefix("//"));
        comment.unwrap_or_default().trim_start_matches(['/', '!']).trim().to_owned()
    };
    let one = |file: &File<'_>| {
        let text = file.contents_utf8().unwrap_or_default();
        ExampleEntry { name: file.path().to_string_lossy().into_owned(), about: about(text) }
    };
    files.into_iter().map(one).collect()
}

pub(super) fn example(name: &str) -> Result<FileText, Refused> {
    let text = EXAMPLES.get_file(name).and_then(File::contents_utf8);
    let text = text.ok_or_else(|| Refused::NoExample(name.to_owned()))?;
    Ok(FileText { path: name.to_owned(), text: text.to_owned(), stamp: None })
}
