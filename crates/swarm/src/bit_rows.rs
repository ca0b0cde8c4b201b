//! Rows of bits as texts of the digits 0 and 1, for `#[serde(with)]`.

use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::Serializer;

pub(crate) fn serialize<S: Serializer>(rows: &[Vec<bool>], serializer: S) -> Result<S::Ok, S::Error> {
    let digit = |&bit: &bool| if bit { '1' } else { '0' };
    serializer.collect_seq(rows.iter().map(|row| row.iter().map(digit).collect::<String>()))
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Vec<bool>>, D::Error> {
    let bit = |digit| match digit {
        b'0' => Ok(false),
        b'1' => Ok(true),
        _ => Err(D::Error::custom("a row has the digits 0 and 1")),
    };
    let rows = Vec::<String>::deserialize(deserializer)?;
    rows.iter().map(|row| row.bytes().map(bit).collect()).collect()
}
