//! Values in the rows of tests and simulations.

use std::num::IntErrorKind;

use crate::check::constant;
use crate::check::wording;
use crate::syntax::tree::NameSyntax;
use nbc_base::diag::{Diagnostic, counted};
use nbc_base::model::{Base, Column};

/// Most significant bit first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum RowCell {
    /// `None` is `-`.
    Bits(Vec<Option<bool>>, Base),
    /// A rising edge: 0, then 1.
    Pulse,
}

pub(crate) fn cell(word: &NameSyntax, column: &Column) -> Result<RowCell, Diagnostic> {
    match word.text.as_str() {
        "-" => return Ok(RowCell::Bits(vec![None; column.width], Base::of_port(column))),
        "^" if column.width == 1 => return Ok(RowCell::Pulse),
        "^" => return Err(wording::wide_pulse(&column.name, column.width, word.span)),
        _ => {}
    }
    if let Some(bits) = member(word, column) {
        return Ok(RowCell::Bits(bits.into_iter().map(Some).collect(), Base::Member));
    }
    if let Some(bits) = number(word, column)? {
        return Ok(RowCell::Bits(bits, Base::Plain));
    }
    let bits = match word.text.split_once('\'') {
        Some((width, constant)) => sized(word, width, constant, column)?,
        None => constant::pattern(&word.text).ok_or_else(|| no_value(word, column))?,
    };
    let letter = word.text.split_once('\'').and_then(|(_, constant)| constant.chars().next());
    if bits.len() == column.width {
        Ok(RowCell::Bits(bits, letter.and_then(Base::of_letter).unwrap_or_default()))
    } else {
        Err(wrong_width(word, &counted(bits.len(), "bit"), column))
    }
}

fn member(word: &NameSyntax, column: &Column) -> Option<Vec<bool>> {
    let members = column.members.as_ref()?;
    Some(members.bits(members.member(&word.text)?.value))
}

/// Several digits of 0 and 1 are bits, not a number.
fn number(word: &NameSyntax, column: &Column) -> Result<Option<Vec<Option<bool>>>, Diagnostic> {
    let is_bits = word.text.bytes().all(|byte| matches!(byte, b'0' | b'1' | b'_'));
    if is_bits && (word.text.len() != 1 || column.width == 1) {
        return Ok(None);
    }
    let Some(value) = constant::unsized_number(&word.text) else { return Ok(None) };
    if column.width < 128 && value >> column.width != 0 {
        return Err(wording::unfitting(value, column.width, word.span));
    }
    Ok(Some((0..column.width).rev().map(|bit| Some(bit < 128 && value >> bit & 1 == 1)).collect()))
}

/// As [`cell`], but every bit of an input is known.
pub(crate) fn input_cell(word: &NameSyntax, column: &Column) -> Result<RowCell, Diagnostic> {
    let is_value = member(word, column).is_some() || constant::unsized_number(&word.text).is_some();
    if !is_value && (constant::is_unknown(&word.text) || with_any_bits(&word.text).is_some()) {
        return Err(wording::not_an_input(word));
    }
    cell(word, column)
}

fn with_any_bits(word: &str) -> Option<String> {
    let any = |c: char| matches!(c, 'x' | 'X' | 'z' | 'Z');
    let is_pattern = word.contains(any) && word.chars().all(|c| matches!(c, '0' | '1' | '-') || any(c));
    is_pattern.then(|| word.replace(any, "-"))
}

fn wrong_width(word: &NameSyntax, found: &str, column: &Column) -> Diagnostic {
    // Digits of 0 and 1 may be bits or a number.
    let is_bits = word.text.bytes().all(|byte| matches!(byte, b'0' | b'1' | b'-' | b'_'));
    let meant = if is_bits { None } else { meant(&word.text, column.width) };
    let number = word.text.parse::<u128>().ok().filter(|value| column.width >= 128 || value >> column.width == 0);
    let number = number.filter(|_| is_bits && word.text.len() > 1).map(|value| format!("{}'d{value}", column.width));
    wording::value_width(found, &column.name, column.width, [meant, number], word.span)
}

fn meant(word: &str, width: usize) -> Option<String> {
    if let Some(bit) = constant::truth(word).filter(|_| width == 1) {
        return Some(u8::from(bit).to_string());
    }
    if constant::is_unknown(word) {
        return Some("-".to_owned());
    }
    if let Some(bits) = with_any_bits(word).filter(|bits| bits.len() == width) {
        return Some(bits);
    }
    let lower = word.to_ascii_lowercase();
    let (base, digits) = match lower.split_once('\'') {
        Some((_, constant)) => (constant.chars().next()?, constant.get(1..)?),
        None => match lower.get(..2) {
            Some("0x") => ('h', &lower[2..]),
            Some("0b") => ('b', &lower[2..]),
            _ => ('d', lower.as_str()),
        },
    };
    let value = constant::value(digits, constant::radix(base)?).ok()?;
    let fits = width >= 128 || value >> width == 0;
    fits.then(|| if width == 1 { value.to_string() } else { format!("{width}'{base}{digits}") })
}

fn sized(word: &NameSyntax, width: &str, constant: &str, column: &Column) -> Result<Vec<Option<bool>>, Diagnostic> {
    let mut digits = constant.chars();
    let radix = digits.next().and_then(constant::radix).ok_or_else(|| no_value(word, column))?;
    if width.is_empty() || !width.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(no_value(word, column));
    }
    let value = constant::value(digits.as_str(), radix).map_err(|error| match error {
        IntErrorKind::PosOverflow => wording::large_value(word.span),
        _ => no_value(word, column),
    })?;
    let width = match width.parse() {
        Ok(width) if width < 128 && value >> width != 0 => {
            return Err(wording::unfitting(value, width, word.span));
        }
        Ok(width) if width == column.width => width,
        Ok(width) => return Err(wrong_width(word, &counted(width, "bit"), column)),
        Err(_) => return Err(wrong_width(word, &format!("{width} bits"), column)),
    };
    Ok((0..width).rev().map(|bit| Some(bit < 128 && value >> bit & 1 == 1)).collect())
}

fn no_value(word: &NameSyntax, column: &Column) -> Diagnostic {
    wording::not_a_value(word, meant(&word.text, column.width))
}
