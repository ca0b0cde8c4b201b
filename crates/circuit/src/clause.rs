//! Conditions on inputs or registers.

/// An input or a register, by its index, with a value.
pub type Literal = (usize, bool);

/// At least one of these has its value.
pub type Clause = Vec<Literal>;
