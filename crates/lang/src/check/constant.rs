//! The digits of constants such as `4'b1010`.

use std::num::IntErrorKind;

pub fn radix(letter: char) -> Option<u32> {
    match letter {
        'b' => Some(2),
        'd' => Some(10),
        'h' => Some(16),
        _ => None,
    }
}

pub fn truth(word: &str) -> Option<bool> {
    match word.to_ascii_lowercase().as_str() {
        "true" | "high" => Some(true),
        "false" | "low" => Some(false),
        _ => None,
    }
}

/// A `-` is both bits, and underscores separate.
pub(crate) fn pattern(word: &str) -> Option<Vec<Option<bool>>> {
    let bit = |c| match c {
        '0' => Some(Some(false)),
        '1' => Some(Some(true)),
        '-' => Some(None),
        _ => None,
    };
    word.chars().filter(|&c| c != '_').map(bit).collect()
}

pub(crate) fn is_unknown(word: &str) -> bool {
    matches!(word, "x" | "X" | "z" | "Z")
}

/// Underscores separate digits; a sign is not a digit.
pub fn value(digits: &str, radix: u32) -> Result<u128, IntErrorKind> {
    let digits: String = digits.chars().filter(|&c| c != '_').collect();
    if digits.starts_with('+') {
        return Err(IntErrorKind::InvalidDigit);
    }
    u128::from_str_radix(&digits, radix).map_err(|error| *error.kind())
}

/// A number and its width if it has one: `12`, `0x1f`, `4'b0101`.
pub(crate) fn sized(word: &str) -> Option<(Option<u32>, u128)> {
    if let Some((width, constant)) = word.split_once('\'') {
        let width = width.parse::<u32>().ok().filter(|width| (1..=128).contains(width))?;
        let value = value(constant.get(1..)?, radix(constant.chars().next()?)?).ok()?;
        return (width == u128::BITS || value >> width == 0).then_some((Some(width), value));
    }
    unsized_number(word).map(|value| (None, value))
}

pub(crate) fn integer<T: TryFrom<u128>>(word: &str) -> Option<T> {
    T::try_from(unsized_number(word)?).ok()
}

pub(crate) fn unsized_number(word: &str) -> Option<u128> {
    let (digits, base) = match word.as_bytes().get(1) {
        Some(b'x' | b'X') => (word.get(2..)?, 16),
        Some(b'b' | b'B') => (word.get(2..)?, 2),
        _ => (word, 10),
    };
    (word.starts_with(|c: char| c.is_ascii_digit())).then(|| value(digits, base).ok()).flatten()
}
