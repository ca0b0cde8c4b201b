//! Values for parameters of Verilog.

use std::fmt;
use std::str::FromStr;

/// The value of a parameter, as it is written in Verilog: `8`, `-2` or `4'b0101`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParameterValue(String);

impl FromStr for ParameterValue {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let fault = "a number of 32 bits with its sign, such as `8` or `-2`, or one with its size, such as `4'b0101`";
        let is_number = text.parse::<i32>().is_ok() && !text.starts_with('+');
        if is_number || is_sized(text) { Ok(Self(text.to_owned())) } else { Err(fault) }
    }
}

fn is_sized(text: &str) -> bool {
    let Some((size, based)) = text.strip_prefix('-').unwrap_or(text).split_once('\'') else { return false };
    let based = based.strip_prefix(['s', 'S']).unwrap_or(based);
    let digits: fn(char) -> bool = match based.chars().next() {
        Some('b' | 'B') => |c| matches!(c, '0' | '1'),
        Some('o' | 'O') => |c| c.is_digit(8),
        Some('d' | 'D') => |c| c.is_ascii_digit(),
        Some('h' | 'H') => |c| c.is_ascii_hexdigit(),
        _ => return false,
    };
    let is_size = size.parse::<u16>().is_ok_and(|size| size > 0) && size.chars().all(|c| c.is_ascii_digit());
    is_size && based.len() > 1 && based.len() < 1000 && based[1..].chars().all(digits)
}

impl fmt::Display for ParameterValue {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_values_and_nothing_else_is() {
        for text in ["8", "-2", "0", "2147483647", "-2147483648", "4'b0101", "-3'sd2", "64'hffff0000ffff0000"] {
            assert_eq!(text.parse::<ParameterValue>().map(|value| value.to_string()), Ok(text.to_owned()));
        }
        for text in ["", "x", "+1", "2147483648", "1;", "'b1", "0'b1", "4'b2", "4'b", "4'q1", "\"a\"", "8 ", "é'b1"] {
            assert!(text.parse::<ParameterValue>().is_err(), "{text}");
        }
    }
}
