//! The patterns in which a network must be right, if not in all.

use crate::clause::Clause;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CareSet {
    pub clauses: Vec<Clause>,
    /// Words of 64 patterns that fulfill the conditions, `words[input][word]`.
    pub words: Vec<Vec<u64>>,
}

impl CareSet {
    pub fn constrains(&self, input: usize) -> bool {
        self.clauses.iter().flatten().any(|&(other, _)| other == input)
    }
}
