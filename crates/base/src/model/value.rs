//! Values of ports in the rows of tests and simulations: bits with the base in which the user wrote them.

use std::fmt;
use std::sync::Arc;

use serde::Serialize;

use super::{Column, Enumeration};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Base {
    /// Its bits alone: `0101`.
    #[default]
    Bits,
    /// `4'b0101`
    Binary,
    /// `4'd5`
    Decimal,
    /// `4'h5`
    Hexadecimal,
    /// The name of a member of the port's enumeration; other values as their bits.
    Member,
    /// `5`
    Plain,
}

impl Base {
    /// The base for a port if no row defines its notation.
    pub fn of_width(width: usize) -> Self {
        if width == 1 { Self::Bits } else { Self::Decimal }
    }

    /// The base for the values of a port if no row defines its notation.
    pub fn of_port(port: &Column) -> Self {
        if port.members.is_some() { Self::Member } else { Self::of_width(port.width) }
    }

    /// The base of a letter in a constant such as `4'd5`.
    pub fn of_letter(letter: char) -> Option<Self> {
        match letter {
            'b' => Some(Self::Binary),
            'd' => Some(Self::Decimal),
            'h' => Some(Self::Hexadecimal),
            _ => None,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "ValueRecord"))]
#[serde(into = "ValueRecord")]
pub struct Value {
    /// The bits, most significant first; `None` is unchecked.
    pub bits: Vec<Option<bool>>,
    pub base: Base,
    pub members: Option<Arc<Enumeration>>,
}

impl Value {
    /// Splits bits into the values of ports. `bases` are the notations of the ports, or empty if there are none.
    pub fn of_ports(ports: &[Column], bits: impl IntoIterator<Item = Option<bool>>, bases: &[Base]) -> Vec<Self> {
        let mut bits = bits.into_iter();
        let value = |(at, port): (usize, &Column)| {
            let bits: Vec<_> = bits.by_ref().take(port.width).collect();
            assert_eq!(bits.len(), port.width, "a bit for each bit of the ports");
            let base = bases.get(at).copied().unwrap_or(Base::of_port(port));
            Self { bits, base, members: port.members.clone() }
        };
        ports.iter().enumerate().map(value).collect()
    }

    pub fn is_open(&self) -> bool {
        self.bits.iter().all(Option::is_none)
    }

    pub fn digits(&self) -> String {
        self.bits.iter().map(|bit| bit.map_or('-', |bit| if bit { '1' } else { '0' })).collect()
    }

    fn number(&self) -> Option<u128> {
        let bits = self.bits.iter().copied().collect::<Option<Vec<bool>>>()?;
        (bits.len() <= 128).then(|| bits.iter().fold(0, |number, &bit| number << 1 | u128::from(bit)))
    }

    fn hexadecimal(&self) -> Option<String> {
        let bits = self.bits.iter().copied().collect::<Option<Vec<bool>>>()?;
        let digit = |bits: &[bool]| bits.iter().fold(0, |digit, &bit| digit << 1 | u32::from(bit));
        let digits = bits.rchunks(4).rev().map(|bits| char::from_digit(digit(bits), 16).expect("four bits"));
        Some(digits.collect())
    }
}

impl fmt::Display for Value {
    /// As the user writes it: `4'd5`; a value that is too wide for a number in its base is written in hexadecimal
    /// digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = self.bits.len();
        let text = match (self.base, self.number()) {
            _ if self.is_open() => "-".to_owned(),
            (Base::Member, Some(number)) => match self.members.as_ref().and_then(|members| members.named(number)) {
                Some(name) => name.to_owned(),
                None => self.digits(),
            },
            (Base::Plain, Some(number)) => number.to_string(),
            (Base::Bits | Base::Member | Base::Plain, _) => self.digits(),
            (Base::Decimal, Some(number)) => format!("{width}'d{number}"),
            (Base::Decimal | Base::Hexadecimal, _) => match self.hexadecimal() {
                Some(digits) => format!("{width}'h{digits}"),
                None => self.digits(),
            },
            (Base::Binary, Some(_)) => format!("{width}'b{}", self.digits()),
            (Base::Binary, None) => self.digits(),
        };
        f.pad(&text)
    }
}

/// A [`Value`] as data.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "Value"))]
struct ValueRecord {
    /// As the user writes it, such as `4'd5`.
    text: String,
    /// The most significant bit first; `-` where nothing is expected or a robot failed.
    bits: String,
}

impl From<Value> for ValueRecord {
    fn from(value: Value) -> Self {
        Self { text: value.to_string(), bits: value.digits() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(digits: &str, base: Base, expected: &str) {
        let bit = |c| match c {
            '0' => Some(false),
            '1' => Some(true),
            _ => None,
        };
        let value = Value { bits: digits.chars().map(bit).collect(), base, members: None };
        assert_eq!((value.to_string().as_str(), value.digits().as_str()), (expected, digits));
    }

    #[test]
    fn values_keep_their_notation() {
        check("1", Base::Bits, "1");
        check("1001", Base::Decimal, "4'd9");
        check("1001", Base::Bits, "1001");
        check("1001", Base::Binary, "4'b1001");
        check("101001", Base::Hexadecimal, "6'h29");
        check("1--0", Base::Decimal, "1--0");
        check("----", Base::Hexadecimal, "-");
        check(&"1".repeat(132), Base::Decimal, &format!("132'h{}", "f".repeat(33)));
    }
}
