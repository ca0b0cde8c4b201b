//! The sources of a session: the texts given to it, which hide those of its world, and the results for each.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex};

use crate::buildable;
use crate::checked::Checked;
use crate::context::{BuiltIn, CheckContext, Readings, RecordingWorld};
use nbc_base::source::{OverlayWorld, SharedWorld, SourceWorld};
use nbc_lang::check::LastChecks;

pub(super) struct Documents {
    world: OverlayWorld<SharedWorld>,
    built_in: Arc<BuiltIn>,
    /// Replacements of declared files, by name and path.
    files: Vec<(String, String)>,
    /// By the identities of files.
    revisions: BTreeMap<String, u64>,
    known: BTreeMap<String, Arc<Checked>>,
    readings: Readings,
    last: LastChecks,
}

impl Documents {
    pub(super) fn new(world: SharedWorld) -> Self {
        Self {
            world: OverlayWorld::new(world),
            built_in: Arc::default(),
            files: Vec::new(),
            revisions: BTreeMap::new(),
            known: BTreeMap::new(),
            readings: Readings::default(),
            last: LastChecks::default(),
        }
    }

    pub(super) fn replace_files(&mut self, files: Vec<(String, String)>) {
        self.files = files;
    }

    pub(super) fn built_in(&self) -> &BuiltIn {
        &self.built_in
    }

    pub(super) fn world(&self) -> &dyn SourceWorld {
        &self.world
    }

    pub(super) fn update(&mut self, path: &str, revision: u64, text: impl Into<String>) {
        let identity = self.world.identity(path);
        if self.revisions.get(&identity).is_some_and(|&known| revision < known) {
            return;
        }
        self.forget(path);
        self.world.insert(path, text);
        self.revisions.insert(identity, revision);
    }

    pub(super) fn close(&mut self, path: &str) {
        self.forget(path);
        self.revisions.remove(&self.world.identity(path));
        self.world.remove(path);
    }

    pub(super) fn checked(&mut self, path: &str) -> Arc<Checked> {
        if let Some(known) = self.known.get(path) {
            return known.clone();
        }
        let revision = self.revisions.get(&self.world.identity(path)).copied().unwrap_or_default();
        let context = CheckContext {
            world: RecordingWorld::of(self.world.clone(), self.readings.clone()),
            built_in: self.built_in.clone(),
            netlists: Mutex::default(),
            compiled: Mutex::default(),
        };
        let mut checked = Checked::read(Arc::new(context), path, revision, &mut self.last);
        if !checked.has_errors() {
            let cancel = checked.context.world.cancel();
            let faults = buildable::faults(&checked, &self.files);
            checked.is_cancelled |= cancel.is_raised();
            checked.diagnostics.extend(faults);
            checked.diagnostics.sort_by_key(|diagnostic| diagnostic.labels.first().map(|label| label.span));
        }
        checked.is_cancelled |= checked.context.world.is_cancelled();
        let checked = Arc::new(checked);
        if !checked.is_cancelled {
            self.known.insert(path.to_owned(), checked.clone());
        }
        checked
    }

    pub(super) fn is_known(&self, path: &str) -> bool {
        self.known.contains_key(path)
    }

    pub(super) fn asked(&self, path: &str) -> BTreeSet<String> {
        self.known.get(path).map(|known| known.context.world.asked()).unwrap_or_default()
    }

    fn forget(&mut self, path: &str) {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        let changed = [path, folder].map(|path| self.world.identity(path));
        self.known.retain(|_, known| !changed.iter().any(|path| known.context.world.has_asked(path)));
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use nbc_base::source::{FileError, MemoryWorld, VerilogError, VerilogFiles, VerilogModule, VerilogModules};

    const INVERTER: &str = "circuit inverter(a) -> (q) { q = not a }";

    fn documents(files: &[(&str, &str)]) -> Documents {
        let mut world = MemoryWorld::default();
        files.iter().for_each(|(path, text)| world.insert(*path, *text));
        Documents::new(Arc::new(world))
    }

    fn circuits(checked: &Checked) -> Vec<&str> {
        let own = checked.program.circuits.iter().filter(|circuit| Some(circuit.span.file) == checked.file);
        own.map(|circuit| circuit.name.as_str()).collect()
    }

    #[test]
    fn a_source_is_checked_again_only_when_its_text_changes() {
        let mut documents = documents(&[("a.nb", INVERTER), ("b.nb", INVERTER)]);
        let [first, other] = ["a.nb", "b.nb"].map(|path| documents.checked(path));
        assert!(Arc::ptr_eq(&first, &documents.checked("a.nb")));
        documents.update("a.nb", 1, INVERTER.replace("inverter", "n"));
        let second = documents.checked("a.nb");
        assert_eq!((second.revision, circuits(&second)), (1, vec!["n"]));
        assert!(Arc::ptr_eq(&other, &documents.checked("b.nb")), "another source stays as it is");
        documents.close("a.nb");
        assert_eq!(circuits(&documents.checked("a.nb")), ["inverter"]);
    }

    #[test]
    fn a_text_of_an_older_revision_is_ignored() {
        let mut documents = documents(&[]);
        documents.update("a.nb", 5, INVERTER);
        documents.update("a.nb", 4, "circuit");
        let checked = documents.checked("a.nb");
        assert_eq!((checked.revision, &checked.diagnostics[..]), (5, &[][..]));
    }

    #[test]
    fn a_source_is_checked_again_when_a_file_that_it_uses_appears() {
        let mut documents = documents(&[("a.nb", "use \"b.nb\"\ncircuit f(a) -> (q) { q = inverter(a) }")]);
        assert!(documents.checked("a.nb").has_errors());
        documents.update("b.nb", 1, INVERTER);
        assert_eq!(documents.checked("a.nb").diagnostics, []);
    }

    struct Translator {
        world: MemoryWorld,
        count: Arc<AtomicUsize>,
        is_cancelled: bool,
    }

    impl SourceWorld for Translator {
        fn read(&self, path: &str) -> Result<String, FileError> {
            self.world.read(path)
        }

        fn read_verilog(&self, _: &VerilogFiles) -> Result<VerilogModules, VerilogError> {
            if self.count.fetch_add(1, Ordering::Relaxed) == 0 && self.is_cancelled {
                return Err(VerilogError::Cancelled);
            }
            let blif = ".model f\n.inputs a\n.outputs q\n.names a q\n0 1\n.end\n".to_owned();
            let module = VerilogModule { name: "f".to_owned(), blif, ..VerilogModule::default() };
            Ok(VerilogModules { modules: vec![module], ..VerilogModules::default() })
        }

        fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
            self.world.list(folder)
        }
    }

    #[test]
    fn verilog_is_read_again_only_when_a_file_of_it_changes() {
        let mut world = MemoryWorld::default();
        world.insert("a.nb", "use \"f.v\"\ncircuit g(a) -> (q) { q = f(a) }");
        world.insert("f.v", "module f(input a, output q);");
        let count = Arc::new(AtomicUsize::new(0));
        let mut documents = Documents::new(Arc::new(Translator { world, count: count.clone(), is_cancelled: false }));
        let mut check = |path, text: &str| {
            documents.update(path, 0, text);
            assert_eq!(documents.checked("a.nb").diagnostics, []);
            count.load(Ordering::Relaxed)
        };
        let changed = "use \"f.v\"\ncircuit g(a) -> (q) { q = not f(a) }";
        assert_eq!(check("a.nb", changed), 1);
        assert_eq!(check("a.nb", &format!("{changed}\n")), 1);
        assert_eq!(check("f.v", "module f(input b, output q);"), 2);
        assert_eq!(check("f.v", "`include \"g.vh\""), 3);
        assert_eq!(check("a.nb", &format!("{changed}\n")), 3);
        assert_eq!(check("g.vh", "// other"), 4);
        assert_eq!(check("a.nb", changed), 4);
    }

    #[test]
    fn a_source_is_checked_again_when_a_reading_was_cancelled() {
        let mut world = MemoryWorld::default();
        world.insert("a.nb", "use \"f.v\"\ncircuit g(a) -> (q) { q = f(a) }");
        world.insert("f.v", "module f(input a, output q);");
        let mut documents = Documents::new(Arc::new(Translator { world, count: Arc::default(), is_cancelled: true }));
        assert!(documents.checked("a.nb").has_errors());
        assert!(!documents.is_known("a.nb"));
        assert_eq!(documents.checked("a.nb").diagnostics, []);
        assert!(documents.is_known("a.nb"));
    }

    #[test]
    fn a_source_is_checked_again_when_a_robot_appears_in_the_folder_of_its_library() {
        let mut documents = documents(&[("a.nb", "library l { from: \"robots\" }")]);
        let missing = documents.checked("a.nb").diagnostics.clone();
        documents.update("robots/x.yaml", 1, "");
        let empty = documents.checked("a.nb").diagnostics.clone();
        documents.update("robots/x.yaml", 2, include_str!("../../../library/robots/nand_5x5.yaml"));
        assert!(!missing.is_empty() && !empty.is_empty() && missing != empty);
        assert_eq!(documents.checked("a.nb").diagnostics, []);
    }
}
