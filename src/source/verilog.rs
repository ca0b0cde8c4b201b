//! Verilog through a [`SourceWorld`](super::SourceWorld): what its translator gives, and why there may be none.

/// The modules of a Verilog file as BLIF.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilogModules {
    /// A flat model for each module.
    pub blif: String,
    /// The names of the modules that no other module of the file contains, in order.
    pub tops: Vec<String>,
}

/// The reason why Verilog could not be translated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum VerilogError {
    /// This world runs no other programs.
    NoTranslator,
    /// Yosys is not installed.
    NoYosys,
    /// There is no temporary folder to work in; the operating system's message.
    NoFolder(String),
    /// Yosys ended without a result.
    NoResult,
    /// A register with an asynchronous set or reset, at a line of the file.
    Asynchronous {
        /// The line, from 1; `None` in a file that it includes.
        line: Option<usize>,
    },
    /// A word that could lead to other files, in a world that ends at a folder.
    Outside {
        /// The line, from 1.
        line: usize,
        /// The directive, system function or interface.
        word: String,
    },
    /// Yosys rejected the text.
    Rejected {
        /// The message of Yosys.
        reason: String,
        /// The line, from 1, if Yosys names one of the file itself.
        line: Option<usize>,
    },
}
