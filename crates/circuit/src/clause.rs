//! Conditions on inputs or registers.

/// An input or a register, by its index, with a value.
pub type ValuedBit = (usize, bool);

/// At least one of these has its value.
pub type Clause = Vec<ValuedBit>;
