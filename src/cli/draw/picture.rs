//! What every kind of picture provides.

use crate::cli::Failure;
use crate::cli::draw::evolution_run::best_champions;
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::titled::{TitledBody, TitledRobots};
use crate::cli::draw::wording;
use nbc_base::diag::Diagnostic;
use nbc_session::report::{EvolutionResults, Film, Stage, Svg};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SubjectKind {
    Library,
    Program,
    Robot,
    Run,
}

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

pub(super) struct Drawn {
    pub(super) drawing: Drawing,
    pub(super) faults: Vec<Diagnostic>,
}

impl From<Drawing> for Drawn {
    fn from(drawing: Drawing) -> Self {
        Self { drawing, faults: Vec::new() }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FilmFormat {
    Apng,
    Gif,
}

type Draw<S> = fn(&S, &DrawRequest) -> Result<Drawn, Failure>;
type DrawProgram = fn(&DrawRequest) -> Result<Drawn, Failure>;

/// A kind of picture. What it has no function for is refused, with the kind of subject that it is for.
pub(super) struct PictureKind {
    pub(super) word: &'static str,
    pub(super) about: &'static str,
    /// Of its files.
    pub(super) extensions: &'static [&'static str],
    /// Options that change the picture, of those that not every kind has.
    pub(super) options: &'static [&'static str],
    /// The subject to name if another is given. A kind for libraries also shows the best robots of a run.
    pub(super) subject: SubjectKind,
    pub(super) robot: Option<Draw<TitledBody>>,
    pub(super) library: Option<Draw<TitledRobots>>,
    pub(super) run: Option<Draw<EvolutionResults>>,
    pub(super) program: Option<DrawProgram>,
}

impl PictureKind {
    /// A kind of picture as SVG or PNG without options and functions.
    pub(super) const fn new(word: &'static str, about: &'static str, subject: SubjectKind) -> Self {
        let (robot, library, run, program) = (None, None, None, None);
        Self { word, about, extensions: &["svg", "png"], options: &[], subject, robot, library, run, program }
    }

    pub(super) fn of_robot(&self, robot: &TitledBody, request: &DrawRequest) -> Result<Drawn, Failure> {
        self.robot.ok_or_else(|| self.refuse(SubjectKind::Robot, request))?(robot, request)
    }

    pub(super) fn of_library(&self, robots: &TitledRobots, request: &DrawRequest) -> Result<Drawn, Failure> {
        self.library.ok_or_else(|| self.refuse(SubjectKind::Library, request))?(robots, request)
    }

    pub(super) fn of_run(&self, results: &EvolutionResults, request: &DrawRequest) -> Result<Drawn, Failure> {
        match (self.run, self.subject) {
            (Some(draw), _) => draw(results, request),
            (None, SubjectKind::Library) => self.of_library(&best_champions(results), request),
            _ => Err(self.refuse(SubjectKind::Run, request)),
        }
    }

    pub(super) fn of_program(&self, request: &DrawRequest) -> Result<Drawn, Failure> {
        self.program.ok_or_else(|| self.refuse(SubjectKind::Program, request))?(request)
    }

    fn refuse(&self, given: SubjectKind, request: &DrawRequest) -> Failure {
        wording::other_kind(&request.what, noun(given), wanted(self.subject, given), self.word).into()
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
