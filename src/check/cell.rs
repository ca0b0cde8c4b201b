//! Values in the rows of tests and simulations.

use crate::diag::{Code, Diagnostic};
use crate::model::Column;
use crate::syntax::tree::Name;

/// A value of a row, as bits with the most significant first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Cell {
    /// These bits; `None` stands where `-` does.
    Bits(Vec<Option<bool>>),
    /// A pulse: 0, then 1.
    Pulse,
}

/// Reads a value for a column.
pub(crate) fn cell(word: &Name, column: &Column) -> Result<Cell, Diagnostic> {
    match word.text.as_str() {
        "-" => return Ok(Cell::Bits(vec![None; column.width])),
        "^" if column.width == 1 => return Ok(Cell::Pulse),
        _ => {}
    }
    let bits = match word.text.split_once('\'') {
        Some((width, digits)) => sized(word, width, digits)?,
        None => plain(word)?,
    };
    if bits.len() == column.width {
        return Ok(Cell::Bits(bits));
    }
    let message = format!("a value of {} bits for `{}`", bits.len(), column.name);
    let label = format!("`{}` has {}", column.name, crate::check::expression::counted(column.width, "bit"));
    let zeros = "0".repeat(column.width.min(16));
    let help = format!("write every bit, as in `{zeros}`, or a number with its width, as in `{}'d0`", column.width);
    Err(Diagnostic::new(Code::Width, message, word.span, label).with_help(help))
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

fn sized(word: &Name, width: &str, digits: &str) -> Result<Vec<Option<bool>>, Diagnostic> {
    let radix = match digits.chars().next() {
        Some('b') => 2,
        Some('d') => 10,
        Some('h') => 16,
        _ => return Err(no_value(word)),
    };
    let digits: String = digits[1..].chars().filter(|&c| c != '_').collect();
    let width: u32 = width.parse().ok().filter(|width| (1..=128).contains(width)).ok_or_else(|| no_value(word))?;
    let value = u128::from_str_radix(&digits, radix).map_err(|_| no_value(word))?;
    if width < 128 && value >> width != 0 {
        let message = format!("`{value}` does not fit into {width} bits");
        return Err(Diagnostic::new(
            Code::OutOfRange,
            message,
            word.span,
            format!("expected at most {}", (1u128 << width) - 1),
        ));
    }
    Ok((0..width).rev().map(|bit| Some(value >> bit & 1 == 1)).collect())
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
