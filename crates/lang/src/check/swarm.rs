//! Swarms: a circuit made of a library's robots.

use crate::check::circuit::Headers;
use crate::check::fields::{self, Fields};
use crate::check::instance::instance;
use crate::check::names::{Home, Names};
use crate::check::quantity;
use crate::check::vocabulary::Vocabulary;
use crate::check::wording;
use crate::check::world::Worlds;
use crate::syntax::tree::{RecordDeclaration, ValueKind, ValueSyntax};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Hold, RegisterStyle, Swarm, WaveTimes};

/// The prelude declares it.
pub const DEFAULT_LIBRARY: &str = "shipped";

/// In cycles.
const MAX_WINDOW: u32 = 1000;

const REGISTERS: [(&str, RegisterStyle); 3] =
    [("master_slave", RegisterStyle::MasterSlave), ("mux", RegisterStyle::Mux), ("waves", RegisterStyle::Waves)];

/// In cycles.
const MAX_STEP: u32 = 100_000;

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
        _ => Err(wording::wrong_kind(&wording::name_of("circuit"), value.span)),
    });
    let library = fields.read("library", DEFAULT_LIBRARY.to_owned(), |value| {
        let name = fields::name(value, "library")?;
        names.libraries.resolve(name, home).map(|_| name.text.clone())
    });
    let hold = fields.read("hold", Hold::Auto, hold);
    let window = fields.read("window", 1, |value| cycles(value, MAX_WINDOW, "3 cycles"));
    let registers = fields.choose("registers", RegisterStyle::MasterSlave, &REGISTERS);
    let waves = wave_times(&mut fields);
    let world = fields.read("world", worlds.default(home), |value| worlds.of(value, home));
    faults.extend(fields.finish());
    let (name, span) = (source.name.text.clone(), source.name.span);
    Some(Swarm { name, span, circuit: circuit?, library, hold, window, registers, waves, world })
}

fn wave_times(fields: &mut Fields<'_>) -> WaveTimes {
    let mut time = |field, most| fields.read(field, None, |value| cycles(value, most, "2 cycles").map(Some));
    WaveTimes { beat: time("beat", MAX_WINDOW), step: time("step", MAX_STEP) }
}

fn cycles(value: &ValueSyntax, most: u32, example: &str) -> Result<u32, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(time) => {
            quantity::whole(f64::from(quantity::cycles(time)?), 1..=most, value.span, "cycles")
        }
        _ => Err(wording::wrong_kind(&wording::time_such_as(example), value.span)),
    }
}

fn hold(value: &ValueSyntax) -> Result<Hold, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(hold) => quantity::cycles(hold).map(Hold::Cycles),
        _ => fields::choice(value, &[("auto", Hold::Auto)])
            .map_err(|_| fields::not_one_of(value, wording::HOLD, &["auto"])),
    }
}
