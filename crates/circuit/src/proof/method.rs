//! Methods of proof.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    Exhaustive {
        patterns: u64,
    },
    /// The two netlists are equal gate by gate, whatever cells each gate is made of.
    Structural,
    Sat {
        calls: usize,
    },
}
