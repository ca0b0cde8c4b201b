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
pub fn value(digits: &str, radix: u32) -> Result<u128, IntErrorKind> {
    let digits: String = digits.chars().filter(|&c| c != '_').collect();
    if digits.starts_with('+') {
        return Err(IntErrorKind::InvalidDigit);
    }
    u128::from_str_radix(&digits, radix).map_err(|error| *error.kind())
}

/// The value of a number as it is written, and its width if it has one: `12`, `0x1f`, `4'b0101`.
pub(crate) fn sized(word: &str) -> Option<(Option<u32>, u128)> {
    if let Some((width, constant)) = word.split_once('\'') {
        let width = width.parse::<u32>().ok().filter(|width| (1..=128).contains(width))?;
        let value = value(constant.get(1..)?, radix(constant.chars().next()?)?).ok()?;
        return (width == u128::BITS || value >> width == 0).then_some((Some(width), value));
    }
    unsized_number(word).map(|value| (None, value))
}

/// The value of a number where an integer stands.
pub(crate) fn integer<T: TryFrom<u128>>(word: &str) -> Option<T> {
    T::try_from(unsized_number(word)?).ok()
}

/// The value of a number without a width: `12`, `0x1f`, `0b101`.
pub(crate) fn unsized_number(word: &str) -> Option<u128> {
    let (digits, base) = match word.as_bytes().get(1) {
        Some(b'x' | b'X') => (word.get(2..)?, 16),
        Some(b'b' | b'B') => (word.get(2..)?, 2),
        _ => (word, 10),
    };
    (word.starts_with(|c: char| c.is_ascii_digit())).then(|| value(digits, base).ok()).flatten()
}
