//! Methods of proof.

/// How a netlist was proved equal to its source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Every pattern of the inputs and cuts was simulated.
    Exhaustive {
        /// The number of patterns.
        patterns: u64,
    },
    /// The two netlists are equal gate by gate, whatever cells each gate is made of.
    Structural,
    /// A SAT solver found no pattern in which they differ.
    Sat {
        /// The number of calls of the solver.
        calls: usize,
    },
}
