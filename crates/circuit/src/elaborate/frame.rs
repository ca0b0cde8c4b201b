//! Frames: a block of statements in one iteration of the loops around it, with its nets.

use nbc_base::model::{ExpressionId, Target};

/// A block in one turn of the loops around it.
pub(super) struct Scope {
    /// The frame of the block around, except for that of the circuit.
    pub(super) parent: Option<u32>,
    /// The first slot of the block's nets, and the net it is in this turn.
    pub(super) first_slot: u32,
    pub(super) first_net: u32,
    pub(super) nets: u32,
    /// Parameters, loop variables and integers with names.
    pub(super) variables: Vec<i128>,
    /// The loop variables as a suffix of names.
    pub(super) turn: String,
}

impl Scope {
    /// The first slot of the block's nets, its net in this iteration, and the number of slots.
    pub(super) fn nets(&self) -> (u32, u32, u32) {
        (self.first_slot, self.first_net, self.nets)
    }
}

/// A statement to be built, with its frame.
#[derive(Clone, Copy)]
pub(super) struct Item<'a> {
    pub(super) frame: u32,
    pub(super) targets: &'a [Target],
    /// Whether the targets are the parts of one value.
    pub(super) joined: bool,
    pub(super) value: ExpressionId,
}
