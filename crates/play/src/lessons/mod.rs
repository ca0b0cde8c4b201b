//! The lessons of the page: Markdown files (docs/lessons.md), those that come with the program or those of an author.

mod checking;
mod piece;
mod reading;
mod solving;
#[cfg(test)]
mod tests;
mod wording;

use std::path::Path;

use include_dir::{Dir, include_dir};

use crate::lesson_texts::{LessonFiles, LessonTexts};
use crate::message::{ClassCourse, ClassLesson, LessonEntry};
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::source::{FileId, SharedWorld, Span};
use nbc_session::{Checked, Session};
use piece::Piece;
use reading::ReadLesson;

const SHIPPED: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/lessons");
const MOST: usize = 100;

/// Lessons, and what is wrong with their files. A file with a mistake gives no lesson.
#[derive(Debug, Default)]
pub(crate) struct ReadLessons {
    pub(crate) lessons: Vec<LessonEntry>,
    pub(crate) found: Diagnostics,
}

/// The programs of an author are checked in `world`, in which the page opens them.
pub(crate) fn load(sources: Vec<LessonTexts>, world: Option<&SharedWorld>) -> ReadLessons {
    let mut read = ReadLessons::default();
    for source in sources {
        match source {
            // A test checks the programs of these.
            LessonTexts::Shipped => shipped().for_each(|(file, text)| read.add(&file, &text, None)),
            LessonTexts::Folder(folder) => read.add_folder(folder, world),
        }
    }
    read
}

pub fn faults_of_lessons(sources: Vec<LessonTexts>, world: &SharedWorld) -> Diagnostics {
    load(sources, Some(world)).found
}

/// For the fuzzer, which has no folder: programs are not checked.
pub fn faults_of_lesson(text: &str) -> Diagnostics {
    let mut read = ReadLessons::default();
    read.add("lesson.md", text, None);
    read.found
}

pub fn course(sources: Vec<LessonTexts>) -> ClassCourse {
    // The programs are not checked: this must not take long.
    let lessons = load(sources, None).lessons;
    let lesson = |lesson: LessonEntry| ClassLesson {
        name: lesson.name,
        title: lesson.title,
        steps: lesson.steps.into_iter().map(|step| step.task).collect(),
    };
    ClassCourse { lessons: lessons.into_iter().map(lesson).collect() }
}

fn shipped() -> impl Iterator<Item = (String, String)> {
    let mut files: Vec<_> = SHIPPED.files().filter(|file| file.path().extension().is_some_and(|e| e == "md")).collect();
    files.sort_by_key(|file| file.path());
    let text = |file: &include_dir::File<'_>| file.contents_utf8().unwrap_or_default().to_owned();
    files.into_iter().map(move |file| (file.path().to_string_lossy().into_owned(), text(file)))
}

impl ReadLessons {
    fn add_folder(&mut self, folder: LessonFiles, world: Option<&SharedWorld>) {
        let LessonFiles { folder, files } = folder;
        let files = match files {
            Ok(files) => files,
            Err(error) => return self.found.list.push(wording::unreadable(&folder, &error)),
        };
        if files.is_empty() {
            self.found.list.push(wording::no_lessons(&folder));
        }
        for (file, text) in files {
            match text {
                Ok(text) if text.len() <= LessonFiles::MOST_BYTES => self.add(&file, &text, world),
                Ok(_) => self.found.list.push(wording::too_large(&file, "bytes", LessonFiles::MOST_BYTES)),
                Err(error) => self.found.list.push(wording::unreadable(&file, &error)),
            }
        }
    }

    fn add(&mut self, path: &str, text: &str, world: Option<&SharedWorld>) {
        if self.lessons.len() == MOST {
            return self.found.list.push(wording::too_large(path, "lessons before it", MOST));
        }
        let file = self.found.sources.add(path, text);
        let place = Path::new(path).file_stem().unwrap_or_default().to_string_lossy();
        let name = place.trim_start_matches(|letter: char| letter.is_ascii_digit()).trim_start_matches('-');
        let mut read = reading::read(name, text);
        let start = Piece { text: text.lines().next().unwrap_or_default(), at: 0 };
        if name.is_empty() || !name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-_".contains(&byte)) {
            read.mistakes.push(wording::FILE_NAME.at(start).called(&place));
        } else if self.lessons.iter().any(|lesson| lesson.name == name) {
            read.mistakes.push(wording::NAME_TAKEN.at(start).called(name));
        }
        let mut found = world.map_or(Vec::new(), |world| faults(file, text, &mut read, world));
        found.extend(read.mistakes.iter().map(|mistaken| mistaken.worded(file)));
        found.sort_by_key(|one| one.labels.first().map(|label| label.span));
        if found.is_empty() {
            self.lessons.push(read.entry);
        }
        self.found.list.extend(found);
    }
}

fn faults(file: FileId, text: &str, read: &mut ReadLesson<'_>, world: &SharedWorld) -> Vec<Diagnostic> {
    let mut session = Session::new(world.clone());
    let mut found = Vec::new();
    let mut ports = Vec::new();
    let programs: Vec<Piece<'_>> = read.program.iter().chain(&read.typed).copied().collect();
    let mut texts: Vec<Vec<Piece<'_>>> = programs.iter().map(|&piece| vec![piece]).collect();
    // A hidden test is for the program above it.
    for &(above, test) in &read.hidden {
        texts.push(programs[..above].last().copied().into_iter().chain([test]).collect());
    }
    for (at, pieces) in texts.iter().enumerate() {
        let path = format!("lesson_{}.nb", read.entry.name);
        // All but the program is blank, so that places are those of the lesson.
        session.update(&path, at as u64 + 1, alone(text, pieces));
        let checked = session.checked(&path);
        ports.extend(ports_of(&checked));
        found.extend(checked.diagnostics.iter().filter(|one| one.is_error()).map(|one| moved(one, &checked, file)));
    }
    for port in &read.ports {
        if ports.is_empty() && read.program.is_none() {
            read.mistakes.push(wording::NO_PROGRAM.at(*port));
        } else if found.is_empty() && !ports.iter().any(|known| known == port.text) {
            read.mistakes.push(wording::UNKNOWN_PORT.at(*port).known(&ports));
        }
    }
    found
}

fn alone(text: &str, pieces: &[Piece<'_>]) -> String {
    let is_inside = |at: usize| pieces.iter().any(|piece| (piece.at..piece.at + piece.text.len()).contains(&at));
    let blank = |(at, letter): (usize, char)| match letter {
        '\n' => "\n".to_owned(),
        _ if is_inside(at) => letter.to_string(),
        _ => " ".repeat(letter.len_utf8()),
    };
    text.char_indices().map(blank).collect()
}

fn ports_of(checked: &Checked) -> Vec<String> {
    let own = checked.program.circuits.iter().filter(|circuit| Some(circuit.span.file) == checked.file);
    own.flat_map(|circuit| &circuit.nets[..circuit.inputs + circuit.outputs]).map(|net| net.name.clone()).collect()
}

fn moved(found: &Diagnostic, checked: &Checked, file: FileId) -> Diagnostic {
    let mut moved = found.clone();
    let own = |span: Span| Some(span.file) == checked.file;
    moved.labels.retain(|label| own(label.span));
    moved.related.retain(|label| own(label.span));
    moved.labels.iter_mut().chain(&mut moved.related).for_each(|label| label.span.file = file);
    moved.fix = None;
    moved
}
