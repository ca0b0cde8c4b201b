//! Swarms: a circuit made of a library's robots.

use crate::check::circuit::Headers;
use crate::check::fields::{self, Fields};
use crate::check::instance::instance;
use crate::check::names::{Home, Names};
use crate::check::quantity;
use crate::check::vocabulary::Vocabulary;
use crate::check::wording::Expected;
use crate::check::world::Worlds;
use crate::syntax::tree::{RecordDeclaration, ValueKind, ValueSyntax};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Hold, RegisterStyle, Swarm, WaveTimes};

/// The default library of a swarm; the prelude declares it.
pub const DEFAULT_LIBRARY: &str = "shipped";

/// The largest window of an output, in cycles.
const MAX_WINDOW: u32 = 1000;

/// What registers are made of, by name.
const REGISTERS: [(&str, RegisterStyle); 3] =
    [("master_slave", RegisterStyle::MasterSlave), ("mux", RegisterStyle::Mux), ("waves", RegisterStyle::Waves)];

/// The longest step of a wave machine, in cycles.
const MAX_STEP: u32 = 100_000;

/// Checks a swarm.
pub(crate) fn swarm(
    source: &RecordDeclaration,
    home: Home,
    names: &Names,
    declared: Vocabulary<'_>,
    headers: &Headers,
    worlds: Worlds<'_>,
    faults: &mut Vec<Diagnostic>,
) -> Option<Swarm> {
    let mut fields = Fields::new("swarm", source);
    let circuit = fields.need("circuit", "circuit: d_latch", |value| match &value.kind {
        ValueKind::Instance(source) => instance(source, home, declared, headers),
        _ => Err(quantity::wrong_kind(Expected::Name("circuit"), value.span)),
    });
    let library = fields.read("library", DEFAULT_LIBRARY.to_owned(), |value| {
        let name = fields::word(value, Expected::Name("library"))?;
        names.libraries.resolve(name, home).map(|_| name.text.clone())
    });
    let hold = fields.read("hold", Hold::Auto, hold);
    let window = fields.read("window", 1, |value| match &value.kind {
        ValueKind::Quantity(window) => {
            quantity::whole(f64::from(quantity::cycles(window)?), 1..=MAX_WINDOW, value.span, "cycles")
        }
        _ => Err(quantity::wrong_kind(Expected::Time("3 cycles"), value.span)),
    });
    let registers = fields.choose("registers", RegisterStyle::MasterSlave, &REGISTERS);
    let waves = wave_times(&mut fields);
    let world = fields.read("world", worlds.default(home), |value| worlds.of(value, home));
    faults.extend(fields.finish());
    let (name, span) = (source.name.text.clone(), source.name.span);
    Some(Swarm { name, span, circuit: circuit?, library, hold, window, registers, waves, world })
}

/// The times of a wave machine.
fn wave_times(fields: &mut Fields<'_>) -> WaveTimes {
    let mut time = |field, most| {
        let read = |value: &ValueSyntax| match &value.kind {
            ValueKind::Quantity(time) => {
                let cycles = f64::from(quantity::cycles(time)?);
                quantity::whole(cycles, 1..=most, value.span, "cycles").map(Some)
            }
            _ => Err(quantity::wrong_kind(Expected::Time("2 cycles"), value.span)),
        };
        fields.read(field, None, read)
    };
    WaveTimes { beat: time("beat", MAX_WINDOW), step: time("step", MAX_STEP) }
}

fn hold(value: &ValueSyntax) -> Result<Hold, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(hold) => quantity::cycles(hold).map(Hold::Cycles),
        _ => fields::choice(value, &[("auto", Hold::Auto)])
            .map_err(|_| fields::not_one_of(value, Expected::Hold, &["auto"])),
    }
}
