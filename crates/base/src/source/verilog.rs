//! Verilog through a [`SourceWorld`](super::SourceWorld): what its translator gives, and why there may be none.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::FileError;

/// The name of the text that Yosys reads, in the places that it gives.
pub const VERILOG_SOURCE: &str = "source.v";

/// The modules of a Verilog file as BLIF.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VerilogModules {
    /// The version of the Yosys that translated them, such as `0.23`.
    pub yosys: String,
    /// A flat model for each module.
    pub blif: String,
    /// The names of the modules that no other module of the file contains, in order.
    pub tops: Vec<String>,
    /// The wires of these modules that are used and that nothing drives. They are 0.
    pub undriven: Vec<VerilogName>,
    /// The modules that were left out, because they have no outputs.
    pub left_out: Vec<VerilogName>,
    /// Hints for synthesizers that a simulator ignores, each kind once.
    pub hints: Vec<VerilogName>,
    /// The lines that declare nets, by module and name.
    pub nets: BTreeMap<(String, String), usize>,
    /// The nets whose leftmost bit has the lowest number, such as `a` of `input [0:3] a`, by module and name.
    pub ascending: BTreeSet<(String, String)>,
    /// The place of each line that Yosys read.
    pub lines: Vec<VerilogPlace>,
    /// What a simulation of each module beside its source has shown.
    pub simulated: BTreeMap<String, Simulated>,
}

/// What a simulation of a translated module beside its source has shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Simulated {
    /// Every output that the source defines was equal in so many steps.
    Equal {
        /// The number of steps.
        steps: usize,
    },
    /// There is no simulator.
    NoSimulator,
    /// The simulator cannot read the source, or took too long.
    NotRun,
    /// The module has feedback, or its registers clock each other, so that the order of events matters.
    NotComparable,
}

impl VerilogModules {
    /// The place of the statement of the BLIF text at these bytes: that of a net in it. `module` is its model.
    pub fn place(&self, module: &str, at: usize) -> Option<&VerilogPlace> {
        let start = self.blif[..at].rfind('\n').map_or(0, |end| end + 1);
        let words: Vec<&str> = self.blif[start..].lines().next()?.split_whitespace().collect();
        // What a statement defines comes first: the last net of `.names`, the second one of `.latch`.
        let defined = if words[0] == ".latch" { words.get(2) } else { words.last() };
        let nets =
            defined.into_iter().chain(&words[1..]).map(|word| word.split_once('=').map_or(*word, |(_, net)| net));
        nets.filter_map(|net| self.line(module, net)).next()
    }

    /// The line of a net: that of its declaration, or one that is part of a name by Yosys, as in `$and$source.v:3$1`.
    fn line(&self, module: &str, net: &str) -> Option<&VerilogPlace> {
        let whole = net.strip_suffix(']').and_then(|net| net.rsplit_once('[')).map_or(net, |(bus, _)| bus);
        let declared = self.nets.get(&(module.to_owned(), whole.to_owned())).copied();
        let named = || verilog_line(net.split_once(VERILOG_SOURCE)?.1);
        self.lines.get(declared.or_else(named)?.checked_sub(1)?)
    }
}

/// The line in a place after the name of its file, such as `:3.2-3.8` or `:3$1_Y`.
pub fn verilog_line(place: &str) -> Option<usize> {
    place.strip_prefix(':')?.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}

/// A name in a Verilog file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilogName {
    /// The name.
    pub name: String,
    /// Its line, if it is known.
    pub place: Option<VerilogPlace>,
}

/// A net with two drivers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilogDrivers {
    /// The net.
    pub net: String,
    /// What drives it, each with its place, if it is known.
    pub drivers: [(String, Option<VerilogPlace>); 2],
    /// The place of its declaration, if it is known.
    pub place: Option<VerilogPlace>,
}

/// A Verilog file that was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VerilogFile<'a> {
    /// Its path.
    pub path: &'a str,
    /// Its text.
    pub text: &'a str,
}

/// A line of a Verilog file or of a file that it includes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilogPlace {
    /// The path of the file, which many places share.
    pub file: Arc<str>,
    /// The line, from 1.
    pub line: usize,
}

/// The reason why Verilog could not be translated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum VerilogError {
    /// This world runs no other programs.
    NoTranslator,
    /// The files are of a workspace that its user does not trust.
    Untrusted,
    /// Yosys is not installed.
    NoYosys,
    /// Nobody waits for the translation any more.
    Cancelled,
    /// There is no temporary folder to work in; the operating system's message.
    NoFolder(String),
    /// Yosys ended without a result.
    NoResult,
    /// Yosys crashed.
    Crashed,
    /// A module without content, so that nothing drives its outputs.
    Empty {
        /// The module.
        module: String,
        /// Its place, if it is known.
        place: Option<VerilogPlace>,
    },
    /// Yosys took too much time.
    TooLong {
        /// The limit, in seconds of a processor.
        seconds: u64,
    },
    /// Yosys needed too much memory.
    TooLarge {
        /// The limit, in megabytes.
        megabytes: u64,
    },
    /// A module that the file does not have.
    NoModule {
        /// The module.
        module: String,
        /// The modules of the file.
        known: Vec<String>,
    },
    /// A parameter that the top module does not have.
    NoParameter {
        /// The parameter.
        parameter: String,
        /// The parameters of the module.
        known: Vec<String>,
    },
    /// Parameters without the module that they are for.
    SeveralModules {
        /// The modules that no other contains.
        known: Vec<String>,
    },
    /// A power whose exponent has too many bits that can change.
    WideExponent {
        /// Its place, if it is known.
        place: Option<VerilogPlace>,
    },
    /// Nets with two drivers.
    DrivenTwice {
        /// The nets.
        nets: Vec<VerilogDrivers>,
    },
    /// A label of a `case` that has an unknown bit, and so never matches.
    UnknownLabel {
        /// The label.
        label: String,
        /// Its place, if it is known.
        place: Option<VerilogPlace>,
    },
    /// A cell of Yosys that is no logic.
    NotLogic {
        /// The kind of the cell.
        cell: String,
        /// Its place, if it is known.
        place: Option<VerilogPlace>,
    },
    /// A word that could lead to other files or programs.
    Outside {
        /// Its place.
        place: VerilogPlace,
        /// The directive, system function or keyword.
        word: String,
    },
    /// An included file that cannot be read.
    Include {
        /// The place of the directive.
        place: VerilogPlace,
        /// The path in the directive.
        path: String,
        /// Why it cannot be read.
        error: FileError,
    },
    /// A net that is not always driven, which a robot cannot be.
    HighImpedance {
        /// Its place.
        place: VerilogPlace,
        /// The keyword or the constant.
        construct: String,
    },
    /// A text that cannot be prepared for Yosys.
    Unclear {
        /// The place of the fault.
        place: VerilogPlace,
        /// The fault.
        fault: VerilogFault,
    },
    /// An output that is another one in a simulation of the source.
    Different(Box<VerilogDifference>),
    /// Yosys rejected the text.
    Rejected {
        /// The message of Yosys.
        reason: String,
        /// The place, if Yosys names one.
        place: Option<VerilogPlace>,
    },
}

/// A step of a simulation in which a translated module differs from its source. Values are bits, the leftmost first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilogDifference {
    /// The module.
    pub module: String,
    /// The step, from 1; 0 is the start.
    pub step: usize,
    /// The output port that differs.
    pub output: String,
    /// Its value in the simulation of the source.
    pub source: String,
    /// Its value in the translation.
    pub translation: String,
    /// The input ports with their values.
    pub inputs: Vec<(String, String)>,
    /// The place of the output's declaration, if it is known.
    pub place: Option<VerilogPlace>,
}

/// A fault that shows before Yosys reads the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum VerilogFault {
    /// A comment without an end.
    OpenComment,
    /// A text in quotes without an end in its line.
    OpenQuote,
    /// A condition without its `` `endif ``.
    OpenCondition,
    /// A part of a condition without its start.
    NoCondition {
        /// The directive.
        word: String,
    },
    /// A character that does not belong there.
    Character {
        /// The character.
        character: char,
    },
    /// A number without digits after its base.
    NoDigits {
        /// The base.
        base: String,
    },
    /// A directive that is not followed by what it needs.
    Directive {
        /// The directive.
        word: String,
        /// What it needs.
        expected: &'static str,
    },
    /// A macro that is not defined, or a directive that is not known.
    Undefined {
        /// The macro.
        word: String,
    },
    /// A macro with another number of arguments than it declares.
    Arguments {
        /// The macro.
        word: String,
        /// The number that it declares.
        expected: usize,
    },
    /// Macros or files that contain each other.
    TooDeep,
    /// An argument of a task that goes in and out.
    InOutArgument,
    /// Too many included files.
    TooManyFiles {
        /// The limit.
        most: u64,
    },
    /// Macros and included files that become too much text.
    TooMuch {
        /// The limit, in megabytes.
        megabytes: u64,
    },
}
