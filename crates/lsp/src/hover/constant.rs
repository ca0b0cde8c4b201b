//! Constants in all bases.

use nbc_base::diag::counted;
use nbc_lang::check::constant;

pub(super) fn text(word: &str) -> Option<String> {
    let (width, value) = match word.split_once('\'') {
        Some((width, digits)) => (Some(width.parse::<u32>().ok()?), value(digits)?),
        None => (None, word.parse().ok()?),
    };
    let bits = width.unwrap_or(1).max(u128::BITS - u128::leading_zeros(value)) as usize;
    let prefix = width.map_or(String::new(), |width| format!("{width}'"));
    let form = |base: &str, digits: String| match width {
        Some(_) => format!("`{prefix}{base}{digits}`"),
        None => format!("`{digits}`"),
    };
    let rows = [
        ("decimal", form("d", value.to_string())),
        ("binary", form("b", format!("{value:0bits$b}"))),
        ("hexadecimal", form("h", format!("{value:0digits$x}", digits = bits.div_ceil(4)))),
    ];
    let rows: String = rows.iter().map(|(base, text)| format!("| {base} | {text} |\n")).collect();
    let bits = counted(bits, "bit");
    Some(format!("| constant | {bits} |\n|---|---|\n{rows}"))
}

fn value(digits: &str) -> Option<u128> {
    let base = digits.chars().next()?;
    constant::value(&digits[base.len_utf8()..], constant::radix(base)?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_is_shown_in_all_bases() {
        let table = "| constant | 6 bits |\n|---|---|\n| decimal | `6'd10` |\n| binary | `6'b001010` |\n\
                     | hexadecimal | `6'h0a` |\n";
        for word in ["6'b1010", "6'd10", "6'h0a", "6'b00_1010"] {
            assert_eq!(text(word).as_deref(), Some(table), "{word}");
        }
        assert!(text("12").unwrap().contains("| binary | `1100` |"));
        assert_eq!(["4'x1", "4'b", "4'b2", "n'd3", "0.5"].map(text), [None, None, None, None, None]);
    }
}
