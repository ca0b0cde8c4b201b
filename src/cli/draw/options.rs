//! Options of `nbc draw` that cannot apply are rejected, not ignored.

use crate::cli::draw::picture::{PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::wording;
use nbc_base::diag::Diagnostic;

/// Rejects the first option that cannot change the picture.
pub(super) fn check_options(request: &DrawRequest, kind: &PictureKind, subject: SubjectKind) -> Result<(), Diagnostic> {
    let is_program = subject == SubjectKind::Program;
    let has_robots = matches!(subject, SubjectKind::Library | SubjectKind::Run);
    let takes = |option| kind.options.contains(&option);
    let choice = request.making.choice();
    let has_library = request.making.library.library.is_some();
    let goal = request.making.goal.given();
    let options = [
        ("--at", request.at.is_some(), takes("--at"), "a pose"),
        ("--axes", !request.axes.is_empty(), takes("--axes"), "a heat map"),
        ("--behavior", request.behavior.is_some(), has_robots, "a library or a run"),
        ("--circuit", choice.circuit.is_some(), is_program, "a source file (.nb)"),
        (goal.unwrap_or_default(), goal.is_some(), is_program, "a source file (.nb)"),
        ("--file", request.named.is_given(), is_program, "a source file (.nb)"),
        ("--frames", request.frames.is_some(), takes("--frames"), "a film"),
        ("--images", request.images.is_given(), takes("--schedule") && !is_program, "robots that move"),
        ("--library", has_library, is_program || subject == SubjectKind::Robot, "a source file (.nb) or a robot"),
        ("--robots", !request.robots.is_empty(), takes("--robots") && is_program, "a swarm in space and time"),
        ("--safe-colors", request.safe_colors, takes("--safe-colors"), "a picture of bodies"),
        ("--schedule", request.schedule.is_some(), takes("--schedule") && !is_program, "robots that move"),
        ("--swarm", choice.swarm.is_some(), is_program, "a source file (.nb)"),
        ("--test", request.test.is_some(), is_program, "a source file (.nb)"),
    ];
    match options.into_iter().find(|(_, given, applies, _)| *given && !applies) {
        None => Ok(()),
        Some((option, .., applies_to)) => {
            Err(wording::option_without_effect(&request.what, option, kind.word, applies_to))
        }
    }
}
