//! Reading of files: the core asks a [`SourceWorld`]. The command line gives it the disk, tests and other doors give it
//! memory.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::{CancelFlag, FileError, VerilogError, VerilogFiles, VerilogModules};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryKind {
    File,
    Folder,
}

/// The source of everything that the core reads: programs and robot files.
pub trait SourceWorld {
    fn read(&self, path: &str) -> Result<String, FileError>;

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, FileError> {
        self.read(path).map(String::into_bytes)
    }

    fn read_verilog(&self, _files: &VerilogFiles) -> Result<VerilogModules, VerilogError> {
        Err(VerilogError::NoReader)
    }

    /// The flag that is raised when nobody waits any more for what is being read.
    fn cancel(&self) -> CancelFlag {
        CancelFlag::default()
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError>;

    /// What is at `path`; `None` if there is nothing that this world has.
    fn kind(&self, path: &str) -> Option<EntryKind> {
        match self.list(path) {
            Ok(_) => Some(EntryKind::Folder),
            Err(_) => self.read_bytes(path).ok().map(|_| EntryKind::File),
        }
    }

    /// The unique name of the file at `path`, however many paths and links lead to it.
    fn identity(&self, path: &str) -> String {
        path.to_owned()
    }
}

pub type SharedWorld = Arc<dyn SourceWorld + Send + Sync>;

macro_rules! forward {
    ($pointer:ident) => {
        impl<W: SourceWorld + ?Sized> SourceWorld for $pointer<W> {
            fn read(&self, path: &str) -> Result<String, FileError> {
                (**self).read(path)
            }

            fn read_bytes(&self, path: &str) -> Result<Vec<u8>, FileError> {
                (**self).read_bytes(path)
            }

            fn read_verilog(&self, files: &VerilogFiles) -> Result<VerilogModules, VerilogError> {
                (**self).read_verilog(files)
            }

            fn cancel(&self) -> CancelFlag {
                (**self).cancel()
            }

            fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
                (**self).list(folder)
            }

            fn kind(&self, path: &str) -> Option<EntryKind> {
                (**self).kind(path)
            }

            fn identity(&self, path: &str) -> String {
                (**self).identity(path)
            }
        }
    };
}

forward!(Arc);
forward!(Box);

/// Files in memory, for tests and for programs that generate source text. A copy has the same bytes.
#[derive(Clone, Debug, Default)]
pub struct MemoryWorld {
    files: BTreeMap<String, Arc<[u8]>>,
}

impl MemoryWorld {
    pub fn insert(&mut self, path: impl Into<String>, contents: impl Into<Vec<u8>>) {
        self.files.insert(path.into(), contents.into().into());
    }

    pub fn remove(&mut self, path: &str) {
        self.files.remove(path);
    }
}

impl SourceWorld for MemoryWorld {
    fn read(&self, path: &str) -> Result<String, FileError> {
        FileError::text(self.read_bytes(path)?)
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, FileError> {
        self.files.get(path).map(|bytes| bytes.to_vec()).ok_or(FileError::NotFound)
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        let entry = |path: &String| {
            let inside = path.strip_prefix(folder)?.strip_prefix('/')?;
            inside.split('/').next().map(str::to_owned)
        };
        let names: BTreeSet<String> = self.files.keys().filter_map(entry).collect();
        if names.is_empty() { Err(FileError::NotFound) } else { Ok(names.into_iter().collect()) }
    }
}

/// Files in memory over another world, such as an editor's buffers over the disk.
#[derive(Clone, Debug, Default)]
pub struct OverlayWorld<W> {
    over: MemoryWorld,
    under: W,
}

impl<W: SourceWorld> OverlayWorld<W> {
    pub fn new(under: W) -> Self {
        Self { over: MemoryWorld::default(), under }
    }

    pub fn insert(&mut self, path: &str, text: impl Into<String>) {
        self.over.insert(self.under.identity(path), text.into());
    }

    pub fn remove(&mut self, path: &str) {
        self.over.remove(&self.under.identity(path));
        self.over.remove(path);
    }
}

impl<W: SourceWorld> SourceWorld for OverlayWorld<W> {
    fn read(&self, path: &str) -> Result<String, FileError> {
        // A file that did not exist when its buffer was opened is known by its path.
        let over = self.over.read(&self.under.identity(path)).or_else(|_| self.over.read(path));
        over.or_else(|_| self.under.read(path))
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let over = self.over.read(&self.under.identity(path)).or_else(|_| self.over.read(path));
        over.map(String::into_bytes).or_else(|_| self.under.read_bytes(path))
    }

    fn read_verilog(&self, files: &VerilogFiles) -> Result<VerilogModules, VerilogError> {
        self.under.read_verilog(files)
    }

    fn cancel(&self) -> CancelFlag {
        self.under.cancel()
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        match (self.over.list(&self.under.identity(folder)), self.under.list(folder)) {
            (Ok(over), Ok(under)) => Ok(BTreeSet::from_iter(over.into_iter().chain(under)).into_iter().collect()),
            (Ok(over), Err(_)) => Ok(over),
            (Err(_), under) => under,
        }
    }

    fn kind(&self, path: &str) -> Option<EntryKind> {
        let over = self.over.kind(&self.under.identity(path)).or_else(|| self.over.kind(path));
        over.or_else(|| self.under.kind(path))
    }

    fn identity(&self, path: &str) -> String {
        self.under.identity(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files(files: &[(&str, &str)]) -> MemoryWorld {
        let mut world = MemoryWorld::default();
        files.iter().for_each(|(path, text)| world.insert(*path, *text));
        world
    }

    #[test]
    fn a_folder_in_memory_lists_its_entries_once() {
        let world = files(&[("a/x.nb", ""), ("a/b/y.nb", ""), ("a/b/z.nb", ""), ("ab/w.nb", "")]);
        assert_eq!(world.list("a"), Ok(vec!["b".to_owned(), "x.nb".to_owned()]));
        assert_eq!(world.list("c"), Err(FileError::NotFound));
        let kinds = ["a", "a/x.nb", "c"].map(|path| world.kind(path));
        assert_eq!(kinds, [Some(EntryKind::Folder), Some(EntryKind::File), None]);
    }

    #[test]
    fn a_buffer_hides_the_file_below_until_it_is_removed() {
        let mut world = OverlayWorld::new(files(&[("a/x.nb", "below"), ("a/y.nb", "other")]));
        world.insert("a/x.nb", "above");
        world.insert("a/new.nb", "new");
        assert_eq!(["a/x.nb", "a/y.nb", "a/new.nb"].map(|path| world.read(path).unwrap()), ["above", "other", "new"]);
        assert_eq!(world.list("a"), Ok(["new.nb", "x.nb", "y.nb"].map(str::to_owned).to_vec()));
        assert!(["a/y.nb", "a/new.nb"].iter().all(|path| world.kind(path) == Some(EntryKind::File)));
        world.remove("a/x.nb");
        assert_eq!(world.read("a/x.nb").as_deref(), Ok("below"));
    }

    /// A world in which every path that ends in a file's name leads to that file.
    struct Linked(MemoryWorld);

    impl SourceWorld for Linked {
        fn read(&self, path: &str) -> Result<String, FileError> {
            self.0.read(&self.identity(path))
        }

        fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
            self.0.list(folder)
        }

        fn identity(&self, path: &str) -> String {
            path.rsplit('/').next().unwrap_or(path).to_owned()
        }
    }

    #[test]
    fn a_buffer_is_read_by_every_path_of_its_file() {
        let mut world = OverlayWorld::new(Linked(files(&[("x.nb", "below")])));
        world.insert("folder/x.nb", "above");
        assert_eq!(world.read("link/x.nb").as_deref(), Ok("above"));
    }
}
