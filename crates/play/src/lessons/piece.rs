//! A part of a lesson's text that knows its place.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Piece<'a> {
    pub(super) text: &'a str,
    pub(super) at: usize,
}

impl<'a> Piece<'a> {
    pub(super) fn trim(self) -> Self {
        let start = self.text.len() - self.text.trim_start().len();
        Self { text: self.text.trim(), at: self.at + start }
    }

    pub(super) fn after(self, prefix: &str) -> Option<Self> {
        let text = self.text.strip_prefix(prefix)?;
        Some(Self { text, at: self.at + prefix.len() })
    }

    pub(super) fn split_once(self, separator: char) -> Option<(Self, Self)> {
        let (before, after) = self.text.split_once(separator)?;
        let at = self.at + before.len() + separator.len_utf8();
        Some((Self { text: before, at: self.at }, Self { text: after, at }))
    }

    pub(super) fn split(self, is_separator: impl Fn(char) -> bool) -> Vec<Self> {
        let mut parts = Vec::new();
        let mut start = 0;
        for (at, letter) in self.text.char_indices().filter(|&(_, letter)| is_separator(letter)) {
            parts.push(Self { text: &self.text[start..at], at: self.at + start });
            start = at + letter.len_utf8();
        }
        parts.push(Self { text: &self.text[start..], at: self.at + start });
        parts
    }

    pub(super) fn words(self) -> Vec<Self> {
        self.split(char::is_whitespace).into_iter().filter(|part| !part.text.is_empty()).collect()
    }
}

pub(super) fn lines(text: &str) -> Vec<Piece<'_>> {
    let whole = Piece { text, at: 0 };
    whole
        .split(|letter| letter == '\n')
        .into_iter()
        .map(|line| Piece { text: line.text.strip_suffix('\r').unwrap_or(line.text), at: line.at })
        .collect()
}
