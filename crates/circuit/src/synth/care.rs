//! The patterns in which a network must be right, if not in all.

use crate::clause::Clause;

/// Conditions on the inputs of a network: only where all hold does it matter what the network computes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CareSet {
    /// Of each clause, an input has the given value.
    pub clauses: Vec<Clause>,
    /// Words of 64 patterns that fulfill the conditions, `words[input][word]`.
    pub words: Vec<Vec<u64>>,
}

impl CareSet {
    /// Whether a condition depends on an input.
    pub fn constrains(&self, input: usize) -> bool {
        self.clauses.iter().flatten().any(|&(other, _)| other == input)
    }
}
