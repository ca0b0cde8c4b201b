//! "Did you mean": the known name nearest to a misspelled one.

/// The nearest of `known`, if it is near enough to be what was meant; the first of equally near ones.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = (word.chars().count() / 3).clamp(1, 3);
    let scored = known.into_iter().filter_map(|name| Some((distance(word, name, limit)?, name)));
    scored.min_by_key(|(distance, _)| *distance).map(|(_, name)| name)
}

/// A help line for an unknown name: the nearest name, or all of them where they are few.
pub fn help<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let known: Vec<_> = known.into_iter().collect();
    if let Some(near) = nearest(word, known.iter().copied()) {
        return Some(format!("did you mean `{near}`?"));
    }
    (1..=8).contains(&known.len()).then(|| format!("known here: {}", alternatives(&known, "and")))
}

/// Words in backticks as a list of the language: "`a`, `b` or `c`".
pub fn alternatives<S: AsRef<str>>(words: &[S], last: &str) -> String {
    let quoted: Vec<_> = words.iter().map(|word| format!("`{}`", word.as_ref())).collect();
    join(&quoted, last)
}

/// Phrases as a list of the language: "a, b or c".
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

/// The number of letters to change, add, drop or exchange, if it is within `limit`.
fn distance(a: &str, b: &str, limit: usize) -> Option<usize> {
    let a: Vec<char> = a.to_lowercase().chars().take(64).collect();
    let b: Vec<char> = b.to_lowercase().chars().take(64).collect();
    if a.len().abs_diff(b.len()) > limit {
        return None;
    }
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            rows[i][j] = edits(&rows, &a, &b, i, j);
        }
    }
    // Where every letter changes, nothing tells that the name was meant.
    Some(rows[a.len()][b.len()]).filter(|&edits| edits <= limit && edits < a.len().max(b.len()))
}

fn edits(rows: &[Vec<usize>], a: &[char], b: &[char], i: usize, j: usize) -> usize {
    if i == 0 || j == 0 {
        return i + j;
    }
    let change = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
    let best = change.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
    let exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
    if exchanged { best.min(rows[i - 2][j - 2] + 1) } else { best }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_meant() {
        assert_eq!(nearest("latc", ["register", "latch"]), Some("latch"));
        assert_eq!(nearest("cicruit", ["circuit", "stimulus"]), Some("circuit"));
        assert_eq!(nearest("q", ["nq", "d"]), Some("nq"));
        assert_eq!(nearest("carry", ["sum", "out"]), None);
        assert_eq!(nearest("c", ["a", "b"]), None);
        assert_eq!(help("carry", ["sum", "out"]).unwrap(), "known here: `sum` and `out`");
    }
}
