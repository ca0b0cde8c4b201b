//! Materials of voxels.

use crate::check::fields::{self, Fields};
use crate::check::names::{Home, Names};
use crate::check::quantity::{self, Measure};
use crate::diag::{Code, Diagnostic};
use crate::model::{Drive, Material, MaterialKind, Response};
use crate::source::Span;
use crate::syntax::tree::{Quantity, RecordDeclaration, Value, ValueKind};

/// The smallest and the largest width of a voxel, as a fraction of its rest width (docs/physics.md 3).
const WIDTHS: std::ops::RangeInclusive<f64> = 0.6..=1.6;

#[derive(Clone, Copy)]
enum Kind {
    Rigid,
    Soft,
    Actuator,
    Sensor,
}

/// Checks a material.
pub(crate) fn material(
    source: &RecordDeclaration,
    home: Home,
    stimuli: &Names,
    faults: &mut Vec<Diagnostic>,
) -> Option<Material> {
    let what = format!("the material `{}`", source.name.text);
    let mut fields = Fields::new(what, source.name.span, &source.record);
    let kinds = [("rigid", Kind::Rigid), ("soft", Kind::Soft), ("actuator", Kind::Actuator), ("sensor", Kind::Sensor)];
    let kind = fields.need("kind", "kind: soft", |value| fields::choice(value, &kinds));
    let Some(kind) = kind else {
        // The allowed fields depend on the kind.
        faults.append(&mut fields.faults);
        return None;
    };
    let kind = match kind {
        Kind::Rigid => Some(MaterialKind::Rigid),
        Kind::Soft => Some(MaterialKind::Soft),
        Kind::Actuator => drive(&mut fields).map(MaterialKind::Actuator),
        Kind::Sensor => response(&mut fields, home, stimuli).map(MaterialKind::Sensor),
    };
    let found = fields.finish();
    let kind = kind.filter(|_| found.is_empty());
    faults.extend(found);
    Some(Material { name: source.name.text.clone(), kind: kind? })
}

fn drive(fields: &mut Fields<'_>) -> Option<Drive> {
    fields.read("drive", (), |value| fields::choice(value, &[("sine", ())]));
    let period = fields.need("period", "period: 84 steps", |value| quantity::steps(quantity_of(value)?));
    let phase = fields.read("phase", 0.0, |value| quantity::measured(quantity_of(value)?, Measure::Degrees));
    let range = fields.need("range", "range: 0.6..1.6", range);
    let ((low, high), period) = range.zip(period)?;
    Some(Drive { period, phase, low, high })
}

fn response(fields: &mut Fields<'_>, home: Home, stimuli: &Names) -> Option<Response> {
    let stimulus =
        fields.need("stimulus", "stimulus: s1", |value| stimuli.resolve(fields::word(value, "a stimulus")?, home));
    let absent = fields.need("absent", "absent: 0.6", width);
    let present = fields.need("present", "present: 1.6", width);
    Some(Response { stimulus: stimulus?, absent: absent?, present: present? })
}

fn quantity_of(value: &Value) -> Result<&Quantity, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(quantity) => Ok(quantity),
        _ => Err(quantity::wrong_kind("a number with its unit", value.span)),
    }
}

fn width(value: &Value) -> Result<f64, Diagnostic> {
    width_of(quantity_of(value)?, value.span)
}

fn width_of(quantity: &Quantity, span: Span) -> Result<f64, Diagnostic> {
    let fault = |fault: Diagnostic| fault.with_help("actuation is a share of the width at rest");
    quantity::within(quantity::bare(quantity)?, WIDTHS, span).map_err(fault)
}

fn range(value: &Value) -> Result<(f64, f64), Diagnostic> {
    let ValueKind::Range(low, high) = &value.kind else {
        return Err(quantity::wrong_kind("a range such as `0.6..1.6`", value.span));
    };
    let (low, high) = (width_of(low, low.span())?, width_of(high, high.span())?);
    if low <= high {
        return Ok((low, high));
    }
    let fault = Diagnostic::new(Code::OutOfRange, "the range runs downwards", value.span, "here");
    Err(fault.with_help(format!("write `{high}..{low}`")))
}
