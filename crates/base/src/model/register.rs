//! How a register takes its data, and what forces it.

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RegisterKind {
    Rising,
    Falling,
    High,
    Low,
}

impl RegisterKind {
    /// The kind that does the same with the opposite of the clock.
    pub fn opposite(self) -> Self {
        match self {
            Self::Rising => Self::Falling,
            Self::Falling => Self::Rising,
            Self::High => Self::Low,
            Self::Low => Self::High,
        }
    }

    pub fn is_edge(self) -> bool {
        matches!(self, Self::Rising | Self::Falling)
    }

    pub fn word(self) -> &'static str {
        match self {
            Self::Rising => "rising",
            Self::Falling => "falling",
            Self::High => "high",
            Self::Low => "low",
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Forcing {
    #[default]
    Never,
    /// A reset gives it its start value as soon as it is 1, and keeps it while it is 1.
    ToStart,
    /// A set and a reset make it 1 and 0. The reset is stronger.
    SetReset,
}

impl Forcing {
    pub fn nets(self) -> &'static [&'static str] {
        match self {
            Self::Never => &[],
            Self::ToStart => &["reset"],
            Self::SetReset => &["set", "reset"],
        }
    }
}
