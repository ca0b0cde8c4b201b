//! Rows of values from files: examples of what a circuit does, as CSV or PLA.

mod binding;
mod csv;
mod file;
mod ports;
mod table;
mod wording;

pub use binding::PortRow;
pub use file::{FileRow, RowColumn, RowFile};
pub use ports::RowPorts;

use crate::formats::pla;
use nbc_base::diag::Diagnostic;
use nbc_base::source::{FileId, SourceFile};

/// A format of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowFormat {
    /// Numbers between commas, with the names of the columns in the first line.
    Csv,
    /// The PLA files of espresso.
    Pla,
}

impl RowFormat {
    /// The format for the extension of a path, in any case.
    pub fn of_path(path: &str) -> Option<Self> {
        let (_, ending) = path.rsplit_once('.')?;
        match ending.to_ascii_lowercase().as_str() {
            "csv" => Some(Self::Csv),
            "pla" => Some(Self::Pla),
            _ => None,
        }
    }

    /// The rows of a file.
    pub fn read(self, source: &SourceFile) -> Result<RowFile, Vec<Diagnostic>> {
        self.parse(&source.text, source.id)
    }

    fn parse(self, text: &str, file: FileId) -> Result<RowFile, Vec<Diagnostic>> {
        match self {
            Self::Csv => csv::read(text, file),
            Self::Pla => table::rows(pla::parse(text, file)?),
        }
    }
}
