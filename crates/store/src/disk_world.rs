//! The disk as a [`SourceWorld`].

use std::fs;
use std::path::Path;

use crate::disk;
use crate::folder::FolderWorld;
use crate::verilog::{Verilog, VerilogFiles};
use nbc_base::source::{EntryKind, FileError, SourceWorld, VerilogError, VerilogFile, VerilogModules};
use nbc_circuit::CancelFlag;

/// The files of this computer.
#[derive(Clone, Copy, Debug, Default)]
pub struct DiskWorld;

impl SourceWorld for DiskWorld {
    fn read(&self, path: &str) -> Result<String, FileError> {
        disk::source(Path::new(path))
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, FileError> {
        disk::source_bytes(Path::new(path))
    }

    fn translate_verilog(&self, files: &[VerilogFile<'_>]) -> Result<VerilogModules, VerilogError> {
        Verilog { world: self, files, cancel: &CancelFlag::default() }.modules()
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        disk::list(Path::new(folder))
    }

    fn kind(&self, path: &str) -> Option<EntryKind> {
        disk::entry_kind(Path::new(path))
    }

    fn identity(&self, path: &str) -> String {
        // A file that is missing has no other name.
        fs::canonicalize(path).map_or_else(|_| path.to_owned(), |whole| whole.to_string_lossy().into_owned())
    }
}

impl VerilogFiles for DiskWorld {
    /// Only files of the folder of the Verilog file, and below.
    fn included(&self, main: &str, path: &str) -> Result<String, FileError> {
        let folder = Path::new(main).parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
        let inside = main.rsplit_once('/').and_then(|(folder, _)| path.strip_prefix(folder)?.strip_prefix('/'));
        let world = FolderWorld::new(folder).map_err(|error| disk::refusal(&error))?;
        world.read(inside.unwrap_or(path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn a_link_is_the_file_it_leads_to() {
        let folder = tempfile::tempdir().unwrap();
        let [file, link] = ["a.nb", "b.nb"].map(|name| folder.path().join(name));
        fs::write(&file, "x").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        let identity = |path: &Path| DiskWorld.identity(path.to_str().unwrap());
        assert_eq!(identity(&file), identity(&link));
    }

    #[test]
    fn only_files_below_a_verilog_file_are_included() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("inner");
        fs::create_dir_all(inner.join("parts")).unwrap();
        fs::write(folder.path().join("secret.vh"), "secret").unwrap();
        fs::write(inner.join("parts/a.vh"), "part").unwrap();
        let main = inner.join("a.v").to_string_lossy().into_owned();
        let beside = |path: &str| inner.join(path).to_string_lossy().into_owned();
        assert_eq!(DiskWorld.included(&main, &beside("parts/a.vh")).as_deref(), Ok("part"));
        for path in [beside("../secret.vh"), "/etc/passwd".to_owned(), beside("parts/../../secret.vh")] {
            assert!(matches!(DiskWorld.included(&main, &path), Err(FileError::Io(_))), "{path}");
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(folder.path(), inner.join("up")).unwrap();
            assert!(DiskWorld.included(&main, &beside("up/secret.vh")).is_err());
        }
    }
}
