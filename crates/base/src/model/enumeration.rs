//! Enumerations: names for the values of a net.

use serde::{Serialize, Serializer};

use crate::source::Span;

/// A declared enumeration: `enum phase { fetch, execute }`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Enumeration {
    pub name: String,
    pub span: Span,
    pub width: u32,
    /// The members in order of declaration; no two have the same value.
    pub members: Vec<EnumerationMember>,
}

/// Its members with their digits: `[["fetch", "0"], ["execute", "1"]]`
impl Serialize for Enumeration {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let width = self.width as usize;
        serializer.collect_seq(self.members.iter().map(|one| (&one.name, format!("{:0width$b}", one.value))))
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnumerationMember {
    pub name: String,
    pub span: Span,
    /// Its value, which fits into the width.
    pub value: u128,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MemberEncoding {
    /// 0, 1, 2, … in as few bits as possible.
    #[default]
    Binary,
    /// As binary, in the order of a Gray code: neighbors differ in one bit.
    Gray,
    /// A bit for each member.
    OneHot,
}

impl MemberEncoding {
    pub const WORDS: [(Self, &'static str); 3] =
        [(Self::Binary, "binary"), (Self::Gray, "gray"), (Self::OneHot, "one_hot")];

    pub const MOST: usize = 128;

    pub fn value(self, place: usize) -> u128 {
        match self {
            Self::Binary => place as u128,
            Self::Gray => (place ^ (place >> 1)) as u128,
            Self::OneHot => 1 << place,
        }
    }

    pub fn width(self, members: usize) -> u32 {
        match self {
            Self::OneHot => members as u32,
            _ => (usize::BITS - members.saturating_sub(1).leading_zeros()).max(1),
        }
    }
}

impl Enumeration {
    pub fn member(&self, name: &str) -> Option<&EnumerationMember> {
        self.members.iter().find(|member| member.name == name)
    }

    /// The bits of a value, the highest first.
    pub fn bits(&self, value: u128) -> Vec<bool> {
        (0..self.width).rev().map(|bit| value >> bit & 1 == 1).collect()
    }

    pub fn named(&self, value: u128) -> Option<&str> {
        self.members.iter().find(|member| member.value == value).map(|member| member.name.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbors_of_a_gray_code_differ_in_one_bit() {
        let values: Vec<u128> = (0..8).map(|place| MemberEncoding::Gray.value(place)).collect();
        assert!(values.windows(2).all(|pair| (pair[0] ^ pair[1]).count_ones() == 1));
        assert!(values.iter().all(|value| *value < 8));
    }

    #[test]
    fn members_need_as_many_bits_as_their_encoding() {
        assert_eq!([1, 2, 3, 4, 5].map(|members| MemberEncoding::Binary.width(members)), [1, 1, 2, 2, 3]);
        assert_eq!(MemberEncoding::OneHot.width(5), 5);
        assert_eq!(MemberEncoding::OneHot.value(3), 8);
    }
}
