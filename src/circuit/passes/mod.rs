//! Passes: small transformations that preserve the function of a netlist, each in its own file.

mod dissolve_wires;
mod fold_constants;
mod share;
mod sweep;

pub use dissolve_wires::DissolveWires;
pub use fold_constants::FoldConstants;
pub use share::Share;
pub use sweep::Sweep;

use crate::circuit::{Netlist, NetlistError};

/// A transformation that preserves the function of a netlist.
pub trait Pass: Sync {
    /// The name, in kebab case.
    fn name(&self) -> &'static str;

    /// A description of one line.
    fn description(&self) -> &'static str;

    /// Changes the netlist.
    ///
    /// # Errors
    /// When the netlist is not well formed.
    fn run(&self, netlist: &mut Netlist) -> Result<(), NetlistError>;
}

/// The passes before technology mapping, in order.
pub const ORDER: &[&dyn Pass] = &[
    // First, so that no other pass has to handle wires.
    &DissolveWires,
    // Before sharing: constants make different cells equal.
    &FoldConstants,
    &Share,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_in_kebab_case_and_all_different() {
        let mut names: Vec<_> = ORDER.iter().map(|pass| pass.name()).collect();
        assert!(names.iter().all(|name| name.chars().all(|c| c.is_ascii_lowercase() || c == '-')));
        assert!(ORDER.iter().all(|pass| !pass.description().contains('\n')));
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), ORDER.len());
    }
}
