//! The lessons of the page: Markdown files (docs/lessons.md), those that come with the program or those of an author.

mod checking;
mod mistake;
mod piece;
mod reading;
mod solving;
#[cfg(test)]
mod tests;
mod wording;

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use include_dir::{Dir, include_dir};

use crate::message::LessonEntry;
use mistake::{LessonMistake, Mistaken};
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::source::{FileId, Span};
use nbc_session::store::FolderWorld;
use nbc_session::{Checked, Session};
use piece::Piece;
use reading::ReadLesson;

const SHIPPED: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/lessons");
/// The most lessons, and bytes of one.
const MOST: usize = 100;
const BYTES: u64 = 64 << 10;

/// Where lessons come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LessonSource {
    /// Those that come with the program.
    Shipped,
    /// The files `*.md` of a folder, but for `README.md`.
    Folder(PathBuf),
}

/// Lessons, and what is wrong with their files. A file with a mistake gives no lesson.
#[derive(Debug, Default)]
pub(crate) struct ReadLessons {
    pub(crate) lessons: Vec<LessonEntry>,
    pub(crate) found: Diagnostics,
}

/// Reads all lessons. The programs of an author are checked in the world in which the page opens them, if there is one.
pub(crate) fn load(sources: &[LessonSource], world: Option<&FolderWorld>) -> ReadLessons {
    let mut read = ReadLessons::default();
    for source in sources {
        match source {
            // A test checks the programs of these.
            LessonSource::Shipped => shipped().for_each(|(file, text)| read.add(&file, &text, None)),
            LessonSource::Folder(folder) => read.add_folder(folder, world),
        }
    }
    read
}

/// What is wrong with a text that is to be a lesson; its programs are not checked.
pub(crate) fn faults_of(text: &str) -> Diagnostics {
    let mut read = ReadLessons::default();
    read.add("lesson.md", text, None);
    read.found
}

/// The names and texts of the files that come with the program.
fn shipped() -> impl Iterator<Item = (String, String)> {
    let mut files: Vec<_> = SHIPPED.files().filter(|file| file.path().extension().is_some_and(|e| e == "md")).collect();
    files.sort_by_key(|file| file.path());
    let text = |file: &include_dir::File<'_>| file.contents_utf8().unwrap_or_default().to_owned();
    files.into_iter().map(move |file| (file.path().to_string_lossy().into_owned(), text(file)))
}

impl ReadLessons {
    fn add_folder(&mut self, folder: &Path, world: Option<&FolderWorld>) {
        let files = match markdown(folder) {
            Ok(files) => files,
            Err(error) => return self.found.list.push(wording::unreadable(folder, &error)),
        };
        if files.is_empty() {
            self.found.list.push(wording::no_lessons(folder));
        }
        for file in files {
            match text_of(&file) {
                Ok(Some(text)) => self.add(&file.to_string_lossy(), &text, world),
                Ok(None) => self.found.list.push(wording::too_large(&file, "bytes", BYTES as usize)),
                Err(error) => self.found.list.push(wording::unreadable(&file, &error)),
            }
        }
    }

    fn add(&mut self, path: &str, text: &str, world: Option<&FolderWorld>) {
        if self.lessons.len() == MOST {
            return self.found.list.push(wording::too_large(Path::new(path), "lessons before it", MOST));
        }
        let file = self.found.sources.add(path, text);
        let place = Path::new(path).file_stem().unwrap_or_default().to_string_lossy();
        let name = place.trim_start_matches(|letter: char| letter.is_ascii_digit()).trim_start_matches('-');
        let mut read = reading::read(name, text);
        let start = Piece { text: text.lines().next().unwrap_or_default(), at: 0 };
        let mut mistake = |mistake| {
            let mistaken = Mistaken { text: place.to_string(), ..Mistaken::new(start, mistake) };
            read.mistakes.push(mistaken);
        };
        if name.is_empty() || !name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-_".contains(&byte)) {
            mistake(LessonMistake::FileName);
        } else if self.lessons.iter().any(|lesson| lesson.name == name) {
            mistake(LessonMistake::NameTaken { name: name.to_owned() });
        }
        let mut found = world.map_or(Vec::new(), |world| faults(file, text, &mut read, world));
        found.extend(read.mistakes.iter().map(|mistaken| wording::worded(file, mistaken)));
        found.sort_by_key(|one| one.labels.first().map(|label| label.span));
        if found.is_empty() {
            self.lessons.push(read.entry);
        }
        self.found.list.extend(found);
    }
}

/// The errors of a lesson's programs, in their places in the lesson. The ports that it names are checked, too.
fn faults(file: FileId, text: &str, read: &mut ReadLesson<'_>, world: &FolderWorld) -> Vec<Diagnostic> {
    let mut session = Session::new(world.clone());
    let mut found = Vec::new();
    let mut ports = Vec::new();
    for (at, piece) in read.program.iter().chain(&read.typed).enumerate() {
        let path = format!("lesson_{}.nb", read.entry.name);
        // All but the program is blank, so that places are those of the lesson.
        session.update(&path, at as u64 + 1, alone(text, *piece));
        let checked = session.checked(&path);
        ports.extend(ports_of(&checked));
        found.extend(checked.diagnostics.iter().filter(|one| one.is_error()).map(|one| moved(one, &checked, file)));
    }
    for port in &read.ports {
        if ports.is_empty() && read.program.is_none() {
            read.mistakes.push(Mistaken::new(*port, LessonMistake::NoProgram));
        } else if found.is_empty() && !ports.iter().any(|known| known == port.text) {
            let known = LessonMistake::UnknownPort { known: ports.clone() };
            read.mistakes.push(Mistaken::new(*port, known));
        }
    }
    found
}

/// A text in which all but a piece is blank.
fn alone(text: &str, piece: Piece<'_>) -> String {
    let is_inside = |at: usize| (piece.at..piece.at + piece.text.len()).contains(&at);
    let blank = |(at, letter): (usize, char)| match letter {
        '\n' => "\n".to_owned(),
        _ if is_inside(at) => letter.to_string(),
        _ => " ".repeat(letter.len_utf8()),
    };
    text.char_indices().map(blank).collect()
}

/// The ports of the circuits of a program itself.
fn ports_of(checked: &Checked) -> Vec<String> {
    let own = checked.program.circuits.iter().filter(|circuit| Some(circuit.span.file) == checked.file);
    own.flat_map(|circuit| &circuit.nets[..circuit.inputs + circuit.outputs]).map(|net| net.name.clone()).collect()
}

/// A diagnostic of a program, about its lesson. What it says of other files is left out.
fn moved(found: &Diagnostic, checked: &Checked, file: FileId) -> Diagnostic {
    let mut moved = found.clone();
    let own = |span: Span| Some(span.file) == checked.file;
    moved.labels.retain(|label| own(label.span));
    moved.related.retain(|label| own(label.span));
    moved.labels.iter_mut().chain(&mut moved.related).for_each(|label| label.span.file = file);
    moved.fix = None;
    moved
}

/// The Markdown files of a folder but for its README, in order.
fn markdown(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let mut files: Vec<_> = entries.collect::<io::Result<_>>()?;
    let is_readme = |path: &PathBuf| path.file_name().is_some_and(|name| name == "README.md");
    files.retain(|path| path.extension().is_some_and(|ending| ending == "md") && path.is_file() && !is_readme(path));
    files.sort();
    Ok(files)
}

/// The text of a file; `None` if it is too large.
fn text_of(path: &Path) -> io::Result<Option<String>> {
    let mut text = String::new();
    File::open(path)?.take(BYTES + 1).read_to_string(&mut text)?;
    Ok((text.len() as u64 <= BYTES).then_some(text))
}
