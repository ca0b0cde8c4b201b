//! Bits in bytes, the lowest first.

/// The bytes of some bits.
pub fn pack(bits: impl IntoIterator<Item = bool>) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (place, bit) in bits.into_iter().enumerate() {
        if place % 8 == 0 {
            bytes.push(0);
        }
        bytes[place / 8] |= u8::from(bit) << (place % 8);
    }
    bytes
}

/// Rows of bits; `None` if the bytes are not exactly these.
pub fn unpack(bytes: &[u8], rows: usize, width: usize) -> Option<Vec<Vec<bool>>> {
    let count = rows.checked_mul(width)?;
    let bit = |place: usize| bytes[place / 8] >> (place % 8) & 1 == 1;
    let is_whole = bytes.len() == count.div_ceil(8) && (count..8 * bytes.len()).all(|place| !bit(place));
    is_whole.then(|| (0..rows).map(|row| (0..width).map(|column| bit(row * width + column)).collect()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_read_as_they_were_written() {
        let rows = vec![vec![true, false, true, true, false], vec![false, true, true, false, true]];
        let bytes = pack(rows.iter().flatten().copied());
        assert_eq!(unpack(&bytes, 2, 5), Some(rows));
        assert_eq!(
            unpack(&bytes, 2, 8),
            Some(vec![
                vec![true, false, true, true, false, false, true, true],
                vec![false, true, false, false, false, false, false, false]
            ])
        );
        assert_eq!(unpack(&bytes, 1, 5), None, "more bytes");
        assert_eq!(unpack(&bytes[..1], 2, 5), None, "fewer bytes");
        assert_eq!(unpack(&[0xff], 1, 5), None, "bits after the last");
        assert_eq!(unpack(&[], 3, 0), Some(vec![Vec::new(); 3]));
    }
}
