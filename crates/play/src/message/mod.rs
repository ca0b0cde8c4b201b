//! What the server sends a page as text: answers, progress and events. `web/src/protocol.ts` is made from these types
//! and from those of the requests (`typescript.rs`); docs/play-protocol.md describes them.

mod bodies;
mod claim;
mod class;
mod evolution;
mod export;
mod files;
pub(super) mod finding;
mod lesson;
mod program;
mod swarm;
mod test_result;
mod written;

use serde::Serialize;
#[cfg(test)]
use ts_rs::TS;

pub(super) use bodies::{
    CharacterSketch, EncodedGait, KeptRobot, PaletteEntry, ProbeReport, RobotCard, RobotCards, looks,
};
pub(super) use claim::{ClaimAnswer, ClaimEntry};
pub(super) use class::ClassName;
pub use class::{ClassCourse, ClassLesson, ClassMember, ClassPlace, ClassRoll};
pub(super) use evolution::{ArchiveChange, AxisEntry, EvolutionEnd, NicheEntry};
pub(super) use export::{ExportedRobot, ExportedRow, ExportedStride, ExportedSwarm, ExportedTest, ExportedWalk};
pub(super) use files::{ExampleEntry, FileChange, FileEntry, FileStamp, FileText, Greeting, PlayLimits, TakenFile};
pub(super) use lesson::{
    LessonCheck, LessonComparison, LessonCount, LessonEntry, LessonGoal, LessonList, LessonMeasure, LessonStep,
    LessonTab, PortValues,
};
pub(super) use program::{CircuitEntry, PortEntry, ProgramReport, TestEntry, TestRowEntry};
pub(super) use swarm::{
    BitSource, ListingRow, ShownClock, ShownEnvironment, ShownListing, ShownMemory, ShownRegister, ShownScript,
    ShownSwarm, ShownWaves, SwarmAnswer, SwarmRobot, WaveBit, WaveRegister,
};
pub(super) use test_result::{TestAnswer, TestResult, listed};
pub(super) use written::{CALLS, WrittenProgram};

use crate::refusal::Refusal;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
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
    Event(PlayEvent),
}

#[derive(Clone, Copy, Debug, Default, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(super) struct Nothing {}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
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
    Test(TestAnswer),
    Prove(ClaimAnswer),
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
#[cfg_attr(test, derive(TS))]
#[serde(tag = "event", rename_all = "lowercase")]
pub(super) enum PlayEvent {
    Archive(ArchiveChange),
    Changed(FileChange),
    /// The swarm cannot go on.
    Stopped {
        reason: String,
    },
}
