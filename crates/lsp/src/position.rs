//! Places in text, as the protocol counts them: lines, and code units of UTF-16 or UTF-8 within a line.

use gen_lsp_types::{Position, PositionEncodingKind, Range};

use nbc_base::source::LineStarts;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Encoding {
    Utf8,
    /// Every client knows it.
    #[default]
    Utf16,
}

impl Encoding {
    /// UTF-8 if the client knows it, because it needs no conversion.
    pub(super) fn negotiated(known: &[PositionEncodingKind]) -> Self {
        if known.contains(&PositionEncodingKind::UTF8) { Self::Utf8 } else { Self::Utf16 }
    }

    pub(super) fn kind(self) -> PositionEncodingKind {
        match self {
            Self::Utf8 => PositionEncodingKind::UTF8,
            Self::Utf16 => PositionEncodingKind::UTF16,
        }
    }

    fn units(self, text: &str) -> usize {
        match self {
            Self::Utf8 => text.len(),
            Self::Utf16 => text.chars().map(char::len_utf16).sum(),
        }
    }
}

pub(super) struct Lines<'t> {
    pub(super) text: &'t str,
    pub(super) starts: &'t LineStarts,
    pub(super) encoding: Encoding,
}

impl Lines<'_> {
    /// The byte at a position; past the end of a line, its end.
    pub(super) fn offset(&self, position: Position) -> usize {
        let Some(start) = self.starts.start(position.line as usize) else { return self.text.len() };
        let end = self.starts.start(position.line as usize + 1).unwrap_or(self.text.len());
        let line = self.text[start..end].trim_end_matches(['\n', '\r']);
        let mut left = position.character as usize;
        for (at, character) in line.char_indices() {
            let width = self.encoding.units(character.encode_utf8(&mut [0; 4]));
            if left < width {
                return start + at;
            }
            left -= width;
        }
        start + line.len()
    }

    pub(super) fn position(&self, offset: usize) -> Position {
        let offset = offset.min(self.text.len());
        let line = self.starts.line(offset);
        let start = self.starts.start(line).expect("the line of a byte exists");
        let character = self.encoding.units(&self.text[start..offset]);
        Position { line: line as u32, character: character as u32 }
    }

    pub(super) fn range(&self, bytes: std::ops::Range<usize>) -> Range {
        Range { start: self.position(bytes.start), end: self.position(bytes.end) }
    }

    pub(super) fn bytes(&self, range: Range) -> std::ops::Range<usize> {
        let (start, end) = (self.offset(range.start), self.offset(range.end));
        start.min(end)..end
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "a𝔸é\r\n\rx\n";

    #[test]
    fn every_byte_of_a_character_has_its_position() {
        for (encoding, places) in [(Encoding::Utf16, [0, 1, 3, 4]), (Encoding::Utf8, [0, 1, 5, 7])] {
            let starts = LineStarts::of(TEXT);
            let lines = Lines { text: TEXT, starts: &starts, encoding };
            for (offset, character) in [0, 1, 5, 7].into_iter().zip(places) {
                let position = Position { line: 0, character };
                assert_eq!(lines.position(offset), position);
                assert_eq!(lines.offset(position), offset);
            }
        }
    }

    #[test]
    fn a_position_past_the_end_of_a_line_or_text_is_its_end() {
        let starts = LineStarts::of(TEXT);
        let lines = Lines { text: TEXT, starts: &starts, encoding: Encoding::Utf16 };
        assert_eq!(lines.position(10), Position { line: 2, character: 0 }, "lines end as in the language");
        for (line, character, offset) in [(9, 0, TEXT.len()), (0, 99, 7), (0, 2, 1)] {
            assert_eq!(lines.offset(Position { line, character }), offset, "inside a pair it is its start");
        }
    }
}
