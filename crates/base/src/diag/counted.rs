//! Counts in messages and reports.

/// A count with its noun: `1 cycle`, `2 cycles`. For nouns whose plural adds an s.
pub fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_singular() {
        assert_eq!([0, 1, 2].map(|count| counted(count, "cycle")), ["0 cycles", "1 cycle", "2 cycles"]);
    }
}
