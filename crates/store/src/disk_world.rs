//! The disk as a [`SourceWorld`].

use std::fs;
use std::path::Path;

use crate::disk;
use crate::verilog::{self, WantedModules};
use nbc_base::source::{EntryKind, FileError, SourceWorld, VerilogError, VerilogFiles, VerilogModules};
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

    fn read_verilog(&self, files: &VerilogFiles) -> Result<VerilogModules, VerilogError> {
        verilog::read(files, &WantedModules::All, &CancelFlag::default())
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
}
