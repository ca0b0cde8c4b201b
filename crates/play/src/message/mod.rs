//! What the server sends a page as text: answers, progress and events. `web/src/protocol.ts` is made from these types
//! and from those of the requests (`typescript.rs`); docs/play-protocol.md describes them.

mod bodies;
mod files;
mod lesson;
mod program;
mod swarm;
mod written;

use serde::Serialize;

pub(super) use bodies::*;
pub(super) use files::*;
pub use lesson::{ClassCourse, ClassLesson, ClassMember, ClassPlace, ClassRoll};
pub(super) use lesson::{
    ClassName, LessonCheck, LessonComparison, LessonCount, LessonEntry, LessonGoal, LessonList, LessonMeasure,
    LessonStep, LessonTab, PortValues,
};
pub(super) use program::*;
pub(super) use swarm::*;
pub(super) use written::{CALLS, WrittenProgram};

use crate::refusal::Refusal;
use nbc_session::DecidedClaim;
use nbc_swarm::TestVerdict;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(untagged)]
pub(super) enum ServerMessage {
    Result {
        id: u64,
        #[serde(flatten)]
        result: RequestResult,
    },
    Done {
        id: u64,
        ok: Nothing,
    },
    Refused {
        id: u64,
        error: Refusal,
    },
    /// How much of a request is done, and how much there is to do.
    Progress {
        id: u64,
        progress: [u64; 2],
    },
    /// The verdicts of a test over the rows so far.
    Found {
        id: u64,
        found: Vec<TestVerdict>,
    },
    Event(PlayEvent),
}

#[derive(Clone, Copy, Debug, Default, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct Nothing {}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(tag = "to", content = "ok", rename_all = "lowercase")]
pub(super) enum RequestResult {
    Hello(Greeting),
    Lessons(LessonList),
    Files(Vec<FileEntry>),
    Read(FileText),
    Save(FileStamp),
    Program(ProgramReport),
    Compile(SwarmAnswer),
    Replay(SwarmAnswer),
    Settle(SettledOutputs),
    Test(TestAnswer),
    Prove(DecidedClaim),
    Robots(RobotCards),
    Probe(ProbeReport),
    Keep(KeptRobot),
    Evolve(EvolutionEnd),
    Take(TakenFile),
    Export(TakenFile),
    Join(ClassName),
}

/// Events sent without a request.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(tag = "event", rename_all = "lowercase")]
pub(super) enum PlayEvent {
    Archive(ArchiveChange),
    Changed(FileChange),
    /// The swarm cannot go on.
    Stopped {
        reason: String,
    },
}
