//! Kinds of pictures, and their file extensions.

use clap::ValueEnum;

/// Kinds of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Kind {
    /// A film as animated PNG
    Apng,
    /// The fitness of a run by group of behaviors, with statistics
    Comparison,
    /// The cells of a circuit, for Graphviz
    Dot,
    /// A film as GIF
    Gif,
    /// The archive of a run
    Heatmap,
    /// The deformed body of a robot at one moment
    Pose,
    /// The coverage and QD-score of a run over its generations
    Progress,
    /// A page with a player
    Report,
    /// The cells of a circuit with their robots
    Schematic,
    /// Paths over time
    Spacetime,
    /// Bodies with their materials
    Sprite,
    /// Snapshots of a robot's gait under each pattern
    Strip,
    /// The waveforms of a swarm
    Vcd,
}

impl Kind {
    /// The file extensions of this kind.
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

    /// The word for it on the command line.
    pub(super) fn word(self) -> String {
        self.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned())
    }
}
