//! Options of mapping: what is minimized, the amount of search, and its early end.

use crate::cancel::CancelFlag;

/// What to minimize.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MappingObjective {
    /// Robots.
    #[default]
    Area,
    /// Cycles along the slowest path, then robots.
    Delay,
    /// The risk of a wrong output: maximizes the smallest noise margin of the robots, then minimizes their number.
    Margin,
}

/// The amount of search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Effort {
    /// Little: for quick looks.
    Fast,
    /// Seconds for circuits of a few hundred cells.
    #[default]
    Normal,
    /// As good as it gets in minutes.
    High,
}

/// How to map.
#[derive(Clone, Debug, Default)]
pub struct MapOptions {
    /// What to minimize.
    pub objective: MappingObjective,
    /// The amount of search.
    pub effort: Effort,
    /// Ends the search early.
    pub cancel: CancelFlag,
}
