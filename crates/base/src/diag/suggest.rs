//! "Did you mean": the known name most similar to a misspelled one.

/// The most errors with a suggestion, because each suggestion compares all names.
pub const MOST: usize = 100;

const LETTERS: usize = 64;

/// The most similar of `known`, if it is similar enough; of equally similar ones, the first.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = (word.chars().count() / 3).clamp(1, 3);
    let mut measure = Measure { word: letters(word).collect(), limit, name: Vec::new(), rows: Default::default() };
    let scored = known.into_iter().filter_map(|name| Some((measure.distance(name)?, name)));
    scored.min_by_key(|(distance, _)| *distance).map(|(_, name)| name)
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Suggestion {
    #[default]
    None,
    Near(String),
    /// One of these; all known names, if they are few.
    Known(Vec<String>),
}

impl Suggestion {
    pub fn of<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        let known: Vec<_> = known.into_iter().collect();
        match nearest(word, known.iter().copied()) {
            Some(near) => Self::Near(near.to_owned()),
            None if (1..=8).contains(&known.len()) => Self::Known(known.into_iter().map(str::to_owned).collect()),
            None => Self::None,
        }
    }

    pub fn near<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        nearest(word, known).map_or(Self::None, |near| Self::Near(near.to_owned()))
    }
}

/// Words in backticks as a list: "`a`, `b` or `c`".
pub fn alternatives<S: AsRef<str>>(words: &[S], last: &str) -> String {
    let quoted: Vec<_> = words.iter().map(|word| format!("`{}`", word.as_ref())).collect();
    join(&quoted, last)
}

pub fn join<S: AsRef<str>>(phrases: &[S], last: &str) -> String {
    match phrases {
        [] => String::new(),
        [only] => only.as_ref().to_owned(),
        [first @ .., end] => {
            let first: Vec<_> = first.iter().map(AsRef::as_ref).collect();
            format!("{} {last} {}", first.join(", "), end.as_ref())
        }
    }
}

fn letters(text: &str) -> impl Iterator<Item = char> {
    text.chars().flat_map(char::to_lowercase).take(LETTERS)
}

/// Unlike `strsim` it stops at the limit, because a misspelled word is compared with every name of a program.
struct Measure {
    word: Vec<char>,
    limit: usize,
    name: Vec<char>,
    /// Edit distances from prefixes of the word (this one, and one and two letters shorter) to those of the name.
    rows: [Vec<usize>; 3],
}

impl Measure {
    /// The number of letters to change, add, drop or exchange, if it is within the limit.
    fn distance(&mut self, name: &str) -> Option<usize> {
        if name.is_ascii() && name.len().min(LETTERS).abs_diff(self.word.len()) > self.limit {
            return None;
        }
        self.name.clear();
        self.name.extend(letters(name));
        self.rows[0] = (0..=self.name.len()).collect();
        for i in 1..=self.word.len() {
            self.advance(i);
            // An exchange covers two letters, so one row may be skipped.
            let out = |row: &[usize], limit| row.iter().all(|&edits| edits > limit);
            if out(&self.rows[0], self.limit) && out(&self.rows[1], self.limit - 1) {
                return None;
            }
        }
        // If every letter changes, the words are unrelated.
        let edits = self.rows[0][self.name.len()];
        (edits <= self.limit && edits < self.word.len().max(self.name.len())).then_some(edits)
    }

    fn advance(&mut self, i: usize) {
        self.rows.rotate_right(1);
        let [row, last, last_but_one] = &mut self.rows;
        row.clear();
        row.push(i);
        for (j, &letter) in (1..).zip(&self.name) {
            let change = last[j - 1] + usize::from(self.word[i - 1] != letter);
            let best = change.min(last[j] + 1).min(row[j - 1] + 1);
            let exchanged = i > 1 && j > 1 && self.word[i - 1] == self.name[j - 2] && self.word[i - 2] == letter;
            row.push(if exchanged { best.min(last_but_one[j - 2] + 1) } else { best });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_similar_name_is_suggested() {
        assert_eq!(nearest("latc", ["register", "latch"]), Some("latch"));
        assert_eq!(nearest("cicruit", ["circuit", "stimulus"]), Some("circuit"));
        assert_eq!(nearest("q", ["nq", "d"]), Some("nq"));
        assert_eq!(nearest("Stmiulus", ["simulate", "stimulus"]), Some("stimulus"));
        assert_eq!(nearest("register", ["regester2x", "registers", "regis"]), Some("registers"));
        assert_eq!(nearest("carry", ["sum", "out"]), None);
        assert_eq!(nearest("c", ["a", "b"]), None);
        assert_eq!(Suggestion::of("outt", ["sum", "out"]), Suggestion::Near("out".to_owned()));
        assert_eq!(
            Suggestion::of("carry", ["sum", "out"]),
            Suggestion::Known(vec!["sum".to_owned(), "out".to_owned()])
        );
        assert_eq!(Suggestion::of("carry", []), Suggestion::None);
    }
}
