//! Verilog through a [`SourceWorld`](super::SourceWorld): what its reader is given, and what it says.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct VerilogFile {
    pub path: String,
    pub text: String,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct VerilogFiles {
    pub files: Vec<VerilogFile>,
    /// The files that these may include or load into memories, by the paths that they use.
    pub others: BTreeMap<String, VerilogFile>,
}

/// The modules of Verilog files that no other contains.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VerilogModules {
    pub version: String,
    pub modules: Vec<VerilogModule>,
    pub notes: Vec<VerilogNote>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VerilogModule {
    pub name: String,
    pub blif: String,
    pub nets: BTreeMap<String, VerilogPlace>,
    /// The ports whose leftmost bit has the lowest number, such as `a` of `input [0:3] a`.
    pub ascending: BTreeSet<String>,
    pub second: SecondReading,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SecondReading {
    Alike,
    /// A circuit that is equal in so many random steps.
    Equal(usize),
    Different,
    NoSteps,
    #[default]
    None,
}

impl VerilogModule {
    /// The place of the statement of the BLIF text at these bytes: that of a net in it.
    pub fn place(&self, at: usize) -> Option<&VerilogPlace> {
        let start = self.blif[..at].rfind('\n').map_or(0, |end| end + 1);
        let words: Vec<&str> = self.blif[start..].lines().next()?.split_whitespace().collect();
        // What a statement defines comes first: the last net of `.names`, the second one of `.latch`.
        let defined = if words[0] == ".latch" { words.get(2) } else { words.last() };
        let nets =
            defined.into_iter().chain(&words[1..]).map(|word| word.split_once('=').map_or(*word, |(_, net)| net));
        let whole = |net: &'_ str| self.nets.get(net.strip_suffix(']')?.rsplit_once('[')?.0);
        nets.filter_map(|net| self.nets.get(net).or_else(|| whole(net))).next()
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilogPlace {
    pub file: Arc<str>,
    /// The line, from 1.
    pub line: usize,
    /// The first column, from 1, and the one after the last; without them the whole line is meant.
    pub columns: Option<[usize; 2]>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VerilogNote {
    pub is_error: bool,
    pub message: String,
    pub label: String,
    pub place: Option<VerilogPlace>,
    pub help: Option<String>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum VerilogError {
    NoReader,
    NotInstalled,
    Cancelled,
    NoFolder(String),
    NoModule { module: String, known: Vec<String> },
    NoParameter { parameter: String, known: Vec<String> },
    SeveralModules { known: Vec<String> },
    Faults(Vec<VerilogNote>),
}
