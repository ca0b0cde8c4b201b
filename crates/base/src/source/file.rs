//! The files of one compilation.

use super::{FileId, Span};

/// The first byte of each line of a text. `\n`, `\r\n` and `\r` end a line, as in the grammar.
#[derive(Clone, Debug)]
pub struct LineStarts(Vec<u32>);

impl LineStarts {
    pub fn of(text: &str) -> Self {
        let (bytes, mut starts) = (text.as_bytes(), vec![0]);
        for (at, &byte) in bytes.iter().enumerate() {
            if byte == b'\n' || byte == b'\r' && bytes.get(at + 1) != Some(&b'\n') {
                starts.push(at as u32 + 1);
            }
        }
        Self(starts)
    }

    pub fn line(&self, offset: usize) -> usize {
        self.0.partition_point(|&start| start as usize <= offset) - 1
    }

    pub fn start(&self, line: usize) -> Option<usize> {
        self.0.get(line).map(|&start| start as usize)
    }
}

#[derive(Clone, Debug)]
pub struct SourceFile {
    pub id: FileId,
    pub name: String,
    pub text: String,
    lines: LineStarts,
}

/// A place for people; both numbers start at 1, and the column counts characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct LineColumn {
    pub line: usize,
    pub column: usize,
}

impl SourceFile {
    pub fn lines(&self) -> &LineStarts {
        &self.lines
    }

    /// The place of a byte offset; an offset past the end is the end.
    pub fn line_column(&self, offset: usize) -> LineColumn {
        let offset = offset.min(self.text.len());
        let line = self.lines.line(offset);
        let start = self.lines.start(line).expect("the line of a byte exists");
        let column = self.text[start..offset].chars().count() + 1;
        LineColumn { line: line + 1, column }
    }
}

/// All source files of one compilation, numbered in the order in which they were added.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: Vec<SourceFile>,
}

impl Sources {
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) -> FileId {
        let id = self.next();
        let mut text = text.into();
        text.drain(..text.len() - without_mark(&text).len());
        self.files.push(SourceFile { id, name: name.into(), lines: LineStarts::of(&text), text });
        id
    }

    /// The number of the next file.
    pub fn next(&self) -> FileId {
        FileId(u32::try_from(self.files.len()).expect("fewer than 2^32 source files"))
    }

    pub fn file(&self, id: FileId) -> &SourceFile {
        &self.files[id.0 as usize]
    }

    pub fn text(&self, span: Span) -> &str {
        &self.file(span.file).text[span.range()]
    }

    pub fn iter(&self) -> impl Iterator<Item = &SourceFile> {
        self.files.iter()
    }
}
pub fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}
