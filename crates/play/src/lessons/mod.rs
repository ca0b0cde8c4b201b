//! The lessons of the page: Markdown files (docs/lessons.md), those that come with the program or those of an author.

mod checking;
mod mistake;
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
use mistake::{LessonMistake, Mistaken};
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::source::{FileId, SharedWorld, Span};
use nbc_session::{Checked, Session};
use piece::Piece;
use reading::ReadLesson;

const SHIPPED: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/lessons");
/// The most lessons.
const MOST: usize = 100;

/// Lessons, and what is wrong with their files. A file with a mistake gives no lesson.
#[derive(Debug, Default)]
pub(crate) struct ReadLessons {
    pub(crate) lessons: Vec<LessonEntry>,
    pub(crate) found: Diagnostics,
}

/// Reads all lessons. The programs of an author are checked in the world in which the page opens them, if there is one.
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

/// What is wrong with the lessons of an author, whose programs are checked in this world. A page shows it, too.
pub fn faults_of_lessons(sources: Vec<LessonTexts>, world: &SharedWorld) -> Diagnostics {
    load(sources, Some(world)).found
}

/// What is wrong with a text that is to be a lesson; its programs are not checked. The fuzzer calls this, because it
/// needs no folder.
pub fn faults_of_lesson(text: &str) -> Diagnostics {
    let mut read = ReadLessons::default();
    read.add("lesson.md", text, None);
    read.found
}

/// The lessons with their tasks, for a teacher.
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

/// The names and texts of the files that come with the program.
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
fn faults(file: FileId, text: &str, read: &mut ReadLesson<'_>, world: &SharedWorld) -> Vec<Diagnostic> {
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
