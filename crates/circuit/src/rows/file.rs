//! The rows of a file, as they are written.

use nbc_base::source::Span;

/// A column of a file: a port, or a bit of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowColumn {
    /// The name, such as `a` or `a[3]`.
    pub name: String,
    /// The bits that its values need.
    pub width: usize,
    /// Whether it is an output, if the format says so.
    pub is_output: Option<bool>,
    /// The place of the name.
    pub span: Span,
}

/// A row of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileRow {
    /// The bits of the columns in order, the most significant of a column first; `None` is any.
    pub bits: Vec<Option<bool>>,
    /// The place of the row.
    pub span: Span,
}

/// The rows of a file, with their columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowFile {
    /// The columns from left to right.
    pub columns: Vec<RowColumn>,
    /// The rows in order.
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
