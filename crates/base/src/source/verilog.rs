//! Verilog through a [`SourceWorld`](super::SourceWorld): what its reader is given, and what it says.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A Verilog file, or one that it reads.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct VerilogFile {
    /// Its path in messages.
    pub path: String,
    pub text: String,
}

/// Verilog files that are read as one design.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct VerilogFiles {
    pub files: Vec<VerilogFile>,
    /// The files that these may include or load into memories, by the paths that they use.
    pub others: BTreeMap<String, VerilogFile>,
}

/// The modules of Verilog files that no other contains.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VerilogModules {
    /// The version of the Yosys that read them, such as `0.70`.
    pub version: String,
    pub modules: Vec<VerilogModule>,
    /// Warnings of the reader.
    pub notes: Vec<VerilogNote>,
}

/// A module as it was read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VerilogModule {
    pub name: String,
    /// A flat model.
    pub blif: String,
    /// Where its nets are declared.
    pub nets: BTreeMap<String, VerilogPlace>,
    /// The ports whose leftmost bit has the lowest number, such as `a` of `input [0:3] a`.
    pub ascending: BTreeSet<String>,
    pub second: SecondReading,
}

/// What a second reader has made of a module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SecondReading {
    /// The same circuit; that is proved.
    Alike,
    /// A circuit that is equal in so many random steps.
    Equal(usize),
    /// Another circuit.
    Different,
    /// One that makes no steps that could be compared.
    NoSteps,
    /// It could not read the module.
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

/// A place in a Verilog file or in one that it includes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilogPlace {
    /// The path of the file, which many places share.
    pub file: Arc<str>,
    /// The line, from 1.
    pub line: usize,
    /// The first column, from 1, and the one after the last; without them the whole line is meant.
    pub columns: Option<[usize; 2]>,
}

/// An error or a warning about Verilog.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VerilogNote {
    pub is_error: bool,
    pub message: String,
    /// What is said of the place.
    pub label: String,
    pub place: Option<VerilogPlace>,
    pub help: Option<String>,
}

/// The reason why Verilog could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum VerilogError {
    /// This world runs no other programs.
    NoReader,
    /// The reader is not installed.
    NotInstalled,
    /// Nobody waits for it any more.
    Cancelled,
    /// There is no temporary folder to work in; the operating system's message.
    NoFolder(String),
    /// A module that the files do not have.
    NoModule { module: String, known: Vec<String> },
    /// A parameter that the top module does not have.
    NoParameter { parameter: String, known: Vec<String> },
    /// Parameters without the module that they are for.
    SeveralModules { known: Vec<String> },
    /// Faults of the files.
    Faults(Vec<VerilogNote>),
}
