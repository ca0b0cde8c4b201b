//! The codes of diagnostics: one for each rule, each with a page under `docs/errors/`.

use std::fmt;

use serde::{Serialize, Serializer};

use super::Severity;

/// Declares the codes, each with a name, a word, a severity and a description, in alphabetical order of the words.
macro_rules! codes {
    ($($name:ident = $word:literal, $severity:ident: $meaning:literal;)*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "String", inline))]
        pub enum Code {
            $($name,)*
        }

        impl Code {
            pub const ALL: &[Self] = &[$(Self::$name,)*];

            /// The code as users write it, for `nbc explain`.
            pub fn word(self) -> &'static str {
                match self {
                    $(Self::$name => $word,)*
                }
            }

            /// The severity of its diagnostics: whether the input is refused.
            pub fn severity(self) -> Severity {
                match self {
                    $(Self::$name => Severity::$severity,)*
                }
            }

            pub fn meaning(self) -> &'static str {
                match self {
                    $(Self::$name => $meaning,)*
                }
            }
        }
    };
}

codes! {
    AllInputs = "all-inputs", Warning: "A test over all inputs of a circuit that has memory.";
    Ambiguous = "ambiguous", Error: "Operators side by side that can be read in two ways.";
    BadSchedule = "bad-schedule", Error: "A schedule on the command line that cannot be read.";
    BadValue = "bad-value", Error: "An option with an invalid value.";
    Checkpoint = "checkpoint", Error: "A checkpoint that is damaged, or belongs to another run.";
    CircuitFile = "circuit-file", Error: "A circuit file (BLIF, PLA, AIGER, .bench, Verilog) with an error.";
    CircularUse = "circular-use", Error: "Files that use each other in a circle.";
    Duplicate = "duplicate", Error: "A name that is declared twice.";
    Empty = "empty", Error: "A file, test or schedule without content.";
    Fault = "fault", Warning: "A robot whose simulation failed.";
    ForeignFormat = "foreign-format", Error: "A file of another version of the program.";
    GroundEnds = "ground-ends", Warning: "A robot that walks off the end of its ground.";
    HoldTooShort = "hold-too-short", Warning: "Inputs held for less time than the robots need to settle.";
    IncompleteLibrary = "incomplete-library", Error: "A cell library with too few functions.";
    IndexOutside = "index-outside", Warning: "A value that can select a word or a bit that does not exist.";
    LoopWithoutStart = "loop-without-start", Warning: "A feedback loop without a start value.";
    MissingField = "missing-field", Error: "A declaration without a required field.";
    MultipleDrivers = "multiple-drivers", Error: "A net driven more than once.";
    Nesting = "nesting", Error: "Text that is nested too deeply.";
    NoEffect = "no-effect", Error: "A field that nothing uses.";
    NoSteps = "no-steps", Error: "A circuit without steps, of which nothing can be proved.";
    NoWaves = "no-waves", Error: "A circuit or a row of a test that no wave machine can run.";
    Operands = "operands", Error: "A circuit or an operator with too many or too few operands.";
    OutOfRange = "out-of-range", Error: "A number out of range.";
    Property = "property", Error: "A property whose words do not go together.";
    Recursion = "recursion", Error: "A circuit that contains itself, or a declaration that uses its own fields.";
    RobotFile = "robot-file", Error: "A robot file with an error.";
    RowWidth = "row-width", Error: "A row with more or fewer values than its table has columns.";
    SameTitle = "same-title", Warning: "Two tests of a circuit that have the same title.";
    StartValue = "start-value", Error: "A start value of a net whose driver has a start value of its own.";
    Syntax = "syntax", Error: "Text that does not follow the grammar.";
    TableIncomplete = "table-incomplete", Error: "A truth table without a row for some pattern.";
    TableOverlap = "table-overlap", Error: "A truth table with two rows for one pattern.";
    TooLarge = "too-large", Error: "A circuit, a table or a program above a limit.";
    Undriven = "undriven", Error: "A net without a driver.";
    Unit = "unit", Error: "A quantity with a wrong unit, or without a unit.";
    Unknown = "unknown", Error: "A name that is not declared.";
    UnknownField = "unknown-field", Error: "A field that the declaration does not have.";
    UnknownRobot = "unknown-robot", Error: "A robot that the library does not have.";
    UnknownWidth = "unknown-width", Error: "A net, constant or parameter of unknown width.";
    Unreadable = "unreadable", Error: "A file that cannot be read.";
    Unused = "unused", Warning: "An input, a net or a stimulus that is never used.";
    Unwritable = "unwritable", Error: "A file or folder that cannot be written.";
    Value = "value", Error: "A value of the wrong kind.";
    WeakRobot = "weak-robot", Warning: "A circuit that uses a robot that makes errors or hardly moves.";
    Width = "width", Error: "Two different widths where they must be equal.";
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.word())
    }
}

impl Serialize for Code {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_codes_are_in_alphabetical_order() {
        assert!(Code::ALL.is_sorted_by_key(|code| code.word()));
    }
}
