//! From trees to a [`Program`](nbc_base::model::Program): names, units, widths. There is a file for each kind of
//! declaration. Checking never stops at the first error.

mod against;
mod analysis;
mod array;
mod cell;
mod circuit;
mod consequences;
pub mod constant;
mod declarations;
mod derived;
mod enumeration;
mod evolution;
mod expression;
mod fields;
mod foreign;
mod images;
mod instance;
mod known;
mod library;
mod limit;
mod load;
mod material;
mod names;
mod program;
mod quantity;
mod record_fields;
mod recursion;
mod schedule;
mod simulate;
mod size;
mod start;
mod swarm;
mod table;
mod test;
mod uses;
mod verilog_files;
mod vocabulary;
mod wording;
mod world;

pub use analysis::Analysis;
pub use instance::named;
pub use known::LastChecks;
pub use load::{PRELUDE, beside, is_usable, open};
pub use record_fields::{Holds, RecordField, record_fields};
pub use swarm::DEFAULT_LIBRARY;
pub use uses::{NameKind, NameUse, NameUses};
pub use verilog_files::verilog_files;

use crate::check::known::KnownCircuits;
use nbc_base::diag::Code;
use nbc_base::source::{FileId, SourceWorld, Sources};

pub fn check(world: &dyn SourceWorld, sources: &mut Sources, file: FileId) -> Analysis {
    check_again(world, sources, file, &mut LastChecks::default())
}

/// Checks a text of which some declarations may be known from before.
pub fn check_again(world: &dyn SourceWorld, sources: &mut Sources, file: FileId, last: &mut LastChecks) -> Analysis {
    let loaded = load::load(world, sources, file, &mut last.texts);
    let mut known = last.files.remove(&sources.file(file).name).unwrap_or_default();
    let is_new = known.is_empty();
    let mut analysis = program::program(world, &loaded, sources, (&mut last.prelude, &mut known));
    // Where a budget ends depends on what was made before.
    if !is_new && analysis.diagnostics.iter().any(|fault| fault.code == Code::TooLarge) {
        known = KnownCircuits::default();
        analysis = program::program(world, &loaded, sources, (&mut last.prelude, &mut known));
    }
    last.files.insert(sources.file(file).name.clone(), known);
    let diagnostics = &mut analysis.diagnostics;
    consequences::forget(diagnostics, sources, &loaded);
    diagnostics.extend(library::folders(world, sources, &loaded.trees));
    diagnostics.extend(loaded.faults);
    analysis.foreign = loaded.foreign;
    analysis.trees = loaded.trees.into_iter().map(|(_, tree)| tree).collect();
    diagnostics.sort_by_key(|diagnostic| diagnostic.labels.first().map(|label| label.span));
    diagnostics.dedup();
    analysis.diagnostics = limit::limit(std::mem::take(diagnostics), sources);
    analysis
}
