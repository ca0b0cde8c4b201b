//! Where a simulation's time goes: a function that is told as each part of a substep ends. The physics itself reads no clock.

/// A part of the work of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Between env steps: stimuli, centers of mass, loading and unloading lanes.
    Books,
    /// Contact with the ground and with oneself, the instability count.
    Contact,
    /// Springs and the integrator: four stages.
    Springs,
    /// Length limits.
    Limits,
}

impl Part {
    /// All parts, in order of a substep.
    pub const ALL: [Self; 4] = [Self::Books, Self::Contact, Self::Springs, Self::Limits];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Books => "books",
            Self::Contact => "contact",
            Self::Springs => "springs",
            Self::Limits => "limits",
        }
    }
}

/// Told of a part when the part ends, by the thread that did it.
pub type Probe = fn(Part);
