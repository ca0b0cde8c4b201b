//! The sources of a swarm's robots: the program, a folder of the world, or an evolution's run.

use std::sync::OnceLock;

use crate::store;
use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Behavior, Library, LibrarySource, Origin};
use nbc_base::source::SourceWorld;

#[derive(Default)]
pub(super) struct BuiltIn {
    shipped: OnceLock<Library>,
    three: OnceLock<Library>,
}

impl BuiltIn {
    pub(super) fn shipped(&self) -> &Library {
        self.shipped.get_or_init(store::shipped_library)
    }

    pub(super) fn three(&self) -> &Library {
        self.three.get_or_init(store::three_library)
    }
}

#[derive(Clone, Copy)]
pub(super) struct RobotSources<'a> {
    pub(super) world: &'a dyn SourceWorld,
    pub(super) built_in: &'a BuiltIn,
    pub(super) file: &'a str,
}

impl<'a> RobotSources<'a> {
    pub(super) fn library(self, declared: &LibrarySource, runs: &str) -> Result<Library, Vec<Diagnostic>> {
        let mut library = match &declared.from {
            Origin::Shipped => self.built_in.shipped().clone(),
            Origin::Three => self.built_in.three().clone(),
            Origin::Folder(folder) => self.folder(folder, declared, None)?,
            Origin::Evolution(name) => {
                let (folder, file) = (robots_of_run(runs, name), self.file);
                let evolve = format!("nbc evolve {file} --run {name} --out {runs}");
                let help = format!("`{evolve}`, then `nbc library add {runs}/{name} --into {folder}`");
                self.folder(&folder, declared, Some(&help))?
            }
        };
        if let Some(behaviors) = &declared.behaviors {
            // What an evolution will find is not known.
            let absent = |behavior: &&Behavior| library.robots.iter().all(|robot| robot.behavior != **behavior);
            let absent: Vec<Behavior> = behaviors.iter().filter(absent).copied().collect();
            if !absent.is_empty() && !matches!(declared.from, Origin::Evolution(_)) {
                return Err(vec![wording::no_behavior(&declared.name, &absent, declared.span)]);
            }
            library.robots.retain(|robot| behaviors.contains(&robot.behavior));
        }
        let names = || library.robots.iter().map(|robot| robot.name.as_str());
        let unknown = declared.without.iter().filter(|(name, _)| names().all(|known| known != name));
        let faults: Vec<_> = unknown.map(|(name, place)| wording::unknown_robot(name, names(), *place)).collect();
        if !faults.is_empty() {
            return Err(faults);
        }
        library.robots.retain(|robot| declared.without.iter().all(|(name, _)| robot.name != *name));
        Ok(library)
    }

    pub(super) fn has_run(self, declared: &LibrarySource, runs: &str) -> bool {
        match &declared.from {
            Origin::Evolution(name) => self.world.list(&robots_of_run(runs, name)).is_ok(),
            Origin::Shipped | Origin::Three | Origin::Folder(_) => true,
        }
    }

    fn folder(self, folder: &str, declared: &LibrarySource, help: Option<&str>) -> Result<Library, Vec<Diagnostic>> {
        let placed = |fault: Diagnostic| wording::of_library(fault, declared.span, help);
        store::read_library(self.world, folder).map_err(|faults| faults.into_iter().map(placed).collect())
    }
}

fn robots_of_run(runs: &str, name: &str) -> String {
    format!("{runs}/{name}/robots")
}
