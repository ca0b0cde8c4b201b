//! Quantities: numbers with their units and valid ranges.

use std::ops::RangeInclusive;

use crate::check::constant;
use crate::check::wording::{Bounds, Expected, ValueError};
use crate::syntax::tree::{Number, Quantity, ValueKind, ValueSyntax};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::CYCLE_STEPS;
use nbc_base::source::Span;

/// What a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Measure {
    /// Time in env steps; cycles and seconds are converted.
    Steps,
    /// Time in actuation cycles.
    Cycles,
    /// An angle in degrees.
    Degrees,
}

/// A unit with its spellings; the first is the preferred one.
struct Unit {
    words: &'static [&'static str],
    measure: Measure,
    /// The unit in terms of the measure's base unit.
    factor: f64,
}

/// Env steps in a second of simulated time: an env step is thirty substeps of 0.1 ms (docs/physics.md 1).
const STEPS_PER_SECOND: f64 = 1.0 / 3e-3;

const UNITS: [Unit; 6] = [
    Unit { words: &["steps", "step"], measure: Measure::Steps, factor: 1.0 },
    Unit { words: &["cycles", "cycle"], measure: Measure::Steps, factor: CYCLE_STEPS as f64 },
    Unit { words: &["s", "seconds", "second"], measure: Measure::Steps, factor: STEPS_PER_SECOND },
    Unit { words: &["ms", "milliseconds"], measure: Measure::Steps, factor: STEPS_PER_SECOND / 1000.0 },
    Unit { words: &["cycles", "cycle"], measure: Measure::Cycles, factor: 1.0 },
    Unit { words: &["deg", "degrees", "degree"], measure: Measure::Degrees, factor: 1.0 },
];

impl Measure {
    fn wanted(self) -> Vec<&'static str> {
        let own = UNITS.iter().filter(|unit| unit.measure == self);
        own.map(|unit| unit.words[0]).filter(|word| *word != "ms").collect()
    }
}

/// A quantity in the base unit of its measure.
pub(crate) fn measured(quantity: &Quantity, measure: Measure) -> Result<f64, Diagnostic> {
    let wanted = measure.wanted();
    let Some(word) = &quantity.unit else {
        let number = quantity.number.text.clone();
        return Err(ValueError::MissingUnit { number, wanted }.at(quantity.number.span));
    };
    let known = |unit: &&Unit| unit.words.contains(&word.text.as_str());
    match UNITS.iter().filter(|unit| unit.measure == measure).find(known) {
        Some(unit) => Ok(number(&quantity.number)? * unit.factor),
        None => {
            let words = UNITS.iter().filter(|unit| unit.measure == measure).flat_map(|unit| unit.words.iter().copied());
            let meant = Suggestion::near(&word.text, words);
            let (number, unit) = (quantity.number.text.clone(), word.text.clone());
            Err(ValueError::WrongUnit { number, unit, wanted, meant }.at(word.span))
        }
    }
}

/// A time in env steps: an integer of at least 1.
pub(crate) fn steps(quantity: &Quantity) -> Result<u32, Diagnostic> {
    whole(measured(quantity, Measure::Steps)?, 1..=100_000_000, quantity.span(), "steps")
}

/// A time in cycles: an integer of at least 1.
pub(crate) fn cycles(quantity: &Quantity) -> Result<u32, Diagnostic> {
    whole(measured(quantity, Measure::Cycles)?, 1..=1_000_000, quantity.span(), "cycles")
}

/// An integer without a unit.
pub(crate) fn count(value: &ValueSyntax, range: RangeInclusive<u32>) -> Result<u32, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(quantity) => in_range(bare(quantity)?, &quantity.number.text, range, quantity.span(), ""),
        _ => Err(wrong_kind(Expected::Number, value.span)),
    }
}

/// A seed: an integer of 64 bits without a unit. A number of a record has fewer exact digits.
pub(crate) fn seed(quantity: &Quantity) -> Result<u64, Diagnostic> {
    bare(quantity)?;
    let text = &quantity.number.text;
    constant::integer(text).ok_or_else(|| outside(text.clone(), Bounds::Seed { most: u64::MAX }, quantity.span()))
}

/// A number without a unit.
pub(crate) fn bare(quantity: &Quantity) -> Result<f64, Diagnostic> {
    match &quantity.unit {
        None => number(&quantity.number),
        Some(unit) => {
            let number = quantity.number.text.clone();
            Err(ValueError::UnexpectedUnit { number, unit: unit.text.clone() }.at(unit.span))
        }
    }
}

/// A number without a unit, or in percent.
pub(crate) fn ratio(quantity: &Quantity) -> Result<f64, Diagnostic> {
    match &quantity.unit {
        Some(unit) if unit.text == "%" => Ok(number(&quantity.number)? / 100.0),
        _ => bare(quantity),
    }
}

/// A share in percent.
pub(crate) fn percent(quantity: &Quantity) -> Result<f64, Diagnostic> {
    match &quantity.unit {
        Some(unit) if unit.text == "%" => within(number(&quantity.number)?, 0.0..=100.0, quantity.number.span),
        _ => Err(wrong_kind(Expected::Percent, quantity.number.span)),
    }
}

/// A number as written.
pub(crate) fn number(number: &Number) -> Result<f64, Diagnostic> {
    let text = number.text.trim_start_matches('-');
    let is_decimal = text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    let value: f64 = if is_decimal {
        number.text.parse().expect("the grammar lets numbers through only")
    } else {
        let value = constant::unsized_number(text).map_or(f64::INFINITY, |value| value as f64);
        if text == number.text { value } else { -value }
    };
    if value.is_finite() { Ok(value) } else { Err(outside(number.text.clone(), Bounds::Smaller, number.span)) }
}

/// An integer in a range.
pub(crate) fn whole(value: f64, range: RangeInclusive<u32>, span: Span, unit: &'static str) -> Result<u32, Diagnostic> {
    in_range(value, &value.to_string(), range, span, unit)
}

/// As [`whole`], for a number that is written so.
fn in_range(
    value: f64,
    written: &str,
    range: RangeInclusive<u32>,
    span: Span,
    unit: &'static str,
) -> Result<u32, Diagnostic> {
    // Seconds need not be a whole number of steps to the last bit.
    let rounded = value.round();
    let near = (value - rounded).abs() < 1e-6;
    let (least, most) = range.into_inner();
    if near && rounded >= f64::from(least) && rounded <= f64::from(most) {
        return Ok(rounded as u32);
    }
    let expected = match (near, most) {
        (false, _) => Bounds::Whole { unit },
        (true, u32::MAX) if rounded < f64::from(least) => Bounds::From { least, unit },
        (true, most) => Bounds::Between { least, most, unit },
    };
    Err(outside(written.to_owned(), expected, span))
}

/// A real number in a range.
pub(crate) fn within(value: f64, range: RangeInclusive<f64>, span: Span) -> Result<f64, Diagnostic> {
    if range.contains(&value) {
        return Ok(value);
    }
    let (least, most) = range.into_inner();
    Err(outside(value.to_string(), Bounds::Real { least, most }, span))
}

fn outside(found: String, expected: Bounds, span: Span) -> Diagnostic {
    ValueError::OutOfRange { found, expected }.at(span)
}

/// The error for a value of another kind than expected.
pub(crate) fn wrong_kind(expected: Expected, span: Span) -> Diagnostic {
    ValueError::WrongKind { expected }.at(span)
}
