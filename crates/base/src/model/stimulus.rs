//! Stimuli: binary signals of the environment, present or absent.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::wording::not_pattern;

/// The stimuli that are present: bit `i` is stimulus `i`, counted from 0 in the order of declaration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Pattern(u32);

impl Pattern {
    /// The four patterns of two stimuli in the paper's order: 00, 01, 10, 11, stimulus 1 written first.
    pub const PAIRS: [Pattern; 4] = [Pattern(0b00), Pattern(0b10), Pattern(0b01), Pattern(0b11)];

    pub const MAX_STIMULI: usize = 32;

    pub fn new(present: &[bool]) -> Self {
        Self::of(present.iter().copied())
    }

    pub fn of(present: impl Iterator<Item = bool>) -> Self {
        Self(present.enumerate().fold(0, |bits, (i, on)| {
            assert!(i < Self::MAX_STIMULI, "a pattern holds at most 32 stimuli");
            bits | u32::from(on) << i
        }))
    }

    pub fn bits(self, stimuli: usize) -> Vec<bool> {
        (0..stimuli).map(|i| self.has(i)).collect()
    }

    /// The patterns of so many stimuli, counted as binary numbers with stimulus 1 first.
    pub fn all(stimuli: usize) -> impl Iterator<Item = Self> {
        assert!(stimuli <= Self::MAX_STIMULI, "a pattern holds at most 32 stimuli");
        let pattern = move |number: u64| (0..stimuli).fold(0, |bits, i| bits | (number >> (stimuli - 1 - i) & 1) << i);
        (0..1u64 << stimuli).map(move |number| Self(pattern(number) as u32))
    }

    pub fn has(self, i: usize) -> bool {
        self.0 >> i & 1 == 1
    }

    /// Its place among the patterns of so many stimuli ([`Pattern::all`]): the digits read as a binary number.
    pub fn number(self, stimuli: usize) -> usize {
        (0..stimuli).fold(0, |number, i| number << 1 | usize::from(self.has(i)))
    }

    pub fn digits(self, stimuli: usize) -> String {
        (0..stimuli).map(|i| if self.has(i) { '1' } else { '0' }).collect()
    }
}

impl TryFrom<String> for Pattern {
    type Error = String;

    fn try_from(digits: String) -> Result<Self, String> {
        let sized = (1..=Self::MAX_STIMULI).contains(&digits.len());
        if !sized || digits.contains(|digit| !matches!(digit, '0' | '1')) {
            return Err(not_pattern(&digits, Self::MAX_STIMULI));
        }
        Ok(Self::new(&digits.chars().map(|digit| digit == '1').collect::<Vec<_>>()))
    }
}

impl From<Pattern> for String {
    fn from(pattern: Pattern) -> Self {
        pattern.digits((32 - pattern.0.leading_zeros()).max(2) as usize)
    }
}

impl fmt::Display for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.digits(2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_counted_with_stimulus_1_first() {
        assert_eq!(Pattern::all(2).collect::<Vec<_>>(), Pattern::PAIRS);
        assert!(Pattern::all(3).enumerate().all(|(number, pattern)| pattern.number(3) == number));
        let digits: Vec<String> = Pattern::all(3).map(|pattern| pattern.digits(3)).collect();
        assert_eq!(digits, ["000", "001", "010", "011", "100", "101", "110", "111"]);
        assert_eq!(Pattern::all(32).nth(1).map(|pattern| pattern.has(31)), Some(true));
    }
}
