//! Quantities: numbers with their units and valid ranges.

use std::ops::RangeInclusive;

use crate::diag::{Code, Diagnostic, suggest};
use crate::model::CYCLE_STEPS;
use crate::source::Span;
use crate::syntax::tree::{Number, Quantity, Value, ValueKind};

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
        let message = format!("`{}` without a unit", quantity.number.text);
        let label = format!("expected {}", suggest::alternatives(&wanted, "or"));
        let help = format!("write `{} {}`", quantity.number.text, wanted[0]);
        return Err(Diagnostic::new(Code::Unit, message, quantity.number.span, label).with_help(help));
    };
    let known = |unit: &&Unit| unit.words.contains(&word.text.as_str());
    match UNITS.iter().filter(|unit| unit.measure == measure).find(known) {
        Some(unit) => Ok(number(&quantity.number)? * unit.factor),
        None => {
            let message = format!("the unit `{}` where {} belongs", word.text, suggest::alternatives(&wanted, "or"));
            let what = if UNITS.iter().any(|unit| known(&unit)) { "a unit of something else" } else { "no unit" };
            Err(Diagnostic::new(Code::Unit, message, word.span, what)
                .with_help(format!("write `{} {}`", quantity.number.text, wanted[0])))
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
pub(crate) fn count(value: &Value, range: RangeInclusive<u32>) -> Result<u32, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(quantity) => whole(bare(quantity)?, range, quantity.span(), ""),
        _ => Err(wrong_kind("a number", value.span)),
    }
}

/// A number without a unit.
pub(crate) fn bare(quantity: &Quantity) -> Result<f64, Diagnostic> {
    match &quantity.unit {
        None => number(&quantity.number),
        Some(unit) => {
            let message = format!("the unit `{}` where no unit belongs", unit.text);
            let help = format!("write `{}`", quantity.number.text);
            Err(Diagnostic::new(Code::Unit, message, unit.span, "this number counts").with_help(help))
        }
    }
}

/// A number as written.
pub(crate) fn number(number: &Number) -> Result<f64, Diagnostic> {
    let value: f64 = number.text.parse().expect("the grammar lets numbers through only");
    if value.is_finite() { Ok(value) } else { Err(outside(&number.text, number.span, "a smaller number".to_owned())) }
}

/// An integer in a range.
pub(crate) fn whole(value: f64, range: RangeInclusive<u32>, span: Span, unit: &str) -> Result<u32, Diagnostic> {
    // Seconds may differ from an integer number of steps by rounding.
    let rounded = value.round();
    let near = (value - rounded).abs() < 1e-6;
    if near && rounded >= f64::from(*range.start()) && rounded <= f64::from(*range.end()) {
        return Ok(rounded as u32);
    }
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let expected = match (near, *range.end()) {
        (false, _) => format!("a whole number of{}", if unit.is_empty() { " things" } else { &unit }),
        (true, u32::MAX) => format!("{} or more{unit}", range.start()),
        (true, end) => format!("{} to {end}{unit}", range.start()),
    };
    Err(outside(&shortest(value), span, expected))
}

/// A real number in a range.
pub(crate) fn within(value: f64, range: RangeInclusive<f64>, span: Span) -> Result<f64, Diagnostic> {
    if range.contains(&value) {
        return Ok(value);
    }
    Err(outside(&shortest(value), span, format!("{} to {}", shortest(*range.start()), shortest(*range.end()))))
}

fn outside(found: &str, span: Span, expected: String) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, format!("`{found}` is out of range"), span, format!("expected {expected}"))
}

fn shortest(value: f64) -> String {
    format!("{value}")
}

/// The error for a value of another kind than expected.
pub(crate) fn wrong_kind(expected: &str, span: Span) -> Diagnostic {
    Diagnostic::new(Code::Value, "a value of the wrong kind", span, format!("expected {expected}"))
}
