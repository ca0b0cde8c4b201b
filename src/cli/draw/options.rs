//! Options of `nbc draw` that cannot apply are rejected, not ignored.

use crate::cli::draw::order::Order;
use crate::cli::draw::picture::{PictureKind, SubjectKind};
use crate::cli::wording::DrawError;

/// Rejects the first option that cannot change the picture.
///
/// # Errors
/// A diagnostic that says what the option is for.
pub(super) fn check_options(order: &Order, kind: &dyn PictureKind, subject: SubjectKind) -> Result<(), DrawError> {
    let is_program = subject == SubjectKind::Program;
    let has_robots = matches!(subject, SubjectKind::Library | SubjectKind::Run);
    let takes = |option| kind.options().contains(&option);
    let choice = order.circuit.choice();
    let options = [
        ("--at", order.at.is_some(), takes("--at"), "a pose"),
        ("--axes", !order.axes.is_empty(), takes("--axes"), "a heat map"),
        ("--behavior", order.behavior.is_some(), has_robots, "a library or a run"),
        ("--circuit", choice.circuit.is_some(), is_program, "a source file (.nb)"),
        ("--frames", order.frames.is_some(), takes("--frames"), "a film"),
        ("--robots", !order.robots.is_empty(), takes("--robots") && is_program, "a swarm in space and time"),
        ("--safe-colors", order.safe_colors, takes("--safe-colors"), "a picture of bodies"),
        ("--schedule", order.schedule.is_some(), takes("--schedule") && !is_program, "robots that move"),
        ("--swarm", choice.swarm.is_some(), is_program, "a source file (.nb)"),
        ("--test", order.test.is_some(), is_program, "a source file (.nb)"),
    ];
    let Some((option, .., wanted)) = options.into_iter().find(|(_, given, applies, _)| *given && !applies) else {
        return Ok(());
    };
    Err(DrawError::Option { what: order.what.clone(), option, kind: kind.word(), applies_to: wanted })
}
