//! From trees to a [`Program`]: names, units, widths. There is a file for each kind of declaration. Checking never
//! stops at the first error.

mod cell;
mod circuit;
mod constant;
mod evolution;
mod expression;
mod fields;
mod foreign;
mod instance;
mod library;
mod load;
mod material;
mod names;
mod program;
mod quantity;
mod recursion;
mod schedule;
mod simulate;
mod size;
mod swarm;
mod table;
mod test;
mod uses;
mod wording;

pub use instance::named;
pub use load::{PRELUDE, open};
pub use swarm::DEFAULT_LIBRARY;
pub use uses::{NameKind, NameUse, NameUses};

use std::collections::BTreeSet;

use crate::diag::{Code, Diagnostic};
use crate::model::Program;
use crate::source::{FileId, SourceWorld, Sources, Span};

/// A program and its diagnostics.
#[derive(Clone, Debug, Default)]
pub struct Analysis {
    /// The program, complete only if there are no errors.
    pub program: Program,
    /// Errors and warnings, ordered by place.
    pub diagnostics: Vec<Diagnostic>,
    /// The names with a meaning.
    pub uses: NameUses,
}

impl Analysis {
    /// Whether there are errors.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }
}

/// Checks a file of `sources`. The prelude and the files it uses are added to `sources`.
pub fn check(world: &dyn SourceWorld, sources: &mut Sources, file: FileId) -> Analysis {
    let loaded = load::load(world, sources, file);
    let (program, mut diagnostics, uses) = program::program(&loaded.trees, sources);
    forget_consequences(&mut diagnostics, sources, &loaded);
    diagnostics.extend(library::folders(world, sources, &loaded.trees));
    diagnostics.extend(loaded.faults);
    diagnostics.sort_by_key(|diagnostic| diagnostic.labels.first().map(|label| label.span));
    diagnostics.dedup();
    Analysis { program, diagnostics, uses }
}

/// A name whose declaration could not be parsed is not reported as unknown, because the declaration has its own
/// message.
fn forget_consequences(diagnostics: &mut Vec<Diagnostic>, sources: &Sources, loaded: &load::Loaded) {
    let text = |span: Span| &sources.file(span.file).text[span.range()];
    let broken: BTreeSet<&str> =
        loaded.trees.iter().flat_map(|(_, tree)| &tree.broken).map(|&span| text(span)).collect();
    let follows = |diagnostic: &Diagnostic| {
        diagnostic.code == Code::Unknown
            && diagnostic.labels.first().is_some_and(|label| broken.contains(text(label.span)))
    };
    diagnostics.retain(|diagnostic| !follows(diagnostic));
}
