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

pub trait Pass: Sync {
    fn name(&self) -> &'static str;

    fn about(&self) -> &'static str;

    fn run(&self, netlist: &mut Netlist) -> Result<(), NetlistError>;

    /// The cells of a netlist that it would merge with others, and those others.
    fn merged(&self, _netlist: &Netlist) -> Vec<(NetId, NetId)> {
        Vec::new()
    }
}

pub const ORDER: &[&dyn Pass] = &[
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

pub fn run(netlist: &mut Netlist) -> Result<(), NetlistError> {
    ORDER.iter().try_for_each(|pass| pass.run(netlist))
}

pub fn after_each(mut netlist: Netlist) -> Result<Vec<(&'static dyn Pass, Netlist)>, NetlistError> {
    let after = |pass: &&'static dyn Pass| pass.run(&mut netlist).map(|()| (*pass, netlist.clone()));
    ORDER.iter().map(after).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_pass_has_a_name_of_its_own() {
        let mut names: Vec<&str> = ORDER.iter().map(|pass| pass.name()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), ORDER.len());
    }
}
