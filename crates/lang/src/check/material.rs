//! Materials of voxels.

use crate::check::fields::{self, Fields};
use crate::check::images::Stimuli;
use crate::check::names::Home;
use crate::check::quantity::{self, Measure};
use crate::check::wording;
use crate::syntax::tree::{Quantity, RecordDeclaration, ValueKind, ValueSyntax};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Drive, Material, MaterialKind, Response};
use nbc_base::source::Span;

/// Widths of a voxel as a fraction of its rest width (docs/physics.md 3).
const WIDTHS: std::ops::RangeInclusive<f64> = 0.6..=1.6;

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Rigid,
    Soft,
    Actuator,
    Sensor,
}

pub(crate) fn material(
    source: &RecordDeclaration,
    home: Home,
    stimuli: Stimuli<'_>,
    faults: &mut Vec<Diagnostic>,
) -> Option<Material> {
    let mut fields = Fields::new("material", source);
    let kinds = [("rigid", Kind::Rigid), ("soft", Kind::Soft), ("actuator", Kind::Actuator), ("sensor", Kind::Sensor)];
    let kind = fields.need("kind", "kind: soft", |value| fields::choice(value, &kinds));
    let Some(kind) = kind else {
        faults.extend(fields.abandon());
        return None;
    };
    fields.note("kind", fields::word_of(&kinds, kind));
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

fn response(fields: &mut Fields<'_>, home: Home, stimuli: Stimuli<'_>) -> Option<Response> {
    let stimulus =
        fields.need("stimulus", "stimulus: s1", |value| stimuli.resolve(fields::name(value, "stimulus")?, home));
    let absent = fields.need("absent", "absent: 0.6", width);
    let present = fields.need("present", "present: 1.6", width);
    let (stimulus, image) = stimulus?;
    Some(Response { image, ..Response::of(stimulus, absent?, present?) })
}

fn quantity_of(value: &ValueSyntax) -> Result<&Quantity, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(quantity) => Ok(quantity),
        _ => Err(wording::wrong_kind(wording::QUANTITY, value.span)),
    }
}

fn width(value: &ValueSyntax) -> Result<f64, Diagnostic> {
    width_of(quantity_of(value)?, value.span)
}

fn width_of(quantity: &Quantity, span: Span) -> Result<f64, Diagnostic> {
    let found = quantity::bare(quantity)?;
    let (least, most) = WIDTHS.into_inner();
    if WIDTHS.contains(&found) { Ok(found) } else { Err(wording::width_outside(found, least, most, span)) }
}

fn range(value: &ValueSyntax) -> Result<(f64, f64), Diagnostic> {
    let ValueKind::Range(low, high) = &value.kind else {
        return Err(wording::wrong_kind(wording::RANGE, value.span));
    };
    let (first, last) = (width_of(low, low.span())?, width_of(high, high.span())?);
    if first <= last { Ok((first, last)) } else { Err(wording::descending(first, last, value.span)) }
}
