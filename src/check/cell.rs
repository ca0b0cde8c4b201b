//! Values in the rows of tests and simulations.

use std::num::IntErrorKind;

use crate::check::constant;
use crate::diag::{Code, Diagnostic, counted};
use crate::model::{Base, Column};
use crate::syntax::tree::Name;

/// A value of a row, as bits with the most significant first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Cell {
    /// The bits, or `None` for `-`, and the text as written.
    Bits(Vec<Option<bool>>, Base),
    /// A rising edge: 0, then 1.
    Pulse,
}

/// The most bits of an example value in a message.
const SHOWN: usize = 16;

/// Reads a value for a column.
pub(crate) fn cell(word: &Name, column: &Column) -> Result<Cell, Diagnostic> {
    match word.text.as_str() {
        "-" => return Ok(Cell::Bits(vec![None; column.width], Base::of_width(column.width))),
        "^" if column.width == 1 => return Ok(Cell::Pulse),
        "^" => return Err(wide_pulse(word, column)),
        _ => {}
    }
    let bits = match word.text.split_once('\'') {
        Some((width, constant)) => sized(word, width, constant, column)?,
        None => plain(word)?,
    };
    let letter = word.text.split_once('\'').and_then(|(_, constant)| constant.chars().next());
    if bits.len() == column.width {
        Ok(Cell::Bits(bits, letter.and_then(Base::of_letter).unwrap_or_default()))
    } else {
        Err(wrong_width(word, &counted(bits.len(), "bit"), column))
    }
}

fn wide_pulse(word: &Name, column: &Column) -> Diagnostic {
    let message = format!("`^` pulses one bit, and `{}` has {}", column.name, column.width);
    Diagnostic::new(Code::Value, message, word.span, "expected a value of all bits")
        .with_help(format!("write a number with its width, as in `{}'d0`", column.width))
}

fn wrong_width(word: &Name, found: &str, column: &Column) -> Diagnostic {
    let message = format!("a value of {found} for `{}`", column.name);
    let label = format!("`{}` has {}", column.name, counted(column.width, "bit"));
    let number = format!("a number with its width, as in `{}'d0`", column.width);
    let help = if column.width > SHOWN {
        format!("write every bit, or {number}")
    } else {
        format!("write every bit, as in `{}`, or {number}", "0".repeat(column.width))
    };
    Diagnostic::new(Code::Width, message, word.span, label).with_help(help)
}

fn plain(word: &Name) -> Result<Vec<Option<bool>>, Diagnostic> {
    let bit = |c| match c {
        '0' => Some(Some(false)),
        '1' => Some(Some(true)),
        '-' => Some(None),
        _ => None,
    };
    word.text.chars().filter(|&c| c != '_').map(bit).collect::<Option<_>>().ok_or_else(|| no_value(word))
}

/// A number with the given width in bits.
fn sized(word: &Name, width: &str, constant: &str, column: &Column) -> Result<Vec<Option<bool>>, Diagnostic> {
    let mut digits = constant.chars();
    let radix = digits.next().and_then(constant::radix).ok_or_else(|| no_value(word))?;
    if width.is_empty() || !width.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(no_value(word));
    }
    let value = constant::value(digits.as_str(), radix).map_err(|error| match error {
        IntErrorKind::PosOverflow => too_large(word),
        _ => no_value(word),
    })?;
    let width = match width.parse() {
        Ok(width) if width < 128 && value >> width != 0 => return Err(unfitting(word, value, width)),
        Ok(width) if width == column.width => width,
        Ok(width) => return Err(wrong_width(word, &counted(width, "bit"), column)),
        Err(_) => return Err(wrong_width(word, &format!("{width} bits"), column)),
    };
    Ok((0..width).rev().map(|bit| Some(bit < 128 && value >> bit & 1 == 1)).collect())
}

fn unfitting(word: &Name, value: u128, width: usize) -> Diagnostic {
    let message = format!("`{value}` does not fit into {}", counted(width, "bit"));
    let label = format!("expected at most {}", (1u128 << width) - 1);
    Diagnostic::new(Code::OutOfRange, message, word.span, label)
}

fn too_large(word: &Name) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, "the value is too large", word.span, "expected less than 128 bits")
        .with_help("write every bit, as in `0110`")
}

fn no_value(word: &Name) -> Diagnostic {
    Diagnostic::new(
        Code::Value,
        format!("`{}` is no value", word.text),
        word.span,
        "expected bits such as `0`, `1`, `0110`, or `4'd6`",
    )
    .with_help("`-` is not checked; `^` is a clock's 0 and then 1")
}
