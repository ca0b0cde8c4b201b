//! The largest circuits.

/// The most cells of a circuit, written in the language or read from a file; docs/synthesis.md, "Measured", has figures
/// for this size.
pub(crate) const MAX_CELLS: u64 = 1_000_000;

/// The most bits of nets and gates of a circuit, including the circuits it contains.
pub(crate) const MAX_NETS: u64 = 8 * MAX_CELLS;

/// The most statements of a circuit, counting each iteration of a `for`.
pub(crate) const MAX_STATEMENTS: usize = 500_000;

/// The most bits of a net.
pub const MAX_WIDTH: i64 = 1 << 20;

/// How deep circuits may be built of circuits.
pub(crate) const MAX_HIERARCHY: usize = 200;
