//! Quantities: numbers with their units and valid ranges.

use std::ops::RangeInclusive;

use crate::check::constant;
use crate::check::wording;
use crate::syntax::tree::{Number, Quantity, ValueKind, ValueSyntax};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::CYCLE_STEPS;
use nbc_base::source::Span;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Measure {
    Steps,
    Cycles,
    Degrees,
}

/// The first spelling is the preferred one.
struct Unit {
    words: &'static [&'static str],
    measure: Measure,
    /// In the measure's base unit.
    factor: f64,
}

/// An env step is thirty substeps of 0.1 ms (docs/physics.md 1).
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

pub(crate) fn measured(quantity: &Quantity, measure: Measure) -> Result<f64, Diagnostic> {
    let wanted = measure.wanted();
    let Some(word) = &quantity.unit else {
        return Err(wording::missing_unit(&quantity.number.text, &wanted, quantity.number.span));
    };
    let known = |unit: &&Unit| unit.words.contains(&word.text.as_str());
    match UNITS.iter().filter(|unit| unit.measure == measure).find(known) {
        Some(unit) => Ok(number(&quantity.number)? * unit.factor),
        None => {
            let words = UNITS.iter().filter(|unit| unit.measure == measure).flat_map(|unit| unit.words.iter().copied());
            let meant = Suggestion::near(&word.text, words);
            Err(wording::wrong_unit(&quantity.number.text, &word.text, &wanted, &meant, word.span))
        }
    }
}

pub(crate) fn steps(quantity: &Quantity) -> Result<u32, Diagnostic> {
    whole(measured(quantity, Measure::Steps)?, 1..=100_000_000, quantity.span(), "steps")
}

pub(crate) fn cycles(quantity: &Quantity) -> Result<u32, Diagnostic> {
    whole(measured(quantity, Measure::Cycles)?, 1..=1_000_000, quantity.span(), "cycles")
}

pub(crate) fn count(value: &ValueSyntax, range: RangeInclusive<u32>) -> Result<u32, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(quantity) => in_range(bare(quantity)?, &quantity.number.text, range, quantity.span(), ""),
        _ => Err(wording::wrong_kind(wording::NUMBER, value.span)),
    }
}

/// An integer of 64 bits; a number of a record has fewer exact digits.
pub(crate) fn seed(quantity: &Quantity) -> Result<u64, Diagnostic> {
    bare(quantity)?;
    let text = &quantity.number.text;
    constant::integer(text).ok_or_else(|| wording::seed_outside(text, quantity.span()))
}

pub(crate) fn bare(quantity: &Quantity) -> Result<f64, Diagnostic> {
    match &quantity.unit {
        None => number(&quantity.number),
        Some(unit) => Err(wording::unexpected_unit(&quantity.number.text, &unit.text, unit.span)),
    }
}

pub(crate) fn ratio(quantity: &Quantity) -> Result<f64, Diagnostic> {
    match &quantity.unit {
        Some(unit) if unit.text == "%" => Ok(number(&quantity.number)? / 100.0),
        _ => bare(quantity),
    }
}

pub(crate) fn percent(quantity: &Quantity) -> Result<f64, Diagnostic> {
    match &quantity.unit {
        Some(unit) if unit.text == "%" => within(number(&quantity.number)?, 0.0..=100.0, quantity.number.span),
        _ => Err(wording::wrong_kind(wording::PERCENT, quantity.number.span)),
    }
}

pub(crate) fn number(number: &Number) -> Result<f64, Diagnostic> {
    let text = number.text.trim_start_matches('-');
    let is_decimal = text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    let value: f64 = if is_decimal {
        number.text.parse().expect("the grammar lets numbers through only")
    } else {
        let value = constant::unsized_number(text).map_or(f64::INFINITY, |value| value as f64);
        if text == number.text { value } else { -value }
    };
    if value.is_finite() { Ok(value) } else { Err(wording::infinite(&number.text, number.span)) }
}

pub(crate) fn whole(value: f64, range: RangeInclusive<u32>, span: Span, unit: &'static str) -> Result<u32, Diagnostic> {
    in_range(value, &value.to_string(), range, span, unit)
}

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
    Err(match (near, most) {
        (false, _) => wording::not_whole(written, unit, span),
        (true, u32::MAX) if rounded < f64::from(least) => wording::below(written, least, unit, span),
        (true, most) => wording::outside(written, least, most, unit, span),
    })
}

pub(crate) fn within(value: f64, range: RangeInclusive<f64>, span: Span) -> Result<f64, Diagnostic> {
    if range.contains(&value) {
        return Ok(value);
    }
    let (least, most) = range.into_inner();
    Err(wording::real_outside(value, least, most, span))
}
