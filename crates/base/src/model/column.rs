//! Columns: the ports of a circuit, as in the header of a test.

use std::sync::Arc;

use serde::Serialize;

use super::Enumeration;

/// A port with its width: a column of a test, a waveform or a table.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Column {
    pub name: String,
    /// The width in bits, at least 1.
    pub width: usize,
    /// The number of its words, if it is an array.
    #[serde(skip)]
    pub words: Option<usize>,
    /// The members of its enumeration with their digits: `[["fetch", "0"], ["execute", "1"]]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<Vec<[String; 2]>>"))]
    pub members: Option<Arc<Enumeration>>,
}

impl Column {
    pub fn new(name: impl Into<String>, width: usize) -> Self {
        Self { name: name.into(), width, words: None, members: None }
    }

    /// The ports that have these bits, named as [`Column::bits`] names them: a run from `a[3]` down to `a[0]` is one
    /// port.
    pub fn group(bits: &[String]) -> Vec<Self> {
        let mut ports = Vec::new();
        let mut rest = bits;
        while let Some(first) = rest.first() {
            let width = whole_port(rest).unwrap_or(1);
            let name = if width == 1 { first } else { bit_parts(first).expect("a bit of a bus").0 };
            ports.push(Self::new(name, width));
            rest = &rest[width..];
        }
        ports
    }

    /// The names of the port's bits, most significant first.
    pub fn bits(&self) -> Vec<String> {
        match self.width {
            1 => vec![self.name.clone()],
            width => (0..width).rev().map(|bit| format!("{}[{bit}]", self.name)).collect(),
        }
    }
}

/// The width of the bus that these bits begin with, if all its bits are there.
fn whole_port(bits: &[String]) -> Option<usize> {
    let (name, highest) = bit_parts(&bits[0])?;
    let run = bits.get(..=highest)?;
    let whole = run.iter().zip((0..=highest).rev()).all(|(bit, at)| bit_parts(bit) == Some((name, at)));
    (whole && highest > 0).then_some(highest + 1)
}

/// The name of a bus and the number of its bit, from the name of the bit: `a` and 3 for `a[3]`. `None` for other names.
pub fn bit_parts(bit: &str) -> Option<(&str, usize)> {
    let (name, number) = bit.strip_suffix(']')?.rsplit_once('[')?;
    let is_plain = !number.is_empty() && number.bytes().all(|digit| digit.is_ascii_digit());
    // The number of bits fits too.
    Some((name, number.parse().ok().filter(|&number: &usize| is_plain && number < usize::MAX)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_grouped_into_ports() {
        let column = |name: &str, width| Column::new(name, width);
        let ports = [column("a", 3), column("b", 1), column("c", 2), column("c2", 2)];
        let bits: Vec<String> = ports.iter().flat_map(Column::bits).collect();
        assert_eq!(Column::group(&bits), ports);
        let apart = ["a[0]", "b[2]", "b[1]", "c[1]", "d[0]"].map(str::to_owned);
        assert_eq!(Column::group(&apart), apart.map(|bit| column(&bit, 1)), "bits that are no whole ports");
    }
}
