//! A world whose door decides when Verilog is translated.

use std::fmt;
use std::sync::Arc;

use crate::store::verilog::{Verilog, VerilogFiles};
use nbc_base::source::{EntryKind, FileError, SourceWorld, VerilogError, VerilogFile, VerilogModules};
use nbc_circuit::CancelFlag;

/// Called before each translation. Returns the flag that ends it, or the reason why it is not permitted.
type Permit = Arc<dyn Fn() -> Result<CancelFlag, VerilogError> + Send + Sync>;

/// Files of another world, whose Verilog is translated as far as a door permits.
#[derive(Clone)]
pub struct GuardedWorld<W> {
    world: W,
    permit: Permit,
}

impl<W> fmt::Debug for GuardedWorld<W> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("GuardedWorld").finish_non_exhaustive()
    }
}

impl<W> GuardedWorld<W> {
    /// The same files. `permit` is asked before each translation for the flag that ends it.
    pub fn new(world: W, permit: impl Fn() -> Result<CancelFlag, VerilogError> + Send + Sync + 'static) -> Self {
        Self { world, permit: Arc::new(permit) }
    }

    /// The same files. Translations end when the flag is raised.
    pub fn until(world: W, cancel: CancelFlag) -> Self {
        Self::new(world, move || Ok(cancel.clone()))
    }
}

impl<W: VerilogFiles> SourceWorld for GuardedWorld<W> {
    fn read(&self, path: &str) -> Result<String, FileError> {
        self.world.read(path)
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, FileError> {
        self.world.read_bytes(path)
    }

    fn translate_verilog(&self, files: &[VerilogFile<'_>]) -> Result<VerilogModules, VerilogError> {
        let cancel = (self.permit)()?;
        if cancel.is_raised() {
            return Err(VerilogError::Cancelled);
        }
        Verilog { world: &self.world, files, cancel: &cancel }.modules()
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
    use crate::store::DiskWorld;

    const FILES: [VerilogFile<'_>; 1] =
        [VerilogFile { path: "m.v", text: "module m(input a, output q);\n assign q = a;\nendmodule\n" }];

    #[test]
    fn nothing_is_translated_without_a_permit_or_after_its_end() {
        let refusing = GuardedWorld::new(DiskWorld, || Err(VerilogError::Untrusted));
        assert_eq!(refusing.translate_verilog(&FILES), Err(VerilogError::Untrusted));
        let cancel = CancelFlag::default();
        cancel.raise();
        let over = GuardedWorld::until(DiskWorld, cancel);
        assert_eq!(over.translate_verilog(&FILES), Err(VerilogError::Cancelled));
    }
}
