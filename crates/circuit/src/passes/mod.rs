//! Passes: small transformations that preserve the function of a netlist, each in its own file.

mod dissolve_wires;
mod fold_constants;
mod merge_registers;
mod share;
mod sweep;

pub use dissolve_wires::DissolveWires;
pub(crate) use dissolve_wires::check_drivers;
pub use fold_constants::FoldConstants;
pub use merge_registers::MergeRegisters;
pub use share::Share;
pub use sweep::Sweep;

use crate::{NetId, Netlist, NetlistError};

/// A transformation that preserves the function of a netlist.
pub trait Pass: Sync {
    /// Changes the netlist.
    ///
    /// # Errors
    /// When the netlist is not well formed.
    fn run(&self, netlist: &mut Netlist) -> Result<(), NetlistError>;

    /// The cells of a netlist that it would merge with others, and those others.
    fn merged(&self, _netlist: &Netlist) -> Vec<(NetId, NetId)> {
        Vec::new()
    }
}

/// The passes before technology mapping, in order.
pub(crate) const ORDER: &[&dyn Pass] = &[
    // First, so that no other pass has to handle wires.
    &DissolveWires,
    // Before sharing: constants make different cells equal.
    &FoldConstants,
    &Share,
    // After sharing, which merges their clocks.
    &MergeRegisters,
    // Last, because other passes leave cells without receivers.
    &Sweep,
];

/// Runs every pass in order.
///
/// # Errors
/// When the netlist is not well formed.
pub fn run(netlist: &mut Netlist) -> Result<(), NetlistError> {
    ORDER.iter().try_for_each(|pass| pass.run(netlist))
}
