//! What checking a source finds.

use crate::check::uses::NameUses;
use crate::syntax::tree::Tree;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Instance, Program};
use nbc_base::source::ForeignCircuit;
use nbc_circuit::NetWidths;

/// A program and its diagnostics.
#[derive(Clone, Debug, Default)]
pub struct Analysis {
    /// The program, complete only if there are no errors.
    pub program: Program,
    /// Errors and warnings, ordered by place.
    pub diagnostics: Vec<Diagnostic>,
    /// The names with a meaning.
    pub uses: NameUses,
    /// The widths of the nets that were built.
    pub widths: NetWidths,
    /// The trees of the files, the checked file's last.
    pub trees: Vec<Tree>,
    /// The circuits that were built, with the values of their parameters, those of the prelude included.
    pub instances: Vec<Instance>,
    /// The circuits of other tools' files, and what their proofs begin with.
    pub foreign: Vec<ForeignCircuit>,
    /// Whether nobody waited for the result any more, so that a part of it is missing.
    pub is_cancelled: bool,
}

impl Analysis {
    /// Whether a diagnostic is an error, so that the program cannot be built.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }
}

#[cfg(test)]
mod tests {
    use crate::check;
    use nbc_base::source::{MemoryWorld, Sources, Span};

    #[test]
    fn nets_have_a_width_for_each_choice_of_parameters() {
        let text = "\
circuit join[n](a[n]) -> (q[2 * n]) { t = {a, a}  q = t }
circuit both(a[2], b[3]) -> (p[4], q[6]) { p = join(a)  q = join(b) }
";
        let mut sources = Sources::default();
        let file = sources.add("a.nb", text);
        let analysis = check::check(&MemoryWorld::default(), &mut sources, file);
        let widths = |name: &str| -> Vec<u32> {
            let start = text.find(name).unwrap();
            analysis.widths.of(Span::new(file, start, start + 1)).collect()
        };
        assert_eq!(widths("t = "), [4, 6]);
        assert_eq!(widths("p[4]"), [4]);
        assert_eq!(widths("both"), [0; 0]);
        let instances: Vec<String> = analysis.instances.iter().map(ToString::to_string).collect();
        assert_eq!(instances, ["join[2]", "join[3]", "both"]);
    }
}
