//! What checking a source finds.

use crate::check::uses::NameUses;
use crate::syntax::tree::Tree;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Instance, Program};
use nbc_base::source::ForeignCircuit;
use nbc_circuit::NetWidths;

#[derive(Clone, Debug, Default)]
pub struct Analysis {
    /// Complete only if there are no errors.
    pub program: Program,
    /// Ordered by place.
    pub diagnostics: Vec<Diagnostic>,
    pub uses: NameUses,
    pub widths: NetWidths,
    /// The checked file's is the last.
    pub trees: Vec<Tree>,
    /// Those of the prelude included.
    pub instances: Vec<Instance>,
    pub foreign: Vec<ForeignCircuit>,
    pub is_cancelled: bool,
}

impl Analysis {
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
