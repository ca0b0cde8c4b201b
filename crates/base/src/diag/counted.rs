//! Counts in messages and reports.

pub fn counted(count: usize, noun: &str) -> String {
    if count == 1 {
        return format!("1 {noun}");
    }
    let ends = |endings: &[&str]| endings.iter().any(|ending| noun.ends_with(ending));
    match noun.strip_suffix('y').filter(|stem| !stem.ends_with(['a', 'e', 'o', 'u'])) {
        Some(stem) => format!("{count} {stem}ies"),
        None if ends(&["ch", "sh", "s", "x"]) => format!("{count} {noun}es"),
        None => format!("{count} {noun}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_singular() {
        assert_eq!([0, 1, 2].map(|count| counted(count, "cycle")), ["0 cycles", "1 cycle", "2 cycles"]);
        for (noun, two) in [("latch", "2 latches"), ("body", "2 bodies"), ("relay", "2 relays"), ("match", "2 matches")]
        {
            assert_eq!(counted(2, noun), two);
        }
    }
}
