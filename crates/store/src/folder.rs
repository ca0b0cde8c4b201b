//! One folder of the disk as a world: nothing outside of it is read.

use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use crate::disk;
use crate::verilog::{self, WantedModules};
use nbc_base::source::{EntryKind, FileError, SourceWorld, VerilogError, VerilogFiles, VerilogModules};
use nbc_circuit::CancelFlag;

/// Paths are relative to the folder, or absolute and below it. What lies outside cannot be read, not even by links.
#[derive(Clone, Debug)]
pub struct FolderWorld {
    /// Without links.
    root: PathBuf,
    /// Texts of files that the folder lacks, by their paths in it.
    spare: fn(&str) -> Option<&'static str>,
}

impl FolderWorld {
    pub fn new(root: &Path) -> io::Result<Self> {
        let root = fs::canonicalize(root)?;
        if root.is_dir() { Ok(Self { root, spare: |_| None }) } else { Err(io::ErrorKind::NotADirectory.into()) }
    }

    /// The same with files that can be read where the folder has none.
    pub fn with_spare(self, spare: fn(&str) -> Option<&'static str>) -> Self {
        Self { spare, ..self }
    }

    pub fn root(&self) -> &Path {
        &self.root
    }

    pub fn existing(&self, path: &str) -> Result<PathBuf, FileError> {
        let mut place = self.root.clone();
        // Part by part, because what is beyond a link that leads out must not even be looked for.
        for part in self.inside(path)?.components() {
            place = fs::canonicalize(place.join(part)).map_err(|error| disk::refusal(&error))?;
            if !place.starts_with(&self.root) {
                return Err(outside());
            }
        }
        Ok(place)
    }

    /// The place of a file that may not exist yet, in a folder that does.
    pub fn writable(&self, path: &str) -> Result<PathBuf, FileError> {
        match self.existing(path) {
            Err(FileError::NotFound) => {}
            found => return found,
        }
        let path = Path::new(path);
        let name = path.file_name().ok_or_else(outside)?;
        let folder = path.parent().map(|folder| folder.to_string_lossy().into_owned()).unwrap_or_default();
        Ok(self.existing(&folder)?.join(name))
    }

    /// A path that leads out is refused without reading the disk, so that answers reveal nothing about it.
    fn inside<'p>(&self, path: &'p str) -> Result<&'p Path, FileError> {
        let path = Path::new(path);
        let inside = if path.is_absolute() { path.strip_prefix(&self.root).map_err(|_| outside())? } else { path };
        let mut depth = 0;
        for part in inside.components() {
            match part {
                Component::Normal(_) => depth += 1,
                Component::CurDir => {}
                Component::ParentDir if depth > 0 => depth -= 1,
                _ => return Err(outside()),
            }
        }
        Ok(inside)
    }
}

fn outside() -> FileError {
    FileError::Io("it is outside of the folder".to_owned())
}

impl SourceWorld for FolderWorld {
    fn read(&self, path: &str) -> Result<String, FileError> {
        FileError::text(self.read_bytes(path)?)
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let read = self.existing(path).and_then(|place| disk::source_bytes(&place));
        read.or_else(|error| {
            let spare = self.inside(path)?.to_str().and_then(self.spare);
            spare.map(Vec::from).filter(|_| error == FileError::NotFound).ok_or(error)
        })
    }

    fn read_verilog(&self, files: &VerilogFiles) -> Result<VerilogModules, VerilogError> {
        verilog::read(files, &WantedModules::All, &CancelFlag::default())
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        disk::list(&self.existing(folder)?)
    }

    fn kind(&self, path: &str) -> Option<EntryKind> {
        disk::entry_kind(&self.existing(path).ok()?)
    }

    fn identity(&self, path: &str) -> String {
        let place = self.existing(path).or_else(|_| self.inside(path).map(|inside| self.root.join(inside)));
        place.map_or_else(|_| path.to_owned(), |whole| whole.to_string_lossy().into_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(result: Result<PathBuf, FileError>) -> bool {
        result == Err(outside())
    }

    #[test]
    fn what_is_below_the_folder_is_found_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().join("served");
        fs::create_dir_all(root.join("inner")).unwrap();
        fs::write(root.join("inner/a.nb"), "a").unwrap();
        fs::write(folder.path().join("secret.nb"), "s").unwrap();
        let world = FolderWorld::new(&root).unwrap();
        assert_eq!(world.read("inner/a.nb").unwrap(), "a");
        assert_eq!(world.read("inner/../inner/a.nb").unwrap(), "a");
        assert_eq!(world.read(&world.root().join("inner/a.nb").to_string_lossy()).unwrap(), "a");
        assert_eq!(world.read("b.nb"), Err(FileError::NotFound));
        let spared = world.clone().with_spare(|path| (path == "b.nb").then_some("b"));
        assert_eq!(spared.read("b.nb").unwrap(), "b");
        assert_eq!(spared.read("inner/b.nb"), Err(FileError::NotFound));
        assert_eq!(world.list("inner").unwrap(), ["a.nb"]);
        for path in ["../secret.nb", "inner/../../secret.nb", "/etc/passwd", "/", ".."] {
            assert!(refused(world.existing(path)) && refused(world.writable(path)), "{path}");
        }
        assert!(FolderWorld::new(&root.join("inner/a.nb")).is_err());
    }

    #[test]
    fn a_new_file_has_a_place_in_a_folder_that_is_there() {
        let folder = tempfile::tempdir().unwrap();
        let world = FolderWorld::new(folder.path()).unwrap();
        assert_eq!(world.writable("new.nb").unwrap(), world.root().join("new.nb"));
        assert_eq!(world.writable("missing/new.nb"), Err(FileError::NotFound));
    }

    #[test]
    #[cfg(unix)]
    fn links_do_not_lead_out() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().join("served");
        fs::create_dir(&root).unwrap();
        fs::write(folder.path().join("secret.nb"), "s").unwrap();
        std::os::unix::fs::symlink(folder.path(), root.join("up")).unwrap();
        let world = FolderWorld::new(&root).unwrap();
        // What is there and what is not is refused alike.
        for path in ["up", "up/secret.nb", "up/missing.nb", "up/missing/secret.nb", "up/served/a.nb/../../x"] {
            assert!(refused(world.existing(path)), "{path}");
        }
        assert!(refused(world.writable("up/new.nb")));
        assert_eq!((world.kind("up"), world.kind("up/secret.nb")), (None, None));
    }
}
