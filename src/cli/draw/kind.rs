//! Kinds of pictures, and the files that hold them.

use clap::ValueEnum;

/// Kinds of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Kind {
    /// A film in a PNG file
    Apng,
    /// A run's fitness by group of behaviors, with its statistics
    Comparison,
    /// A circuit's cells for Graphviz
    Dot,
    /// A film
    Gif,
    /// A run's archive
    Heatmap,
    /// A robot bent by the physics, at one moment
    Pose,
    /// A run's coverage and QD-score over the generations
    Progress,
    /// A page with a player
    Report,
    /// A circuit's cells with their robots
    Schematic,
    /// Paths over time
    Spacetime,
    /// Bodies with their materials
    Sprite,
    /// Snapshots of a robot's gait under each pattern
    Strip,
    /// A swarm's waveforms
    Vcd,
}

impl Kind {
    /// The extensions of the files that hold such a picture.
    pub(super) fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Apng => &["png", "apng"],
            Self::Gif => &["gif"],
            Self::Vcd => &["vcd"],
            Self::Dot => &["dot", "gv"],
            Self::Report => &["html"],
            _ => &["svg", "png"],
        }
    }

    /// Its word on the command line.
    pub(super) fn word(self) -> String {
        self.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned())
    }
}
