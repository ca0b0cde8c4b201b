//! A world whose door decides when Verilog is translated.

use std::fmt;
use std::sync::Arc;

use crate::verilog::{self, WantedModules};
use nbc_base::source::{EntryKind, FileError, SourceWorld, VerilogError, VerilogFiles, VerilogModules};
use nbc_circuit::CancelFlag;

/// Files of another world, whose Verilog is translated as far as a door permits.
#[derive(Clone)]
pub struct GuardedWorld<W> {
    world: W,
    /// Gives the flag that ends work which begins now.
    cancel: Arc<dyn Fn() -> CancelFlag + Send + Sync>,
}

impl<W> fmt::Debug for GuardedWorld<W> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("GuardedWorld").finish_non_exhaustive()
    }
}

impl<W> GuardedWorld<W> {
    pub fn new(world: W, cancel: impl Fn() -> CancelFlag + Send + Sync + 'static) -> Self {
        Self { world, cancel: Arc::new(cancel) }
    }

    pub fn until(world: W, cancel: CancelFlag) -> Self {
        Self::new(world, move || cancel.clone())
    }
}

impl<W: SourceWorld> SourceWorld for GuardedWorld<W> {
    fn read(&self, path: &str) -> Result<String, FileError> {
        self.world.read(path)
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, FileError> {
        self.world.read_bytes(path)
    }

    fn read_verilog(&self, files: &VerilogFiles) -> Result<VerilogModules, VerilogError> {
        let cancel = self.cancel();
        if cancel.is_raised() {
            return Err(VerilogError::Cancelled);
        }
        verilog::read(files, &WantedModules::All, &cancel)
    }

    fn cancel(&self) -> CancelFlag {
        (self.cancel)()
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        self.world.list(folder)
    }

    fn kind(&self, path: &str) -> Option<EntryKind> {
        self.world.kind(path)
    }

    fn identity(&self, path: &str) -> String {
        self.world.identity(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DiskWorld;

    #[test]
    fn nothing_is_read_after_the_end() {
        let cancel = CancelFlag::default();
        cancel.raise();
        let over = GuardedWorld::until(DiskWorld, cancel);
        assert_eq!(over.read_verilog(&VerilogFiles::default()), Err(VerilogError::Cancelled));
    }
}
