//! A site in memory, whose owner does its work: for a page without threads and without a disk.

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex};

use crate::lesson_texts::LessonTexts;
use crate::local_crew::LocalCrew;
use crate::lock::lock;
use crate::outbox::Line;
use crate::page_files::beside_example;
use crate::shell::{CancelSource, Crew, PageFolder, Portion, Portions, Shell, WorkKind};
use nbc_base::fnv::Fnv;
use nbc_base::source::{EntryKind, FileError, MemoryWorld, SharedWorld, SourceWorld};
use nbc_circuit::CancelFlag;

/// Files in memory. All clones are the same folder.
#[derive(Clone, Default)]
pub struct MemoryFolder {
    files: Arc<Mutex<Files>>,
}

#[derive(Default)]
struct Files {
    world: MemoryWorld,
    /// Sizes in bytes and hashes of contents, the stamps by which a returning page sees whether a file has changed.
    known: BTreeMap<String, (usize, u64)>,
    written: Vec<String>,
}

impl MemoryFolder {
    pub fn insert(&self, path: &str, contents: impl AsRef<[u8]>) {
        let (contents, mut hash) = (contents.as_ref(), Fnv::default());
        hash.add(contents);
        let mut files = lock(&self.files);
        files.known.insert(path.to_owned(), (contents.len(), hash.value()));
        files.world.insert(identity(path), contents);
    }

    pub fn remove(&self, path: &str) {
        let mut files = lock(&self.files);
        files.known.remove(path);
        files.world.remove(&identity(path));
    }

    pub fn take_written(&self) -> Option<(String, String)> {
        let mut files = lock(&self.files);
        let path = files.written.pop()?;
        files.written.retain(|other| *other != path);
        let text = files.world.read(&identity(&path)).unwrap_or_default();
        Some((path, text))
    }
}

impl PageFolder for MemoryFolder {
    fn name(&self) -> String {
        "this browser".to_owned()
    }

    fn uri(&self) -> String {
        "file:///".to_owned()
    }

    fn world(&self) -> SharedWorld {
        self.guarded(Arc::new(CancelFlag::default))
    }

    fn guarded(&self, cancel: CancelSource) -> SharedWorld {
        Arc::new(MemoryFiles { folder: self.clone(), cancel })
    }

    fn files(&self, wanted: &dyn Fn(&str) -> bool) -> Vec<(String, u64)> {
        let files = lock(&self.files);
        let all = files.known.iter().filter(|(path, _)| wanted(path));
        all.map(|(path, (size, _))| (path.clone(), *size as u64)).collect()
    }

    fn stamp(&self, path: &str) -> Option<String> {
        lock(&self.files).known.get(path).map(|(size, hash)| format!("{hash:x}.{size}"))
    }

    fn may_write(&self, path: &str) -> Result<(), FileError> {
        // No name of a file leads out: there is nothing but this folder.
        let is_part = |part: &str| !matches!(part, "" | "." | "..");
        let is_folder = path.is_empty() || path.split('/').all(is_part);
        if is_folder { Ok(()) } else { Err(FileError::NotFound) }
    }

    fn write(&self, path: &str, text: &str) -> Result<(), String> {
        self.insert(path, text);
        lock(&self.files).written.push(path.to_owned());
        Ok(())
    }

    fn make_folder(&self, _path: &str) -> Result<(), String> {
        Ok(())
    }
}

struct MemoryFiles {
    folder: MemoryFolder,
    cancel: CancelSource,
}

impl SourceWorld for MemoryFiles {
    // Examples come with the program, and so do the files beside them.
    fn read(&self, path: &str) -> Result<String, FileError> {
        FileError::text(self.read_bytes(path)?)
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let place = identity(path);
        let read = lock(&self.folder.files).world.read_bytes(&place);
        let shipped = || beside_example(&place[1..]).map(Vec::from);
        read.or_else(|error| shipped().filter(|_| error == FileError::NotFound).ok_or(error))
    }

    fn cancel(&self) -> CancelFlag {
        (self.cancel)()
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        lock(&self.folder.files).world.list(identity(folder).trim_end_matches('/'))
    }

    fn kind(&self, path: &str) -> Option<EntryKind> {
        lock(&self.folder.files).world.kind(identity(path).trim_end_matches('/'))
    }

    fn identity(&self, path: &str) -> String {
        identity(path)
    }
}

/// The path of a file from the root, which is the folder. A path cannot lead out of it.
fn identity(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => _ = parts.pop(),
            name => parts.push(name),
        }
    }
    format!("/{}", parts.join("/"))
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PageMessage {
    Text(String),
    Frame(Vec<u8>),
}

#[derive(Default)]
pub struct LocalLine {
    waiting: Mutex<(VecDeque<String>, Option<Vec<u8>>)>,
}

impl LocalLine {
    /// The next message, texts first. A frame waits until the page has room for it.
    pub fn next(&self, has_room: bool) -> Option<PageMessage> {
        let (texts, frame) = &mut *lock(&self.waiting);
        let text = texts.pop_front().map(PageMessage::Text);
        text.or_else(|| frame.take_if(|_| has_room).map(PageMessage::Frame))
    }
}

impl Line for LocalLine {
    fn text(&self, text: String) {
        lock(&self.waiting).0.push_back(text);
    }

    fn frame(&self, frame: Vec<u8>) {
        lock(&self.waiting).1 = Some(frame);
    }

    fn has_room(&self) -> bool {
        lock(&self.waiting).1.is_none()
    }

    fn remove_frame(&self) -> bool {
        lock(&self.waiting).1.take().is_some()
    }

    fn wake(&self) {}
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeptFile {
    pub address: String,
    pub media_type: &'static str,
    pub bytes: Vec<u8>,
}

#[derive(Default)]
struct LocalWork {
    queue: VecDeque<Portions>,
    /// How many pieces of work at the end of the queue wait for workers.
    waiting: usize,
}

#[derive(Default)]
pub struct LocalShell {
    work: Mutex<LocalWork>,
    kept: Mutex<(u64, VecDeque<KeptFile>)>,
    template: Mutex<Option<Arc<str>>>,
    crew: LocalCrew,
}

impl LocalShell {
    /// Work that waits for workers does not count until [`LocalShell::wake`].
    pub fn has_work(&self) -> bool {
        let work = lock(&self.work);
        work.queue.len() > work.waiting
    }

    pub fn wake(&self) {
        lock(&self.work).waiting = 0;
    }

    pub fn advance(&self) {
        let next = lock(&self.work).queue.pop_front();
        let Some(mut portions) = next else { return };
        let portion = portions();
        let work = &mut *lock(&self.work);
        work.waiting = if portion == Portion::Waits { (work.waiting + 1).min(work.queue.len() + 1) } else { 0 };
        if portion != Portion::Done {
            work.queue.push_back(portions);
        }
    }

    pub fn set_template(&self, text: &str) {
        *lock(&self.template) = Some(text.into());
    }

    pub fn local_crew(&self) -> &LocalCrew {
        &self.crew
    }

    pub fn take_kept(&self) -> Option<KeptFile> {
        lock(&self.kept).1.pop_front()
    }
}

impl Shell for LocalShell {
    fn start(&self, _kind: WorkKind, portions: Portions) {
        let work = &mut *lock(&self.work);
        work.queue.push_back(portions);
        work.waiting = 0;
    }

    fn keep(&self, name: &str, media_type: &'static str, bytes: Vec<u8>) -> String {
        let (number, files) = &mut *lock(&self.kept);
        *number += 1;
        let address = format!("take/{number}/{name}");
        files.push_back(KeptFile { address: address.clone(), media_type, bytes });
        address
    }

    fn template(&self) -> Option<Arc<str>> {
        lock(&self.template).clone()
    }

    fn lessons(&self) -> Vec<LessonTexts> {
        vec![LessonTexts::Shipped]
    }

    fn crew(&self) -> Option<&dyn Crew> {
        Some(&self.crew)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_example_needs_is_there_until_there_is_a_file_of_that_name() {
        let folder = MemoryFolder::default();
        let words = folder.world().read("riscv/sum.hex").unwrap();
        assert!(words.lines().count() > 3);
        assert!(folder.world().read("digits/read.nb").unwrap().contains("circuit read("));
        assert_eq!(folder.world().read("latch.nb"), Err(FileError::NotFound), "a program is opened by its user");
        folder.insert("riscv/sum.hex", "0");
        assert_eq!(folder.world().read("riscv/sum.hex").unwrap(), "0");
        folder.remove("riscv/sum.hex");
        assert!(folder.stamp("riscv/sum.hex").is_none() && folder.world().read("riscv/sum.hex").unwrap().len() > 1);
    }
}
