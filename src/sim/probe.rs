//! Where a simulation's time goes: a function that is told as each part of a substep ends. The physics itself reads no clock.

/// A part of the work of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Whatever came before on this thread; no part of the simulation.
    Elsewhere,
    /// Between env steps: stimuli, centers of mass, loading and unloading lanes.
    Bookkeeping,
    /// Contact with the ground and with oneself, the instability count.
    Contact,
    /// Springs and the integrator: four stages.
    Springs,
    /// Length limits.
    Limits,
}

/// Told of a part when the part ends, by the thread that did it, and of how many simulations side by side it was. Limits end a substep,
/// bookkeeping ends what one thread does in one go.
pub type Probe = fn(Part, usize);
