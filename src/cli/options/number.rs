//! Whole numbers as values of options.

/// A whole number that is not negative.
pub(in crate::cli) fn number<T: TryFrom<u64>>(text: &str) -> Result<T, String> {
    let number = text.parse::<u64>().ok().and_then(|number| T::try_from(number).ok());
    number.ok_or_else(|| format!("expected a whole number from 0 to {}", u64::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_digit_of_a_number_counts() {
        assert_eq!(number::<u64>("9007199254740993"), Ok(9_007_199_254_740_993));
        assert_eq!(number::<u64>("18446744073709551615"), Ok(u64::MAX));
        for text in ["-1", "18446744073709551616", "1.0", "1e3", ""] {
            assert_eq!(number::<u64>(text), Err("expected a whole number from 0 to 18446744073709551615".to_owned()));
        }
    }
}
