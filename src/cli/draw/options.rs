//! Options of `nbc draw` that cannot apply are rejected, not ignored.

use crate::cli::draw::arguments::DrawArguments;
use crate::cli::draw::kind::Kind;
use crate::cli::wording::DrawError;

/// The kinds of subjects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Drawn {
    Library,
    Program,
    Robot,
    Run,
}

impl DrawArguments {
    /// Rejects the first option that cannot change the picture.
    ///
    /// # Errors
    /// A diagnostic that says what the option is for.
    pub(super) fn check_options(&self, drawn: Drawn) -> Result<(), DrawError> {
        let kind = self.kind;
        let is_film = matches!(kind, Kind::Apng | Kind::Gif);
        let shows_bodies =
            is_film || matches!(kind, Kind::Pose | Kind::Report | Kind::Schematic | Kind::Sprite | Kind::Strip);
        let moves = is_film || matches!(kind, Kind::Pose | Kind::Spacetime | Kind::Strip);
        let choice = self.circuit.choice();
        let options = [
            ("--at", self.at.is_some(), kind == Kind::Pose, "a pose"),
            ("--axes", !self.axes.is_empty(), kind == Kind::Heatmap, "a heat map"),
            ("--behavior", self.behavior.is_some(), matches!(drawn, Drawn::Library | Drawn::Run), "a library or a run"),
            ("--circuit", choice.circuit.is_some(), drawn == Drawn::Program, "a source file (.nb)"),
            (
                "--robots",
                !self.robots.is_empty(),
                drawn == Drawn::Program && kind == Kind::Spacetime,
                "a swarm in space and time",
            ),
            ("--safe-colors", self.safe_colors, shows_bodies, "a picture of bodies"),
            ("--schedule", self.schedule.is_some(), drawn != Drawn::Program && moves, "robots that move"),
            ("--swarm", choice.swarm.is_some(), drawn == Drawn::Program, "a source file (.nb)"),
            ("--test", self.test.is_some(), drawn == Drawn::Program, "a source file (.nb)"),
        ];
        let Some((option, .., wanted)) = options.into_iter().find(|(_, given, applies, _)| *given && !applies) else {
            return Ok(());
        };
        Err(DrawError::Option { what: self.what.clone(), option, kind: kind.word(), applies_to: wanted })
    }
}
