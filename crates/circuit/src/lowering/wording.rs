//! Why state does not become multiplexers, in words.

pub(super) const FORCED: &str = "it is set or reset without its clock";
pub(super) const LOOP: &str = "it is written as a loop of cells";
