//! A folder of the disk as that of a page.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;
use std::sync::Arc;
use std::time::UNIX_EPOCH;

use nbc_base::diag::io_words;
use nbc_base::source::{FileError, SharedWorld};
use nbc_play::{CancelSource, PageFolder, beside_example};
use nbc_session::store::{self, FolderWorld, GuardedWorld};

/// A folder of the disk. Nothing outside of it is read or written.
#[derive(Clone, Debug)]
pub(super) struct DiskFolder {
    world: FolderWorld,
}

impl DiskFolder {
    pub(super) fn new(world: FolderWorld) -> Self {
        Self { world: world.with_spare(beside_example) }
    }
}

impl PageFolder for DiskFolder {
    fn name(&self) -> String {
        self.world.root().file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    fn uri(&self) -> String {
        nbc_lsp::file_uri(&self.world.root().to_string_lossy())
    }

    fn world(&self) -> SharedWorld {
        Arc::new(self.world.clone())
    }

    fn guarded(&self, cancel: CancelSource) -> SharedWorld {
        Arc::new(GuardedWorld::new(self.world.clone(), move || cancel()))
    }

    fn files(&self, wanted: &dyn Fn(&str) -> bool) -> Vec<(String, u64)> {
        let root = self.world.root();
        let one = |path: String| {
            let size = fs::metadata(&path).map_or(0, |about| about.len());
            Some((Path::new(&path).strip_prefix(root).ok()?.to_string_lossy().into_owned(), size))
        };
        store::source_files([root.to_owned()], wanted).into_iter().filter_map(one).collect()
    }

    fn stamp(&self, path: &str) -> Option<String> {
        let about = fs::metadata(self.world.existing(path).ok()?).ok()?;
        let time = about.modified().ok()?.duration_since(UNIX_EPOCH).unwrap_or_default();
        Some(format!("{}.{}", time.as_nanos(), about.len()))
    }

    fn may_write(&self, path: &str) -> Result<(), FileError> {
        self.world.writable(path).map(|_| ())
    }

    fn write(&self, path: &str, text: &str) -> Result<(), String> {
        let place = self.world.writable(path).map_err(words)?;
        store::write(&place, text.as_bytes()).map_err(|error| io_words(&error))
    }

    fn make_folder(&self, path: &str) -> Result<(), String> {
        let place = self.world.writable(path).map_err(words)?;
        store::create_folder(&place).map_err(|error| io_words(&error))
    }
}

fn words(error: FileError) -> String {
    match error {
        FileError::Io(reason) => reason,
        _ => io_words(&ErrorKind::NotFound.into()),
    }
}
