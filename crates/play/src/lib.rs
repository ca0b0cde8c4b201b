//! The live page, without sockets, threads, clocks and disk: a [`Visit`] takes the requests of a page and the time, and
//! sends answers, events and frames to its [`Line`] (docs/play-protocol.md). A shell, such as a server, turns sockets
//! and clocks into these calls, and chooses where long work runs ([`Shell`]).

mod bodies;
mod class;
mod crew_part;
mod evolving;
mod frame;
mod history;
mod jobs;
mod lesson_texts;
mod lessons;
mod live_page;
mod local;
mod local_crew;
mod lock;
mod message;
mod outbox;
mod page_files;
mod programs;
mod recorded_page;
mod refusal;
mod request;
mod runner;
mod script;
mod shared_cycle;
mod shell;
mod site;
mod state;
mod taking;
mod text_checker;
#[cfg(test)]
mod typescript;
mod visit;
mod wording;

pub use class::Class;
pub use crew_part::{CrewPart, CrewResult, GivenParts};
pub use lesson_texts::{LessonFiles, LessonTexts};
pub use lessons::{course, faults_of_lesson, faults_of_lessons};
pub use live_page::{live_page, live_template};
pub use local::{KeptFile, LocalLine, LocalShell, MemoryFolder, PageMessage};
pub use local_crew::LocalCrew;
pub use message::{ClassCourse, ClassRoll};
pub use outbox::Line;
pub use page_files::beside_example;
pub use recorded_page::{ExportedPage, recorded_page, recorded_runs};
pub use shell::{CancelSource, Crew, PageFolder, Portion, Portions, Shell, WorkKind};
pub use site::{PUBLIC_PAGE, PlaySite};
pub use visit::Visit;
