//! Where the lessons of the page come from.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use nbc_play::{LessonFiles, LessonTexts};

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LessonSource {
    Shipped,
    /// The files `*.md` of a folder, except `README.md`.
    Folder(PathBuf),
}

impl LessonSource {
    pub(super) fn texts(&self) -> LessonTexts {
        match self {
            Self::Shipped => LessonTexts::Shipped,
            Self::Folder(folder) => {
                LessonTexts::Folder(LessonFiles { folder: folder.display().to_string(), files: files(folder) })
            }
        }
    }
}

fn files(folder: &Path) -> io::Result<Vec<(String, io::Result<String>)>> {
    let entries = fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let mut files: Vec<_> = entries.collect::<io::Result<_>>()?;
    let is_readme = |path: &PathBuf| path.file_name().is_some_and(|name| name == "README.md");
    files.retain(|path| path.extension().is_some_and(|ending| ending == "md") && path.is_file() && !is_readme(path));
    files.sort();
    Ok(files.into_iter().map(|file| (file.to_string_lossy().into_owned(), text_of(&file))).collect())
}

fn text_of(path: &Path) -> io::Result<String> {
    let mut bytes = Vec::new();
    let most = LessonFiles::MOST_BYTES as u64;
    File::open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Ok(String::from_utf8_lossy(&bytes).into_owned());
    }
    String::from_utf8(bytes).map_err(|_| io::ErrorKind::InvalidData.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lessons_of_a_folder_are_its_markdown_files_but_for_the_readme() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &[u8]| fs::write(folder.path().join(name), text).unwrap();
        let files = || files(folder.path()).unwrap();
        assert!(files().is_empty());
        write("README.md", b"Not a lesson.");
        write("2-gate.md", &[0xff]);
        write("1-gate.md", b"# Gate");
        write("3-gate.md", "é".repeat(LessonFiles::MOST_BYTES).as_bytes());
        let found = files();
        assert_eq!(found.len(), 3);
        assert!(found[0].0.ends_with("1-gate.md") && found[0].1.as_deref().is_ok_and(|text| text == "# Gate"));
        assert!(found[1].1.is_err());
        assert!(found[2].1.as_deref().is_ok_and(|text| text.len() > LessonFiles::MOST_BYTES));
        assert!(super::files(&folder.path().join("nowhere")).is_err());
    }
}
