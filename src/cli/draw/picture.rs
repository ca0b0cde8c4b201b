//! What every kind of picture provides.

use crate::cli::Failure;
use crate::cli::draw::evolution_run::best_champions;
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::titled_body::TitledBody;
use crate::cli::draw::titled_robots::TitledRobots;
use crate::cli::draw::wording::DrawError;
use nbc_session::report::{EvolutionResults, Film, Stage, Svg};

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SubjectKind {
    Library,
    Program,
    Robot,
    Run,
}

/// A finished picture, or a film to be made.
pub(super) enum Drawing {
    Picture(Svg),
    Text(String),
    Film { format: FilmFormat, film: Film, stage: Stage },
}

/// The formats of films.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FilmFormat {
    Apng,
    Gif,
}

/// A kind of picture. What it cannot show is refused, with the kind of subject that it is for.
pub(super) trait PictureKind: Sync {
    /// The word for it on the command line.
    fn word(&self) -> &'static str;

    /// A line about it in the help.
    fn about(&self) -> &'static str;

    /// The extensions of its files.
    fn extensions(&self) -> &'static [&'static str] {
        &["svg", "png"]
    }

    /// The options that change the picture, of those that not every kind has.
    fn options(&self) -> &'static [&'static str] {
        &[]
    }

    /// The kind of subject that it is for: the one to name if another is given. A kind for libraries also shows the
    /// best robots of a run.
    fn subject(&self) -> SubjectKind;

    /// Draws one robot.
    fn of_robot(&self, _robot: &TitledBody, request: &DrawRequest) -> Result<Drawing, Failure> {
        Err(self.refuse(SubjectKind::Robot, request))
    }

    /// Draws the robots of a library.
    fn of_library(&self, _robots: &TitledRobots, request: &DrawRequest) -> Result<Drawing, Failure> {
        Err(self.refuse(SubjectKind::Library, request))
    }

    /// Draws an evolution run; its best robots, if this is a picture of several robots.
    fn of_run(&self, results: &EvolutionResults, request: &DrawRequest) -> Result<Drawing, Failure> {
        match self.subject() {
            SubjectKind::Library => self.of_library(&best_champions(results), request),
            _ => Err(self.refuse(SubjectKind::Run, request)),
        }
    }

    /// Draws the circuit of a source file, or its swarm.
    fn of_program(&self, request: &DrawRequest) -> Result<Drawing, Failure> {
        Err(self.refuse(SubjectKind::Program, request))
    }

    /// The error for a subject that has no such picture.
    fn refuse(&self, given: SubjectKind, request: &DrawRequest) -> Failure {
        let (what, kind) = (request.what.clone(), self.word());
        DrawError::Kind { what, given: noun(given), expected: wanted(self.subject(), given), kind }.into()
    }
}

fn noun(subject: SubjectKind) -> &'static str {
    match subject {
        SubjectKind::Library => "a library",
        SubjectKind::Program => "a source file",
        SubjectKind::Robot => "a robot",
        SubjectKind::Run => "a run",
    }
}

/// The subject to name instead of the given one.
fn wanted(subject: SubjectKind, given: SubjectKind) -> &'static str {
    match (subject, given) {
        (SubjectKind::Run, _) => "the folder of a run",
        (SubjectKind::Program, _) => "a source file (.nb)",
        (SubjectKind::Library, _) => "a library",
        (SubjectKind::Robot, SubjectKind::Library) => "one robot, or one `--behavior` of it,",
        (SubjectKind::Robot, SubjectKind::Run) => "one `--behavior` of it",
        (SubjectKind::Robot, _) => "a robot",
    }
}
