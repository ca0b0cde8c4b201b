//! .bench files.

use nbc_base::diag::counted;

/// A line of .bench that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BenchError {
    /// A file without outputs.
    NoOutput,
    /// A line that is not a statement.
    NotAStatement,
    /// Nothing between two commas.
    UnnamedNet,
    /// A name with a space in it.
    SpaceInName,
    /// A gate that the format does not have, of that many nets.
    UnknownGate { gate: String, nets: usize },
    /// A port of several nets.
    PortNets { word: String, nets: usize },
    /// A gate without a net.
    Unassigned { word: String },
}

impl BenchError {
    /// The message and the label.
    pub(super) fn words(self) -> (String, String) {
        let fixed = |message: &str, label: &str| (message.to_owned(), label.to_owned());
        match self {
            Self::NoOutput => fixed("no `OUTPUT` in this .bench file", "expected `OUTPUT(net)`"),
            Self::NotAStatement => {
                fixed("not a statement of .bench", "expected `INPUT(a)`, `OUTPUT(b)` or `b = NAND(a, c)`")
            }
            Self::UnnamedNet => fixed("net has no name", "expected a name between the commas"),
            Self::SpaceInName => fixed("name contains a space", "expected a comma between names"),
            Self::UnknownGate { gate, nets } => (
                format!(".bench has no gate `{gate}` of {}", counted(nets, "net")),
                "expected AND, NAND, OR, NOR, XOR or XNOR of any nets, NOT, BUFF or DFF of one".to_owned(),
            ),
            Self::PortNets { word, nets } => {
                (format!("`{word}` names {}", counted(nets, "net")), format!("expected `{word}(net)` for each net"))
            }
            Self::Unassigned { word } => {
                (format!("the value of `{word}` is not assigned to a net"), format!("expected `net = {word}(…)`"))
            }
        }
    }
}
