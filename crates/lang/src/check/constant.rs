//! The digits of constants such as `4'b1010`.

use std::num::IntErrorKind;

/// The base for a letter.
pub fn radix(letter: char) -> Option<u32> {
    match letter {
        'b' => Some(2),
        'd' => Some(10),
        'h' => Some(16),
        _ => None,
    }
}

/// The bit that a word of other languages means.
pub fn truth(word: &str) -> Option<bool> {
    match word.to_ascii_lowercase().as_str() {
        "true" | "high" => Some(true),
        "false" | "low" => Some(false),
        _ => None,
    }
}

/// The bits of a word of `0`, `1` and `-` (both), where underscores separate; `None` if it has other characters.
pub(crate) fn pattern(word: &str) -> Option<Vec<Option<bool>>> {
    let bit = |c| match c {
        '0' => Some(Some(false)),
        '1' => Some(Some(true)),
        '-' => Some(None),
        _ => None,
    };
    word.chars().filter(|&c| c != '_').map(bit).collect()
}

/// Whether a word stands for an unknown bit in other languages.
pub(crate) fn is_unknown(word: &str) -> bool {
    matches!(word, "x" | "X" | "z" | "Z")
}

/// The value of digits in a base; underscores separate. A sign is not a digit.
///
/// # Errors
/// When a character is not a digit of the base, or the value needs more than 128 bits.
pub fn value(digits: &str, radix: u32) -> Result<u128, IntErrorKind> {
    let digits: String = digits.chars().filter(|&c| c != '_').collect();
    if digits.starts_with('+') {
        return Err(IntErrorKind::InvalidDigit);
    }
    u128::from_str_radix(&digits, radix).map_err(|error| *error.kind())
}
