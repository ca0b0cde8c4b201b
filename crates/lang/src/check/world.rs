//! Worlds: factors of the paper's physics, and noise. A missing field is that of the world named by `from`. Also the
//! changes of sampled worlds.

use crate::check::derived::{self, CheckState};
use crate::check::fields::{self, Fields};
use crate::check::load::beside;
use crate::check::names::{Home, NameTable};
use crate::check::quantity;
use crate::check::wording;
use crate::syntax::tree::{NameSyntax, RecordDeclaration, ValueKind, ValueSyntax};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{GroundProfile, Hears, NamedWorld, PhysicsWorld, Variation, WorldFactors, WorldNoise};
use nbc_base::source::{SourceWorld, Sources, Span};

#[derive(Clone, Copy)]
pub(crate) struct Worlds<'a> {
    pub(crate) names: &'a NameTable,
    pub(crate) checked: &'a [CheckState<NamedWorld>],
}

impl Worlds<'_> {
    pub(crate) fn of(self, value: &ValueSyntax, home: Home) -> Result<NamedWorld, Diagnostic> {
        self.named(fields::name(value, "world")?, home)
    }

    pub(crate) fn default(self, home: Home) -> NamedWorld {
        let declared = self.names.find(NamedWorld::DEFAULT, home).map(|place| &self.checked[place]);
        if let Some(CheckState::Sound(named)) = declared { NamedWorld::clone(named) } else { NamedWorld::default() }
    }

    /// The paper's world if the named one has errors.
    pub(crate) fn named(self, name: &NameSyntax, home: Home) -> Result<NamedWorld, Diagnostic> {
        let found = &self.checked[self.names.resolve(name, home)?];
        Ok(if let CheckState::Sound(named) = found { NamedWorld::clone(named) } else { NamedWorld::default() })
    }
}

#[derive(Clone, Copy)]
pub(crate) struct ProgramFiles<'a> {
    pub(crate) world: &'a dyn SourceWorld,
    pub(crate) sources: &'a Sources,
}

pub(crate) fn world(
    source: &RecordDeclaration,
    home: Home,
    (names, checked): (&NameTable, &[CheckState<NamedWorld>]),
    files: ProgramFiles<'_>,
    faults: &mut Vec<Diagnostic>,
) -> CheckState<NamedWorld> {
    let mut fields = Fields::new("world", source);
    let base = fields.read("from", None, |value| derived::base(value, home, names, checked).map(Some));
    let (base, whole) = match base {
        Some(CheckState::Sound(base)) => (base.world, true),
        Some(_) => (PhysicsWorld::default(), false),
        None if source.name.text == NamedWorld::DEFAULT => (PhysicsWorld::default(), true),
        None => (Worlds { names, checked }.default(home).world, true),
    };
    let mut factor = |field, of: f64| fields.read(field, of, factor);
    let WorldFactors { friction, gravity, stiffness, drag, damping, swelling } = base.factors;
    let factors = WorldFactors {
        friction: factor("friction", friction),
        gravity: factor("gravity", gravity),
        stiffness: factor("stiffness", stiffness),
        drag: factor("drag", drag),
        damping: factor("damping", damping),
        swelling: factor("swelling", swelling),
    };
    let noise = WorldNoise {
        start: fields.read("start", base.noise.start, voxels),
        missed: fields.read("missed", base.noise.missed, share),
        weak: fields.read("weak", base.noise.weak, share),
        dead: fields.read("dead", base.noise.dead, share),
        phase: fields.read("phase", base.noise.phase, share),
        drift: fields.read("drift", base.noise.drift, |value| ratio(value, 0.0..=WorldNoise::MOST_DRIFT)),
        seed: fields.read("seed", base.noise.seed, |value| match &value.kind {
            ValueKind::Quantity(seed) => quantity::seed(seed),
            _ => Err(wording::wrong_kind(wording::NUMBER, value.span)),
        }),
    };
    if !whole || !fields.faults.is_empty() {
        fields.note_fault();
    }
    let WorldNoise { start, missed, dead, phase, drift, .. } = noise;
    for (field, amount) in [("start", start), ("missed", missed), ("dead", dead), ("phase", phase), ("drift", drift)] {
        if amount > 0.0 {
            fields.note(field, "");
        }
    }
    let hears = fields.choose("hears", base.hears, &[("cycle", Hears::Cycle), ("always", Hears::Always)]);
    let ground = fields.read("ground", base.ground, |value| ground(value, files));
    let found = fields.finish();
    let sound = found.is_empty() && whole;
    faults.extend(found);
    let world = PhysicsWorld { factors, noise, ground, hears };
    let named = || NamedWorld { name: source.name.text.clone(), world };
    if sound { CheckState::Sound(Box::new(named())) } else { CheckState::Faulty }
}

pub(crate) fn variation(value: &ValueSyntax) -> Result<Variation, Diagnostic> {
    let ValueKind::Record(record) = &value.kind else {
        return Err(wording::wrong_kind(wording::CHANGES, value.span));
    };
    let mut fields = Fields::inner("variation", value.span, record);
    let all = fields.read(Variation::ALL, 0.0, |value| change(Variation::ALL, value));
    let variation = Variation::of(|name| {
        let usual = if Variation::is_factor(name) { all } else { 0.0 };
        fields.read(name, usual, |value| change(name, value))
    });
    match fields.finish().into_iter().next() {
        Some(fault) => Err(fault),
        None => Ok(variation),
    }
}

fn change(name: &str, value: &ValueSyntax) -> Result<f64, Diagnostic> {
    if name == "start" { voxels(value) } else { ratio(value, 0.0..=Variation::most(name)) }
}

fn ground(value: &ValueSyntax, files: ProgramFiles<'_>) -> Result<GroundProfile, Diagnostic> {
    match &value.kind {
        ValueKind::Text(path) => return ground_file(path, value.span, files),
        ValueKind::Instance(_) => return Err(wording::wrong_kind(wording::GROUND, value.span)),
        _ => (),
    }
    let (values, most) = (fields::list(value), GroundProfile::MOST_HEIGHTS);
    match values.len() {
        0 => return Err(wording::empty_list("ground", value.span)),
        entries if entries > most => {
            return Err(wording::long_list("ground", entries, most, value.span));
        }
        _ => (),
    }
    let height = |value| quantity::count(value, 0..=GroundProfile::MOST_HEIGHT.into()).map(|height| height as u8);
    let heights: Vec<u8> = values.iter().map(height).collect::<Result<_, _>>()?;
    Ok(GroundProfile::new(&heights).expect("each height is in its range"))
}

fn ground_file(path: &str, span: Span, files: ProgramFiles<'_>) -> Result<GroundProfile, Diagnostic> {
    let file = beside(&files.sources.file(span.file).name, path);
    let text = files.world.read(&file).map_err(|error| wording::unreadable_value(&file, &error, span))?;
    GroundProfile::of_file(&text).map_err(|error| wording::ground(&file, &error, span))
}

fn factor(value: &ValueSyntax) -> Result<f64, Diagnostic> {
    ratio(value, WorldFactors::RANGE)
}

pub(crate) fn share(value: &ValueSyntax) -> Result<f64, Diagnostic> {
    ratio(value, 0.0..=1.0)
}

fn ratio(value: &ValueSyntax, range: std::ops::RangeInclusive<f64>) -> Result<f64, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(given) => quantity::within(quantity::ratio(given)?, range, value.span),
        _ => Err(wording::wrong_kind(wording::RATIO, value.span)),
    }
}

fn voxels(value: &ValueSyntax) -> Result<f64, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(given) => {
            quantity::within(quantity::bare(given)?, 0.0..=WorldNoise::MOST_START, value.span)
        }
        _ => Err(wording::wrong_kind(wording::NUMBER, value.span)),
    }
}
