//! Verilog through a [`SourceWorld`](super::SourceWorld): what its translator gives, and why there may be none.

use super::FileError;

/// The modules of a Verilog file as BLIF.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilogModules {
    /// A flat model for each module.
    pub blif: String,
    /// The names of the modules that no other module of the file contains, in order.
    pub tops: Vec<String>,
}

/// A line of a Verilog file or of a file that it includes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilogPlace {
    /// The path of the file.
    pub file: String,
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
    /// A register with an asynchronous set or reset.
    Asynchronous {
        /// Its place, if Yosys names it.
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
    /// Yosys rejected the text.
    Rejected {
        /// The message of Yosys.
        reason: String,
        /// The place, if Yosys names one.
        place: Option<VerilogPlace>,
    },
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
    /// Macros and included files that become too much text.
    TooMuch {
        /// The limit, in megabytes.
        megabytes: usize,
    },
}
