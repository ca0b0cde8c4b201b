//! PLA files.

use nbc_base::diag::counted;

/// A line of a PLA that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlaError {
    /// Cubes without `.i` and `.o` before them.
    NoWidths,
    /// A directive without its number.
    Count { directive: String },
    /// A directive that is not supported.
    UnknownDirective { directive: String },
    /// A type that is not supported.
    UnknownType { found: String },
    /// More or fewer names than ports.
    Names { expected: usize, found: usize },
    /// A cube with too many or too few digits.
    CubeWidth { inputs: usize, outputs: usize, found: usize },
    /// A character that is no digit of an input.
    InputDigit { found: char },
    /// A character that is no digit of an output.
    OutputDigit { found: char },
    /// Outputs that are open somewhere.
    Open,
}

impl PlaError {
    /// The message and the label.
    pub(super) fn words(self) -> (String, String) {
        let fixed = |message: &str, label: &str| (message.to_owned(), label.to_owned());
        match self {
            Self::NoWidths => fixed(
                "the numbers of inputs and outputs are missing in this PLA file",
                "expected lines such as `.i 4` and `.o 1` before this",
            ),
            Self::Count { directive } => {
                fixed(&format!("`{directive}` has no number of ports"), "expected a number of at least 1")
            }
            Self::UnknownDirective { directive } => fixed(
                &format!("unknown PLA directive `{directive}`"),
                "expected .i, .o, .ilb, .ob, .p, .type, .e or a row",
            ),
            Self::UnknownType { found } => {
                fixed(&format!("unknown type `{found}` of a PLA"), "expected f, fd, fr or fdr")
            }
            Self::Names { expected, found } => (
                format!("{} for {}", counted(found, "name"), counted(expected, "port")),
                "expected a name for each port".to_owned(),
            ),
            Self::CubeWidth { inputs, outputs, found } => (
                "row has the wrong width".to_owned(),
                format!(
                    "expected {} of inputs and {outputs} of outputs, found {}",
                    counted(inputs, "digit"),
                    counted(found, "digit")
                ),
            ),
            Self::InputDigit { found } => {
                fixed(&format!("`{found}` is not a digit of an input"), "expected `0`, `1` or `-`")
            }
            Self::OutputDigit { found } => {
                fixed(&format!("`{found}` is not a digit of an output"), "expected `0`, `1`, `-` or `~`")
            }
            Self::Open => fixed(
                "outputs that this PLA leaves open are 0 in the circuit",
                "`nbc learn` chooses them so that the circuit is small",
            ),
        }
    }
}
