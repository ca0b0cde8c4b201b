//! What every kind of picture provides.

use crate::cli::Failure;
use crate::cli::draw::evolution_run::best_champions;
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::titled_body::TitledBody;
use crate::cli::draw::titled_robots::TitledRobots;
use crate::cli::draw::wording::DrawError;
use nbc_base::diag::Diagnostic;
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
    /// A picture of the whole, and a page on which its parts open.
    Sheets {
        top: Svg,
        page: String,
    },
    Film {
        format: FilmFormat,
        film: Box<Film>,
        stage: Box<Stage>,
    },
}

/// A drawing, with a warning of each robot whose simulation failed.
pub(super) struct Drawn {
    pub(super) drawing: Drawing,
    pub(super) faults: Vec<Diagnostic>,
}

impl From<Drawing> for Drawn {
    fn from(drawing: Drawing) -> Self {
        Self { drawing, faults: Vec::new() }
    }
}

/// The formats of films.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FilmFormat {
    Apng,
    Gif,
}

/// The description of a kind of picture.
pub(super) struct KindDescription {
    /// The word for it on the command line.
    pub(super) word: &'static str,
    /// A line about it in the help.
    pub(super) about: &'static str,
    /// The extensions of its files.
    pub(super) extensions: &'static [&'static str],
    /// The options that change the picture, of those that not every kind has.
    pub(super) options: &'static [&'static str],
    /// The kind of subject that it is for: the one to name if another is given. A kind for libraries also shows the
    /// best robots of a run.
    pub(super) subject: SubjectKind,
}

impl KindDescription {
    /// A kind of picture as SVG or PNG without options.
    pub(super) fn new(word: &'static str, about: &'static str, subject: SubjectKind) -> Self {
        Self { word, about, extensions: &["svg", "png"], options: &[], subject }
    }
}

/// A kind of picture. What it cannot show is refused, with the kind of subject that it is for.
pub(super) trait PictureKind: Sync {
    /// Its name and what it applies to.
    fn description(&self) -> KindDescription;

    /// Draws one robot.
    fn of_robot(&self, _robot: &TitledBody, request: &DrawRequest) -> Result<Drawn, Failure> {
        Err(self.refuse(SubjectKind::Robot, request))
    }

    /// Draws the robots of a library.
    fn of_library(&self, _robots: &TitledRobots, request: &DrawRequest) -> Result<Drawn, Failure> {
        Err(self.refuse(SubjectKind::Library, request))
    }

    /// Draws an evolution run; its best robots, if this is a picture of several robots.
    fn of_run(&self, results: &EvolutionResults, request: &DrawRequest) -> Result<Drawn, Failure> {
        match self.description().subject {
            SubjectKind::Library => self.of_library(&best_champions(results), request),
            _ => Err(self.refuse(SubjectKind::Run, request)),
        }
    }

    /// Draws the circuit of a source file, or its swarm.
    fn of_program(&self, request: &DrawRequest) -> Result<Drawn, Failure> {
        Err(self.refuse(SubjectKind::Program, request))
    }

    /// The error for a subject that has no such picture.
    fn refuse(&self, given: SubjectKind, request: &DrawRequest) -> Failure {
        let KindDescription { word: kind, subject, .. } = self.description();
        let what = request.what.clone();
        DrawError::Kind { what, given: noun(given), expected: wanted(subject, given), kind }.into()
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
