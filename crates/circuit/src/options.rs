//! Options of mapping: what is minimized, the amount of search, and its early end.

use crate::CancelFlag;

/// What technology mapping minimizes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MappingObjective {
    #[default]
    Area,
    /// Cycles along the slowest path, then robots.
    Delay,
    /// The risk of a wrong output: maximizes the smallest noise margin of the robots, then minimizes their number.
    Margin,
    /// The risk of a wrong output in another world: as `Margin`, with the radius of the robots.
    Sturdy,
}

/// How long a search takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Effort {
    Fast,
    /// Seconds for circuits of a few hundred cells.
    #[default]
    Normal,
}

#[derive(Clone, Debug, Default)]
pub struct MapOptions {
    pub objective: MappingObjective,
    pub effort: Effort,
    /// Ends the search early, with the best result so far.
    pub cancel: CancelFlag,
}
