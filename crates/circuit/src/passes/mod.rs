//! Passes: small transformations that preserve the function of a netlist, each in its own file.

mod dissolve_wires;
mod fold_constants;
mod merge_registers;
mod share;
mod sweep;
mod turn_clocks;

pub(crate) use dissolve_wires::check_drivers;
pub use dissolve_wires::dissolve_wires;
use fold_constants::fold_constants;
use merge_registers::{merge_registers, merged_registers};
pub(crate) use share::share;
pub use sweep::sweep;
pub(crate) use turn_clocks::turn_clocks;

use crate::{NetId, Netlist, NetlistError};

#[derive(Clone, Copy)]
pub struct Pass {
    pub name: &'static str,
    pub about: &'static str,
    pub(crate) run: fn(&mut Netlist) -> Result<(), NetlistError>,
    pub(crate) merged: fn(&Netlist) -> Vec<(NetId, NetId)>,
}

impl Pass {
    const fn new(name: &'static str, about: &'static str, run: fn(&mut Netlist) -> Result<(), NetlistError>) -> Self {
        Self { name, about, run, merged: |_| Vec::new() }
    }
}

/// The passes before technology mapping, in order.
pub const ORDER: &[Pass] = &[
    // First, so that no other pass has to handle wires.
    Pass::new("dissolve-wires", "replaces wires by their drivers", dissolve_wires),
    Pass::new("turn-clocks", "removes inverters before clocks", |netlist| {
        turn_clocks(netlist);
        Ok(())
    }),
    // Before sharing: constants make different cells equal.
    Pass::new("fold-constants", "simplifies cells with constant or repeated pins", |netlist| {
        fold_constants(netlist);
        Ok(())
    }),
    Pass::new("share", "merges cells that compute the same", |netlist| {
        share(netlist);
        Ok(())
    }),
    // After sharing, which merges their clocks.
    Pass {
        name: "merge-registers",
        about: "merges registers that always store the same bit",
        run: |netlist| {
            merge_registers(netlist);
            Ok(())
        },
        merged: merged_registers,
    },
    // Last, because other passes leave cells without receivers.
    Pass::new("sweep", "removes what no output depends on", |netlist| {
        sweep(netlist);
        Ok(())
    }),
];

/// The passes over logic. They keep all registers that an output depends on.
pub(crate) fn simplify(netlist: &mut Netlist) {
    fold_constants(netlist);
    share(netlist);
    sweep(netlist);
}

pub fn run(netlist: &mut Netlist) -> Result<(), NetlistError> {
    ORDER.iter().try_for_each(|pass| (pass.run)(netlist))
}

pub fn after_each(mut netlist: Netlist) -> Result<Vec<(&'static Pass, Netlist)>, NetlistError> {
    let after = |pass: &'static Pass| (pass.run)(&mut netlist).map(|()| (pass, netlist.clone()));
    ORDER.iter().map(after).collect()
}
