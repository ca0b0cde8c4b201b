//! The requests of a page; docs/play-protocol.md describes them.

use serde::Deserialize;

use crate::message::ClassPlace;
use crate::runner::{Change, bits_of};
use nbc_swarm::Level;

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct Request {
    pub(super) id: u64,
    #[serde(flatten)]
    pub(super) verb: Verb,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(tag = "do", rename_all = "lowercase")]
pub(super) enum Verb {
    Hello,
    Lessons,
    Files,
    Read {
        path: Option<String>,
        example: Option<String>,
    },
    Save {
        path: String,
        text: String,
        stamp: Option<String>,
    },
    Program {
        path: String,
        text: String,
    },
    Compile {
        path: String,
        circuit: String,
        swarm: Option<String>,
    },
    Test {
        path: String,
        test: ChosenTest,
        level: Level,
    },
    Prove {
        path: String,
        claim: usize,
    },
    Replay {
        path: String,
        test: ChosenTest,
        swarm: Option<String>,
        world: Option<String>,
        row: usize,
    },
    Inputs {
        bits: String,
    },
    Clock {
        bit: usize,
        half: Option<u32>,
    },
    Settle {
        rows: Vec<String>,
    },
    Run {
        speed: Option<f64>,
    },
    Pause,
    Step {
        cycles: u32,
    },
    Reset,
    Seek {
        cycle: u32,
    },
    View {
        robots: Vec<usize>,
    },
    Robots {
        path: Option<String>,
    },
    Probe {
        body: Vec<String>,
        cycles: u32,
        character: Option<bool>,
    },
    Keep(KeepRequest),
    Evolve(EvolveRequest),
    Take {
        what: TakeKind,
        cycles: u32,
    },
    Export {
        path: String,
        circuit: String,
        swarm: Option<String>,
        /// Whether the page gets the whole program, or else a recording.
        live: bool,
    },
    Join {
        name: String,
        // The key of the name, if this browser has had it before.
        key: Option<String>,
    },
    Progress {
        place: Option<ClassPlace>,
        finished: u32,
    },
    Leave,
    Cancel {
        of: u64,
    },
}

/// A test by its number in the program, or the text of one that is not in it, such as one that refutes a property.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(untagged)]
pub(super) enum ChosenTest {
    Declared(usize),
    Shown(String),
}

impl ChosenTest {
    /// The number of a declared test, or the text of another one, which is then the last test of the program.
    pub(super) fn parts(self) -> (Option<usize>, Option<String>) {
        match self {
            Self::Declared(test) => (Some(test), None),
            Self::Shown(text) => (None, Some(text)),
        }
    }
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct KeepRequest {
    /// The program that is to use it. Its robots are beside it.
    pub(super) path: Option<String>,
    pub(super) name: String,
    pub(super) body: Vec<String>,
    pub(super) replace: Option<bool>,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct EvolveRequest {
    /// The body to start from, if it is not a random one.
    pub(super) body: Option<Vec<String>>,
    /// Columns and rows.
    #[serde(rename = "box")]
    pub(super) bounds: [usize; 2],
    pub(super) generations: u32,
    pub(super) seed: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub(super) enum TakeKind {
    Page,
    Gif,
    Png,
    Svg,
    Vcd,
    Csv,
}

impl Verb {
    pub(super) fn change(self) -> Result<Change, Self> {
        Ok(match self {
            Self::Inputs { bits } => Change::Inputs(bits_of(&bits)),
            Self::Clock { bit, half } => Change::Clock { bit, half },
            Self::Run { speed } => Change::Run { speed },
            Self::Pause => Change::Pause,
            Self::Step { cycles } => Change::Step { cycles },
            Self::Reset => Change::Reset,
            Self::Seek { cycle } => Change::Seek { cycle },
            Self::View { robots } => Change::View { robots },
            other => return Err(other),
        })
    }
}
