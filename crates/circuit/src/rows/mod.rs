//! Rows of values from files: examples of what a circuit does, as CSV or PLA.

mod binding;
mod csv;
mod ports;
mod table;
mod wording;

pub use binding::PortRow;
pub use ports::RowPorts;

use crate::formats::pla;
use nbc_base::diag::Diagnostic;
use nbc_base::source::{FileId, SourceFile, Span};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowFormat {
    Csv,
    Pla,
}

impl RowFormat {
    pub fn of_path(path: &str) -> Option<Self> {
        let (_, ending) = path.rsplit_once('.')?;
        match ending.to_ascii_lowercase().as_str() {
            "csv" => Some(Self::Csv),
            "pla" => Some(Self::Pla),
            _ => None,
        }
    }

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

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowColumn {
    pub name: String,
    pub width: usize,
    /// Whether it is an output, if the format says so.
    pub is_output: Option<bool>,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileRow {
    /// The bits of the columns in order, the most significant of a column first; `None` is any.
    pub bits: Vec<Option<bool>>,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowFile {
    pub columns: Vec<RowColumn>,
    pub rows: Vec<FileRow>,
}

impl RowFile {
    /// For each column, the place of its first bit in a row.
    pub fn starts(&self) -> Vec<usize> {
        let start = |next: &mut usize, column: &RowColumn| {
            *next += column.width;
            Some(*next - column.width)
        };
        self.columns.iter().scan(0, start).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::RowFormat::{Csv, Pla};
    use super::*;
    use nbc_base::budget::Limit;

    fn check(format: RowFormat, text: &str, expected: Result<&[&str], &str>) {
        let shown = format.parse(text, FileId(0)).map(|file| {
            let digit = |bit: &Option<bool>| bit.map_or('-', |bit| if bit { '1' } else { '0' });
            file.rows.iter().map(|row| row.bits.iter().map(digit).collect()).collect::<Vec<String>>()
        });
        let shown = shown.map_err(|faults| faults[0].message.clone());
        assert_eq!(shown, expected.map(|rows| rows.iter().map(|&row| row.to_owned()).collect()).map_err(str::to_owned));
    }

    #[test]
    fn cells_are_numbers_and_columns_as_wide_as_these_need() {
        check(Csv, "a,b,c\n1,5,0x0f\n0,-,\n", Ok(&["110100001111", "0-----------"]));
        check(Csv, "# comment\n\"a\" , b\r\n 2,\"1\"\r\n\r\n1,0 # one\n", Ok(&["101", "010"]));
    }

    #[test]
    fn other_csv_is_refused() {
        check(Csv, "", Err("file has no columns"));
        check(Csv, "a,b\n", Err("file has no rows"));
        check(Csv, "0,1\n1,1\n", Err("file has no names of columns"));
        check(Csv, "a,,b\n0,0,0\n", Err("column has no name"));
        check(Csv, "a,b,a\n0,0,0\n", Err("column `a` is there twice"));
        check(Csv, "a,b\n0,1,1\n", Err("row has 3 values for 2 columns"));
        check(Csv, "a,b\n0,-1\n", Err("`-1` is not a value of `b`"));
        check(Csv, "a,b\n0,1.5\n", Err("`1.5` is not a value of `b`"));
        check(Csv, "a,b\n0,0x\n", Err("`0x` is not a value of `b`"));
        let long = |digits: usize| format!("a,q\n0x{},1\n0,0\n", "f".repeat(digits));
        let most = Limit::Width.most() as usize / 4;
        let widest = Csv.parse(&long(most), FileId(0));
        assert_eq!(widest.map(|file| file.columns[0].width), Ok(4 * most));
        check(Csv, &long(most + 1), Err("value of `a` has 1048580 bits"));
        let widest = format!("0x{}", "f".repeat(most));
        let many = format!("a,b,c,q\n{widest},{widest},{widest},1\n{}", "0,0,0,1\n".repeat(30));
        check(Csv, &many, Err("the rows of the file have more than 67108864 bits"));
    }

    #[test]
    fn rows_are_listed_or_those_of_the_whole_table() {
        check(Pla, ".i 2\n.o 1\n.type fr\n1- 1\n00 0\n", Ok(&["101", "111", "000"]));
        check(Pla, ".i 2\n.o 2\n.type fdr\n11 -0\n01 ~1\n", Ok(&["11-0", "01-1"]));
        check(Pla, ".i 2\n.o 1\n-1 -\n11 1\n", Ok(&["000", "01-", "100", "111"]));
        check(Pla, ".i 1\n.o 2\n.type f\n1 10\n", Ok(&["000", "110"]));
    }

    #[test]
    fn other_tables_are_refused() {
        check(Pla, ".i 17\n.o 1\n", Err("a PLA of this type describes all rows of 17 inputs"));
        let open = format!(".i 17\n.o 1\n.type fr\n{} 1\n", "-".repeat(17));
        check(Pla, &open, Err("row leaves 17 inputs open"));
        let many = format!(".i 16\n.o 1\n.type fr\n{}", format!("{} 1\n", "-".repeat(16)).repeat(20));
        check(Pla, &many, Err("file has more than 200000 rows"));
        check(Pla, ".i 1\n.o 1\n.type fr\n", Err("file has no rows"));
        check(Pla, ".i 2\n.o 1\n.ilb a a\n.ob q\n11 1\n", Err("column `a` is there twice"));
    }
}
